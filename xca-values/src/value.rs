//! The types of substates and parameters.

use crate::state_names::StateNames;
use std::fmt;

/// The scalar types of substates and parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ScalarType {
    /// `bool`
    Bool,
    /// An enum that derives `States`.
    State(&'static StateNames),
    /// `u8`
    U8,
    /// `i32`
    I32,
    /// `u32`
    U32,
    /// `f32` in either precision of the run
    F32,
    /// `f64` in either precision of the run
    F64,
    /// `f32` or `f64`, depending on the run's [`Precision`]
    Real,
}

/// The floating-point type that [`Real`] stands for in a run. Default: `F64`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// 32 bits
    F32,
    /// 64 bits
    #[default]
    F64,
}

/// The floating-point type chosen for each run.
///
/// Write `Real` in processes, and in structs that derive `Substates` or `Parameters`. The macros make one
/// copy for each [`Precision`]. In all other code `Real` is `f64`, which holds the values of either precision
/// exactly.
pub type Real = f64;

/// A scalar, a small vector of scalars, or an array of either.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ValueType {
    /// The scalar.
    pub scalar: ScalarType,
    /// The number of lanes: 1 for a scalar, 2 to 4 for a vector.
    pub lanes: u8,
    /// The number of elements of an array.
    pub length: Option<u32>,
}

/// The machine type of a stored scalar. The run's precision has replaced `Real`. `bool` is stored as 0 or 1
/// in a `U8`, a state as its number in a `U8`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the names say it")]
pub enum StoredScalar {
    U8,
    I32,
    U32,
    F32,
    F64,
}

/// The machine type of a stored substate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct StoredType {
    /// The scalar.
    pub scalar: StoredScalar,
    /// The number of lanes, 1 to 4.
    pub lanes: u8,
    /// The number of elements of an array, 1 for a single value.
    pub length: u32,
}

impl ScalarType {
    /// Whether a number is a value of this type. Floating-point numbers must be finite. `bool` has the values
    /// 0 and 1, states have their numbers.
    pub fn fits(self, number: f64) -> bool {
        let within = |least: f64, largest: f64| number.fract() == 0.0 && (least..=largest).contains(&number);
        match self {
            Self::Bool => within(0.0, 1.0),
            Self::State(names) => within(0.0, names.largest().into()),
            Self::U8 => within(0.0, u8::MAX.into()),
            Self::I32 => within(i32::MIN.into(), i32::MAX.into()),
            Self::U32 => within(0.0, u32::MAX.into()),
            Self::F32 | Self::F64 | Self::Real => number.is_finite(),
        }
    }

    /// Whether a number can be a stored value of this type. As for [`Self::fits`], but floating-point numbers
    /// may be NaN or infinite.
    pub fn holds(self, number: f64) -> bool {
        matches!(self, Self::F32 | Self::F64 | Self::Real) || self.fits(number)
    }

    /// Parses a value. `bool` becomes 0 or 1, a state its number. Returns `None` if the text is not a value
    /// of this type.
    pub fn parse(self, text: &str) -> Option<f64> {
        match self {
            Self::Bool => text.parse().ok().map(|value: bool| value.into()),
            Self::State(names) => names.number(text).map(f64::from),
            _ => text.parse().ok().filter(|number| self.fits(*number)),
        }
    }

    /// The text of a number, which [`Self::parse`] reads back.
    pub fn text(self, number: f64) -> String {
        match self {
            Self::Bool => (number != 0.0).to_string(),
            Self::State(names) => {
                let name = names.states.get(number as usize);
                name.map_or_else(|| number.to_string(), |name| (*name).to_owned())
            }
            _ => Shortest(number).to_string(),
        }
    }
}

/// A number with the fewest digits that restore it exactly, for messages. Very large and very small numbers
/// have an exponent.
#[derive(Debug, Clone, Copy)]
pub struct Shortest(pub f64);

impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = self;
        let magnitude = number.abs();
        if magnitude.is_finite() && (magnitude >= 1e16 || (magnitude > 0.0 && magnitude < 1e-5)) {
            write!(f, "{number:e}")
        } else {
            write!(f, "{number}")
        }
    }
}

impl StoredScalar {
    /// Writes a number that fits the type into bytes.
    pub fn encode(self, number: f64, out: &mut [u8]) {
        match self {
            Self::U8 => out.copy_from_slice(&(number as u8).to_ne_bytes()),
            Self::I32 => out.copy_from_slice(&(number as i32).to_ne_bytes()),
            Self::U32 => out.copy_from_slice(&(number as u32).to_ne_bytes()),
            Self::F32 => out.copy_from_slice(&(number as f32).to_ne_bytes()),
            Self::F64 => out.copy_from_slice(&number.to_ne_bytes()),
        }
    }

