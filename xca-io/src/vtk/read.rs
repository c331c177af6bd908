//! Reading back the files that this crate writes: these, and no other forms that VTK knows.

use std::io;
use std::path::{Path, PathBuf};

use super::Grid;
use super::appended::{COMPONENT_NAME, DATA, END, STATES_OF, escaped, head, read_names, unescaped};
use super::blocks::{Broken, expanded};
use super::dense::{GHOST_TYPE, hidden_cells};
use crate::regular_file;

/// The array that tells the time.
const TIME: &str = "TimeValue";

/// No value has more components: their names alone would fill the memory.
const MOST_COMPONENTS: usize = 1 << 20;

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
    /// What follows the name of the array in the name of each component: nothing for a scalar, else `.x`,
    /// `[3]`, `[3].x`.
    pub component_names: Vec<String>,
    /// What its values are called, by number, if they are states.
    pub states: Vec<String>,
    /// The numbers, in the byte order of this machine.
    pub bytes: Vec<u8>,
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

/// Reads dense substates from `path` (`.vti`).
///
/// # Errors
/// [`ReadVtkError`] where the file is not one that [`super::write_dense`] has written.
pub fn read_dense(path: &Path) -> Result<DenseFile, ReadVtkError> {
    let parts = Parts::read(path, "ImageData")?;
    let grid = parts.grid().ok_or_else(|| parts.foreign("its grid makes no sense"))?;
    let cells = grid.cells.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
    let cells = cells.ok_or_else(|| parts.foreign("its grid makes no sense"))?;
    let (time, mut arrays) = parts.arrays(cells)?;
    let is_ghosts = |array: &ReadArray| array.name == GHOST_TYPE;
    let hidden = arrays.iter().position(is_ghosts).map(|at| arrays.remove(at));
    let is_whole = |ghosts: &ReadArray| ghosts.numbers == NumberType::U8 && ghosts.components == 1;
    if !hidden.as_ref().is_none_or(is_whole) {
        return Err(parts.foreign("its ghost types make no sense"));
    }
    let hidden = hidden.map(|ghosts| hidden_cells(&ghosts.bytes));
    Ok(DenseFile { time, grid, hidden, arrays })
}

/// Reads particles from `path` (`.vtp`).
///
/// # Errors
/// [`ReadVtkError`] where the file is not one that [`super::write_particles`] has written.
pub fn read_particles(path: &Path) -> Result<ParticleFile, ReadVtkError> {
    let parts = Parts::read(path, "PolyData")?;
    let count = parts.attribute("<Piece ", "NumberOfPoints").and_then(|count| count.parse().ok());
    let count = count.ok_or_else(|| parts.foreign("it does not say how many points it has"))?;
    let (time, mut arrays) = parts.arrays(count)?;
    // The points, and which of them belong to which vertex, come before what the points have.
    let names: Vec<&str> = arrays.iter().take(3).map(|array| array.name.as_str()).collect();
    if names != ["Points", "connectivity", "offsets"] || arrays[0].components != 3 {
        return Err(parts.foreign("it has no points"));
    }
    let positions = arrays.remove(0);
    arrays.drain(..2);
    Ok(ParticleFile { time, positions, arrays })
}

/// A file in its parts.
struct Parts<'a> {
    path: &'a Path,
    /// The lines of XML.
    head: String,
    /// What follows them.
    data: Vec<u8>,
}

impl<'a> Parts<'a> {
    fn read(path: &'a Path, kind: &str) -> Result<Self, ReadVtkError> {
        let mut bytes = regular_file::read(path, u64::MAX)
            .map_err(|source| ReadVtkError::Read { path: path.to_owned(), source })?;
        let foreign = |what| ReadVtkError::Foreign { path: path.to_owned(), what };
        let truncated = || ReadVtkError::Truncated { path: path.to_owned(), found: bytes.len() };
        let first = head(kind);
        if !bytes.starts_with(first.as_bytes()) {
            let is_beginning = first.as_bytes().starts_with(&bytes);
            return Err(if is_beginning { truncated() } else { foreign("its first lines are others") });
        }
        let Some(end) = bytes.windows(DATA.len()).position(|window| window == DATA.as_bytes()) else {
            return Err(truncated());
        };
        let data = bytes.split_off(end + DATA.len());
        bytes.truncate(end);
        let head = String::from_utf8(bytes).map_err(|_| foreign("its first lines are no text"))?;
        Ok(Self { path, head, data })
    }

