//! Converts the planes of a state to binary, little-endian, and back.

use super::Description;
use super::description::{GroupShape, Kind};
use std::io::{self, Read, Write};
use xca_core::engine::{EngineFailure, Plane, Population, SubstateId};
use xca_core::{GroupSnapshot, Outline, Simulation, Snapshot, StoredType};

/// The size of the blocks in which the planes of a simulation are read. Smaller ones would cost messages
/// between the parts of a space, larger ones memory of their host.
pub(super) const BLOCK: usize = 1 << 22;

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
    written: u128,
}

impl<'a, W: Write> PlaneWriter<'a, W> {
    pub(super) fn new(description: &'a Description, file: &'a mut W) -> Self {
        Self { description, file, written: 0 }
    }

    /// Adds bytes of a plane, which are in the byte order of this machine.
    fn add(&mut self, plane: Plane, bytes: &[u8]) -> Result<(), PlaneError> {
        // What is not described is not in the file.
        let Some(size) = size_of_numbers(self.description, plane) else { return Ok(()) };
        self.written += bytes.len() as u128;
        if cfg!(target_endian = "little") {
            return self.file.write_all(bytes).map_err(PlaneError::Write);
        }
        let mut turned = bytes.to_vec();
        turn(&mut turned, size);
        self.file.write_all(&turned).map_err(PlaneError::Write)
    }
}

/// The size of a number of a plane. `None` if the plane is not described.
pub(super) fn size_of_numbers(description: &Description, plane: Plane) -> Option<usize> {
    let group = description.groups.get(plane.group())?;
    match plane {
        Plane::Counts(_) | Plane::Labels(_) => Some(size_of::<u32>()),
        Plane::Values(SubstateId { field, .. }) => Some(group.substates.get(field)?.stored.scalar.size()),
    }
}

/// Reverses the bytes of each number of `size` bytes.
fn turn(bytes: &mut [u8], size: usize) {
    bytes.chunks_exact_mut(size).for_each(<[u8]>::reverse);
}

/// The error for data that contradicts its description.
fn inconsistent() -> io::Error {
    io::ErrorKind::InvalidData.into()
}

/// Reads the next bytes of a plane, which has numbers of `size` bytes.
pub(super) fn read_block(file: &mut impl Read, size: usize, block: &mut [u8]) -> io::Result<()> {
    file.read_exact(block)?;
    if cfg!(target_endian = "big") {
        turn(block, size);
    }
    Ok(())
}

/// Reads the next plane of `count` values.
fn read_plane(file: &mut impl Read, count: usize, stored: StoredType) -> io::Result<Vec<u8>> {
    let mut bytes = vec![0; count * stored.size()];
    read_block(file, stored.scalar.size(), &mut bytes)?;
    Ok(bytes)
}

fn read_numbers(file: &mut impl Read, count: usize) -> io::Result<Vec<u32>> {
    let mut numbers = vec![0; count];
    read_block(file, size_of::<u32>(), bytemuck::cast_slice_mut::<u32, u8>(&mut numbers))?;
    Ok(numbers)
}

fn read_substates(file: &mut impl Read, shape: &GroupShape, count: usize) -> io::Result<Vec<Vec<u8>>> {
    shape.substates.iter().map(|substate| read_plane(file, count, substate.stored)).collect()
}

/// Reads a snapshot from the data of a file, which has as many bytes as the description says.
///
/// # Errors
/// Those of the system, and [`io::ErrorKind::InvalidData`] if the data contradicts the description.
pub(super) fn read(description: &Description, mut file: impl Read) -> io::Result<Snapshot> {
    let mut groups = Vec::new();
    for shape in &description.groups {
        groups.push(match shape.kind {
            Kind::Cells { cells } => GroupSnapshot::Cells(read_substates(&mut file, shape, cells)?),
            Kind::Items { cells, items, left, .. } => {
                let counts = read_numbers(&mut file, cells)?;
                let labels = read_numbers(&mut file, items)?;
                if counts.iter().map(|count| u64::from(*count)).sum::<u64>() != items as u64 {
                    return Err(inconsistent());
                }
                let fields = read_substates(&mut file, shape, items)?;
                GroupSnapshot::Population(Population { counts, labels, fields }, left)
            }
        });
    }
    let Outline { step, parameters, stop, broken, .. } = description.outline();
    Ok(Snapshot { step, groups, parameters, stop, broken })
}

#[cfg(test)]
mod tests {
    use super::turn;

    #[test]
    fn bytes_can_be_turned() {
        let turned = |mut bytes: Vec<u8>, size| {
            turn(&mut bytes, size);
            bytes
        };
        assert_eq!(turned(vec![1, 2, 3, 4, 5, 6, 7, 8], 4), [4, 3, 2, 1, 8, 7, 6, 5]);
        assert_eq!(turned(vec![1, 2], 1), [1, 2]);
    }
}
