//! A program as the command line needs it.

use super::outcome::Unable;
use crate::engines::Engines;
use crate::program::Given;
use clap::{ArgMatches, Command};
use xca_record::SetUp;

/// A program as the command line needs it.
pub(super) struct Definition<'a> {
    pub(super) name: &'static str,
    pub(super) about: &'static str,
    pub(super) version: &'static str,
    pub(super) examples: &'static str,
    /// Adds the options of the model.
    pub(super) options: fn(Command) -> Command,
    pub(super) set_up: &'a SetUpModel<'a>,
    pub(super) engines: &'a Engines,
}

impl Definition<'_> {
    /// The version of the framework, the name of the program, and its version.
    pub(super) fn identity(&self) -> [&'static str; 3] {
        [env!("CARGO_PKG_VERSION"), self.name, self.version]
    }
}

pub(super) type SetUpModel<'a> = dyn Fn(&ArgMatches, Given) -> Result<SetUp, Unable> + 'a;
