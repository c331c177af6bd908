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
    /// What it holds. A `bool`, a state and a `u8` take the four bytes of a `u32`.
    pub value_type: ValueType,
    /// Where it begins, in bytes; the lanes of an element follow each other.
    pub offset: u32,
    /// From one element of an array to the next, in bytes.
    pub stride: u32,
}

impl Layout {
    /// The layout that WGSL gives to these fields in a storage buffer, and, where none of them is an array,
    /// in a uniform buffer too.
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
            let stride = (scalar * lanes).next_multiple_of(alignment);
            layout.fields.push(FieldLayout { name: name.to_owned(), value_type, offset, stride });
            end = offset + value_type.length.map_or(scalar * lanes, |length| stride * length);
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

const NUMBER: ValueType = ValueType::scalar(ScalarType::U32);
const REAL: ValueType = ValueType::scalar(ScalarType::Real);

/// The fields of the description of the space.
pub(crate) const SPACE: [(&str, ValueType); 13] = [
    ("extents", ValueType::vector(ScalarType::I32, 3)),
    ("neighbours", NUMBER),
    ("halo", ValueType::vector(ScalarType::U32, 3)),
    ("row", NUMBER),
    ("first", ValueType::vector(ScalarType::U32, 3)),
    ("base", NUMBER),
    ("count", ValueType::vector(ScalarType::U32, 3)),
    ("layer", NUMBER),
    ("seed", ValueType::vector(ScalarType::U32, 2)),
    ("stream", NUMBER),
    ("side", REAL),
    ("covered", REAL),
    ("zero", REAL),
];

/// The fields of what changes from step to step.
pub(crate) const MOMENT: [(&str, ValueType); 2] =
    [("step", ValueType::vector(ScalarType::U32, 2)), ("items", NUMBER)];

/// The fields of the record of a fault: where it is, what happened ([`crate::FaultKind`]), and what that kind
/// tells of it.
pub(crate) const FAULT: [(&str, ValueType); 6] = [
    ("cell", NUMBER),
    ("label", NUMBER),
    ("kind", NUMBER),
    ("number", NUMBER),
    ("limit", NUMBER),
    ("value", REAL),
];
