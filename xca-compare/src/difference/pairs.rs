//! Which item of one state is which of the other.

use super::{Difference, Kind, Place, Worst};
use std::collections::HashMap;
use xca_core::engine::Population;

/// Places of the first state with those of the other.
#[derive(Debug)]
pub(super) enum Pairs {
    /// So many, each with its like.
    Same(usize),
    Listed(Vec<[usize; 2]>),
}

impl Pairs {
    fn len(&self) -> usize {
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

    /// The place in the first state.
    pub(super) fn first(&self, index: usize) -> usize {
        self.at(index)[0]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.len()).map(|index| self.at(index).into())
    }
}

/// The items that have the same label, and how many have no like.
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

/// Which items are in other cells.
pub(super) fn cells(name: &str, first: &Population, other: &Population, pairs: &Pairs) -> Difference {
    let mut difference = Difference::none(format!("cells of {name}"), Kind::Cell);
    difference.values = pairs.len();
    if first.counts == other.counts && matches!(pairs, Pairs::Same(_)) {
        return difference;
    }
    let [of_first, of_other] = [first, other].map(cell_of_each);
    for (a, b) in pairs.iter().filter(|(a, b)| of_first[*a] != of_other[*b]) {
        difference.different += 1;
        let cells = [of_first[a] as f64, of_other[b] as f64];
        difference.worst.get_or_insert_with(|| Worst::new(Place::Item(first.labels[a]), 0, cells));
    }
    difference
}

/// The cell of each item.
fn cell_of_each(population: &Population) -> Vec<usize> {
    let counts = population.counts.iter().enumerate();
    counts.flat_map(|(cell, count)| std::iter::repeat_n(cell, *count as usize)).collect()
}
