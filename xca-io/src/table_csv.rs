//! A time series as CSV, written row by row during a run.
//!
//! The header is `step,time`, then the names of the observables. Time is in seconds or in the unit of the
//! model. Each row is written at once, as soon as it is known. After Ctrl-C or the end of the process, the
//! file therefore holds complete rows. A crash of the machine is the exception. Numbers are the shortest
//! decimals that read back as the same `f64`.

use crate::regular_file;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// A time series that cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SeriesError {
    /// The file cannot be made or written.
    #[error("cannot write the time series {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A row has more or fewer values than the header has names.
    #[error("cannot write row `step {step}` of {}: {found} values for {expected} names", path.display())]
    Width {
        /// The file.
        path: PathBuf,
        /// The step of the row.
        step: u64,
        /// The number of names.
        expected: usize,
        /// The number of values.
        found: usize,
    },
    /// The file does not begin with the rows that were written.
    #[error("cannot continue the time series {}: its first {bytes} bytes have changed", path.display())]
    Changed {
        /// The file.
        path: PathBuf,
        /// The length of those rows in bytes.
        bytes: u64,
    },
    /// Two columns have the same name.
    #[error("cannot write the time series {}: the name `{name}` is used twice", path.display())]
    RepeatedName {
        /// The file.
        path: PathBuf,
        /// The name.
        name: String,
    },
}

/// A writer of time series.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let temporary = tempfile::tempdir()?;
/// # let path = temporary.path().join("observables.csv");
/// use xca_io::table_csv::SeriesWriter;
///
/// let mut series = SeriesWriter::create(&path, &["particles", "kinetic energy"])?;
/// series.append(0, 0.0, &[2602.0, 0.0])?;
/// series.append(100, 1.118e-3, &[2602.0, 1.5631e-4])?;
/// assert_eq!(
///     std::fs::read_to_string(&path)?,
///     "step,time,particles,kinetic energy\n0,0,2602,0\n100,0.001118,2602,0.00015631\n"
/// );
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct SeriesWriter {
    path: PathBuf,
    file: File,
    names: usize,
    written: Written,
}

/// The amount of a time series that has been written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Written {
    /// The length of the file in bytes.
    pub bytes: u64,
    /// The CRC-32 of the file.
    pub crc32: u32,
}

impl SeriesWriter {
    /// Creates the file and writes its header. Overwrites an earlier file.
    ///
    /// # Errors
    /// [`SeriesError::Write`] and [`SeriesError::RepeatedName`] (`step` and `time` are reserved).
    pub fn create(path: &Path, names: &[&str]) -> Result<Self, SeriesError> {
        let header: Vec<&str> = ["step", "time"].iter().chain(names).copied().collect();
        if let Some(i) = (0..header.len()).find(|&i| header[..i].contains(&header[i])) {
            return Err(SeriesError::RepeatedName { path: path.to_owned(), name: header[i].to_owned() });
        }
        let file =
            File::create(path).map_err(|source| SeriesError::Write { path: path.to_owned(), source })?;
        let mut series =
            Self { path: path.to_owned(), file, names: names.len(), written: Written::default() };
        series.write_row(&header)?;
        Ok(series)
    }

    /// Resumes a file with `names` columns. Cuts off everything beyond `written`.
    ///
    /// # Errors
    /// [`SeriesError::Write`], and [`SeriesError::Changed`] if the file does not begin with the written rows.
    pub fn resume(path: &Path, names: usize, written: Written) -> Result<Self, SeriesError> {
        let opened =
            regular_file::check(path).and_then(|()| File::options().read(true).write(true).open(path));
        let resumed = opened.and_then(|mut file| {
            let mut start = Vec::new();
            Read::by_ref(&mut file).take(written.bytes).read_to_end(&mut start)?;
            Ok((file, start))
        });
        let failed = |source| SeriesError::Write { path: path.to_owned(), source };
        let (file, start) = resumed.map_err(failed)?;
        if start.len() as u64 != written.bytes || crc32fast::hash(&start) != written.crc32 {
            return Err(SeriesError::Changed { path: path.to_owned(), bytes: written.bytes });
        }
        file.set_len(written.bytes).map_err(failed)?;
        Ok(Self { path: path.to_owned(), file, names, written })
    }

    /// The amount written, after it has been flushed to the disk.
    ///
    /// # Errors
    /// [`SeriesError::Write`].
    pub fn written(&self) -> Result<Written, SeriesError> {
        let synced = self.file.sync_data();
        synced.map_err(|source| SeriesError::Write { path: self.path.clone(), source })?;
        Ok(self.written)
    }

