//! Parameters: values that are the same in all cells, and that steering may change between steps.

use crate::float::Float;
use crate::host_value::{HostScalar, HostValue};
use std::any::{Any, TypeId};
use std::fmt;
use std::sync::Arc;
use xca_values::Interval;
use xca_values::{Field, Schema};
use xca_values::{Precision, ScalarType, Shortest, ValueType};

/// A struct whose fields are parameters. Derive it.
///
/// Field types are those of substates: `bool`, `u8`, `i32`, `u32`, `f32`, `f64`, `Real`; vectors of a number;
/// enums that derive `States`; arrays of these. Read and set them by name. The text is a number, `true` or
/// `false`, or the name of a state. Separate the components of a vector or an array by commas:
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
/// assert_eq!(error.to_string(), "no parameter is called `beta`; known parameters: alpha, wind");
/// # Ok::<(), ParameterError>(())
/// ```
///
/// Attributes add a unit and a range, or mark a parameter as computed. Every value must be in the range, in
/// the precision of the run; for vectors and arrays, every component. NaN is never valid.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Parameters, Clone, Debug)]
/// struct Flow {
///     #[parameter(unit = "m/s", range = 0.0..)]
///     lid_speed: Real,
///     /// Viscosity of the fluid.
///     #[parameter(unit = "m2/s", positive)]
///     viscosity: Real,
///     #[parameter(range = 0.0..=1.0)]
///     shares: [Real; 2],
///     /// See `ModelBuilder::compute_parameters`.
///     #[parameter(computed)]
///     relaxation: Real,
/// }
///
/// let mut flow = Flow { lid_speed: 0.1, viscosity: 0.01, shares: [0.5; 2], relaxation: 1.0 };
/// let error = flow.set("viscosity", "0").unwrap_err();
/// assert_eq!(error.to_string(), "the parameter `viscosity` is 0, but must be above 0 (m2/s)");
/// let error = flow.set("relaxation", "1.5").unwrap_err();
/// assert_eq!(error.to_string(), "the parameter `relaxation` is computed from others; set those");
/// assert_eq!(Flow::SCHEMA.fields[1].documentation, "Viscosity of the fluid.");
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

    /// Converts to the struct that a kernel sees.
    fn native<R: Float>(&self) -> Self::Native<R>;

    /// The value of the field with this number.
    fn value(&self, field: usize) -> ParameterValue;

    /// Sets the field with this number. The value must have the type of the field.
    fn set_value(&mut self, field: usize, value: &ParameterValue);

    /// The value of the parameter with this name.
    ///
    /// # Errors
    /// Returns [`ParameterError::Unknown`] if no parameter has the name.
    fn get(&self, name: &str) -> Result<ParameterValue, ParameterError> {
        find(Self::SCHEMA, name).map(|(index, _)| self.value(index))
    }

    /// Sets the parameter with this name from text: a number, `true` or `false`, or the name of a state.
    /// Separate the components of a vector or an array by commas.
    ///
    /// # Errors
    /// Returns an error if the name is unknown, the parameter is computed, or the text is not a value of its
    /// type and range.
    fn set(&mut self, name: &str, text: &str) -> Result<(), ParameterError> {
        let (index, field) = find(Self::SCHEMA, name)?;
        if field.computed {
            return Err(ParameterError::Computed { name: field.name });
        }
        let value = ParameterValue::parse(name, field.value_type, text)?;
        value.check(field, Precision::F64)?;
        self.set_value(index, &value);
        Ok(())
    }

    /// Checks that all values are in their ranges.
    ///
    /// # Errors
    /// Returns [`ParameterError::OutOfRange`] for the first that is not.
    fn check(&self) -> Result<(), ParameterError> {
        let mut fields = Self::SCHEMA.fields.iter().enumerate();
        fields.try_for_each(|(number, field)| self.value(number).check(field, Precision::F64))
    }
}

fn find(schema: &'static Schema, name: &str) -> Result<(usize, &'static Field), ParameterError> {
    schema.field(name).ok_or_else(|| ParameterError::Unknown { name: name.to_owned(), known: schema.names() })
}

/// The value of a parameter, with its type. Components are `f64`, which holds every scalar type exactly.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Parameters, Clone, Debug)]
/// struct Wind {
///     velocity: Vector2<Real>,
/// }
///
/// let wind = Wind { velocity: Vector2::new(3.0, -1.0) };
/// let value = wind.get("velocity")?;
/// assert_eq!(value.components(), [3.0, -1.0]);
/// assert_eq!(value.to_string(), "3, -1");
/// # Ok::<(), ParameterError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterValue {
    value_type: ValueType,
    components: Vec<f64>,
}

impl ParameterValue {
    /// From the value of a field; for the derive.
    #[doc(hidden)]
    pub fn new<V: HostValue>(value_type: ValueType, value: V) -> Self {
        let components = (0..V::COMPONENTS).map(|index| value.component(index).to_number()).collect();
        Self { value_type, components }
    }

    /// A value with these components. `None` if their number is wrong, or one is not a value of the type.
    pub fn from_components(value_type: ValueType, components: Vec<f64>) -> Option<Self> {
        let all_fit = components.iter().all(|number| value_type.scalar.holds(*number));
        (components.len() == value_type.components() && all_fit).then_some(Self { value_type, components })
    }

