//! What colours the cells or the items of a view: a substate, a component of one, or a number computed of all
//! of them.

use std::fmt;
use std::sync::Arc;
use xca_checkpoint::components::Part;
use xca_core::{Precision, StoredType, Substates};

/// What is drawn, and what the scale calls it.
#[derive(Debug, Clone)]
pub(crate) struct Drawn {
    pub(crate) quantity: Quantity,
    pub(crate) label: String,
}

#[derive(Debug, Clone)]
pub(crate) enum Quantity {
    Part(Part),
    Computed(Computation),
}

impl Quantity {
    /// The number of the substate that it is, or is of.
    pub(crate) fn field(&self) -> Option<usize> {
        self.part().map(|part| part.field)
    }

    pub(crate) fn part(&self) -> Option<Part> {
        match self {
            Self::Part(part) => Some(*part),
            Self::Computed(_) => None,
        }
    }
}

type Compute = dyn Fn(Precision, &[&[u8]]) -> f64 + Send + Sync;

/// A function of the substates of one cell or item, which it gets as their stored bytes.
#[derive(Clone)]
pub(crate) struct Computation {
    compute: Arc<Compute>,
}

impl Computation {
    pub(crate) fn of<S: Substates>(quantity: impl Fn(&S) -> f64 + Send + Sync + 'static) -> Self {
        let compute =
            move |precision, fields: &[&[u8]]| quantity(&S::decode(precision, |field| fields[field]));
        Self { compute: Arc::new(compute) }
    }

    /// Its values for the cells or items with these numbers.
    pub(crate) fn values(
        &self,
        precision: Precision,
        fields: &[StoredBytes<'_>],
        which: impl Iterator<Item = usize>,
    ) -> Vec<f64> {
        let mut values = Vec::with_capacity(fields.len());
        let all = which.map(|index| {
            values.clear();
            values.extend(fields.iter().map(|field| field.value(index)));
            (self.compute)(precision, &values)
        });
        all.collect()
    }
}

impl fmt::Debug for Computation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Computation")
    }
}

/// The values of a substate of all cells or items, as they are stored.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StoredBytes<'a> {
    pub(crate) stored: StoredType,
    pub(crate) bytes: &'a [u8],
}

impl<'a> StoredBytes<'a> {
    fn value(&self, index: usize) -> &'a [u8] {
        let size = self.stored.size();
        &self.bytes[index * size..(index + 1) * size]
    }
}
