//! The values of a substate in the device's memory.

use crate::device::{Binding, Buffer, Device, DeviceError};
use crate::space::{HaloCell, Section, Shown, Space};
use std::ops::Range;
use xca_core::{Faces, StoredScalar, StoredType};

/// A substate of all cells or of all items: a value for each, element after element, lane beside lane, a
/// `u8`, `bool` or state in the four bytes of a `u32`.
#[derive(Debug)]
pub(crate) struct Plane {
    stored: StoredType,
    /// The one that shows the present state, then the one that results go to, where these differ.
    buffers: Vec<Buffer>,
}

impl Plane {
    /// Zeros for so many cells or items.
    pub(crate) fn new(
        device: &Device,
        name: &str,
        stored: StoredType,
        values: usize,
        doubled: bool,
    ) -> Result<Self, DeviceError> {
        let size = (values * size_on_device(stored)) as u64;
        let buffers = (0..if doubled { 2 } else { 1 }).map(|_| device.buffer(name, size));
        Ok(Self { stored, buffers: buffers.collect::<Result<_, _>>()? })
    }

    /// The bytes of a value on the device.
    pub(crate) fn size(&self) -> usize {
        size_on_device(self.stored)
    }

    /// The present values.
    pub(crate) fn now(&self) -> &Buffer {
        &self.buffers[0]
    }

    /// Where results go.
    pub(crate) fn next(&self) -> &Buffer {
        self.buffers.last().unwrap_or(&self.buffers[0])
    }

    /// Makes the results the present values.
    pub(crate) fn swap(&mut self) {
        self.buffers.reverse();
    }

    /// The bytes that it takes.
    pub(crate) fn memory(&self) -> usize {
        self.buffers.iter().map(|buffer| buffer.size() as usize).sum()
    }

    /// Those values of a buffer of this plane that a section of the space needs.
    pub(crate) fn section(&self, buffer: &Buffer, section: &Section) -> Binding {
        let size = self.size() as u64;
        Binding::part(buffer, section.base as u64 * size, section.stored as u64 * size)
    }

    /// Writes the values of all items.
    pub(crate) fn write_items(&self, device: &Device, values: &[u8]) -> Result<(), DeviceError> {
        device.upload(self.now(), 0, &widened(self.stored, values))
    }

    /// The values of so many items.
    pub(crate) fn read_items(&self, device: &Device, items: usize) -> Result<Vec<u8>, DeviceError> {
        let bytes = device.download(self.now(), 0..(items * self.size()) as u64)?;
        Ok(narrowed(self.stored, bytes))
    }

    /// Writes the values of all cells, and those of the halo into every buffer.
    pub(crate) fn write_space(
        &self,
        device: &Device,
        space: &Space,
        halo: &[HaloCell],
        outside: &Faces<Vec<u8>>,
        values: &[u8],
    ) -> Result<(), DeviceError> {
        let size = self.size();
        let values = widened(self.stored, values);
        let outside = outside.map(|bytes| widened(self.stored, bytes).into_owned());
        let mut stored = vec![0; space.stored() * size];
        let row = space.extents()[0] * size;
        for (number, values) in values.chunks_exact(row).enumerate() {
            let start = space.row_start(number) * size;
            stored[start..start + row].copy_from_slice(values);
        }
        for HaloCell { number, shows } in halo {
            match shows {
                // Arrives from another part before it is seen.
                Shown::Elsewhere => {}
                Shown::Cell(source) => stored.copy_within(source * size..(source + 1) * size, number * size),
                Shown::Outside(face) => {
                    stored[number * size..(number + 1) * size].copy_from_slice(&outside[*face]);
                }
            }
        }
        self.buffers.iter().try_for_each(|buffer| device.upload(buffer, 0, &stored))
    }

    /// The values of all cells.
    pub(crate) fn read_space(&self, device: &Device, space: &Space) -> Result<Vec<u8>, DeviceError> {
        let size = self.size();
        let row = space.extents()[0] * size;
        let mut values = Vec::with_capacity(space.rows() * row);
        let stored = device.download(self.now(), 0..(space.stored() * size) as u64)?;
        for number in 0..space.rows() {
            let start = space.row_start(number) * size;
            values.extend(&stored[start..start + row]);
        }
        Ok(narrowed(self.stored, values))
    }

    /// The values of the cells with these stored numbers.
    pub(crate) fn read_cells(&self, device: &Device, numbers: &[usize]) -> Result<Vec<u8>, DeviceError> {
        Ok(narrowed(self.stored, device.collect(self.now(), &self.runs(numbers))?))
    }

    /// Writes the values of the cells with these stored numbers, in their order.
    pub(crate) fn write_cells(
        &self,
        device: &Device,
        numbers: &[usize],
        values: &[u8],
    ) -> Result<(), DeviceError> {
        device.scatter(self.now(), &self.runs(numbers), &widened(self.stored, values))
    }

    /// The bytes of cells that follow each other, as ranges in the order of the cells.
    fn runs(&self, numbers: &[usize]) -> Vec<Range<u64>> {
        let size = self.size() as u64;
        let in_one = numbers.chunk_by(|number, next| number + 1 == *next);
        in_one.map(|run| run[0] as u64 * size..(run[0] + run.len()) as u64 * size).collect()
    }
}

/// The bytes of a value on the device.
pub(crate) fn size_on_device(stored: StoredType) -> usize {
    stored.scalar.size().max(4) * stored.components()
}

/// Values as the device stores them.
fn widened(stored: StoredType, values: &[u8]) -> std::borrow::Cow<'_, [u8]> {
    match stored.scalar {
        StoredScalar::U8 => values.iter().flat_map(|byte| u32::from(*byte).to_ne_bytes()).collect(),
        _ => values.into(),
    }
}

/// Values as the host stores them.
fn narrowed(stored: StoredType, values: Vec<u8>) -> Vec<u8> {
    match stored.scalar {
        StoredScalar::U8 => {
            bytemuck::pod_collect_to_vec::<u8, u32>(&values).into_iter().map(|word| word as u8).collect()
        }
        _ => values,
    }
}
