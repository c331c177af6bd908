//! Items by label.

use super::Population;
use std::ops::Range;

/// Items of a population, by label.
#[derive(Debug, Clone, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct LabelledItems {
    /// Their labels, in ascending order.
    pub labels: Vec<u32>,
    /// The linear indices of their cells.
    pub cells: Vec<u32>,
    /// The stored bytes of each substate.
    pub fields: Vec<Vec<u8>>,
}

impl LabelledItems {
    /// The number of labels in a block of [`super::Execution::label_counts`].
    pub const BLOCK: u64 = 1 << 16;

    /// All items of a population. `sizes` are the sizes of its substates in bytes, and `cell` gives the
    /// linear index of the cell with this number among the counts.
    pub fn of(population: Population, sizes: &[usize], cell: impl Fn(usize) -> u32) -> Self {
        let counts = population.counts.iter().enumerate();
        let cells = counts.flat_map(|(number, count)| std::iter::repeat_n(cell(number), *count as usize));
        Self { cells: cells.collect(), labels: population.labels, fields: population.fields }.sorted(sizes)
    }

    /// The items of several lists.
    pub fn merged(lists: Vec<Self>, sizes: &[usize]) -> Self {
        let mut all = Self { fields: vec![Vec::new(); sizes.len()], ..Self::default() };
        for list in lists {
            all.labels.extend(list.labels);
            all.cells.extend(list.cells);
            all.fields.iter_mut().zip(list.fields).for_each(|(all, field)| all.extend(field));
        }
        all.sorted(sizes)
    }

    /// Those with labels in this range.
    pub fn within(&self, labels: Range<u64>, sizes: &[usize]) -> Self {
        let place = |end: u64| self.labels.partition_point(|label| u64::from(*label) < end);
        let (from, to) = (place(labels.start), place(labels.end));
        let fields =
            self.fields.iter().zip(sizes).map(|(bytes, size)| bytes[from * size..to * size].to_vec());
        let fields = fields.collect();
        Self { labels: self.labels[from..to].to_vec(), cells: self.cells[from..to].to_vec(), fields }
    }

    /// The number of items in each block of labels.
    pub fn counts(&self) -> Vec<u32> {
        let mut counts = vec![0; ((1_u64 << 32) / Self::BLOCK) as usize];
        for label in &self.labels {
            counts[(u64::from(*label) / Self::BLOCK) as usize] += 1;
        }
        counts
    }

    fn sorted(self, sizes: &[usize]) -> Self {
        if self.labels.is_sorted() {
            return self;
        }
        let mut order: Vec<usize> = (0..self.labels.len()).collect();
        order.sort_unstable_by_key(|place| self.labels[*place]);
        let field = |(bytes, size): (&Vec<u8>, &usize)| {
            order.iter().flat_map(|place| &bytes[place * size..(place + 1) * size]).copied().collect()
        };
        Self {
            labels: order.iter().map(|place| self.labels[*place]).collect(),
            cells: order.iter().map(|place| self.cells[*place]).collect(),
            fields: self.fields.iter().zip(sizes).map(field).collect(),
        }
    }
}
