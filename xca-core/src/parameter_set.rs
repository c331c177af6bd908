//! The parameters of a model: a struct, or several.

use std::any::{Any, TypeId};
use std::fmt;
use std::sync::Arc;
use xca_process::{AnyParameters, ParameterError, ParameterValue, Parameters};
use xca_values::Precision;
use xca_values::{Field, Schema};

/// All parameters of a model, numbered in the order of the structs and their fields.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Air {
///     speed: Real,
/// }
///
/// #[derive(Parameters, Clone, Debug)]
/// struct Flow {
///     rate: Real,
/// }
///
/// let model = Model::builder("flow")
///     .extents([4, 4, 1])
///     .substates::<Air>()
///     .parameters(Flow { rate: 0.5 })
///     .build()?;
/// assert_eq!(model.parameters().names(), ["rate"]);
/// assert_eq!(model.parameters().value_by_name("Flow.rate")?.components(), [0.5]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A parameter is named by its field (`rate`). If several structs have a field of that name, use struct and
/// field (`Flow.rate`).
#[derive(Clone, Default)]
pub struct ParameterSet {
    structs: Vec<Box<dyn AnyParameters>>,
    computations: Vec<Arc<Computation>>,
}

/// Computes parameters from others.
type Computation = dyn Fn(&mut ParameterSet) + Send + Sync;

/// Where a parameter stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Place {
    struct_: usize,
    field: usize,
}

impl ParameterSet {
    /// Adds a struct, or replaces the one of the same type.
    pub(crate) fn add<P: Parameters>(&mut self, parameters: P) {
        let known = self.structs.iter_mut().find(|known| known.parameters_type() == TypeId::of::<P>());
        match known {
            Some(known) => *known = Box::new(parameters),
            None => self.structs.push(Box::new(parameters)),
        }
    }

    /// Adds a computation of some parameters of the struct `P` from others of it.
    pub(crate) fn compute<P: Parameters>(&mut self, computation: impl Fn(&mut P) + Send + Sync + 'static) {
        self.computations.push(Arc::new(move |set: &mut ParameterSet| {
            if let Some(mut parameters) = set.get::<P>().cloned() {
                computation(&mut parameters);
                set.add(parameters);
            }
        }));
    }

    /// Changes parameters, computes those that follow, and checks that all are in their ranges, as a run of
    /// this precision has them.
    ///
    /// # Errors
    /// Of the change, or where a parameter is out of its range. The parameters are then what they were.
    pub(crate) fn change(
        &mut self,
        precision: Precision,
        change: impl FnOnce(&mut Self) -> Result<(), ParameterError>,
    ) -> Result<(), ParameterError> {
        let mut changed = self.clone();
        change(&mut changed)?;
        for computation in &self.computations {
            computation(&mut changed);
        }
        changed.check(precision)?;
        *self = changed;
        Ok(())
    }

    /// Checks that all parameters are in their ranges, as a run of this precision has them.
    ///
    /// # Errors
    /// The first that is not.
    pub(crate) fn check(&self, precision: Precision) -> Result<(), ParameterError> {
        self.fields().zip(self.values()).try_for_each(|(field, value)| value.check(field, precision))
    }

    /// The structs, in the order of their addition.
    pub fn structs(&self) -> impl Iterator<Item = &dyn AnyParameters> {
        self.structs.iter().map(|parameters| &**parameters)
    }

    /// The struct of this type.
    pub fn struct_of_type(&self, type_id: TypeId) -> Option<&dyn AnyParameters> {
        self.structs().find(|parameters| parameters.parameters_type() == type_id)
    }

    /// The values of the struct `P`.
    pub fn get<P: Parameters>(&self) -> Option<&P> {
        self.structs().find_map(|parameters| parameters.as_any().downcast_ref())
    }

    /// The values of the struct `P`.
    ///
    /// # Errors
    /// Returns an error if the model has no parameters of this type.
    pub fn typed<P: Parameters>(&self) -> Result<&P, ParameterError> {
        self.get().ok_or_else(|| ParameterError::OtherStruct { wanted: P::SCHEMA.name, given: self.listed() })
    }

    /// Replaces the values of the struct `P`.
    ///
    /// # Errors
    /// Where there is none, or a parameter is out of its range. The parameters are then what they were.
    pub(crate) fn replace<P: Parameters>(
        &mut self,
        precision: Precision,
        parameters: P,
    ) -> Result<(), ParameterError> {
        self.typed::<P>()?;
        self.change(precision, |set| {
            set.add(parameters);
            Ok(())
        })
    }

