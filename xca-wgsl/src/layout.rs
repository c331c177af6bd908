//! Where the fields of a buffer that is a struct lie.

use xca_core::{Precision, ScalarType, Schema, StoredScalar, ValueType};

/// The layout of a struct in a buffer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layout {
    /// The size in bytes, with the padding at the end.
    pub size: u32,
    /// The fields in order.
    pub fields: Vec<FieldLayout>,
}

/// One field of a [`Layout`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldLayout {
    /// Its name in the model.
    pub name: String,
    /// What it holds. A `u8` takes the four bytes of a `u32`.
    pub value_type: ValueType,
    /// Where it begins, in bytes; lanes follow each other.
    pub offset: u32,
}

impl Layout {
    /// The layout that WGSL gives to these fields.
    pub(crate) fn of<'a>(
        fields: impl IntoIterator<Item = (&'a str, ValueType)>,
        precision: Precision,
    ) -> Self {
        let mut layout = Self { size: 0, fields: Vec::new() };
        let mut end = 0;
        let mut largest = 4;
        for (name, value_type) in fields {
            let scalar = match value_type.stored(precision).scalar {
                StoredScalar::F64 => 8,
                _ => 4,
            };
            let lanes = u32::from(value_type.lanes);
            // A vector of three is aligned like one of four.
            let alignment = scalar * if lanes == 3 { 4 } else { lanes };
            largest = largest.max(alignment);
            let offset = u32::next_multiple_of(end, alignment);
            layout.fields.push(FieldLayout { name: name.to_owned(), value_type, offset });
            end = offset + scalar * lanes;
        }
        layout.size = end.next_multiple_of(largest);
        layout
    }

    /// The layout of a struct of parameters.
    pub(crate) fn of_schema(schema: &Schema, precision: Precision) -> Self {
        Self::of(schema.fields.iter().map(|field| (field.name, field.value_type)), precision)
    }

    /// The field with this name.
    pub fn field(&self, name: &str) -> Option<&FieldLayout> {
        self.fields.iter().find(|field| field.name == name)
    }
}

/// The fields of the description of the space.
pub(crate) const SPACE: [(&str, ValueType); 13] = [
    ("extents", ValueType { scalar: ScalarType::I32, lanes: 3, length: None }),
    ("neighbours", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
    ("halo", ValueType { scalar: ScalarType::U32, lanes: 3, length: None }),
    ("row", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
    ("first", ValueType { scalar: ScalarType::U32, lanes: 3, length: None }),
    ("base", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
    ("count", ValueType { scalar: ScalarType::U32, lanes: 3, length: None }),
    ("layer", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
    ("seed", ValueType { scalar: ScalarType::U32, lanes: 2, length: None }),
    ("stream", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
    ("side", ValueType { scalar: ScalarType::Real, lanes: 1, length: None }),
    ("covered", ValueType { scalar: ScalarType::Real, lanes: 1, length: None }),
    ("zero", ValueType { scalar: ScalarType::Real, lanes: 1, length: None }),
];

/// The fields of what changes from step to step.
pub(crate) const MOMENT: [(&str, ValueType); 2] = [
    ("step", ValueType { scalar: ScalarType::U32, lanes: 2, length: None }),
    ("items", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
];

/// The fields of the record of a fault.
pub(crate) const FAULT: [(&str, ValueType); 4] = [
    ("cell", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
    ("label", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
    ("code", ValueType { scalar: ScalarType::U32, lanes: 1, length: None }),
    ("value", ValueType { scalar: ScalarType::Real, lanes: 1, length: None }),
];
