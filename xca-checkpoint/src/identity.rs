//! The program that runs a model, and its options.

use serde_json::{Map, Value};

/// The program that runs a model.
#[derive(Debug, Clone, Default)]
pub struct Identity {
    /// Its name.
    pub program: String,
    /// Its version.
    pub version: String,
    /// The command line, including the options of a configuration file.
    pub command_line: Vec<String>,
    /// The working directory, the base of relative paths in the command line.
    pub directory: String,
    /// All options of the model, including defaults.
    pub options: Map<String, Value>,
}