    /// The names of the structs, for messages.
    pub(crate) fn listed(&self) -> String {
        let names: Vec<&str> = self.schemas().map(|schema| schema.name).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(", ") }
    }

    /// The schemas of the structs.
    pub fn schemas(&self) -> impl Iterator<Item = &'static Schema> {
        self.structs().map(AnyParameters::schema)
    }

    /// All fields, in the order of their numbers.
    pub fn fields(&self) -> impl Iterator<Item = &'static Field> {
        self.schemas().flat_map(|schema| schema.fields)
    }

    /// The names of all parameters, with the struct if the field's name is not unique.
    pub fn names(&self) -> Vec<String> {
        let all: Vec<(&Schema, &Field)> = self
            .schemas()
            .flat_map(|schema| schema.fields.iter().map(move |field| (schema, field)))
            .collect();
        let is_shared = |name: &str| all.iter().filter(|(_, field)| field.name == name).count() > 1;
        let name = |(schema, field): &(&Schema, &Field)| {
            if is_shared(field.name) {
                format!("{}.{}", schema.name, field.name)
            } else {
                field.name.to_owned()
            }
        };
        all.iter().map(name).collect()
    }

    /// The number of parameters.
    pub fn count(&self) -> usize {
        self.fields().count()
    }

    fn place(&self, number: usize) -> Option<Place> {
        let mut rest = number;
        for (struct_, schema) in self.schemas().enumerate() {
            if rest < schema.fields.len() {
                return Some(Place { struct_, field: rest });
            }
            rest -= schema.fields.len();
        }
        None
    }

    /// The value of the parameter with this number.
    pub fn value(&self, number: usize) -> Option<ParameterValue> {
        let Place { struct_, field } = self.place(number)?;
        Some(self.structs[struct_].value_of(field))
    }

    /// The values of all parameters, in the order of their numbers.
    pub fn values(&self) -> impl Iterator<Item = ParameterValue> {
        (0..self.count()).filter_map(|number| self.value(number))
    }

    /// The components of each parameter, as the bits of an `f64`, which holds every scalar type exactly.
    pub fn bits(&self) -> Vec<Vec<u64>> {
        let bits = |value: ParameterValue| value.components().iter().map(|number| number.to_bits()).collect();
        self.values().map(bits).collect()
    }

    /// Sets all parameters from the [`Self::bits`] of the same structs, without checks and computations.
    /// Skips bits that are not a value of the parameter's type.
    pub fn set_bits(&mut self, bits: &[Vec<u64>]) {
        let fields: Vec<&Field> = self.fields().collect();
        for (number, (bits, field)) in bits.iter().zip(fields).enumerate() {
            let components = bits.iter().map(|number| f64::from_bits(*number)).collect();
            if let Some(value) = ParameterValue::from_components(field.value_type, components)
                && let Some(Place { struct_, field }) = self.place(number)
            {
                self.structs[struct_].set_value_of(field, &value);
            }
        }
    }

    /// Where the parameter with this name stands.
    fn find_place(&self, name: &str) -> Result<Place, ParameterError> {
        let whole = |schema: &Schema, field: &Field| format!("{}.{}", schema.name, field.name);
        let mut found: Vec<(Place, String)> = Vec::new();
        for (struct_, schema) in self.schemas().enumerate() {
            for (number, field) in schema.fields.iter().enumerate() {
                if field.name == name || whole(schema, field) == name {
                    found.push((Place { struct_, field: number }, whole(schema, field)));
                }
            }
        }
        match &found[..] {
            [(place, _)] => Ok(*place),
            [] => Err(ParameterError::Unknown { name: name.to_owned(), known: self.names().join(", ") }),
            several => {
                let known: Vec<&str> = several.iter().map(|(_, whole)| whole.as_str()).collect();
                Err(ParameterError::Ambiguous { name: name.to_owned(), known: known.join(", ") })
            }
        }
    }

    /// The value of the parameter with this name.
    ///
    /// # Errors
    /// Returns [`ParameterError::Unknown`] or [`ParameterError::Ambiguous`] if the name does not match
    /// exactly one parameter.
    pub fn value_by_name(&self, name: &str) -> Result<ParameterValue, ParameterError> {
        let Place { struct_, field } = self.find_place(name)?;
        Ok(self.structs[struct_].value_of(field))
    }

    /// Sets the parameter with this name from text.
    ///
    /// # Errors
    /// As [`Self::value_by_name`], and where the text is no value of the parameter's type.
    pub(crate) fn set_by_name(&mut self, name: &str, text: &str) -> Result<(), ParameterError> {
        let Place { struct_, field } = self.find_place(name)?;
        let field = &self.structs[struct_].schema().fields[field];
        self.structs[struct_].set_by_name(field.name, text)
    }

    /// The view of each struct that kernels of this precision take.
    pub fn kernel_views(&self, precision: Precision) -> Vec<Arc<dyn Any + Send + Sync>> {
        self.structs().map(|parameters| parameters.kernel_view(precision)).collect()
    }
}

impl fmt::Debug for ParameterSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(&self.structs).finish()
    }
}
