//! The format of the file: a line, a description, binary data, a checksum.

use super::Description;
use super::planes::{self, PlaneError, PlaneWriter, Planes};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use xca_core::{EngineFailure, Snapshot};
use xca_io::atomic::{WriteError, write_atomically};

/// The version of the format.
const FORMAT: u32 = 1;

/// The first word of every checkpoint.
const MAGIC: &str = "xca-checkpoint ";

/// The longest first line, in bytes.
const LONGEST_LINE: u64 = 100;

/// The size of the checksum, a CRC-32, in bytes.
const CHECKSUM: u64 = 4;

/// What is wrong with a checkpoint whose parts contradict each other.
const MISMATCH: &str = "its data do not match its description";

/// A checkpoint that cannot be used.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum CheckpointError {
    #[error("cannot read the checkpoint {}", path.display())]
    Read { path: PathBuf, source: io::Error },
    #[error("{} is not a checkpoint of an xca program", path.display())]
    NoCheckpoint { path: PathBuf },
    #[error("{} has format {format}; this program reads format {FORMAT}", path.display())]
    OtherFormat { path: PathBuf, format: u32 },
    #[error("{} is truncated: {found} bytes of {wanted}", path.display())]
    Truncated { path: PathBuf, found: u64, wanted: u64 },
    #[error("{} has been altered: {what}", path.display())]
    Altered { path: PathBuf, what: String },
    #[error("{} belongs to another run: its {what} is {found}, not {wanted}", path.display())]
    Foreign { path: PathBuf, what: &'static str, found: String, wanted: String },
}

