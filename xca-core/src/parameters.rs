//! Parameters: values that are the same in all cells, and that steering may change between steps.

use crate::schema::Schema;
use crate::value::{Float, HostValue, Precision, ScalarType, ValueType};
use std::any::{Any, TypeId};
use std::fmt;
use std::sync::Arc;

/// A struct whose fields are parameters; derive it.
///
/// Fields are of type `i32`, `u32`, `f32`, `f64`, `Real`, or a small vector of one of these. They can be read and set by name:
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Parameters, Clone, Debug, PartialEq)]
/// struct Conduction {
///     alpha: Real,
///     wind: Vector2<Real>,
/// }
///
/// let mut parameters = Conduction { alpha: 0.1, wind: Vector2::new(1.0, 0.0) };
/// parameters.set("alpha", "0.25")?;
/// parameters.set("wind", "3, -1")?;
/// assert_eq!(parameters, Conduction { alpha: 0.25, wind: Vector2::new(3.0, -1.0) });
/// let error = parameters.set("beta", "1").unwrap_err();
/// assert_eq!(error.to_string(), "no parameter is called `beta`; Conduction has alpha, wind");
/// # Ok::<(), ParameterError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no struct of parameters",
    label = "its fields are not parameters",
    note = "write `#[derive(Parameters, Clone, Debug)]` above the struct `{Self}`"
)]
pub trait Parameters: Clone + fmt::Debug + Send + Sync + 'static {
    /// The fields.
    const SCHEMA: &'static Schema;

    /// The same struct as a kernel of precision `R` sees it.
    type Native<R: Float>: Copy + Send + Sync + 'static;

    /// Converts to what a kernel sees.
    fn native<R: Float>(&self) -> Self::Native<R>;

    /// The value of the field with this number.
    fn value(&self, field: usize) -> ParameterValue;

    /// Sets the field with this number; the value has as many lanes as the field and fits its type.
    fn set_value(&mut self, field: usize, value: &ParameterValue);

    /// The value of the parameter with this name.
    ///
    /// # Errors
    /// [`ParameterError::Unknown`] where no parameter has the name.
    fn get(&self, name: &str) -> Result<ParameterValue, ParameterError> {
        find(Self::SCHEMA, name).map(|(index, _)| self.value(index))
    }

    /// Sets the parameter with this name from text: a number, or as many numbers as the vector has lanes, separated by commas.
    ///
    /// # Errors
    /// Where no parameter has the name, or the text is no value of its type.
    fn set(&mut self, name: &str, text: &str) -> Result<(), ParameterError> {
        let (index, value_type) = find(Self::SCHEMA, name)?;
        let value = ParameterValue::parse(name, value_type, text)?;
        self.set_value(index, &value);
        Ok(())
    }
}

fn find(schema: &'static Schema, name: &str) -> Result<(usize, ValueType), ParameterError> {
    schema.field(name).map(|(index, field)| (index, field.value_type)).ok_or_else(|| {
        ParameterError::Unknown { name: name.to_owned(), of: schema.name, known: schema.names() }
    })
}

/// The parameters of a model that has none.
#[diagnostic::do_not_recommend]
impl Parameters for () {
    const SCHEMA: &'static Schema = &Schema { name: "()", fields: &[], position: None };
    type Native<R: Float> = ();

    fn native<R: Float>(&self) {}

    fn value(&self, _field: usize) -> ParameterValue {
        ParameterValue { value_type: ValueType { scalar: ScalarType::Real, lanes: 1 }, lanes: Vec::new() }
    }

    fn set_value(&mut self, _field: usize, _value: &ParameterValue) {}
}

/// The value of a parameter, with its type. Every scalar type fits exactly into the `f64` of its lanes.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterValue {
    value_type: ValueType,
    lanes: Vec<f64>,
}

impl ParameterValue {
    /// From the value of a field; for the derive.
    #[doc(hidden)]
    pub fn new<V: HostValue>(value_type: ValueType, value: V) -> Self
    where
        V::Scalar: Into<f64>,
    {
        Self { value_type, lanes: (0..V::LANES).map(|lane| value.lane(lane).into()).collect() }
    }

    /// A value with these lanes; nothing where the type has another number of them.
    pub fn from_lanes(value_type: ValueType, lanes: Vec<f64>) -> Option<Self> {
        (lanes.len() == usize::from(value_type.lanes)).then_some(Self { value_type, lanes })
    }

    /// The value of a field; for the derive.
    #[doc(hidden)]
    pub fn to<V: HostValue>(&self) -> V
    where
        V::Scalar: FromLane,
    {
        V::from_lanes(|lane| V::Scalar::from_lane(self.lanes[lane]))
    }

    /// The type.
    pub fn value_type(&self) -> ValueType {
        self.value_type
    }

