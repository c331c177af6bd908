//! Reading back the files that this crate writes: these, and no other forms that VTK knows.

mod element;

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use super::Grid;
use super::appended::{DATA, END, STATES_OF, head, read_names, unescaped};
use super::blocks::{Broken, Source};
use super::dense::{GHOST_TYPE, hidden_cells};
use crate::deflate::can_hold;
use crate::regular_file;
use element::{Element, attribute, default_name};

/// The array that tells the time.
const TIME: &str = "TimeValue";

/// No file has longer lines of XML, in bytes.
const LONGEST_HEAD: u64 = 1 << 24;

/// A VTK file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadVtkError {
    /// The file is not there or not readable.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file ends too early.
    #[error("{} is truncated: it ends after {found} bytes", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// The bytes that it has.
        found: usize,
    },
    /// The values do not fit into memory.
    #[error("the values of {} take {needed} bytes of memory, and {most} are free", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The bytes of its values.
        needed: u64,
        /// The most bytes that they may have.
        most: u64,
    },
    /// The file is something else, or was changed.
    #[error("{} is not a VTK file as this program writes them: {what}", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What is not as it should be.
        what: &'static str,
    },
}

/// What the numbers of an array are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum NumberType {
    U8,
    I32,
    U32,
    F32,
    F64,
}

/// An array with its values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadArray {
    /// Its name.
    pub name: String,
    /// What its numbers are.
    pub numbers: NumberType,
    /// How many of them a value has.
    pub components: usize,
    /// What follows the name of the array in the names of its components, where the file tells it.
    /// [`Self::component_name`] knows it of all.
    pub component_names: Vec<String>,
    /// What its values are called, by number, if they are states.
    pub states: Vec<String>,
    /// The numbers, in the byte order of this machine.
    pub bytes: Vec<u8>,
}

impl ReadArray {
    /// What follows the name of the array in the name of a component: nothing for a scalar, else `.x`, `[3]`,
    /// `[3].x`.
    pub fn component_name(&self, component: usize) -> String {
        let given = self.component_names.get(component).cloned();
        given.unwrap_or_else(|| default_name(component, self.components))
    }
}

/// What [`super::write_dense`] has written.
#[derive(Debug, Clone, PartialEq)]
pub struct DenseFile {
    /// The simulated time.
    pub time: f64,
    /// The cells.
    pub grid: Grid,
    /// Which cells are hidden, if the file has an array [`super::GHOST_TYPE`].
    pub hidden: Option<Vec<bool>>,
    /// One value for each cell, x fastest, then y.
    pub arrays: Vec<ReadArray>,
}

/// What [`super::write_particles`] has written.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleFile {
    /// The simulated time.
    pub time: f64,
    /// Where the particles are.
    pub positions: ReadArray,
    /// One value for each particle.
    pub arrays: Vec<ReadArray>,
}

/// Reads dense substates from `path` (`.vti`), whose values may take at most `most` bytes of memory.
///
/// # Errors
/// [`ReadVtkError`] where the file is not one that [`super::write_dense`] has written, or is too large.
pub fn read_dense(path: &Path, most: u64) -> Result<DenseFile, ReadVtkError> {
    let parts = Parts::read(path, "ImageData", most)?;
    let grid = parts.grid().ok_or_else(|| parts.foreign("its grid makes no sense"))?;
    let cells = grid.cells.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
    let cells = cells.ok_or_else(|| parts.foreign("its grid makes no sense"))?;
    let (time, mut arrays) = parts.arrays(cells)?;
    let is_ghosts = |array: &ReadArray| array.name == GHOST_TYPE;
    let hidden = arrays.iter().position(is_ghosts).map(|at| arrays.remove(at));
    let is_whole = |ghosts: &ReadArray| ghosts.numbers == NumberType::U8 && ghosts.components == 1;
    if !hidden.as_ref().is_none_or(is_whole) {
        return Err(foreign(path, "its ghost types make no sense"));
    }
    let hidden = hidden.map(|ghosts| hidden_cells(&ghosts.bytes));
    Ok(DenseFile { time, grid, hidden, arrays })
}

