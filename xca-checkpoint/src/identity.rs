//! The program that runs a model, and what it was told.

use serde_json::{Map, Value};

/// The program that runs a model.
#[derive(Debug, Clone, Default)]
pub struct Identity {
    /// Its name.
    pub program: String,
    /// Its version.
    pub version: String,
    /// The command line, with what a configuration file added to it.
    pub command_line: Vec<String>,
    /// The working directory, from which the relative paths of the command line go.
    pub directory: String,
    /// All options of the model, with their defaults.
    pub options: Map<String, Value>,
}