    /// Appends a row and hands it to the system. The values are in the order of the names. `NaN` and `inf`
    /// are written as such.
    ///
    /// # Errors
    /// [`SeriesError::Width`] and [`SeriesError::Write`].
    pub fn append(&mut self, step: u64, time: f64, values: &[f64]) -> Result<(), SeriesError> {
        if values.len() != self.names {
            let (path, expected, found) = (self.path.clone(), self.names, values.len());
            return Err(SeriesError::Width { path, step, expected, found });
        }
        let numbers = std::iter::once(&time).chain(values).map(|&value| shortest(value));
        let row: Vec<String> = std::iter::once(step.to_string()).chain(numbers).collect();
        self.write_row(&row)
    }

    fn write_row<T: AsRef<[u8]>>(&mut self, fields: &[T]) -> Result<(), SeriesError> {
        let mut csv = csv::Writer::from_writer(Vec::new());
        let row = csv
            .write_record(fields)
            .map_err(io::Error::from)
            .and_then(|()| csv.into_inner().map_err(|error| io::Error::other(error.to_string())));
        let row = row.and_then(|row| self.file.write_all(&row).map(|()| row));
        let row = row.map_err(|source| SeriesError::Write { path: self.path.clone(), source })?;
        let mut sum = crc32fast::Hasher::new_with_initial_len(self.written.crc32, self.written.bytes);
        sum.update(&row);
        self.written = Written { bytes: self.written.bytes + row.len() as u64, crc32: sum.finalize() };
        Ok(())
    }
}

/// The shortest decimal that reads back as `value`. Integers have no point. Very small and very large values
/// have an exponent.
fn shortest(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 { format!("{value}") } else { format!("{value:?}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn every_row_is_in_the_file_as_soon_as_it_is_appended() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("o.csv");
        let mut series = SeriesWriter::create(&path, &["energy", "a, b"]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "step,time,energy,\"a, b\"\n");
        series.append(0, 0.0, &[0.25, -3.0]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap().lines().count(), 2);
        series.append(1, 1.118_034e-5, &[1.0e22, f64::NAN]).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.ends_with("\n0,0,0.25,-3\n1,1.118034e-5,1e22,NaN\n"), "{text}");
    }

    #[test]
    fn a_series_goes_on_where_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("o.csv");
        let mut series = SeriesWriter::create(&path, &["energy"]).unwrap();
        series.append(0, 0.0, &[1.0]).unwrap();
        let written = series.written().unwrap();
        let text = fs::read(&path).unwrap();
        assert_eq!(written, Written { bytes: text.len() as u64, crc32: crc32fast::hash(&text) });
        series.append(5, 0.5, &[2.0]).unwrap();
        let whole = fs::read(&path).unwrap();
        // A row that the end of the process cut off.
        fs::write(&path, &whole[..whole.len() - 1]).unwrap();
        let mut series = SeriesWriter::resume(&path, 1, written).unwrap();
        assert_eq!(fs::read(&path).unwrap(), text);
        series.append(5, 0.5, &[2.0]).unwrap();
        assert_eq!(fs::read(&path).unwrap(), whole);
        assert!(series.append(6, 0.6, &[]).is_err());
        for changed in [&whole[..text.len() - 1], b"step,time,energy\n0,0,7\n"] {
            fs::write(&path, changed).unwrap();
            let error = SeriesWriter::resume(&path, 1, written).unwrap_err().to_string();
            assert!(error.contains("its first 23 bytes have changed"), "{error}");
            assert_eq!(fs::read(&path).unwrap(), changed);
        }
    }

    #[test]
    fn only_a_regular_file_goes_on() {
        if cfg!(unix) {
            let folder = tempfile::tempdir().unwrap();
            let pipe = folder.path().join("o.csv");
            assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
            let error = SeriesWriter::resume(&pipe, 1, Written::default()).unwrap_err();
            let SeriesError::Write { source, .. } = error else { panic!("{error}") };
            assert_eq!(source.kind(), io::ErrorKind::InvalidInput);
        }
    }

    #[test]
    fn numbers_read_back_exactly() {
        let mut bits = 1_u64;
        for _ in 0..2000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = f64::from_bits(bits);
            if value.is_finite() {
                assert_eq!(shortest(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
            }
        }
        for value in [-0.0, 315_979.0, 1e15, 0.1 + 0.2, 5e-324, f64::MAX] {
            assert_eq!(shortest(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
        assert_eq!(shortest(315_979.0), "315979");
    }

    #[test]
    fn a_row_of_the_wrong_width_is_refused_and_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("o.csv");
        let mut series = SeriesWriter::create(&path, &["energy"]).unwrap();
        let error = series.append(5, 0.1, &[1.0, 2.0]).unwrap_err();
        assert!(error.to_string().contains("2 values for 1 names"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "step,time,energy\n");
    }

    #[test]
    fn a_name_used_twice_and_a_missing_folder_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        let error = SeriesWriter::create(&folder.path().join("o.csv"), &["a", "time"]).unwrap_err();
        assert!(error.to_string().contains("the name `time` is used twice"), "{error}");
        let error = SeriesWriter::create(&folder.path().join("missing/o.csv"), &[]).unwrap_err();
        assert!(error.to_string().contains("missing/o.csv"), "{error}");
    }
}
