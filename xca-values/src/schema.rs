//! Names and types of the fields of a substate or parameter struct.

use crate::interval::Interval;
use crate::value::ValueType;

/// The fields of a struct that derives `Substates` or `Parameters`.
#[derive(Debug, PartialEq)]
pub struct Schema {
    /// The name of the struct.
    pub name: &'static str,
    /// The fields in the order of the source.
    pub fields: &'static [Field],
    /// The index of the field marked `#[position]`, for populations.
    pub position: Option<usize>,
}

/// A field: one substate or one parameter.
#[derive(Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// Its type.
    pub value_type: ValueType,
    /// Its documentation in the source, in one line.
    pub documentation: &'static str,
    /// Its unit, such as `m/s`.
    pub unit: Option<&'static str>,
    /// The range of a parameter, for each component.
    pub range: Interval,
    /// Whether a parameter is computed from others, and cannot be set.
    pub computed: bool,
}

impl Schema {
    /// The index and the description of the field with this name.
    pub fn field(&self, name: &str) -> Option<(usize, &'static Field)> {
        self.fields.iter().enumerate().find(|(_, field)| field.name == name)
    }

    /// The names of the components of a field in tables. A scalar has the name of the field. Others are
    /// called `field_x`, `field_3` or `field_3_x` ([`ValueType::component_names`]). Those of the position are
    /// `x`, `y` and `z`.
    pub fn columns(&self, field: usize) -> Vec<String> {
        let Field { name, value_type, .. } = &self.fields[field];
        let whole = |component: String| match component.as_str() {
            "" => (*name).to_owned(),
            _ if self.position == Some(field) => component,
            _ => format!("{name}_{component}"),
        };
        value_type.component_names().into_iter().map(whole).collect()
    }

    /// The names of all fields, separated by commas, for messages.
    pub fn names(&self) -> String {
        self.fields.iter().map(|field| field.name).collect::<Vec<_>>().join(", ")
    }
}
