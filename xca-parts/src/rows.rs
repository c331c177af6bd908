//! Rows and their parts: gathers and scatters their data.

use crate::cut::Cut;
use std::ops::Range;
use xca_core::Geometry;
use xca_core::engine::Population;

/// Rows, in their order, and the part that each belongs to.
pub(crate) struct Rows {
    owners: Vec<usize>,
    parts: usize,
    width: usize,
}

/// The numbers of values in rows.
#[derive(Clone, Copy)]
pub(crate) enum Lengths<'a> {
    /// The same number in all rows.
    Same(usize),
    /// A count for each row, times a factor.
    Each(&'a [usize], usize),
}

impl Lengths<'_> {
    fn of(self, row: usize) -> usize {
        match self {
            Self::Same(length) => length,
            Self::Each(counts, size) => counts.get(row).map_or(0, |count| count * size),
        }
    }

    /// The number of values in the first rows.
    pub(crate) fn sum(self, rows: usize) -> usize {
        (0..rows).map(|row| self.of(row)).sum()
    }
}

impl Rows {
    /// All rows of the space.
    pub(crate) fn new(geometry: &Geometry, cut: &Cut) -> Self {
        let [_, height, depth] = geometry.extents();
        Self::of(geometry, 0..height * depth, cut)
    }

    /// Some rows of the space.
    pub(crate) fn of(geometry: &Geometry, rows: impl Iterator<Item = usize>, cut: &Cut) -> Self {
        let [width, height, _] = geometry.extents();
        let owner = |row: usize| cut.part_of([row % height, row / height]);
        Self { owners: rows.map(owner).collect(), parts: cut.count(), width }
    }

    /// The number of parts.
    pub(crate) fn parts(&self) -> usize {
        self.parts
    }

    /// Whether some of the rows belong to this part.
    pub(crate) fn has(&self, part: usize) -> bool {
        self.owners.contains(&part)
    }

    /// Gathers the data of all parts. `None` if the lengths do not match.
    pub(crate) fn gather<T: Clone>(&self, parts: &[Vec<T>], lengths: Lengths<'_>) -> Option<Vec<T>> {
        self.gather_rows(0..self.owners.len(), parts, lengths)
    }

    /// Gathers the data of some rows. The lengths are those of these rows alone. `None` if they do not match.
    pub(crate) fn gather_rows<T: Clone>(
        &self,
        rows: Range<usize>,
        parts: &[Vec<T>],
        lengths: Lengths<'_>,
    ) -> Option<Vec<T>> {
        let mut rest: Vec<&[T]> = parts.iter().map(Vec::as_slice).collect();
        let mut whole = Vec::with_capacity(parts.iter().map(Vec::len).sum());
        for (row, owner) in self.owners.get(rows)?.iter().enumerate() {
            let (values, after) = rest.get(*owner)?.split_at_checked(lengths.of(row))?;
            whole.extend_from_slice(values);
            rest[*owner] = after;
        }
        rest.iter().all(|rest| rest.is_empty()).then_some(whole)
    }

    /// Scatters the data of all rows to the parts.
    pub(crate) fn scatter<T: Clone>(&self, whole: &[T], lengths: Lengths<'_>) -> Vec<Vec<T>> {
        self.scatter_rows(0..self.owners.len(), whole, lengths)
    }

    /// Scatters the data of some rows. The lengths are those of these rows alone.
    pub(crate) fn scatter_rows<T: Clone>(
        &self,
        rows: Range<usize>,
        mut whole: &[T],
        lengths: Lengths<'_>,
    ) -> Vec<Vec<T>> {
        let mut parts = vec![Vec::new(); self.parts];
        for (row, owner) in self.owners.get(rows).unwrap_or_default().iter().enumerate() {
            let (values, after) = whole.split_at(lengths.of(row).min(whole.len()));
            parts[*owner].extend_from_slice(values);
            whole = after;
        }
        parts
    }

    /// The number of items in each row, from the numbers in each cell.
    pub(crate) fn items(&self, counts: &[u32]) -> Vec<usize> {
        items_of_rows(counts, self.width)
    }

    /// Gathers a population from those of the parts. `sizes` are the sizes of its fields. `None` if the
    /// lengths do not match.
    pub(crate) fn gather_items(&self, parts: Vec<Population>, sizes: &[usize]) -> Option<Population> {
        let counts: Vec<Vec<u32>> = parts.iter().map(|part| part.counts.clone()).collect();
        let counts = self.gather(&counts, Lengths::Same(self.width))?;
        let items = self.items(&counts);
        let labels: Vec<Vec<u32>> = parts.iter().map(|part| part.labels.clone()).collect();
        let field = |(number, size): (usize, &usize)| {
            let values = parts.iter().map(|part| part.fields.get(number).cloned());
            self.gather(&values.collect::<Option<Vec<_>>>()?, Lengths::Each(&items, *size))
        };
        let fields = sizes.iter().enumerate().map(field).collect::<Option<_>>()?;
        Some(Population { labels: self.gather(&labels, Lengths::Each(&items, 1))?, counts, fields })
    }

    /// Scatters a population to the parts.
    pub(crate) fn scatter_items(&self, whole: &Population, sizes: &[usize]) -> Vec<Population> {
        let items = self.items(&whole.counts);
        let counts = self.scatter(&whole.counts, Lengths::Same(self.width));
        let labels = self.scatter(&whole.labels, Lengths::Each(&items, 1));
        let population = |(counts, labels)| Population { counts, labels, fields: Vec::new() };
        let mut parts: Vec<Population> = counts.into_iter().zip(labels).map(population).collect();
        for (values, size) in whole.fields.iter().zip(sizes) {
            let shared = self.scatter(values, Lengths::Each(&items, *size));
            parts.iter_mut().zip(shared).for_each(|(part, values)| part.fields.push(values));
        }
        parts
    }
}

/// The number of items in each row of so many cells, from the numbers in the cells.
pub(crate) fn items_of_rows(counts: &[u32], width: usize) -> Vec<usize> {
    let items = |counts: &[u32]| counts.iter().map(|count| *count as usize).sum();
    counts.chunks_exact(width).map(items).collect()
}
