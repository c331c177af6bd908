//! Items that are made row by row, for engines that take them so.

use super::{State, StateError};
use crate::engine::{EngineFailure, InputError, Plane, Population, SubstateId, full_cell};
use crate::model::GroupKind;
use std::ops::Range;

/// The size of the blocks in which items are made, in bytes, if a cell has one item.
const BLOCK: usize = 1 << 22;

impl State<'_> {
    /// Replaces the items of a population. `make` gives those of some rows, one block of rows after the
    /// other. An engine that takes items by rows needs no second copy of all.
    pub(super) fn set_items_of_rows(
        &mut self,
        group: usize,
        mut make: impl FnMut(&Self, Range<usize>) -> Population,
    ) -> Result<(), StateError> {
        let [width, height, depth] = self.geometry().extents();
        let rows = height * depth;
        if !self.execution.collect_items(Plane::Counts(group), 0..0, &[])? {
            let population = make(self, 0..rows);
            return Ok(self.execution.set_population(group, &population)?);
        }
        let definition = &self.structure.groups()[group];
        let GroupKind::Population { slots, .. } = *definition.kind() else { return Ok(()) };
        let size: usize = definition.sizes(self.precision).iter().sum();
        let step = (BLOCK / (width * size).max(1)).max(1);
        let mut items = 0;
        for start in (0..rows).step_by(step) {
            let rows = start..(start + step).min(rows);
            let Population { counts, labels, fields } = make(self, rows.clone());
            let place = |cell: usize| self.geometry().indices(start * width + cell);
            full_cell(&counts, slots, place).map_or(Ok(()), Err)?;
            items += labels.len() as u64;
            if items > 1 << 32 {
                let (substates, reason) =
                    (definition.schema().name, "it has more items than labels".to_owned());
                return Err(EngineFailure::Input(InputError::Items { substates, reason }).into());
            }
            let [counts, labels]: [&[u8]; 2] = [&counts, &labels].map(|all| bytemuck::cast_slice(all));
            let values = |(field, values)| (Plane::Values(SubstateId { group, field }), values);
            let fields = fields.iter().map(Vec::as_slice).enumerate().map(values);
            let planes = [(Plane::Counts(group), counts), (Plane::Labels(group), labels)];
            for (plane, bytes) in planes.into_iter().chain(fields) {
                self.execution.collect_items(plane, rows.clone(), bytes)?;
            }
        }
        Ok(self.execution.set_collected_items(group)?)
    }
}
