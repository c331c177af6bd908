//! Readers of the VTK files that this crate writes, and of no others.

mod collection;
mod element;
mod found;

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use super::appended::{DATA, END, STATES_OF, head, is_as_text, read_names, read_numbers, unescaped};
use super::blocks::{Broken, Source};
use super::dense::{GHOST_TYPE, hidden_cells};
use super::hexagons::{self, CORNER, CORNERS, EXTENTS, SIDE, STAGGER_AXIS};
use super::{Grid, HexagonGrid, NumberType};
use crate::deflate::can_hold;
use crate::regular_file;
use element::{Element, TIME, attribute};

pub use collection::{ListedFile, read_collection};
pub use found::{DenseFile, HexagonFile, ParticleFile, PolyDataFile, ReadArray};

/// The longest head of XML, in bytes.
const LONGEST_HEAD: u64 = 1 << 24;

/// A VTK file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadVtkError {
    /// The file does not exist or is not readable.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The file ends too early.
    #[error("{} is truncated: it ends after {found} bytes", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// The length of the file in bytes.
        found: usize,
    },
    /// The values do not fit into memory.
    #[error("the values of {} take {needed} bytes of memory, and {most} are free", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The size of the values in bytes.
        needed: u64,
        /// The limit of that size in bytes.
        most: u64,
    },
    /// The file has another format, or was changed.
    #[error("{} is not a VTK file as this program writes them: {what}", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// The problem.
        what: &'static str,
    },
}

/// Reads dense substates from `path` (`.vti`). `most` limits the memory for the values, in bytes.
///
/// # Errors
/// [`ReadVtkError`] if [`super::write_dense`] has not written the file, or if it is too large.
pub fn read_dense(path: &Path, most: u64) -> Result<DenseFile, ReadVtkError> {
    let parts = Parts::read(path, "ImageData", most)?;
    let grid = parts.grid().ok_or_else(|| parts.foreign("its grid is invalid"))?;
    let cells = grid.cells.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
    let cells = cells.ok_or_else(|| parts.foreign("its grid is invalid"))?;
    let (time, mut arrays) = parts.arrays(&[], cells)?;
    let hidden = hidden(path, &mut arrays)?;
    Ok(DenseFile { time, grid, hidden, arrays })
}

/// Reads particles from `path` (`.vtp`). `most` limits the memory for the values, in bytes.
///
/// # Errors
/// [`ReadVtkError`] if [`super::write_particles`] has not written the file, or if it is too large.
pub fn read_particles(path: &Path, most: u64) -> Result<ParticleFile, ReadVtkError> {
    particles(Parts::read(path, "PolyData", most)?)
}

/// Reads dense substates on hexagons from `path` (`.vtp`). `most` limits the memory for the values, in bytes.
///
/// # Errors
/// [`ReadVtkError`] if [`super::write_hexagons`] has not written the file, or if it is too large.
pub fn read_hexagons(path: &Path, most: u64) -> Result<HexagonFile, ReadVtkError> {
    hexagons(Parts::read(path, "PolyData", most)?)
}

/// Reads particles or hexagons from `path` (`.vtp`). `most` limits the memory for the values, in bytes.
///
/// # Errors
/// Those of [`read_particles`] and [`read_hexagons`].
pub fn read_poly_data(path: &Path, most: u64) -> Result<PolyDataFile, ReadVtkError> {
    let parts = Parts::read(path, "PolyData", most)?;
    if parts.count("NumberOfPolys") == Some(0) {
        particles(parts).map(PolyDataFile::Particles)
    } else {
        hexagons(parts).map(PolyDataFile::Hexagons)
    }
}

fn particles(parts: Parts<'_>) -> Result<ParticleFile, ReadVtkError> {
    let path = parts.path;
    let count = parts.count("NumberOfPoints");
    let count = count.ok_or_else(|| parts.foreign("the number of its points is missing"))?;
    let (time, mut arrays) = parts.arrays(&[], count)?;
    let positions = points(path, &mut arrays)?;
    Ok(ParticleFile { time, positions, arrays })
}

fn hexagons(parts: Parts<'_>) -> Result<HexagonFile, ReadVtkError> {
    let path = parts.path;
    let grid = parts.hexagon_grid().ok_or_else(|| parts.foreign("its grid is invalid"))?;
    let cells = grid.count();
    let corners = cells.and_then(|cells| cells.checked_mul(CORNERS));
    let (Some(cells), Some(corners)) = (cells, corners) else {
        return Err(parts.foreign("its grid is invalid"));
    };
    if [parts.count("NumberOfPolys"), parts.count("NumberOfPoints")] != [Some(cells), Some(corners)] {
        return Err(parts.foreign("its cells do not match its grid"));
    }
    let (time, mut arrays) = parts.arrays(&[1, corners, corners], cells)?;
    points(path, &mut arrays)?;
    let hidden = hidden(path, &mut arrays)?;
    Ok(HexagonFile { time, grid, hidden, arrays })
}

