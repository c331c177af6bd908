//! Types as the shader knows them, and what WGSL calls them.

use xca_core::{Precision, ScalarType, StateNames, ValueType, ir};

/// A type, after inference.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Type {
    Unit,
    Bool,
    Scalar(ScalarType),
    Vector(ScalarType, u8),
    /// A state: a `u32` without arithmetic.
    State(&'static StateNames),
    Array(Box<Type>, usize),
    Tuple(Vec<Type>),
    Destination,
}

impl Type {
    pub(crate) const U32: Self = Self::Scalar(ScalarType::U32);

    pub(crate) fn of_value(value_type: ValueType) -> Self {
        let element = match (value_type.scalar, value_type.lanes) {
            (ScalarType::Bool, _) => Self::Bool,
            (ScalarType::State(names), _) => Self::State(names),
            (scalar, 1) => Self::Scalar(scalar),
            (scalar, lanes) => Self::Vector(scalar, lanes),
        };
        match value_type.length {
            Some(length) => Self::Array(Box::new(element), length as usize),
            None => element,
        }
    }

    /// Whether it is a tuple or an array of such.
    pub(crate) fn holds_tuples(&self) -> bool {
        match self {
            Self::Tuple(_) => true,
            Self::Array(element, _) => element.holds_tuples(),
            _ => false,
        }
    }

    /// The scalar of a number or vector.
    pub(crate) fn scalar(&self) -> Option<ScalarType> {
        match self {
            Self::Scalar(scalar) | Self::Vector(scalar, _) => Some(*scalar),
            _ => None,
        }
    }

    /// The number of lanes of a vector, 1 for everything else.
    pub(crate) fn lanes(&self) -> u8 {
        match self {
            Self::Vector(_, lanes) => *lanes,
            _ => 1,
        }
    }

    pub(crate) fn is_float(&self) -> bool {
        self.scalar().is_some_and(is_float)
    }

    pub(crate) fn is_u8(&self) -> bool {
        self.scalar() == Some(ScalarType::U8)
    }

    /// An integer, or something that is compared like one.
    pub(crate) fn is_discrete(&self) -> bool {
        matches!(self, Self::Bool | Self::State(_)) || matches!(self, Self::Scalar(_)) && !self.is_float()
    }

    /// The type of the elements of an array, and how many there are.
    pub(crate) fn array(&self) -> Option<(&Type, usize)> {
        match self {
            Self::Array(element, length) => Some((element, *length)),
            _ => None,
        }
    }

    /// What WGSL calls it.
    pub(crate) fn wgsl(&self) -> String {
        match self {
            Self::Unit => "()".to_owned(),
            Self::Bool => "bool".to_owned(),
            Self::Scalar(scalar) => scalar_name(*scalar).to_owned(),
            Self::Vector(scalar, lanes) => format!("vec{lanes}<{}>", scalar_name(*scalar)),
            Self::State(_) => "u32".to_owned(),
            Self::Array(element, length) => format!("array<{}, {length}>", element.wgsl()),
            Self::Tuple(_) => self.word(),
            Self::Destination => "Destination".to_owned(),
        }
    }

    /// A part of the name of a routine that works on this type.
    pub(crate) fn word(&self) -> String {
        match self {
            Self::Scalar(scalar) => scalar_name(*scalar).to_lowercase(),
            Self::Vector(scalar, lanes) => format!("vec{lanes}_{}", scalar_name(*scalar).to_lowercase()),
            Self::Array(element, length) => format!("array_{}_{length}", element.word()),
            // With the number of parts, so that tuples in tuples stay apart.
            Self::Tuple(parts) => {
                let words: Vec<String> = parts.iter().map(Self::word).collect();
                format!("tuple_{}_{}", parts.len(), words.join("_"))
            }
            other => other.wgsl(),
        }
    }
}

impl From<&ir::Type> for Type {
    fn from(written: &ir::Type) -> Self {
        match written {
            ir::Type::Bool => Self::Bool,
            ir::Type::Scalar(scalar) => Self::Scalar(*scalar),
            ir::Type::Vector(scalar, lanes) => Self::Vector(*scalar, *lanes),
            ir::Type::State(names) => Self::State(names),
            ir::Type::Array(element, length) => Self::Array(Box::new(Self::from(&**element)), *length),
            ir::Type::Tuple(parts) => Self::Tuple(parts.iter().map(Self::from).collect()),
            ir::Type::Destination => Self::Destination,
        }
    }
}

/// What WGSL calls a scalar in memory. There are no bytes in WGSL: `u8` is a `u32` that is kept below 256, a
/// state a `u32`, and a `bool` is 0 or 1 in a `u32`.
pub(crate) fn scalar_name(scalar: ScalarType) -> &'static str {
    match scalar {
        ScalarType::Bool | ScalarType::State(_) | ScalarType::U8 | ScalarType::U32 => "u32",
        ScalarType::I32 => "i32",
        ScalarType::F32 => "f32",
        ScalarType::F64 => "f64",
        ScalarType::Real => "Real",
    }
}

/// The precision that `Real` has, as WGSL calls it.
pub(crate) fn real(precision: Precision) -> &'static str {
    match precision {
        Precision::F32 => "f32",
        Precision::F64 => "f64",
    }
}

/// What WGSL calls the type of a value where it lies in a buffer that the host fills.
pub(crate) fn in_memory(value_type: ValueType) -> String {
    match (Type::of_value(value_type), value_type.scalar) {
        (Type::Array(_, length), ScalarType::Bool) => format!("array<u32, {length}>"),
        (_, ScalarType::Bool) => "u32".to_owned(),
        (type_, _) => type_.wgsl(),
    }
}

/// A component that was read from memory, as a value.
pub(crate) fn loaded(scalar: ScalarType, text: &str) -> String {
    if scalar == ScalarType::Bool { format!("({text} != 0u)") } else { text.to_owned() }
}

pub(crate) fn is_float(scalar: ScalarType) -> bool {
    matches!(scalar, ScalarType::F32 | ScalarType::F64 | ScalarType::Real)
}

pub(crate) fn is_f64(scalar: ScalarType, precision: Precision) -> bool {
    match scalar {
        ScalarType::F64 => true,
        ScalarType::Real => precision == Precision::F64,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::Type;
    use xca_core::{ScalarType, ir};

    #[test]
    fn names() {
        let table = Type::from(&ir::Type::Array(Box::new(ir::Type::Vector(ScalarType::Real, 3)), 4));
        assert_eq!(table.wgsl(), "array<vec3<Real>, 4>");
        assert_eq!(Type::Scalar(ScalarType::U8).wgsl(), "u32");
        assert_eq!(Type::Vector(ScalarType::I32, 2).word(), "vec2_i32");
    }
}
