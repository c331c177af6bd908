//! What is observed of a model that does not say it.

use crate::program::Observable;
use xca_core::engine::Population;
use xca_core::model::{Group, GroupKind};
use xca_core::reduction::{Reduction, reduce_values};
use xca_core::{GroupSnapshot, Model, Precision, Snapshot};

/// The least, mean and largest value of each floating substate, the sum, least and largest of each whole-numbered one, the mean of each lane of
/// a vector; and of a population, how many items it has and how many the fullest cell holds.
pub(super) fn measure(model: &Model, precision: Precision, snapshot: &Snapshot) -> Vec<Observable> {
    let mut observables = Vec::new();
    for (group, state) in model.groups().iter().zip(&snapshot.groups) {
        let prefix = if model.groups().len() > 1 {
            format!("{}_", group.schema().name.to_lowercase())
        } else {
            String::new()
        };
        let fields = match state {
            GroupSnapshot::Cells(fields) => fields,
            GroupSnapshot::Population(population, left) => {
                observables.extend(count(group, &prefix, population, *left));
                &population.fields
            }
        };
        for (field, bytes) in fields.iter().enumerate() {
            observables.extend(of_field(group, field, precision, &prefix, bytes));
        }
    }
    observables
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
    let sum = reduced(Reduction::Sum, 0.0);
    if sum.len() > 1 {
        let lanes = ["x", "y", "z", "w"].into_iter().zip(sum);
        return lanes
            .map(|(lane, sum)| Observable::number(name(&format!("{lane}_mean")), sum / count))
            .collect();
    }
    let is_float = matches!(stored.scalar, xca_core::StoredScalar::F32 | xca_core::StoredScalar::F64);
    let (middle, value) = if is_float { ("mean", sum[0] / count) } else { ("sum", sum[0]) };
    vec![
        Observable::number(name("min"), reduced(Reduction::Minimum, f64::NAN)[0]),
        Observable::number(name(middle), value),
        Observable::number(name("max"), reduced(Reduction::Maximum, f64::NAN)[0]),
    ]
}