    /// The value of a field; for the derive.
    #[doc(hidden)]
    pub fn to<V: HostValue>(&self) -> V {
        V::from_components(&mut |index| {
            V::Scalar::from_number(self.components.get(index).copied().unwrap_or_default())
        })
    }

    /// The type.
    pub fn value_type(&self) -> ValueType {
        self.value_type
    }

    /// The components: one for a scalar, the lanes of a vector, those of all elements of an array.
    pub fn components(&self) -> &[f64] {
        &self.components
    }

    /// Checks that the value is in the range of its field, at this precision.
    ///
    /// # Errors
    /// Returns [`ParameterError::OutOfRange`] if it is not.
    pub fn check(&self, field: &'static Field, precision: Precision) -> Result<(), ParameterError> {
        let is_real = matches!(self.value_type.scalar, ScalarType::Real);
        let precision = if is_real { precision } else { Precision::F64 };
        let range = field.range.rounded(precision);
        let outside = |&&number: &&f64| {
            let rounded = precision.rounded(number);
            !range.contains(rounded) || (number.is_finite() && !rounded.is_finite())
        };
        match self.components.iter().find(outside) {
            None => Ok(()),
            Some(&number) => Err(ParameterError::OutOfRange {
                name: field.name,
                number,
                precision,
                range: field.range,
                unit: field.unit.map(|unit| format!(" ({unit})")).unwrap_or_default(),
            }),
        }
    }

    fn parse(name: &str, value_type: ValueType, text: &str) -> Result<Self, ParameterError> {
        let invalid = || ParameterError::Invalid { name: name.to_owned(), text: text.to_owned(), value_type };
        let components: Vec<f64> = text
            .split(',')
            .map(|part| value_type.scalar.parse(part.trim()).ok_or_else(invalid))
            .collect::<Result<_, _>>()?;
        if components.len() == value_type.components() {
            Ok(Self { value_type, components })
        } else {
            Err(invalid())
        }
    }
}

impl fmt::Display for ParameterValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, component) in self.components.iter().enumerate() {
            let separator = if index > 0 { ", " } else { "" };
            write!(f, "{separator}{}", self.value_type.scalar.text(*component))?;
        }
        Ok(())
    }
}

/// An error in reading or setting a parameter.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterError {
    /// The model has no parameters of this type.
    #[error("the model has no parameters `{wanted}`; it has: {given}")]
    OtherStruct {
        /// The requested type.
        wanted: &'static str,
        /// The types that the model has.
        given: String,
    },
    /// No parameter has this name.
    #[error("no parameter is called `{name}`; known parameters: {known}")]
    Unknown {
        /// The name.
        name: String,
        /// The known names.
        known: String,
    },
    /// Several structs have a parameter of this name.
    #[error("several parameters are called `{name}`; say which: {known}")]
    Ambiguous {
        /// The name.
        name: String,
        /// The parameters of that name.
        known: String,
    },
    /// The parameter is computed from others.
    #[error("the parameter `{name}` is computed from others; set those")]
    Computed {
        /// Its name.
        name: &'static str,
    },
    /// The number is out of the parameter's range.
    #[error("the parameter `{name}` is {}{}, but must be {range}{unit}", Shortest(*number), in_precision(*number, *precision))]
    OutOfRange {
        /// Its name.
        name: &'static str,
        /// The number.
        number: f64,
        /// The precision of the run, to which the number is rounded.
        precision: Precision,
        /// The range.
        range: Interval,
        /// Its unit in parentheses, or nothing.
        unit: String,
    },
    /// The text is not a value of the parameter's type.
    #[error("`{text}` is no value for the parameter `{name}`, which is {}", value_type.described())]
    Invalid {
        /// The parameter.
        name: String,
        /// The text.
        text: String,
        /// The type that it must have.
        value_type: ValueType,
    },
}

fn in_precision(number: f64, precision: Precision) -> String {
    let rounded = precision.rounded(number);
    if rounded == number || number.is_nan() {
        String::new()
    } else {
        format!(" ({} in {precision})", Shortest(rounded))
    }
}

/// Parameters of unknown type: those that a model keeps and an engine reads.
pub trait AnyParameters: Any + fmt::Debug + Send + Sync {
    /// The fields.
    fn schema(&self) -> &'static Schema;

    /// The value of the field with this number.
    fn value_of(&self, field: usize) -> ParameterValue;

    /// Sets the field with this number. The value has the components of the field and fits its type.
    fn set_value_of(&mut self, field: usize, value: &ParameterValue);

    /// Sets the parameter with this name from text.
    ///
    /// # Errors
    /// Those of [`Parameters::set`].
    fn set_by_name(&mut self, name: &str, text: &str) -> Result<(), ParameterError>;

    /// The form in a kernel of this precision: `P::Native<R>`.
    fn kernel_view(&self, precision: Precision) -> Arc<dyn Any + Send + Sync>;

    /// The type of the struct.
    fn parameters_type(&self) -> TypeId;

    /// A copy.
    fn duplicate(&self) -> Box<dyn AnyParameters>;

    /// For a downcast.
    fn as_any(&self) -> &dyn Any;
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
