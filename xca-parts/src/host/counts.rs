//! What the host counts in all parts: items and work.

use super::Host;
use crate::message::{Census, Command, Reply};
use crate::rows::Lengths;
use xca_core::engine::{EngineFailure, RowWork};

impl Host {
    /// The number of items in each row. `None` for a group of cells.
    pub(super) fn items_of_rows(&self, group: usize) -> Result<Option<Vec<usize>>, EngineFailure> {
        if !self.is_population(group) {
            return Ok(None);
        }
        let items = |reply| match reply {
            Reply::ItemsOfRows { items } => Some(items),
            _ => None,
        };
        let replies = self.ask(&Command::ItemsOfRows { group })?;
        let parts: Option<Vec<Vec<usize>>> = replies.into_iter().map(items).collect();
        let items = parts.and_then(|parts| self.rows.gather(&parts, Lengths::Same(1)));
        items.map(Some).ok_or_else(|| self.garbled())
    }

    /// The census of a population over all parts.
    pub(super) fn census(&self, group: usize) -> Result<Census, EngineFailure> {
        if !self.is_population(group) {
            return Ok(Census::default());
        }
        let mut all = Census::default();
        for reply in self.ask(&Command::Census { group })? {
            let Reply::Census { census } = reply else { return Err(self.garbled()) };
            all.items += census.items;
            all.left += census.left;
            all.largest_occupancy = all.largest_occupancy.max(census.largest_occupancy);
        }
        all.left += self.left[group];
        Ok(all)
    }

    /// The work of each row since the executions started.
    pub(super) fn work(&self) -> Result<RowWork, EngineFailure> {
        let work = |reply| match reply {
            Reply::Work { work } => Some((work.cells, work.items)),
            _ => None,
        };
        let parts = self.ask(&Command::Work)?.into_iter().map(work).collect::<Option<_>>();
        let (cells, items): (Vec<Vec<u64>>, Vec<Vec<u64>>) = parts.ok_or_else(|| self.garbled())?;
        if cells.iter().any(Vec::is_empty) {
            return Ok(RowWork::default());
        }
        let gather = |parts: &[Vec<u64>]| self.rows.gather(parts, Lengths::Same(1));
        let work = gather(&cells).zip(gather(&items)).map(|(cells, items)| RowWork { cells, items });
        work.ok_or_else(|| self.garbled())
    }
}
