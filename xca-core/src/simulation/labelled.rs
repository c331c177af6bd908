//! The items of a population by label, for files that need not be in memory as a whole.

use super::Simulation;
use crate::engine::{EngineFailure, LabelledItems, Plane, check_plane};
use std::ops::Range;

/// The number of items that a block has at most, unless those of [`LabelledItems::BLOCK`] labels are more.
const MOST: u64 = 1 << 17;

impl Simulation {
    /// Passes on the items of the population with this number among the groups, by label: from an engine with
    /// parts of the space in blocks, from others at once.
    ///
    /// # Errors
    /// Returns an error if there is no such population, the engine lost its state, or that of `take`.
    pub fn read_items<E: From<EngineFailure>>(
        &self,
        group: usize,
        mut take: impl FnMut(LabelledItems) -> Result<(), E>,
    ) -> Result<(), E> {
        check_plane(&self.model, Plane::Labels(group)).map_err(EngineFailure::Input)?;
        let Some(counts) = self.execution.label_counts(group)? else {
            let sizes = self.model.groups()[group].sizes(self.options.precision);
            let population = self.execution.population(group)?;
            return take(LabelledItems::of(population, &sizes, |cell| cell as u32));
        };
        ranges(&counts).into_iter().try_for_each(|labels| take(self.execution.labelled_items(group, labels)?))
    }

    /// The number of items that [`Self::read_items`] gives at once, at most.
    ///
    /// # Errors
    /// Returns an error if the engine lost its state.
    pub fn items_at_once(&self, group: usize) -> Result<usize, EngineFailure> {
        let counts = self.execution.label_counts(group)?;
        let most = counts.map_or(u64::MAX, |counts| counts.into_iter().max().map_or(0, u64::from).max(MOST));
        Ok(self.execution.items(group).min(usize::try_from(most).unwrap_or(usize::MAX)))
    }
}

/// The ranges of labels with some items, none of which has too many. `counts` are those of blocks of labels.
fn ranges(counts: &[u32]) -> Vec<Range<u64>> {
    let (mut ends, mut items) = (vec![0], 0);
    for (block, count) in (0..).zip(counts) {
        if items > 0 && items + u64::from(*count) > MOST {
            ends.push(block * LabelledItems::BLOCK);
            items = 0;
        }
        items += u64::from(*count);
    }
    if items > 0 {
        ends.push(counts.len() as u64 * LabelledItems::BLOCK);
    }
    ends.array_windows().map(|[start, end]| *start..*end).collect()
}

#[cfg(test)]
mod tests {
    use super::{MOST, ranges};
    use crate::engine::LabelledItems;

    #[test]
    fn no_range_has_too_many_items() {
        let block = LabelledItems::BLOCK;
        let half = MOST as u32 / 2;
        assert!(ranges(&[0; 9]).is_empty());
        assert_eq!(ranges(&[1, 0, 0, 5]).len(), 1);
        assert_eq!(ranges(&[1, 0, 0, 5])[0], 0..4 * block);
        assert_eq!(ranges(&[half, half, 1, 0]), [0..2 * block, 2 * block..4 * block]);
        assert_eq!(ranges(&[0, 3 * half, 0, half]), [0..2 * block, 2 * block..4 * block]);
    }
}