    /// The size in bytes.
    pub const fn size(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl StoredType {
    /// The size of one value in bytes: its elements one after the other, the lanes of each side by side.
    pub const fn size(self) -> usize {
        self.scalar.size() * self.components()
    }

    /// The size of an element in bytes. Without an array, the size of the value.
    pub const fn element_size(self) -> usize {
        self.scalar.size() * self.lanes as usize
    }

    /// The number of scalars in a value.
    pub const fn components(self) -> usize {
        self.lanes as usize * self.length as usize
    }
}

impl ValueType {
    /// A single scalar.
    pub const fn scalar(scalar: ScalarType) -> Self {
        Self { scalar, lanes: 1, length: None }
    }

    /// A small vector.
    pub const fn vector(scalar: ScalarType, lanes: u8) -> Self {
        Self { scalar, lanes, length: None }
    }

    /// An array of `length` values of this type, which must not be an array.
    pub const fn array(self, length: u32) -> Self {
        Self { length: Some(length), ..self }
    }

    /// The type of an element. Without an array, the type itself.
    pub const fn element(self) -> Self {
        Self { length: None, ..self }
    }

    /// The number of scalars in a value.
    pub const fn components(self) -> usize {
        let length = match self.length {
            Some(length) => length as usize,
            None => 1,
        };
        self.lanes as usize * length
    }

    /// The type for messages, with the possible values of `bool` and states.
    pub fn described(self) -> String {
        match self.scalar {
            ScalarType::Bool => format!("a {self}: true or false"),
            ScalarType::State(names) => format!("a {self}: {}", names.states.join(", ")),
            _ => format!("a {self}"),
        }
    }

    /// The names of the components, for columns and files. A scalar has an empty name. Lanes of a vector are
    /// `x` to `w`, elements of an array have their index, lanes of elements have both (`3_x`).
    pub fn component_names(self) -> Vec<String> {
        let lanes = &["x", "y", "z", "w"][..usize::from(self.lanes)];
        match (self.length, self.lanes) {
            (None, 1) => vec![String::new()],
            (None, _) => lanes.iter().map(|lane| (*lane).to_owned()).collect(),
            (Some(length), 1) => (0..length).map(|element| element.to_string()).collect(),
            (Some(length), _) => (0..length)
                .flat_map(|element| lanes.iter().map(move |lane| format!("{element}_{lane}")))
                .collect(),
        }
    }

    /// The suffixes of the components, for people. Empty for a scalar, `.x` for a lane, `[3]` for an element,
    /// `[3].x` for a lane of an element.
    pub fn component_suffixes(self) -> Vec<String> {
        let suffix = |part: &str| match part.parse::<u32>() {
            Ok(element) => format!("[{element}]"),
            Err(_) if part.is_empty() => String::new(),
            Err(_) => format!(".{part}"),
        };
        self.component_names().iter().map(|name| name.split('_').map(suffix).collect()).collect()
    }

    /// The index of the component with this name. Accepts the form of [`Self::component_names`], and `[3].x`
    /// and `3.x`.
    pub fn component_named(self, name: &str) -> Option<usize> {
        let name = name.replace(['.', '['], "_").replace(']', "");
        let name = name.trim_start_matches('_');
        self.component_names().iter().position(|known| !name.is_empty() && known == name)
    }

    /// The machine type at this precision.
    pub const fn stored(self, precision: Precision) -> StoredType {
        let scalar = match (self.scalar, precision) {
            (ScalarType::U8 | ScalarType::Bool | ScalarType::State(_), _) => StoredScalar::U8,
            (ScalarType::I32, _) => StoredScalar::I32,
            (ScalarType::U32, _) => StoredScalar::U32,
            (ScalarType::F32, _) | (ScalarType::Real, Precision::F32) => StoredScalar::F32,
            (ScalarType::F64, _) | (ScalarType::Real, Precision::F64) => StoredScalar::F64,
        };
        let length = match self.length {
            Some(length) => length,
            None => 1,
        };
        StoredType { scalar, lanes: self.lanes, length }
    }
}

impl fmt::Display for ScalarType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Bool => "bool",
            Self::State(names) => names.name,
            Self::U8 => "u8",
            Self::I32 => "i32",
            Self::U32 => "u32",
            Self::F32 => "f32",
            Self::F64 => "f64",
            Self::Real => "Real",
        })
    }
}

impl fmt::Display for ValueType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.length, self.lanes) {
            (Some(length), _) => write!(f, "[{}; {length}]", self.element()),
            (None, 1) => write!(f, "{}", self.scalar),
            (None, lanes) => write!(f, "Vector{lanes}<{}>", self.scalar),
        }
    }
}

impl Precision {
    /// Rounds a number to this precision.
    pub fn rounded(self, number: f64) -> f64 {
        match self {
            Self::F32 => f64::from(number as f32),
            Self::F64 => number,
        }
    }
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        })
    }
}

impl std::str::FromStr for Precision {
    type Err = UnknownPrecision;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "f32" => Ok(Self::F32),
            "f64" => Ok(Self::F64),
            other => Err(UnknownPrecision(other.to_owned())),
        }
    }
}

/// A precision that is neither `f32` nor `f64`.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a precision; use f32 or f64")]
pub struct UnknownPrecision(String);

#[cfg(test)]
mod tests {
    use super::{ScalarType, ValueType};

    #[test]
    fn components_are_named() {
        let names = |value_type: ValueType| value_type.component_names().join(" ");
        assert_eq!(names(ValueType::scalar(ScalarType::Real)), "");
        assert_eq!(names(ValueType::vector(ScalarType::Real, 3)), "x y z");
        assert_eq!(names(ValueType::scalar(ScalarType::Bool).array(3)), "0 1 2");
        assert_eq!(names(ValueType::vector(ScalarType::I32, 2).array(2)), "0_x 0_y 1_x 1_y");
    }
}
