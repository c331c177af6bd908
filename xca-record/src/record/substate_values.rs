//! The values of a substate, with what is known of it.

use super::values::Plane;
use xca_checkpoint::components::state_names;
use xca_core::Field;
use xca_io::vtk::DataArray;

/// The values of a substate that is saved.
#[derive(Debug, Clone)]
pub struct SubstateValues {
    field: &'static Field,
    plane: Plane,
    /// Of an array; VTK has names of its own for the lanes of a vector.
    components: Vec<String>,
    states: Vec<String>,
}

impl SubstateValues {
    pub(super) fn new(field: &'static Field, plane: Plane) -> Self {
        let components = field.value_type.length.map(|_| field.value_type.component_suffixes());
        let states = state_names(field.value_type.scalar);
        Self { field, plane, components: components.unwrap_or_default(), states }
    }

    /// The definition of the substate: its name, type, unit and documentation.
    pub fn field(&self) -> &'static Field {
        self.field
    }

    /// One value for each cell, or for each item by label.
    pub fn values(&self) -> &Plane {
        &self.plane
    }

    /// What `bool` and states are called, by number; nothing of numbers.
    pub fn states(&self) -> &[String] {
        &self.states
    }

    pub(crate) fn array(&self) -> DataArray<'_> {
        let array = DataArray::new(self.field.name, self.plane.as_values());
        array.with_components(&self.components).with_states(&self.states)
    }
}
