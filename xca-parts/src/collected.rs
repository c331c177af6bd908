//! Items that come plane by plane and row by row.

use xca_core::engine::{Plane, Population};

/// The items of a population in a part, as far as they have come.
#[derive(Default)]
pub(crate) struct CollectedItems {
    counts: Vec<u8>,
    labels: Vec<u8>,
    fields: Vec<Vec<u8>>,
}

impl CollectedItems {
    /// Adds the bytes of a plane in the next rows. `begins` for the first rows.
    pub(crate) fn add(&mut self, plane: Plane, begins: bool, bytes: &[u8]) {
        let all = match plane {
            Plane::Counts(_) => &mut self.counts,
            Plane::Labels(_) => &mut self.labels,
            Plane::Values(substate) => {
                self.fields.resize_with(self.fields.len().max(substate.field + 1), Vec::new);
                &mut self.fields[substate.field]
            }
        };
        if begins {
            all.clear();
        }
        all.extend_from_slice(bytes);
    }

    /// All items, each with so many fields.
    pub(crate) fn population(mut self, fields: usize) -> Population {
        self.fields.resize_with(fields, Vec::new);
        Population { counts: numbers(&self.counts), labels: numbers(&self.labels), fields: self.fields }
    }
}

/// The numbers of a plane of counts or labels.
pub(crate) fn numbers(bytes: &[u8]) -> Vec<u32> {
    bytes.as_chunks().0.iter().map(|number| u32::from_ne_bytes(*number)).collect()
}