    fn foreign(&self, what: &'static str) -> ReadVtkError {
        ReadVtkError::Foreign { path: self.path.to_owned(), what }
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

    /// The time, and all arrays, which have so many values each.
    fn arrays(&self, count: usize) -> Result<(f64, Vec<ReadArray>), ReadVtkError> {
        let wrong = || self.foreign("one of its arrays makes no sense");
        let mut arrays = Vec::new();
        let mut rest = self.data.as_slice();
        for line in self.head.lines().filter(|line| line.starts_with("<DataArray ")) {
            let element = Element::new(line, count).ok_or_else(wrong)?;
            // The values of one array follow those of the one before.
            if element.offset != self.data.len() - rest.len() {
                return Err(wrong());
            }
            let (bytes, others) = expanded(rest, element.length).map_err(|broken| match broken {
                Broken::Short => self.truncated(),
                Broken::Wrong => self.foreign("its data are not those of its arrays"),
            })?;
            let states = self.states_of(&element.name).ok_or_else(wrong)?;
            arrays.push(element.array(bytes, states));
            rest = others;
        }
        if rest != END.as_bytes() {
            let is_short = END.as_bytes().starts_with(rest);
            return Err(if is_short {
                self.truncated()
            } else {
                self.foreign("it goes on where it should end")
            });
        }
        match arrays.first() {
            Some(ReadArray { name, bytes, .. }) if name == TIME && bytes.len() == 8 => {
                let time = arrays.remove(0).bytes.as_chunks().0[0];
                Ok((f64::from_ne_bytes(time), arrays))
            }
            _ => Err(self.foreign("it does not say its time")),
        }
    }

    /// The names of the states of an array; none where it has numbers.
    fn states_of(&self, array: &str) -> Option<Vec<String>> {
        let start = format!("{STATES_OF}{}\" ", escaped(array));
        let element = self.head.lines().find(|line| line.starts_with(&start));
        element.map_or(Some(Vec::new()), read_names)
    }

    fn truncated(&self) -> ReadVtkError {
        let found = self.head.len() + DATA.len() + self.data.len();
        ReadVtkError::Truncated { path: self.path.to_owned(), found }
    }
}

/// An attribute of an element.
fn attribute(element: &str, name: &str) -> Option<String> {
    let value = element.split_once(&format!(" {name}=\""))?.1.split_once('"')?.0;
    Some(unescaped(value))
}

/// What the head says of an array.
struct Element {
    name: String,
    numbers: NumberType,
    components: usize,
    component_names: Vec<String>,
    /// Where its values stand, and how many bytes they are when they are expanded.
    offset: usize,
    length: usize,
}

impl Element {
    /// From a line of the head; `count` is the number of its values.
    fn new(element: &str, count: usize) -> Option<Self> {
        let (numbers, size) = match attribute(element, "type")?.as_str() {
            "UInt8" => (NumberType::U8, 1),
            "Int32" => (NumberType::I32, 4),
            "UInt32" => (NumberType::U32, 4),
            "Float32" => (NumberType::F32, 4),
            "Float64" => (NumberType::F64, 8),
            _ => return None,
        };
        let number = |name: &str| attribute(element, name).map(|text| text.parse::<usize>());
        let components = number("NumberOfComponents").unwrap_or(Ok(1)).ok()?;
        if !(1..=MOST_COMPONENTS).contains(&components) {
            return None;
        }
        // The time alone is one number in a file of many values.
        let given = number("NumberOfTuples").transpose().ok()?;
        let name = attribute(element, "Name")?;
        let is_time = name == TIME && given == Some(1);
        let count = if is_time {
            1
        } else {
            Some(count).filter(|count| given.is_none_or(|given| given == *count))?
        };
        let length = count.checked_mul(components)?.checked_mul(size)?;
        let component_name = |number: usize| {
            let given = attribute(element, &format!("{COMPONENT_NAME}{number}"));
            given.unwrap_or_else(|| default_name(number, components))
        };
        let component_names = (0..components).map(component_name).collect();
        let offset = number("offset")?.ok()?;
        Some(Self { name, numbers, components, component_names, offset, length })
    }

    /// The array with its values.
    fn array(self, bytes: Vec<u8>, states: Vec<String>) -> ReadArray {
        let Self { name, numbers, components, component_names, .. } = self;
        ReadArray {
            name,
            numbers,
            components,
            component_names,
            states,
            bytes: numbers.of_this_machine(bytes),
        }
    }
}

/// What follows the name of an array for a component that the file does not name.
fn default_name(number: usize, components: usize) -> String {
    match (components, [".x", ".y", ".z", ".w"].get(number)) {
        (1, _) => String::new(),
        (2..=4, Some(lane)) => (*lane).to_owned(),
        _ => format!("[{number}]"),
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
