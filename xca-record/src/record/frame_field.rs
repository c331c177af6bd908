//! A substate as an array of a frame.

use super::values::Plane;
use crate::components::state_names;
use xca_core::Field;
use xca_io::vtk::DataArray;

/// The values of a substate, with the names that a frame keeps.
pub(super) struct FrameField {
    name: &'static str,
    plane: Plane,
    /// Of an array; VTK has names of its own for the lanes of a vector.
    components: Vec<String>,
    states: Vec<String>,
}

impl FrameField {
    pub(super) fn new(field: &Field, plane: Plane) -> Self {
        let components = field.value_type.length.map(|_| field.value_type.component_suffixes());
        Self {
            name: field.name,
            plane,
            components: components.unwrap_or_default(),
            states: state_names(field.value_type.scalar),
        }
    }

    pub(super) fn array(&self) -> DataArray<'_> {
        let array = DataArray::new(self.name, self.plane.as_values());
        array.with_components(&self.components).with_states(&self.states)
    }
}
