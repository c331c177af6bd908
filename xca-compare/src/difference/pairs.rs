//! The pairs of items of two states.

use std::collections::HashMap;
use xca_core::engine::Population;

/// Indices in the first state, paired with those in the other.
#[derive(Debug)]
pub(super) enum Pairs {
    /// This many pairs of equal indices.
    Same(usize),
    Listed(Vec<[usize; 2]>),
}

impl Pairs {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Same(number) => *number,
            Self::Listed(pairs) => pairs.len(),
        }
    }

    fn at(&self, index: usize) -> [usize; 2] {
        match self {
            Self::Same(_) => [index, index],
            Self::Listed(pairs) => pairs[index],
        }
    }

    /// The index in the first state.
    pub(super) fn first(&self, index: usize) -> usize {
        self.at(index)[0]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.len()).map(|index| self.at(index).into())
    }
}

/// The pairs of items with the same label, and the number of unpaired items.
pub(super) fn by_label(first: &Population, other: &Population) -> (Pairs, usize) {
    if first.labels == other.labels {
        return (Pairs::Same(first.labels.len()), 0);
    }
    let places: HashMap<u32, usize> =
        other.labels.iter().enumerate().map(|(place, label)| (*label, place)).collect();
    let pairs = first.labels.iter().enumerate();
    let pairs: Vec<_> = pairs.filter_map(|(place, label)| Some([place, *places.get(label)?])).collect();
    let unmatched = first.labels.len() + other.labels.len() - 2 * pairs.len();
    (Pairs::Listed(pairs), unmatched)
}
