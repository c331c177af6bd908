//! The parameters of a run, read and set between its steps.

use super::{State, StateError};
use xca_process::{ParameterValue, Parameters};

impl State<'_> {
    /// The parameters of the struct `P`.
    ///
    /// # Errors
    /// Returns an error if the model has no parameters of this type.
    pub fn parameters<P: Parameters>(&self) -> Result<P, StateError> {
        Ok(self.parameters.typed::<P>()?.clone())
    }

    /// Replaces the parameters of the struct `P`, from the next step on.
    ///
    /// # Errors
    /// Returns an error if the model has no parameters of this type, or a value is out of its range.
    pub fn set_parameters<P: Parameters>(&mut self, parameters: P) -> Result<(), StateError> {
        Ok(self.parameters.replace(self.precision, parameters)?)
    }

    /// The value of a parameter by name.
    ///
    /// # Errors
    /// Returns an error if the name is unknown or ambiguous.
    pub fn parameter(&self, name: &str) -> Result<ParameterValue, StateError> {
        Ok(self.parameters.value_by_name(name)?)
    }

    /// Sets a parameter by name, from text, from the next step on.
    ///
    /// # Errors
    /// Returns an error if the name is unknown or ambiguous, the parameter is computed, or the text is not a
    /// value of its type and range.
    pub fn set_parameter(&mut self, name: &str, text: &str) -> Result<(), StateError> {
        Ok(self.parameters.change(self.precision, |parameters| parameters.set_by_name(name, text))?)
    }
}
