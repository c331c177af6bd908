//! A kind of engine, as a program offers it.

use super::options::{EngineOption, EngineOptions};
use std::fmt;
use xca_core::{Engine, Model, Precision};
use xca_record::Failure;

/// A kind of engine, which a program offers by a name.
///
/// An engine from elsewhere takes part in every subcommand once its kind is added:
///
/// ```no_run
/// use xca_run::prelude::*;
/// use xca_run::{CommandLine, EngineKind, EngineOptions};
/// use xca_run::record::Failure;
///
/// #[derive(Debug)]
/// struct Plain;
///
/// impl EngineKind for Plain {
///     fn name(&self) -> &'static str {
///         "plain"
///     }
///
///     fn about(&self) -> &'static str {
///         "The reference engine under another name"
///     }
///
///     fn make(&self, _options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
///         Ok(Box::new(Reference))
///     }
/// }
///
/// # #[derive(Args)]
/// # struct Forest {}
/// # impl Program for Forest {
/// #     const NAME: &'static str = "forest";
/// #     const ABOUT: &'static str = "A fire in a forest";
/// #     fn set_up(&self, _given: Given) -> Result<SetUp, Failure> { Err("no model".into()) }
/// # }
/// fn main() -> ExitCode {
///     CommandLine::of::<Forest>(env!("CARGO_PKG_VERSION")).engine(Plain).main()
/// }
/// ```
pub trait EngineKind: fmt::Debug + Send + Sync {
    /// What `--engine` calls it: the name of the engines that it makes.
    fn name(&self) -> &'static str;

    /// A line about it, for help and `list`.
    fn about(&self) -> &'static str;

    /// What can be chosen of it, each an option of the command line. Names of the frame's own options are
    /// refused when the program starts.
    fn options(&self) -> &'static [EngineOption] {
        &[]
    }

    /// What stands after its name and a colon, as in `cpu:2`: the first of its options unless it says
    /// otherwise.
    fn detail(&self) -> Option<EngineDetail> {
        self.options().first().map(|option| EngineDetail { option: *option, is_required: false })
    }

    /// Why a subcommand, such as `watch`, cannot use it; nothing where it can.
    fn refuses(&self, _subcommand: &str) -> Option<&'static str> {
        None
    }

    /// What is chosen where many engines of this kind work side by side, unless the user chooses himself.
    fn beside_others(&self) -> EngineOptions {
        EngineOptions::default()
    }

    /// Whether its engines take all processes that a launcher such as `mpirun` has started.
    fn spans_processes(&self) -> bool {
        false
    }

    /// What this process does where it is only there to help another one, which runs the model; nothing where
    /// it runs the model itself.
    ///
    /// # Errors
    /// Where the processes do not find each other.
    fn helper(&self) -> Result<Option<Box<dyn Helper>>, Failure> {
        Ok(None)
    }

    /// Makes an engine. The options have been checked one by one.
    ///
    /// # Errors
    /// Where the machine does not have what was chosen.
    fn make(&self, options: &EngineOptions) -> Result<Box<dyn Engine>, Failure>;

    /// What it can run on, for `list`; nothing of an engine that only knows the processor.
    fn devices(&self) -> Option<Devices> {
        None
    }

    /// What it makes of the processes of a model, as text; nothing of an engine that makes no text of them.
    ///
    /// # Errors
    /// Where it cannot run the model.
    fn source(&self, _model: &Model, _precision: Precision) -> Option<Result<String, Failure>> {
        None
    }
}

/// A process that helps another one to run a model.
pub trait Helper {
    /// Helps until the other one ends. It is given a way to make the model that the other one runs.
    ///
    /// # Errors
    /// Where it cannot help.
    fn help(&self, model: &mut dyn FnMut(Precision) -> Result<Model, Failure>) -> Result<(), Failure>;
}

/// What is chosen of an engine after its name and a colon.
#[derive(Debug, Clone, Copy)]
pub struct EngineDetail {
    /// What it is; it need not be an option of the command line too.
    pub option: EngineOption,
    /// Whether the name alone is no engine.
    pub is_required: bool,
}

/// What a kind of engine can run on.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Devices {
    /// A table of at most 80 columns, or why there are none.
    pub text: String,
    /// An object for each.
    pub data: Vec<serde_json::Value>,
}

/// A part that the program was built without.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "this program was built without the feature `{feature}`; build it with \
     `cargo run --release --features xca/{feature}`"
)]
pub struct MissingFeature {
    pub(super) feature: &'static str,
}

#[cfg(not(feature = "terminal"))]
impl MissingFeature {
    /// The subcommand `watch`.
    pub(crate) const TERMINAL: Self = Self { feature: "terminal" };
}
