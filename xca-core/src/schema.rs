//! What the fields of a substate or parameter struct are called and hold.

use crate::value::ValueType;

/// The fields of a struct that derives `Substates` or `Parameters`.
#[derive(Debug, PartialEq, Eq)]
pub struct Schema {
    /// The name of the struct.
    pub name: &'static str,
    /// The fields in the order of the source.
    pub fields: &'static [Field],
    /// The index of the field marked `#[position]`, for populations.
    pub position: Option<usize>,
}

/// A field: one substate or one parameter.
#[derive(Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// What it holds.
    pub value_type: ValueType,
}

impl Schema {
    /// The index and the description of the field with this name.
    pub fn field(&self, name: &str) -> Option<(usize, &'static Field)> {
        self.fields.iter().enumerate().find(|(_, field)| field.name == name)
    }

    /// What the lanes of the field with this number are called in tables: a scalar like the field, the lanes
    /// of a vector `field_x` and so on, those of the position `x`, `y`, `z`.
    pub fn columns(&self, field: usize) -> Vec<String> {
        let Field { name, value_type } = &self.fields[field];
        let lanes = usize::from(value_type.lanes);
        if lanes == 1 {
            return vec![(*name).to_owned()];
        }
        let letters = ["x", "y", "z", "w"].into_iter().take(lanes);
        if self.position == Some(field) {
            letters.map(str::to_owned).collect()
        } else {
            letters.map(|letter| format!("{name}_{letter}")).collect()
        }
    }

    /// The names of all fields, separated by commas, for messages.
    pub fn names(&self) -> String {
        self.fields.iter().map(|field| field.name).collect::<Vec<_>>().join(", ")
    }
}
