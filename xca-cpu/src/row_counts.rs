//! Counts of the work in each row of a part, by which the parts of a space are balanced.

use crate::activity::Activity;
use crate::group::Group;
use xca_core::engine::RowWork;
use xca_core::{Model, ProcessKind};

/// The work since the start, but for passes that skip cells: [`Activity`] counts their cells.
pub(crate) struct RowCounts {
    /// The number of cells in a row.
    width: u64,
    /// The cells of each row that processes have run on, in passes over all cells.
    cells_of_each: u64,
    /// The items of each row that processes have run on.
    items: Vec<u64>,
}

impl RowCounts {
    pub(crate) fn new(rows: usize, width: usize) -> Self {
        Self { width: width as u64, cells_of_each: 0, items: vec![0; rows] }
    }

    /// Counts a pass of a stage. `skips` tells whether it runs only on cells that are due.
    pub(crate) fn ran(&mut self, model: &Model, stage: &[usize], groups: &[Group], skips: bool) {
        for &process in stage {
            if !skips && model.processes()[process].kind == ProcessKind::Cells {
                self.cells_of_each += self.width;
            }
            if let Some(group) = model.plan().process(process).population
                && let Group::Population(population) = &groups[group]
            {
                let rows = self.items.iter_mut().zip(population.places());
                rows.for_each(|(items, places)| *items += places.len() as u64);
            }
        }
    }

    /// The work of each row.
    pub(crate) fn work(&self, activity: Option<&Activity>) -> RowWork {
        let mut cells = vec![self.cells_of_each; self.items.len()];
        if let Some(activity) = activity {
            cells.iter_mut().zip(activity.work_of_rows()).for_each(|(all, due)| *all += due);
        }
        RowWork { cells, items: self.items.clone() }
    }
}