/// A checkpoint that could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointWriteError {
    /// The file could not be written.
    #[error(transparent)]
    File(#[from] WriteError),
    /// The engine lost the state.
    #[error(transparent)]
    State(#[from] EngineFailure),
}

/// A reader or writer that computes the CRC-32 of all bytes.
struct Summed<T> {
    inner: T,
    sum: crc32fast::Hasher,
}

impl<T> Summed<T> {
    fn new(inner: T) -> Self {
        Self { inner, sum: crc32fast::Hasher::new() }
    }
}

impl<T: Write> Write for Summed<T> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

/// Writes a checkpoint.
pub(super) fn write(
    path: &Path,
    description: &Description,
    state: &impl Planes,
) -> Result<(), CheckpointWriteError> {
    let mut lost = None;
    let written = write_atomically(path, |file| {
        let text = serde_json::to_vec_pretty(description)?;
        let mut file = Summed::new(file);
        writeln!(file, "{MAGIC}{FORMAT} {} {}", text.len(), description.data_bytes())?;
        file.write_all(&text)?;
        state.write(&mut PlaneWriter::new(description, &mut file)).map_err(|error| match error {
            PlaneError::Write(error) => error,
            PlaneError::State(failure) => {
                lost = Some(failure);
                io::ErrorKind::Other.into()
            }
        })?;
        let sum = file.sum.finalize();
        file.inner.write_all(&sum.to_le_bytes())
    });
    match lost {
        Some(failure) => Err(failure.into()),
        None => Ok(written?),
    }
}

/// The lengths in the first line.
struct Lengths {
    line: u64,
    description: u64,
    data: u64,
}

impl Lengths {
    fn whole(&self) -> Option<u64> {
        [self.description, self.data, CHECKSUM].into_iter().try_fold(self.line, u64::checked_add)
    }
}

/// The beginning of a checkpoint. The next bytes of the file are its data.
pub(super) struct Opened {
    pub(super) description: Description,
    /// The place of the data in the file.
    pub(super) start: u64,
}

/// Opens a file that has `found` bytes. Checks the checksum, and the size of the data.
pub(super) fn open(
    path: &Path,
    file: &mut (impl Read + Seek),
    found: u64,
) -> Result<Opened, CheckpointError> {
    let failed = |source| CheckpointError::Read { path: path.to_owned(), source };
    let lengths = first_line(path, file, found)?;
    let altered = |what: String| CheckpointError::Altered { path: path.to_owned(), what };
    let wanted = lengths.whole().ok_or_else(|| altered("its first line is invalid".to_owned()))?;
    if found < wanted {
        return Err(CheckpointError::Truncated { path: path.to_owned(), found, wanted });
    }
    if found > wanted {
        return Err(altered(format!("it has {found} bytes, but its first line says {wanted}")));
    }
    file.rewind().map_err(failed)?;
    let mut sum = Summed::new(io::sink());
    io::copy(&mut file.by_ref().take(wanted - CHECKSUM), &mut sum).map_err(failed)?;
    let mut stored = [0; CHECKSUM as usize];
    file.read_exact(&mut stored).map_err(failed)?;
    if sum.sum.finalize().to_le_bytes() != stored {
        return Err(altered("its checksum does not match its content".to_owned()));
    }
    file.seek(io::SeekFrom::Start(lengths.line)).map_err(failed)?;
    let mut description = Vec::with_capacity(usize::try_from(lengths.description).unwrap_or(0));
    file.by_ref().take(lengths.description).read_to_end(&mut description).map_err(failed)?;
    let description: Description = serde_json::from_slice(&description)
        .map_err(|error| altered(format!("its description is invalid: {error}")))?;
    if !description.makes_sense(lengths.data) {
        return Err(altered(MISMATCH.to_owned()));
    }
    Ok(Opened { description, start: lengths.line + lengths.description })
}

/// Reads the state of a checkpoint that has been opened.
pub(super) fn read(
    path: &Path,
    description: &Description,
    file: impl Read,
) -> Result<Snapshot, CheckpointError> {
    planes::read(description, file).map_err(|error| unread(path, error))
}

/// The error for data that cannot be read, or that do not match their description.
pub(super) fn unread(path: &Path, error: io::Error) -> CheckpointError {
    let path = path.to_owned();
    match error.kind() {
        io::ErrorKind::InvalidData | io::ErrorKind::UnexpectedEof => {
            CheckpointError::Altered { path, what: MISMATCH.to_owned() }
        }
        _ => CheckpointError::Read { path, source: error },
    }
}

fn first_line(path: &Path, file: &mut impl Read, found: u64) -> Result<Lengths, CheckpointError> {
    let mut start = Vec::new();
    let read = file.take(LONGEST_LINE).read_to_end(&mut start);
    read.map_err(|source| CheckpointError::Read { path: path.to_owned(), source })?;
    let line = start.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let has_end = line.len() < start.len();
    let text = String::from_utf8_lossy(line).into_owned();
    let no_checkpoint = || CheckpointError::NoCheckpoint { path: path.to_owned() };
    let Some(numbers) = text.strip_prefix(MAGIC) else {
        let is_beginning = !has_end && MAGIC.starts_with(&text);
        return Err(if is_beginning { cut_off(path, found) } else { no_checkpoint() });
    };
    if !has_end {
        return Err(if found < LONGEST_LINE { cut_off(path, found) } else { no_checkpoint() });
    }
    let (format, lengths) = numbers.split_once(' ').ok_or_else(no_checkpoint)?;
    let format: u32 = format.parse().map_err(|_| no_checkpoint())?;
    if format != FORMAT {
        return Err(CheckpointError::OtherFormat { path: path.to_owned(), format });
    }
    let lengths = lengths.split_once(' ').and_then(|(description, data)| {
        let line = line.len() as u64 + 1;
        Some(Lengths { line, description: description.parse().ok()?, data: data.parse().ok()? })
    });
    lengths.ok_or_else(|| CheckpointError::Altered {
        path: path.to_owned(),
        what: "its first line is invalid".to_owned(),
    })
}

/// The error for a file that ends in its first line.
fn cut_off(path: &Path, found: u64) -> CheckpointError {
    CheckpointError::Truncated { path: path.to_owned(), found, wanted: LONGEST_LINE }
}
