//! The colours of states and kinds.

use super::Quantity;
use xca_checkpoint::components::{DrawnPart, Part};
use xca_core::{HostScalar, HostValue, Schema, Substate, Substates};
use xca_picture::Category;

/// The colour of a value of a substate.
#[derive(Debug, Clone)]
pub(crate) struct ValueColour {
    /// The number of the substate.
    field: usize,
    value: f64,
    colour: [u8; 3],
}

impl ValueColour {
    pub(super) fn all<S: Substates, V: HostValue>(
        substate: Substate<S, V>,
        colours: &[(V::Scalar, [u8; 3])],
    ) -> impl Iterator<Item = Self> {
        let field = substate.index();
        colours.iter().map(move |(value, colour)| Self { field, value: value.to_number(), colour: *colour })
    }
}

/// The states of what is drawn with their colours, from the colour with this number in the palette on; none
/// where it is a number.
pub(super) fn categories(
    schema: &Schema,
    quantity: &Quantity,
    colours: &[ValueColour],
    first: usize,
) -> Vec<Category> {
    let Some(Part { field, component }) = quantity.part() else { return Vec::new() };
    let states = schema.fields.get(field).map(|field| {
        let drawn = DrawnPart::of(field.value_type, component);
        drawn.states(field.value_type)
    });
    let names = states.unwrap_or_default().into_iter().enumerate();
    coloured(names.map(|(number, name)| (number as f64, name)), Some(field), colours, first)
}

/// Values with their names, in the colours that the author gives them, else in those of the palette.
pub(super) fn coloured(
    names: impl Iterator<Item = (f64, String)>,
    field: Option<usize>,
    colours: &[ValueColour],
    first: usize,
) -> Vec<Category> {
    let category = |(number, (value, name)): (usize, (f64, String))| {
        let given = colours.iter().find(|given| Some(given.field) == field && given.value == value);
        let plain = Category::new(first + number, value, name);
        given.map_or(plain.clone(), |given| Category { colour: given.colour, ..plain })
    };
    names.enumerate().map(category).collect()
}