/// Reads particles from `path` (`.vtp`), whose values may take at most `most` bytes of memory.
///
/// # Errors
/// [`ReadVtkError`] where the file is not one that [`super::write_particles`] has written, or is too large.
pub fn read_particles(path: &Path, most: u64) -> Result<ParticleFile, ReadVtkError> {
    let parts = Parts::read(path, "PolyData", most)?;
    let count = parts.attribute("<Piece ", "NumberOfPoints").and_then(|count| count.parse().ok());
    let count = count.ok_or_else(|| parts.foreign("it does not say how many points it has"))?;
    let (time, mut arrays) = parts.arrays(count)?;
    // The points, and which of them belong to which vertex, come before what the points have.
    let names: Vec<&str> = arrays.iter().take(3).map(|array| array.name.as_str()).collect();
    if names != ["Points", "connectivity", "offsets"] || arrays[0].components != 3 {
        return Err(foreign(path, "it has no points"));
    }
    let positions = arrays.remove(0);
    arrays.drain(..2);
    Ok(ParticleFile { time, positions, arrays })
}

fn foreign(path: &Path, what: &'static str) -> ReadVtkError {
    ReadVtkError::Foreign { path: path.to_owned(), what }
}

/// A file in its parts.
struct Parts<'a> {
    path: &'a Path,
    /// The lines of XML.
    head: String,
    /// What follows them.
    data: Source<BufReader<File>>,
    /// The bytes of the file.
    found: usize,
    /// The most bytes that its values may have.
    most: u64,
}

impl<'a> Parts<'a> {
    fn read(path: &'a Path, kind: &str, most: u64) -> Result<Self, ReadVtkError> {
        let failed = |source| ReadVtkError::Read { path: path.to_owned(), source };
        let file = regular_file::open(path).map_err(failed)?;
        let found = file.metadata().map_err(failed)?.len();
        let truncated = || ReadVtkError::Truncated { path: path.to_owned(), found: found as usize };
        let mut file = BufReader::with_capacity(1 << 18, file);
        let first = head(kind);
        let mut bytes = Vec::new();
        file.by_ref().take(first.len() as u64).read_to_end(&mut bytes).map_err(failed)?;
        if bytes != first.as_bytes() {
            let is_beginning = first.as_bytes().starts_with(&bytes);
            return Err(if is_beginning { truncated() } else { foreign(path, "its first lines are others") });
        }
        let mut limited = file.by_ref().take(LONGEST_HEAD);
        while !bytes.ends_with(DATA.as_bytes()) {
            // The values begin behind a mark.
            if limited.read_until(b'_', &mut bytes).map_err(failed)? == 0 {
                let is_long = bytes.len() as u64 > LONGEST_HEAD;
                return Err(if is_long {
                    foreign(path, "its first lines are too long")
                } else {
                    truncated()
                });
            }
        }
        let left = found.saturating_sub(bytes.len() as u64);
        bytes.truncate(bytes.len() - DATA.len());
        let head = String::from_utf8(bytes).map_err(|_| foreign(path, "its first lines are no text"))?;
        Ok(Self { path, head, data: Source::new(file, left), found: found as usize, most })
    }

    fn foreign(&self, what: &'static str) -> ReadVtkError {
        foreign(self.path, what)
    }

    /// An attribute of the first element that begins so.
    fn attribute(&self, element: &str, name: &str) -> Option<String> {
        attribute(self.head.lines().find(|line| line.starts_with(element))?, name)
    }

    fn grid(&self) -> Option<Grid> {
        let numbers = |name: &str| -> Option<Vec<f64>> {
            let text = self.attribute("<ImageData ", name)?;
            text.split(' ').map(|number| number.parse().ok()).collect()
        };
        let extent = self.attribute("<Piece ", "Extent")?;
        let extent: Vec<usize> = extent.split(' ').map(|n| n.parse().ok()).collect::<Option<_>>()?;
        let [0, nx, 0, ny, 0, nz] = extent[..] else { return None };
        let (origin, spacing) = (numbers("Origin")?, numbers("Spacing")?);
        Some(Grid { cells: [nx, ny, nz], origin: origin.try_into().ok()?, spacing: spacing.try_into().ok()? })
    }

