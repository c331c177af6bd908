//! The space and the substates of a model: all that a state needs to know of it.

use super::Group;
use crate::engine::SubstateId;
use std::any::TypeId;
use xca_process::Geometry;
use xca_process::Substates;
use xca_values::{Precision, StoredType};

/// The space and the substates of a model.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    /// The model's name.
    pub(super) name: String,
    pub(super) geometry: Geometry,
    pub(super) groups: Vec<Group>,
}

impl Structure {
    /// The model's name.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The cellular space.
    pub(crate) fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The structs of substates, in the order of their addition.
    pub(crate) fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The number of the group of this type, if the model has it.
    pub(crate) fn group_number(&self, type_id: TypeId) -> Option<usize> {
        self.groups.iter().position(|group| group.type_id == type_id)
    }

    /// The number of the group of the struct `S`, if the model has it.
    pub(crate) fn group_of<S: Substates>(&self) -> Option<usize> {
        self.group_number(TypeId::of::<S>())
    }

    /// The machine type of a substate.
    pub(crate) fn stored(&self, substate: SubstateId, precision: Precision) -> StoredType {
        self.groups[substate.group].schema.fields[substate.field].value_type.stored(precision)
    }
}