    /// The lanes: one for a scalar.
    pub fn lanes(&self) -> &[f64] {
        &self.lanes
    }

    fn parse(name: &str, value_type: ValueType, text: &str) -> Result<Self, ParameterError> {
        let invalid = || ParameterError::Invalid { name: name.to_owned(), text: text.to_owned(), value_type };
        let lanes = text
            .split(',')
            .map(|part| {
                let number: f64 = part.trim().parse().map_err(|_| invalid())?;
                if value_type.scalar.fits(number) { Ok(number) } else { Err(invalid()) }
            })
            .collect::<Result<Vec<_>, _>>()?;
        if lanes.len() == usize::from(value_type.lanes) {
            Ok(Self { value_type, lanes })
        } else {
            Err(invalid())
        }
    }
}

impl fmt::Display for ParameterValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, lane) in self.lanes.iter().enumerate() {
            let separator = if index > 0 { ", " } else { "" };
            write!(f, "{separator}{lane}")?;
        }
        Ok(())
    }
}

/// A scalar that can be made of a lane of a [`ParameterValue`].
#[doc(hidden)]
pub trait FromLane {
    fn from_lane(lane: f64) -> Self;
}

macro_rules! from_lane {
    ($($type:ident)*) => {$(
        impl FromLane for $type {
            fn from_lane(lane: f64) -> Self {
                lane as $type
            }
        }
    )*};
}

from_lane!(u8 i32 u32 f32 f64);

/// A parameter that cannot be read or set.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ParameterError {
    /// The parameters are of another type.
    #[error("the model's parameters are `{given}`, not `{wanted}`")]
    OtherStruct {
        /// The type that was asked for.
        wanted: &'static str,
        /// The type that the model has.
        given: &'static str,
    },
    /// No parameter has this name.
    #[error("no parameter is called `{name}`; {of} has {known}")]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// The parameter struct.
        of: &'static str,
        /// The names that it has.
        known: String,
    },
    /// The text is no value of the parameter's type.
    #[error("`{text}` is no value for the parameter `{name}`, which is a {value_type}")]
    Invalid {
        /// The parameter.
        name: String,
        /// The text.
        text: String,
        /// The type that it must have.
        value_type: ValueType,
    },
}

/// Parameters whose type is not known: what a model keeps and an engine reads.
pub trait AnyParameters: Any + fmt::Debug + Send + Sync {
    /// The fields.
    fn schema(&self) -> &'static Schema;

    /// The value of the field with this number.
    fn value_of(&self, field: usize) -> ParameterValue;

    /// Sets the field with this number; the value has as many lanes as the field and fits its type.
    fn set_value_of(&mut self, field: usize, value: &ParameterValue);

    /// Sets the parameter with this name from text.
    ///
    /// # Errors
    /// As [`Parameters::set`].
    fn set_by_name(&mut self, name: &str, text: &str) -> Result<(), ParameterError>;

    /// What a kernel of this precision sees: `P::Native<R>`.
    fn kernel_view(&self, precision: Precision) -> Arc<dyn Any + Send + Sync>;

    /// The type of the struct.
    fn parameters_type(&self) -> TypeId;

    /// A copy.
    fn duplicate(&self) -> Box<dyn AnyParameters>;

    /// For a downcast.
    fn as_any(&self) -> &dyn Any;
}

/// Parameters as what they are.
pub(crate) fn typed<P: Parameters>(parameters: &dyn AnyParameters) -> Result<&P, ParameterError> {
    let (wanted, given) = (P::SCHEMA.name, parameters.schema().name);
    parameters.as_any().downcast_ref().ok_or(ParameterError::OtherStruct { wanted, given })
}

impl<P: Parameters> AnyParameters for P {
    fn schema(&self) -> &'static Schema {
        P::SCHEMA
    }

    fn value_of(&self, field: usize) -> ParameterValue {
        self.value(field)
    }

    fn set_value_of(&mut self, field: usize, value: &ParameterValue) {
        self.set_value(field, value);
    }

    fn set_by_name(&mut self, name: &str, text: &str) -> Result<(), ParameterError> {
        self.set(name, text)
    }

    fn kernel_view(&self, precision: Precision) -> Arc<dyn Any + Send + Sync> {
        match precision {
            Precision::F32 => Arc::new(self.native::<f32>()),
            Precision::F64 => Arc::new(self.native::<f64>()),
        }
    }

    fn parameters_type(&self) -> TypeId {
        TypeId::of::<P>()
    }

    fn duplicate(&self) -> Box<dyn AnyParameters> {
        Box::new(self.clone())
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

impl Clone for Box<dyn AnyParameters> {
    fn clone(&self) -> Self {
        (**self).duplicate()
    }
}
