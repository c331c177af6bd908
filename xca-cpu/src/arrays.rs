//! The stored data of the items of a population.

use xca_core::StoredType;
use xca_core::storage::Buffer;

/// The stored data of items, by place.
#[derive(Default)]
pub(crate) struct Arrays {
    pub(crate) labels: Vec<u32>,
    /// The linear indices of the items' cells.
    pub(crate) cells: Vec<u32>,
    /// The numbers of the items in neighbour lists. Empty without lists.
    pub(crate) numbers: Vec<u32>,
    /// The positions in metres when the lists were made. Empty without lists.
    pub(crate) references: Vec<[f32; 3]>,
    pub(crate) fields: Vec<Buffer>,
}

/// The values of an array as bytes, with the size of each.
pub(crate) struct Values<'a> {
    pub(crate) size: usize,
    pub(crate) bytes: &'a mut [u8],
}

impl Arrays {
    pub(crate) fn new(types: &[StoredType], places: usize) -> Self {
        Self {
            labels: vec![0; places],
            cells: vec![0; places],
            numbers: Vec::new(),
            references: Vec::new(),
            fields: types.iter().map(|stored| Buffer::zeroed(places * stored.size())).collect(),
        }
    }

    /// The index of the labels in [`Self::values`].
    pub(crate) const LABELS: usize = 0;
    /// The index of the cells.
    pub(crate) const CELLS: usize = 1;

    /// All arrays, for moving items, always in the same order.
    pub(crate) fn values<'a>(&'a mut self, types: &[StoredType]) -> Vec<Values<'a>> {
        let numbers = [&mut self.labels, &mut self.cells, &mut self.numbers];
        let numbers = numbers.map(|values| Values { size: 4, bytes: bytemuck::cast_slice_mut(values) });
        let references =
            Values { size: size_of::<[f32; 3]>(), bytes: bytemuck::cast_slice_mut(&mut self.references) };
        let fields = self.fields.iter_mut().zip(types);
        let fields = fields.map(|(field, stored)| Values { size: stored.size(), bytes: field.bytes_mut() });
        let all = numbers.into_iter().chain([references]).chain(fields);
        all.filter(|values| !values.bytes.is_empty()).collect()
    }

    pub(crate) fn memory(&self) -> usize {
        let numbers = self.labels.capacity() + self.cells.capacity() + self.numbers.capacity();
        let references = self.references.capacity() * size_of::<[f32; 3]>();
        numbers * size_of::<u32>() + references + self.fields.iter().map(Buffer::capacity).sum::<usize>()
    }
}
