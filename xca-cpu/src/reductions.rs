//! Reductions of substates of cells. The results of rows are cached: a row that has not changed since is not
//! reduced again.

use crate::activity::Activity;
use crate::dense::Dense;
use crate::layout::Layout;
use rayon::prelude::*;
use xca_core::StoredType;
use xca_core::engine::SubstateId;
use xca_core::reduction::{Reduced, ReducedRows, Reduction, append_row};

/// The number of cached reductions, more than a model's steering usually alternates between.
const MOST_KEPT: usize = 16;

/// The number of rows that are worth the start of a thread.
const ROWS_AT_ONCE: usize = 16;

/// The cached results of recent reductions.
#[derive(Default)]
pub(crate) struct Reductions {
    /// The most recently used is the last.
    kept: Vec<Kept>,
}

/// The results of all rows.
struct Kept {
    substate: SubstateId,
    reduction: Reduction,
    /// The time of the results.
    time: u64,
    rows: Vec<Reduced>,
}

impl Reductions {
    /// Reduces the rows of a substate of cells, component by component.
    pub(crate) fn reduce(
        &mut self,
        (substate, dense): (SubstateId, &Dense),
        layout: &Layout,
        activity: &Activity,
        reduction: &Reduction,
    ) -> ReducedRows {
        let components = dense.stored.components();
        let place =
            self.kept.iter().position(|kept| kept.substate == substate && kept.reduction == *reduction);
        let mut kept = match place {
            Some(place) => self.kept.remove(place),
            None => {
                let rows = vec![Reduced::Nothing; layout.rows() * components];
                Kept { substate, reduction: reduction.clone(), time: 0, rows }
            }
        };
        let is_stale = |row: &usize| place.is_none() || activity.last_change(substate, *row) > kept.time;
        let stale: Vec<usize> = (0..layout.rows()).filter(is_stale).collect();
        let parts = stale.par_chunks(ROWS_AT_ONCE).map(|rows| {
            let mut results = Vec::with_capacity(rows.len() * components);
            rows.iter().for_each(|row| reduce_row(dense, layout, *row, reduction, &mut results));
            results
        });
        let parts: Vec<Vec<Reduced>> = parts.collect();
        let results = parts.iter().flat_map(|part| part.chunks_exact(components));
        for (row, results) in stale.iter().zip(results) {
            kept.rows[row * components..(row + 1) * components].copy_from_slice(results);
        }
        kept.time = activity.time();
        let rows = ReducedRows { components, results: kept.rows.clone() };
        if self.kept.len() == MOST_KEPT {
            self.kept.remove(0);
        }
        self.kept.push(kept);
        rows
    }
}

/// Appends the results of a row of cells. Each element of an array has a plane of its own.
pub(crate) fn reduce_row(
    dense: &Dense,
    layout: &Layout,
    row: usize,
    reduction: &Reduction,
    results: &mut Vec<Reduced>,
) {
    let element = StoredType { length: 1, ..dense.stored };
    for number in 0..dense.stored.length as usize {
        append_row(reduction, element, dense.row_of_plane(layout, row, number), results);
    }
}
