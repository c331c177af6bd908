//! The substates of a struct.

use crate::dense::Dense;
use crate::population::Population;

/// The substates of one struct.
#[allow(clippy::large_enum_variant, reason = "a model has a few of them")]
pub(crate) enum Group {
    Cells(Vec<Dense>),
    Population(Population),
}

/// The population, of a group that is one.
pub(crate) fn population(group: &Group) -> Option<&Population> {
    match group {
        Group::Population(population) => Some(population),
        Group::Cells(_) => None,
    }
}