/// Removes the array of points. Only the arrays that group points come before it.
fn points(path: &Path, arrays: &mut Vec<ReadArray>) -> Result<ReadArray, ReadVtkError> {
    let names: Vec<&str> = arrays.iter().take(3).map(|array| array.name.as_str()).collect();
    if names != ["Points", "connectivity", "offsets"] || arrays[0].components != 3 {
        return Err(foreign(path, "it has no points"));
    }
    let points = arrays.remove(0);
    arrays.drain(..2);
    Ok(points)
}

/// Removes the array that hides cells.
fn hidden(path: &Path, arrays: &mut Vec<ReadArray>) -> Result<Option<Vec<bool>>, ReadVtkError> {
    let is_ghosts = |array: &ReadArray| array.name == GHOST_TYPE;
    let hidden = arrays.iter().position(is_ghosts).map(|at| arrays.remove(at));
    let is_whole = |ghosts: &ReadArray| ghosts.numbers == NumberType::U8 && ghosts.components == 1;
    if !hidden.as_ref().is_none_or(is_whole) {
        return Err(foreign(path, "its ghost types are invalid"));
    }
    Ok(hidden.map(|ghosts| hidden_cells(&ghosts.bytes)))
}

fn foreign(path: &Path, what: &'static str) -> ReadVtkError {
    ReadVtkError::Foreign { path: path.to_owned(), what }
}

/// A file, split into its head and its values.
struct Parts<'a> {
    path: &'a Path,
    /// The XML before the values.
    head: String,
    /// The values and the closing tags.
    data: Source<BufReader<File>>,
    /// The length of the file in bytes.
    found: usize,
    /// The limit of the memory for its values, in bytes.
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
            return Err(if is_beginning { truncated() } else { foreign(path, "its first lines differ") });
        }
        let mut limited = file.by_ref().take(LONGEST_HEAD);
        while !bytes.ends_with(DATA.as_bytes()) {
            // The values begin after an underscore.
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
        let head = String::from_utf8(bytes).map_err(|_| foreign(path, "its first lines are not text"))?;
        Ok(Self { path, head, data: Source::new(file, left), found: found as usize, most })
    }

    fn foreign(&self, what: &'static str) -> ReadVtkError {
        foreign(self.path, what)
    }

    /// An attribute of the first element that begins with `element`.
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

    fn hexagon_grid(&self) -> Option<HexagonGrid> {
        let head = &self.head;
        let (extents, corner) = (read_numbers(head, EXTENTS)?, read_numbers(head, CORNER)?);
        hexagons::grid(extents, corner, read_numbers(head, SIDE)?, read_numbers(head, STAGGER_AXIS)?)
    }

    /// A count in the attributes of the piece.
    fn count(&self, name: &str) -> Option<usize> {
        self.attribute("<Piece ", name)?.parse().ok()
    }

    /// The descriptions of the arrays. The first have the lengths in `first`, the others the length `count`.
    fn elements(&self, first: &[usize], count: usize) -> Result<Vec<Element>, ReadVtkError> {
        let lines = self.head.lines().filter(|line| line.starts_with("<DataArray ") && !is_as_text(line));
        let counts = first.iter().copied().chain(std::iter::repeat(count));
        let elements =
            lines.zip(counts).map(|(line, count)| Element::new(line, count)).collect::<Option<Vec<_>>>();
        let elements = elements.ok_or_else(|| self.foreign("one of its arrays is invalid"))?;
        let needed = elements.iter().fold(0_u64, |sum, element| sum.saturating_add(element.length as u64));
        // Check before anything is expanded.
        if !can_hold(self.data.left(), needed) {
            return Err(self.truncated());
        }
        if needed > self.most {
            return Err(ReadVtkError::TooLarge { path: self.path.to_owned(), needed, most: self.most });
        }
        Ok(elements)
    }

    /// Reads the time and all arrays. The time is the first of them in the file. For their lengths see
    /// [`Self::elements`].
    fn arrays(mut self, first: &[usize], count: usize) -> Result<(f64, Vec<ReadArray>), ReadVtkError> {
        let elements = self.elements(first, count)?;
        let states = self.states();
        let begin = self.data.left();
        let mut arrays = Vec::new();
        for element in elements {
            // The values of the arrays follow each other.
            let states = states.get(&element.name).map_or(Some(Vec::new()), |line| read_names(line));
            let is_next = element.offset as u64 == begin - self.data.left();
            let (true, Some(states)) = (is_next, states.filter(|states| element.can_have(states))) else {
                return Err(self.foreign("one of its arrays is invalid"));
            };
            let bytes = self.data.expanded(element.length).map_err(|broken| match broken {
                Broken::Short => self.truncated(),
                Broken::Wrong => self.foreign("its data do not match its arrays"),
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
            _ => Err(self.foreign("its time is missing")),
        }
    }

    /// Checks that only the last lines are left.
    fn check_end(&mut self) -> Result<(), ReadVtkError> {
        let mut end = vec![0; self.data.left().min(END.len() as u64 + 1) as usize];
        // This also finds a file that became shorter meanwhile.
        let is_read = self.data.fill(&mut end).is_ok();
        match end.as_slice() {
            end if is_read && end == END.as_bytes() => Ok(()),
            end if END.as_bytes().starts_with(end) => Err(self.truncated()),
            _ => Err(self.foreign("it continues where it should end")),
        }
    }

    /// The elements with the names of states, by array.
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

#[cfg(test)]
mod tests;
