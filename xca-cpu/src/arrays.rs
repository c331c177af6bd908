//! The stored data of the items of a population.

use bytemuck::Pod;
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

    /// Replaces each array by one with so many places. `fill` gets the old one, the new one and the size of
    /// a value in bytes. One array after the other, because both exist meanwhile.
    pub(crate) fn replace(
        &mut self,
        types: &[StoredType],
        places: usize,
        has_lists: bool,
        fill: impl Fn(&[u8], &mut [u8], usize),
    ) {
        let listed = if has_lists { places } else { 0 };
        replace(&mut self.labels, places, &fill);
        replace(&mut self.cells, places, &fill);
        replace(&mut self.numbers, listed, &fill);
        replace(&mut self.references, listed, &fill);
        for (field, stored) in self.fields.iter_mut().zip(types) {
            let mut new = Buffer::zeroed(places * stored.size());
            fill(field.bytes(), new.bytes_mut(), stored.size());
            *field = new;
        }
    }

    pub(crate) fn memory(&self) -> usize {
        let numbers = self.labels.capacity() + self.cells.capacity() + self.numbers.capacity();
        let references = self.references.capacity() * size_of::<[f32; 3]>();
        numbers * size_of::<u32>() + references + self.fields.iter().map(Buffer::capacity).sum::<usize>()
    }
}

/// Replaces a vector by one of this length.
fn replace<T: Pod>(values: &mut Vec<T>, length: usize, fill: impl Fn(&[u8], &mut [u8], usize)) {
    let mut new = bytemuck::allocation::zeroed_vec(length);
    if length > 0 {
        fill(bytemuck::cast_slice(values), bytemuck::cast_slice_mut(&mut new), size_of::<T>());
    }
    *values = new;
}