    /// What the head says of the arrays, which have so many values each.
    fn elements(&self, count: usize) -> Result<Vec<Element>, ReadVtkError> {
        let lines = self.head.lines().filter(|line| line.starts_with("<DataArray "));
        let elements = lines.map(|line| Element::new(line, count)).collect::<Option<Vec<_>>>();
        let elements = elements.ok_or_else(|| self.foreign("one of its arrays makes no sense"))?;
        let needed = elements.iter().fold(0_u64, |sum, element| sum.saturating_add(element.length as u64));
        // Before anything is expanded.
        if !can_hold(self.data.left(), needed) {
            return Err(self.truncated());
        }
        if needed > self.most {
            return Err(ReadVtkError::TooLarge { path: self.path.to_owned(), needed, most: self.most });
        }
        Ok(elements)
    }

    /// The time, and all arrays, which have so many values each.
    fn arrays(mut self, count: usize) -> Result<(f64, Vec<ReadArray>), ReadVtkError> {
        let elements = self.elements(count)?;
        let states = self.states();
        let begin = self.data.left();
        let mut arrays = Vec::new();
        for element in elements {
            // The values of one array follow those of the one before.
            let states = states.get(&element.name).map_or(Some(Vec::new()), |line| read_names(line));
            let is_next = element.offset as u64 == begin - self.data.left();
            let (true, Some(states)) = (is_next, states.filter(|states| element.can_have(states))) else {
                return Err(self.foreign("one of its arrays makes no sense"));
            };
            let bytes = self.data.expanded(element.length).map_err(|broken| match broken {
                Broken::Short => self.truncated(),
                Broken::Wrong => self.foreign("its data are not those of its arrays"),
                Broken::Read(source) => ReadVtkError::Read { path: self.path.to_owned(), source },
            })?;
            arrays.push(element.array(bytes, states));
        }
        self.check_end()?;
        match arrays.first() {
            Some(ReadArray { name, bytes, .. }) if name == TIME && bytes.len() == 8 => {
                let time = arrays.remove(0).bytes.as_chunks().0[0];
                Ok((f64::from_ne_bytes(time), arrays))
            }
            _ => Err(self.foreign("it does not say its time")),
        }
    }

    /// Checks that nothing but the last lines is left.
    fn check_end(&mut self) -> Result<(), ReadVtkError> {
        let mut end = vec![0; self.data.left().min(END.len() as u64 + 1) as usize];
        // A file that has become shorter meanwhile does not end as it should either.
        let is_read = self.data.fill(&mut end).is_ok();
        match end.as_slice() {
            end if is_read && end == END.as_bytes() => Ok(()),
            end if END.as_bytes().starts_with(end) => Err(self.truncated()),
            _ => Err(self.foreign("it goes on where it should end")),
        }
    }

    /// The elements with the names of states, by the arrays that they are of.
    fn states(&self) -> HashMap<String, String> {
        let of_line = |line: &str| {
            let (array, _) = line.strip_prefix(STATES_OF)?.split_once('"')?;
            Some((unescaped(array), line.to_owned()))
        };
        self.head.lines().filter_map(of_line).collect()
    }

    fn truncated(&self) -> ReadVtkError {
        ReadVtkError::Truncated { path: self.path.to_owned(), found: self.found }
    }
}

impl NumberType {
    /// Numbers of a file, which are little-endian, as this machine has them.
    fn of_this_machine(self, mut bytes: Vec<u8>) -> Vec<u8> {
        let size = match self {
            Self::U8 => 1,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        };
        if cfg!(target_endian = "big") {
            bytes.chunks_exact_mut(size).for_each(<[u8]>::reverse);
        }
        bytes
    }
}

#[cfg(test)]
mod tests;
