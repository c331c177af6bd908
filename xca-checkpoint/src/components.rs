//! Names and texts of the components of a value.
//!
//! Files and columns take their names from [`ValueType::component_names`] (`outflow_3_x`). People read
//! `outflow[3].x`. The command line accepts this form and `outflow.3.x`, which needs no quotes in any shell.

use serde_json::Value;
use xca_core::{Field, ScalarType, ValueType};

/// A substate, or one component of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// The index of the field.
    pub field: usize,
    /// The index of the component. `None`: the whole value.
    pub component: Option<usize>,
}

impl Part {
    /// The substate or component with this name in a struct.
    pub fn named(fields: &[Field], name: &str) -> Option<Self> {
        let find = |field: &Field| -> Option<Option<usize>> {
            match name.strip_prefix(field.name)? {
                "" => Some(None),
                rest if rest.starts_with(['.', '[']) => field.value_type.component_named(rest).map(Some),
                _ => None,
            }
        };
        fields
            .iter()
            .enumerate()
            .find_map(|(index, field)| find(field).map(|component| Self { field: index, component }))
    }
}

/// The number of a value that pictures show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawnPart {
    /// The component with this index.
    Component(usize),
    /// The sum of the elements of an array. For `bool`, the number of true ones.
    Sum,
    /// The length of a vector. For an array of vectors, the length of their sum.
    Length {
        /// The number of lanes of the vector.
        lanes: usize,
    },
}

impl DrawnPart {
    /// The drawn number of a value: the given component, if there is one. Otherwise the length of a vector,
    /// the sum of an array, or the length of the sum of an array of vectors. For an array of states, the
    /// first element.
    pub fn of(value_type: ValueType, component: Option<usize>) -> Self {
        let ValueType { scalar, lanes, length } = value_type;
        match (component, lanes, length, scalar) {
            (Some(component), ..) => Self::Component(component),
            (None, 2.., ..) => Self::Length { lanes: lanes.into() },
            (None, _, None, _) | (None, _, _, ScalarType::State(_)) => Self::Component(0),
            (None, _, Some(_), _) => Self::Sum,
        }
    }

    /// The label of the scale in a picture.
    pub fn label(self, field: &Field) -> String {
        let name = field.name;
        match (self, field.value_type.length) {
            (Self::Component(component), _) => name_of(field, Some(component)),
            (Self::Sum, _) if field.value_type.scalar == ScalarType::Bool => format!("{name}: how many"),
            (Self::Sum, _) => format!("sum of {name}"),
            (Self::Length { .. }, None) => format!("length of {name}"),
            (Self::Length { .. }, Some(_)) => format!("length of the sum of {name}"),
        }
    }

    /// The names of its states. Empty for a number.
    pub fn states(self, value_type: ValueType) -> Vec<String> {
        match self {
            Self::Component(_) => state_names(value_type.scalar),
            Self::Sum | Self::Length { .. } => Vec::new(),
        }
    }
}

/// The name of a component, or of the whole value: `outflow[3].x`.
pub fn name_of(field: &Field, component: Option<usize>) -> String {
    let suffix =
        component.and_then(|component| field.value_type.component_suffixes().into_iter().nth(component));
    format!("{}{}", field.name, suffix.unwrap_or_default())
}

/// The names of the values of `bool` and of states, by number. Empty for numbers.
pub fn state_names(scalar: ScalarType) -> Vec<String> {
    match scalar {
        ScalarType::Bool => vec!["false".to_owned(), "true".to_owned()],
        ScalarType::State(names) => names.states.iter().map(|name| (*name).to_owned()).collect(),
        _ => Vec::new(),
    }
}

/// The name of a number, if its type has names and the number is one of its values.
pub fn state_name(states: &[String], number: f64) -> Option<&str> {
    let index = (number.fract() == 0.0 && number >= 0.0).then_some(number as usize)?;
    states.get(index).map(String::as_str)
}

/// The text of a component: all digits, or the name of its state.
pub fn text(states: &[String], number: f64) -> String {
    state_name(states, number).map_or_else(|| format!("{number:?}"), str::to_owned)
}

/// A component as JSON: a name, a truth value or a number.
pub fn json(scalar: ScalarType, number: f64) -> Value {
    match scalar {
        ScalarType::Bool => Value::Bool(number != 0.0),
        ScalarType::State(_) => Value::String(scalar.text(number)),
        ScalarType::U8 | ScalarType::I32 | ScalarType::U32 => Value::from(number as i64),
        ScalarType::F32 | ScalarType::F64 | ScalarType::Real => Value::from(number),
    }
}

/// The name of a type with its states: `[Ground; 4] (Rock, Soil, Water)`.
pub fn type_text(value_type: ValueType) -> String {
    match value_type.scalar {
        ScalarType::State(names) => format!("{value_type} ({})", names.states.join(", ")),
        _ => value_type.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use xca_core::States;
    use xca_core::prelude::*;

    #[derive(States, Clone, Copy, PartialEq)]
    enum Ground {
        Rock,
        Water,
    }

    #[derive(Substates, Clone, Copy)]
    #[allow(dead_code, reason = "only its schema is looked at")]
    struct Lava {
        out: u8,
        outflow: [Vector2<Real>; 3],
        flow: Vector3<Real>,
        ground: [Ground; 2],
    }

    #[test]
    fn components_are_found_by_each_of_their_names() {
        let fields = Lava::SCHEMA.fields;
        let found = |name: &str| Part::named(fields, name).map(|part| (part.field, part.component));
        assert_eq!(found("out"), Some((0, None)));
        assert_eq!(found("outflow"), Some((1, None)));
        for name in ["outflow.2.y", "outflow[2].y"] {
            assert_eq!(found(name), Some((1, Some(5))), "{name}");
        }
        assert_eq!(found("flow.z"), Some((2, Some(2))));
        assert_eq!(found("ground[1]"), Some((3, Some(1))));
        for name in ["outflow.3.x", "outflow.2", "outflow.", "out.0", "flow.w", "outf", "ground[2]", ""] {
            assert_eq!(found(name), None, "{name}");
        }
        for field in fields {
            for component in 0..field.value_type.components() {
                let name = name_of(field, Some(component));
                let part = Part::named(fields, &name).unwrap();
                assert_eq!(fields[part.field].name, field.name);
                assert_eq!(part.component.unwrap_or(0), component, "{name}");
            }
        }
        assert_eq!(fields[1].value_type.component_suffixes()[4..], ["[2].x", "[2].y"]);
        assert_eq!(fields[2].value_type.component_suffixes(), [".x", ".y", ".z"]);
        assert_eq!(fields[0].value_type.component_suffixes(), [""]);
    }

    #[test]
    fn states_have_names_and_numbers_have_digits() {
        let ground = ScalarType::State(Ground::NAMES);
        let names = state_names(ground);
        assert_eq!([text(&names, 1.0), text(&names, 2.0), text(&[], 0.1)], ["Water", "2.0", "0.1"]);
        assert_eq!(text(&state_names(ScalarType::Bool), 1.0), "true");
        assert_eq!(state_name(&names, -1.0), None);
        assert_eq!(json(ScalarType::Bool, 1.0), serde_json::json!(true));
        assert_eq!(json(ground, 0.0), serde_json::json!("Rock"));
        assert_eq!(json(ScalarType::U32, 7.0).to_string(), "7");
        assert_eq!(type_text(ValueType::scalar(ground).array(2)), "[Ground; 2] (Rock, Water)");
    }
}
