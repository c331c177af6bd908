//! What is observed of a substate.

use crate::observable::Observable;
use xca_checkpoint::components::state_names;
use xca_core::reduction::{Reduced, Reduction, append_row};
use xca_core::statistics::mean;
use xca_core::{EngineFailure, Field, Precision, ScalarType, StoredScalar, StoredType};

/// What is measured of a substate, row by row.
pub(super) struct MeasuredField {
    field: &'static Field,
    stored: StoredType,
    /// The rows so far, and their values.
    rows: usize,
    values: usize,
    what: What,
}

enum What {
    /// The results for each component so far, of each reduction.
    Reduced(Vec<(Reduction, Vec<Reduced>)>),
    /// For each component, how many values there are of each state.
    Counted(Vec<Vec<u64>>),
}

impl MeasuredField {
    pub(super) fn new(field: &'static Field, precision: Precision) -> Self {
        let stored = field.value_type.stored(precision);
        let components = stored.components();
        let what = match field.value_type.scalar {
            scalar @ (ScalarType::Bool | ScalarType::State(_)) => {
                What::Counted(vec![vec![0; state_names(scalar).len()]; components])
            }
            _ => {
                let extremes = [Reduction::Minimum, Reduction::Maximum];
                let extremes = extremes.into_iter().filter(|_| is_number(field));
                let all = [Reduction::Sum].into_iter().chain(extremes);
                What::Reduced(all.map(|all| (all, vec![Reduced::Nothing; components])).collect())
            }
        };
        Self { field, stored, rows: 0, values: 0, what }
    }

    pub(super) fn stored(&self) -> StoredType {
        self.stored
    }

    /// A component of each of these stored values, if they are floating.
    pub(super) fn floats(&self, values: &[u8], component: usize) -> Vec<f64> {
        let numbers: Vec<f64> = match self.stored.scalar {
            StoredScalar::F32 => {
                values.as_chunks().0.iter().map(|one| f32::from_ne_bytes(*one).into()).collect()
            }
            StoredScalar::F64 => values.as_chunks().0.iter().map(|one| f64::from_ne_bytes(*one)).collect(),
            StoredScalar::U8 | StoredScalar::I32 | StoredScalar::U32 => Vec::new(),
        };
        numbers.into_iter().skip(component).step_by(self.stored.components()).collect()
    }

    /// How many rows there have been.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Adds the stored values of the next row.
    pub(super) fn add_row(&mut self, row: &[u8]) {
        self.rows += 1;
        self.values += row.len() / self.stored.size();
        match &mut self.what {
            What::Reduced(reductions) => {
                let mut of_row = Vec::new();
                for (reduction, results) in reductions {
                    of_row.clear();
                    append_row(reduction, self.stored, row, &mut of_row);
                    for (result, one) in results.iter_mut().zip(&of_row) {
                        *result = result.combine(*one, reduction);
                    }
                }
            }
            What::Counted(counts) => {
                for value in row.chunks_exact(counts.len().max(1)) {
                    for (counts, state) in counts.iter_mut().zip(value) {
                        if let Some(count) = counts.get_mut(usize::from(*state)) {
                            *count += 1;
                        }
                    }
                }
            }
        }
    }

    /// The observables; `numbers` gives all numbers of a component once more.
    pub(super) fn observables(
        &self,
        prefix: &str,
        numbers: impl Fn(usize) -> Result<Vec<f64>, EngineFailure>,
    ) -> Result<Vec<Observable>, EngineFailure> {
        let name = |what: &str| format!("{prefix}{}_{what}", self.field.name);
        let components = self.field.value_type.component_names();
        let reductions = match &self.what {
            What::Reduced(reductions) => reductions,
            What::Counted(counts) => {
                let named = components.iter().zip(counts).flat_map(|(component, counts)| {
                    let gap = if component.is_empty() { "" } else { "_" };
                    let counted = self.states().zip(counts);
                    counted.map(move |(state, count)| (format!("{component}{gap}{state}"), *count as f64))
                });
                // Of `bool`, only those that are true.
                let is_told =
                    |index: usize| self.field.value_type.scalar != ScalarType::Bool || index % 2 == 1;
                let told = named.enumerate().filter(|(index, _)| is_told(*index));
                return Ok(told.map(|(_, (what, count))| Observable::number(name(&what), count)).collect());
            }
        };
        let result = |number: usize, component: usize, of_nothing: f64| {
            reductions[number].1[component].number().unwrap_or(of_nothing)
        };
        let mean = |component: usize| -> Result<f64, EngineFailure> {
            match result(0, component, 0.0) / self.values as f64 {
                mean_of if mean_of.is_infinite() => Ok(mean(numbers(component)?.into_iter())),
                mean_of => Ok(mean_of),
            }
        };
        if !is_number(self.field) {
            let components = components.iter().enumerate();
            return components
                .map(|(index, component)| {
                    Ok(Observable::number(name(&format!("{component}_mean")), mean(index)?))
                })
                .collect();
        }
        let is_float = matches!(self.stored.scalar, StoredScalar::F32 | StoredScalar::F64);
        let (middle, value) = if is_float { ("mean", mean(0)?) } else { ("sum", result(0, 0, 0.0)) };
        Ok(vec![
            Observable::number(name("min"), result(1, 0, f64::NAN)),
            Observable::number(name(middle), value),
            Observable::number(name("max"), result(2, 0, f64::NAN)),
        ])
    }

    fn states(&self) -> impl Iterator<Item = String> + use<> {
        state_names(self.field.value_type.scalar).into_iter()
    }
}

/// Whether a substate is a single number, not a vector or an array.
fn is_number(field: &Field) -> bool {
    field.value_type.component_names()[0].is_empty()
}
