//! What is observed of a model that does not say it.

use super::values::Plane;
use crate::observable::Observable;
use std::borrow::Cow;
use xca_checkpoint::components::state_names;
use xca_core::engine::Population;
use xca_core::model::{Group, GroupKind};
use xca_core::reduction::{Reduction, reduce_values};
use xca_core::statistics::mean as mean_of;
use xca_core::{GroupSnapshot, Model, Precision, ScalarType, Snapshot};

/// Of each substate: minimum, mean and maximum of floats; minimum, sum and maximum of whole numbers; the mean
/// of each component of a vector or an array of numbers; how many are true; how many are in each state. Of a
/// population: the number of items, and the number in the fullest cell.
/// Cells without ground have no part in them.
pub(super) fn measure(
    model: &Model,
    precision: Precision,
    snapshot: &Snapshot,
    missing: Option<&[bool]>,
) -> Vec<Observable> {
    let mut observables = Vec::new();
    for (group, state) in model.groups().iter().zip(&snapshot.groups) {
        let prefix = if model.groups().len() > 1 {
            format!("{}_", group.schema().name.to_lowercase())
        } else {
            String::new()
        };
        let (fields, missing) = match state {
            GroupSnapshot::Cells(fields) => (fields, missing),
            GroupSnapshot::Population(population, left) => {
                observables.extend(count(group, &prefix, population, *left));
                (&population.fields, None)
            }
        };
        for (field, bytes) in fields.iter().enumerate() {
            let size = group.schema().fields[field].value_type.stored(precision).size();
            let bytes = missing.map_or(Cow::from(bytes), |missing| kept(bytes, size, missing).into());
            observables.extend(of_field(group, field, precision, &prefix, &bytes));
        }
    }
    observables
}

/// The values, of this size, of the cells that have ground.
fn kept(bytes: &[u8], size: usize, missing: &[bool]) -> Vec<u8> {
    let values = bytes.chunks_exact(size).zip(missing).filter(|(_, is_missing)| !**is_missing);
    values.flat_map(|(value, _)| value).copied().collect()
}

fn count(group: &Group, prefix: &str, population: &Population, left: u64) -> Vec<Observable> {
    let number = |name: &str, value: f64| Observable::number(format!("{prefix}{name}"), value);
    let largest = population.counts.iter().copied().max().unwrap_or(0);
    let mut observables = vec![number("items", population.labels.len() as f64)];
    if matches!(group.kind(), GroupKind::Population { may_leave: true, .. }) {
        observables.push(number("left", left as f64));
    }
    observables.push(number("largest_occupancy", f64::from(largest)));
    observables
}

fn of_field(
    group: &Group,
    field: usize,
    precision: Precision,
    prefix: &str,
    bytes: &[u8],
) -> Vec<Observable> {
    let definition = &group.schema().fields[field];
    let stored = definition.value_type.stored(precision);
    let count = (bytes.len() / stored.size()) as f64;
    let reduced = |reduction: Reduction, of_nothing: f64| -> Vec<f64> {
        let results = reduce_values(&reduction, stored, bytes);
        results.into_iter().map(|result| result.number().unwrap_or(of_nothing)).collect()
    };
    let name = |what: &str| format!("{prefix}{}_{what}", definition.name);
    let component_names = definition.value_type.component_names();
    if let scalar @ (ScalarType::Bool | ScalarType::State(_)) = definition.value_type.scalar {
        let component = |(index, component): (usize, String)| {
            let gap = if component.is_empty() { "" } else { "_" };
            let values = bytes.iter().skip(index).step_by(stored.components());
            let counted = counts(scalar, values).into_iter();
            counted
                .map(|(state, count)| Observable::number(name(&format!("{component}{gap}{state}")), count))
                .collect::<Vec<_>>()
        };
        return component_names.into_iter().enumerate().flat_map(component).collect();
    }
    let sum = reduced(Reduction::Sum, 0.0);
    // The sum may be too large where the mean is not.
    let mean = |component: usize| match sum[component] / count {
        mean if mean.is_infinite() => mean_of(Plane::all(stored, bytes).component(component).into_iter()),
        mean => mean,
    };
    if !component_names[0].is_empty() {
        let components = component_names.into_iter().enumerate();
        return components
            .map(|(index, component)| Observable::number(name(&format!("{component}_mean")), mean(index)))
            .collect();
    }
    let is_float = matches!(stored.scalar, xca_core::StoredScalar::F32 | xca_core::StoredScalar::F64);
    let (middle, value) = if is_float { ("mean", mean(0)) } else { ("sum", sum[0]) };
    vec![
        Observable::number(name("min"), reduced(Reduction::Minimum, f64::NAN)[0]),
        Observable::number(name(middle), value),
        Observable::number(name("max"), reduced(Reduction::Maximum, f64::NAN)[0]),
    ]
}

/// How many values are true, or how many there are of each state.
fn counts<'a>(scalar: ScalarType, values: impl Iterator<Item = &'a u8>) -> Vec<(String, f64)> {
    let states = state_names(scalar);
    let mut counts = vec![0_u64; states.len()];
    for value in values {
        if let Some(count) = counts.get_mut(usize::from(*value)) {
            *count += 1;
        }
    }
    let named = states.into_iter().zip(counts.into_iter().map(|count| count as f64));
    named.skip(usize::from(scalar == ScalarType::Bool)).collect()
}
