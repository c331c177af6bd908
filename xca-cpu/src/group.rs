//! The substates of a struct.

use crate::dense::Dense;
use crate::layout::Layout;
use crate::population::Population;
use xca_core::engine::SubstateId;
use xca_core::model::{Group as Definition, GroupKind};
use xca_core::{Model, Precision, StoredType};

/// The substates of one struct.
#[allow(clippy::large_enum_variant, reason = "a model has a few of them")]
pub(crate) enum Group {
    Cells(Vec<Dense>),
    Population(Population),
}

/// The population of a group, if it is one.
pub(crate) fn population(group: &Group) -> Option<&Population> {
    match group {
        Group::Population(population) => Some(population),
        Group::Cells(_) => None,
    }
}

/// The groups of a model, without values.
pub(crate) fn groups(model: &Model, layout: &Layout, precision: Precision, skin: Option<f64>) -> Vec<Group> {
    let mut buffers = 0..;
    let group = |(number, group): (usize, &Definition)| {
        let GroupKind::Cells { .. } = group.kind() else {
            return Group::Population(Population::new(group, precision, layout, skin));
        };
        let mut plane = |(field, stored): (usize, StoredType)| {
            let outside = group.outside(field, precision).unwrap_or_default();
            let substate = SubstateId { group: number, field };
            let (doubled, elsewhere) =
                (model.plan().is_doubled(substate), model.plan().is_read_elsewhere(substate));
            let numbers = [(); 2].map(|()| buffers.next().unwrap_or(0));
            Dense::new(stored, layout, (&outside, numbers), doubled, elsewhere)
        };
        Group::Cells(group.stored(precision).into_iter().enumerate().map(&mut plane).collect())
    };
    model.groups().iter().enumerate().map(group).collect()
}
