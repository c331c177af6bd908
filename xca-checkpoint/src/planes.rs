//! Converts the planes of a state to binary, little-endian, and back.

use super::Description;
use super::description::{GroupShape, Kind};
use std::io::{self, Read, Write};
use xca_core::engine::{EngineFailure, Plane, Population, SubstateId};
use xca_core::{GroupSnapshot, Simulation, Snapshot};

/// The size of the blocks in which the planes of a simulation are read. Smaller ones would cost messages
/// between the parts of a space, larger ones memory of their host.
const BLOCK: usize = 1 << 22;

/// A state whose planes can be written.
pub(super) trait Planes {
    /// Writes all planes in the order of the file.
    fn write<W: Write>(&self, to: &mut PlaneWriter<'_, W>) -> Result<(), PlaneError>;
}

/// Planes that could not be written.
pub(super) enum PlaneError {
    Write(io::Error),
    State(EngineFailure),
}

impl From<EngineFailure> for PlaneError {
    fn from(failure: EngineFailure) -> Self {
        Self::State(failure)
    }
}

impl Planes for Snapshot {
    fn write<W: Write>(&self, to: &mut PlaneWriter<'_, W>) -> Result<(), PlaneError> {
        let mut groups = self.groups.iter().enumerate();
        groups.try_for_each(|(number, group)| group.planes(number, &mut |plane, bytes| to.add(plane, bytes)))
    }
}

impl Planes for Simulation {
    fn write<W: Write>(&self, to: &mut PlaneWriter<'_, W>) -> Result<(), PlaneError> {
        self.read_blocks(BLOCK, |plane, bytes| to.add(plane, bytes))?;
        if to.written == to.description.data_bytes() {
            return Ok(());
        }
        let message = "the engine gives another number of bytes than the state has";
        Err(PlaneError::Write(io::Error::new(io::ErrorKind::InvalidData, message)))
    }
}

/// A file to which planes are written.
pub(super) struct PlaneWriter<'a, W> {
    description: &'a Description,
    file: &'a mut W,
    /// The number of bytes.
    written: usize,
}

impl<'a, W: Write> PlaneWriter<'a, W> {
    pub(super) fn new(description: &'a Description, file: &'a mut W) -> Self {
        Self { description, file, written: 0 }
    }

    /// Adds bytes of a plane, which are in the byte order of this machine.
    fn add(&mut self, plane: Plane, bytes: &[u8]) -> Result<(), PlaneError> {
        let group = self.description.groups.get(plane.group());
        let size = match plane {
            Plane::Counts(_) | Plane::Labels(_) => group.map(|_| size_of::<u32>()),
            Plane::Values(SubstateId { field, .. }) => {
                group.and_then(|group| group.substates.get(field)).map(|field| field.stored.scalar.size())
            }
        };
        // What is not described is not in the file.
        let Some(size) = size else { return Ok(()) };
        self.written += bytes.len();
        let written = if cfg!(target_endian = "little") {
            self.file.write_all(bytes)
        } else {
            self.file.write_all(&turned(bytes.to_vec(), size))
        };
        written.map_err(PlaneError::Write)
    }
}

/// Reverses the bytes of each number of `size` bytes.
fn turned(mut bytes: Vec<u8>, size: usize) -> Vec<u8> {
    bytes.chunks_exact_mut(size).for_each(<[u8]>::reverse);
    bytes
}

/// A reader of the data of a file, plane by plane.
struct Data<R> {
    file: R,
    /// The number of bytes left.
    left: u64,
}

/// The error for data that contradicts its description.
fn inconsistent() -> io::Error {
    io::ErrorKind::InvalidData.into()
}

impl<R: Read> Data<R> {
    /// Reads the next plane of `count` values. Allocates no more than the file has.
    fn plane(&mut self, count: usize, components: usize, size: usize) -> io::Result<Vec<u8>> {
        let length = count.checked_mul(components).and_then(|numbers| numbers.checked_mul(size));
        let left = length.and_then(|length| self.left.checked_sub(length as u64));
        let (Some(length), Some(left)) = (length, left) else { return Err(inconsistent()) };
        self.left = left;
        let mut bytes = vec![0; length];
        self.file.read_exact(&mut bytes)?;
        Ok(if cfg!(target_endian = "little") { bytes } else { turned(bytes, size) })
    }

    fn numbers(&mut self, count: usize) -> io::Result<Vec<u32>> {
        let bytes = self.plane(count, 1, size_of::<u32>())?;
        Ok(bytes.as_chunks().0.iter().map(|bytes| u32::from_ne_bytes(*bytes)).collect())
    }

    fn substates(&mut self, shape: &GroupShape, count: usize) -> io::Result<Vec<Vec<u8>>> {
        let stored = shape.substates.iter().map(|substate| substate.stored);
        stored.map(|stored| self.plane(count, stored.components(), stored.scalar.size())).collect()
    }
}

/// Reads a snapshot from the next `length` bytes of a file.
///
/// # Errors
/// Those of the system, and [`io::ErrorKind::InvalidData`] if the data contradicts the description.
pub(super) fn read(description: &Description, file: impl Read, length: u64) -> io::Result<Snapshot> {
    let space = description.cells().ok_or_else(inconsistent)?;
    if !description.makes_sense(length) {
        return Err(inconsistent());
    }
    let mut data = Data { file, left: length };
    let mut groups = Vec::new();
    for shape in &description.groups {
        groups.push(match shape.kind {
            Kind::Cells { cells } | Kind::Items { cells, .. } if cells != space => return Err(inconsistent()),
            Kind::Cells { cells } => GroupSnapshot::Cells(data.substates(shape, cells)?),
            Kind::Items { cells, items, left, .. } => {
                let (counts, labels) = (data.numbers(cells)?, data.numbers(items)?);
                if counts.iter().map(|count| u64::from(*count)).sum::<u64>() != items as u64 {
                    return Err(inconsistent());
                }
                let fields = data.substates(shape, items)?;
                GroupSnapshot::Population(Population { counts, labels, fields }, left)
            }
        });
    }
    if data.left > 0 {
        return Err(inconsistent());
    }
    Ok(Snapshot {
        step: description.step,
        groups,
        parameters: description.parameters.iter().map(super::Parameter::bits).collect(),
        stop: description.stop.clone(),
        broken: false,
    })
}

#[cfg(test)]
mod tests {
    use super::turned;

    #[test]
    fn bytes_can_be_turned() {
        assert_eq!(turned(vec![1, 2, 3, 4, 5, 6, 7, 8], 4), [4, 3, 2, 1, 8, 7, 6, 5]);
        assert_eq!(turned(vec![1, 2], 1), [1, 2]);
    }
}
