//! What a model's program is made of.

use std::fmt;
use std::str::FromStr;
use xca_core::{ParameterError, Parameters, Precision};
use xca_record::{Failure, SetUp};

/// A model's program: a struct whose fields are the options that only this model has. A model without such
/// options needs no struct: see [`crate::main_of!`].
///
/// [`crate::main!`] makes a whole program of it. The options that all models share (`--engine`, `--steps`,
/// `--set`, `--out`, …) come with it; no field may be named like one of them. A program whose fields are says
/// so, and nothing else, each time that it is started.
///
/// ```no_run
/// use xca_run::prelude::*;
///
/// #[derive(Substates, Clone)]
/// struct Fire {
///     burning: u8,
/// }
///
/// #[elementary_process]
/// fn spread(cell: &mut Cell<Fire>) {
///     for n in 1..cell.neighbour_count() {
///         cell.burning = cell.burning.max(cell.neighbour(n).burning);
///     }
/// }
///
/// #[derive(Args)]
/// struct Forest {
///     /// Cells along each side.
///     #[arg(long, default_value_t = 200)]
///     size: usize,
/// }
///
/// impl Program for Forest {
///     const NAME: &'static str = "forest";
///     const ABOUT: &'static str = "A fire in a forest";
///
///     fn set_up(&self, _given: Given) -> Result<SetUp, Failure> {
///         let middle = [self.size / 2, self.size / 2, 0];
///         let model = Model::builder("forest")
///             .extents([self.size, self.size, 1])
///             .neighbourhood(Neighbourhood::von_neumann_2d(1))
///             .substates::<Fire>()
///             .process(spread)
///             .fill(move |site| Fire { burning: u8::from(site.cell() == middle) })
///             .build()?;
///         Ok(SetUp::new(model, 100))
///     }
/// }
///
/// fn main() -> ExitCode {
///     xca_run::main!(Forest)
/// }
/// ```
pub trait Program: clap::Args {
    /// The name of the program, and of the folder below `out` that its runs write to unless they are told
    /// another.
    const NAME: &'static str;

    /// One line that says what the model is.
    const ABOUT: &'static str;

    /// Command lines to try, for `--help`: the arguments of `run`, one example a line.
    const EXAMPLES: &'static str = "--steps 500 --engine reference";

    /// Makes the model, and says how long it is run and what is shown of it. To resume a run, this is done
    /// again, and the state is replaced by that of the checkpoint; so the same options must make the same
    /// model.
    ///
    /// # Errors
    /// Where the options make no sense. The program then ends with exit code 2.
    fn set_up(&self, given: Given) -> Result<SetUp, Failure>;
}

/// What the command line says for every model, as far as it bears on the model itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Given {
    /// The seed of random numbers.
    pub seed: u64,
    /// What `Real` is.
    pub precision: Precision,
    /// The number of steps, if it is given.
    pub steps: Option<u64>,
    /// The parameters that are given by `--set`, in the order of the command line.
    pub parameters: Vec<Assignment>,
}

impl Given {
    /// Parameters with what `--set` says of them. For a set-up that computes something from its parameters;
    /// all others leave it to the frame, which sets the parameters of the model once it is made.
    ///
    /// # Errors
    /// Where no parameter has a name that was given, or a text is no value of its type.
    pub fn applied_to<P: Parameters>(&self, mut parameters: P) -> Result<P, ParameterError> {
        for Assignment { name, value } in &self.parameters {
            parameters.set(name, value)?;
        }
        Ok(parameters)
    }
}

/// A parameter and its value, `name=value` on the command line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assignment {
    /// The name of the parameter.
    pub name: String,
    /// The text of the value.
    pub value: String,
}

/// A text that is not of the form `name=value`.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("write NAME=VALUE, such as alpha=0.1")]
pub struct NoAssignment;

impl FromStr for Assignment {
    type Err = NoAssignment;

    fn from_str(text: &str) -> Result<Self, NoAssignment> {
        match text.split_once('=').map(|(name, value)| (name.trim(), value.trim())) {
            Some((name, value)) if !name.is_empty() && !value.is_empty() => {
                Ok(Self { name: name.to_owned(), value: value.to_owned() })
            }
            _ => Err(NoAssignment),
        }
    }
}

impl fmt::Display for Assignment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.name, self.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assignments_are_names_and_values() {
        let assignment: Assignment = " wind = 1, 2 ".parse().unwrap();
        assert_eq!((assignment.name.as_str(), assignment.value.as_str()), ("wind", "1, 2"));
        assert_eq!(assignment.to_string(), "wind=1, 2");
        for text in ["wind", "=1", "wind=", ""] {
            assert_eq!(text.parse::<Assignment>(), Err(NoAssignment), "{text}");
        }
    }
}
