//! The check that substates are finite.

use super::{RunError, Simulation};
use crate::engine::{EngineFailure, Fault, SubstateId};
use crate::model::GroupKind;
use crate::reduction::{Reduced, Reduction};
use xca_values::{StoredScalar, StoredType};

impl Simulation {
    /// Checks that all floating-point substates of cells and items are finite. Skips those of
    /// [`crate::ModelBuilder::allow_non_finite`].
    ///
    /// # Errors
    /// Returns [`Fault::NotFinite`] with the first such value by substate, cell and label, or an error if the
    /// engine lost its state.
    pub fn check_finite(&self) -> Result<(), RunError> {
        for substate in self.model.finite_substates() {
            let counts = self.execution.reduce(substate, &Reduction::CountNonFinite)?;
            if counts.iter().any(|count| !matches!(count, Reduced::Nothing | Reduced::Integer(0))) {
                let fault = self.first_non_finite(substate)?;
                return fault
                    .map_or(Ok(()), |fault| Err(RunError::Fault { step: self.step, text: None, fault }));
            }
        }
        Ok(())
    }

    fn first_non_finite(&self, substate: SubstateId) -> Result<Option<Fault>, EngineFailure> {
        let group = &self.model.groups()[substate.group];
        let field = &group.schema().fields[substate.field];
        let stored = self.model.stored(substate, self.options.precision);
        let Some(found) = NonFinite::first(stored, &self.execution.read(substate)?) else { return Ok(None) };
        let (cell, label) = match group.kind() {
            GroupKind::Cells { .. } => (found.index, None),
            GroupKind::Population { .. } => {
                let items = self.execution.population(substate.group)?;
                // The number of items up to each cell, itself among them.
                let ends = items.counts.iter().scan(0, |end, count| {
                    *end += *count as usize;
                    Some(*end)
                });
                let cell = ends.take_while(|end| *end <= found.index).count();
                (cell, items.labels.get(found.index).copied())
            }
        };
        let suffix = field.value_type.component_suffixes().into_iter().nth(found.component);
        Ok(Some(Fault::NotFinite {
            substate: format!("{}.{}{}", group.schema().name, field.name, suffix.unwrap_or_default()),
            cell: self.model.geometry().indices(cell),
            label,
            value: found.value,
        }))
    }
}

/// A NaN or an infinity among stored values.
struct NonFinite {
    /// Which of the values.
    index: usize,
    /// Which component of it.
    component: usize,
    value: f64,
}

impl NonFinite {
    fn first(stored: StoredType, values: &[u8]) -> Option<Self> {
        let number = |bytes: &[u8]| -> f64 {
            match stored.scalar {
                StoredScalar::F32 => bytemuck::pod_read_unaligned::<f32>(bytes).into(),
                StoredScalar::F64 => bytemuck::pod_read_unaligned(bytes),
                StoredScalar::U8 | StoredScalar::I32 | StoredScalar::U32 => 0.0,
            }
        };
        let mut numbers = values.chunks_exact(stored.scalar.size()).map(number).enumerate();
        let (place, value) = numbers.find(|(_, value)| !value.is_finite())?;
        let components = stored.components();
        Some(Self { index: place / components, component: place % components, value })
    }
}
