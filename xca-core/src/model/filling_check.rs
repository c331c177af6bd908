//! What the functions that make the initial state need of the model.

use super::{Group, GroupKind, ModelError};
use crate::parameter_set::ParameterSet;
use std::any::TypeId;
use xca_process::Parameters;
use xca_process::Substates;

/// What a function makes, and of what.
#[derive(Debug, Clone, Copy)]
pub(super) struct Filling {
    substates: Named,
    /// Whether it makes items, and not the states of cells.
    of_items: bool,
    parameters: Option<Named>,
}

/// A type with the name that users know it by.
#[derive(Debug, Clone, Copy)]
struct Named {
    type_id: TypeId,
    name: &'static str,
}

impl Filling {
    /// Of cells.
    pub(super) fn cells<S: Substates>() -> Self {
        Self { substates: Named::substates::<S>(), of_items: false, parameters: None }
    }

    /// Of a population.
    pub(super) fn items<S: Substates>() -> Self {
        Self { of_items: true, ..Self::cells::<S>() }
    }

    /// The same, with parameters.
    pub(super) fn with<P: Parameters>(self) -> Self {
        let parameters = Named { type_id: TypeId::of::<P>(), name: P::SCHEMA.name };
        Self { parameters: Some(parameters), ..self }
    }

    /// Looks for what it makes and needs.
    pub(super) fn check(&self, groups: &[Group], parameters: &ParameterSet) -> Result<(), ModelError> {
        let substates = self.substates.name;
        let group = groups.iter().find(|group| group.type_id == self.substates.type_id);
        match (group.map(|group| &group.kind), self.of_items) {
            (None, _) => return Err(ModelError::NotAdded { substates }),
            (Some(GroupKind::Population { .. }), false) => {
                return Err(ModelError::FillOfPopulation { substates });
            }
            (Some(GroupKind::Cells { .. }), true) => return Err(ModelError::PopulatedCells { substates }),
            _ => {}
        }
        match self.parameters {
            Some(wanted) if parameters.struct_of_type(wanted.type_id).is_none() => {
                let (wanted, given) = (wanted.name, parameters.listed());
                Err(ModelError::InitialParameters { substates, wanted, given })
            }
            _ => Ok(()),
        }
    }
}

impl Named {
    fn substates<S: Substates>() -> Self {
        Self { type_id: TypeId::of::<S>(), name: S::SCHEMA.name }
    }
}
