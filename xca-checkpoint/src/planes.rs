//! Converts snapshots to binary planes, little-endian, and back.

use super::Description;
use super::description::{GroupShape, Kind};
use std::borrow::Cow;
use std::io::{self, Read, Write};
use xca_core::engine::Population;
use xca_core::{GroupSnapshot, Snapshot, StoredType};

/// Numbers of equal size, one after the other, in the byte order of this machine.
pub(super) struct Plane<'a> {
    size: usize,
    bytes: Cow<'a, [u8]>,
}

impl<'a> Plane<'a> {
    fn of_substate(stored: StoredType, bytes: &'a [u8]) -> Self {
        Self { size: stored.scalar.size(), bytes: Cow::Borrowed(bytes) }
    }

    fn of_numbers(numbers: &[u32]) -> Self {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_ne_bytes()).collect();
        Self { size: size_of::<u32>(), bytes: Cow::Owned(bytes) }
    }

    pub(super) fn write(&self, file: &mut impl Write) -> io::Result<()> {
        if cfg!(target_endian = "little") {
            file.write_all(&self.bytes)
        } else {
            file.write_all(&turned(self.bytes.to_vec(), self.size))
        }
    }
}

/// Reverses the bytes of each number of `size` bytes.
fn turned(mut bytes: Vec<u8>, size: usize) -> Vec<u8> {
    bytes.chunks_exact_mut(size).for_each(<[u8]>::reverse);
    bytes
}

/// The planes of a snapshot in the order of the file. Each group gives its substates. Before them, a
/// population gives the number of items in each cell, and the labels.
pub(super) fn of<'a>(description: &Description, snapshot: &'a Snapshot) -> Vec<Plane<'a>> {
    let mut planes = Vec::new();
    for (shape, state) in description.groups.iter().zip(&snapshot.groups) {
        let fields = match state {
            GroupSnapshot::Cells(fields) => fields,
            GroupSnapshot::Population(population, _) => {
                planes.push(Plane::of_numbers(&population.counts));
                planes.push(Plane::of_numbers(&population.labels));
                &population.fields
            }
        };
        let stored = shape.substates.iter().map(|substate| substate.stored);
        planes.extend(stored.zip(fields).map(|(stored, bytes)| Plane::of_substate(stored, bytes)));
    }
    planes
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
