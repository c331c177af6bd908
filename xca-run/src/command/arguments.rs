//! The options that every model's program has.

use super::initial::Initial;
use super::voice::Voice;
use crate::program::{Assignment, Given};
use clap::Args;
use std::path::PathBuf;
use xca_core::Precision;
use xca_record::Interval;

/// Options of the model itself.
#[derive(Args, Debug, Clone)]
pub(crate) struct ModelArguments {
    /// Floating-point type of `Real`: f32 or f64
    #[arg(long, value_name = "TYPE", default_value_t = Precision::F64)]
    precision: Precision,

    /// Seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed)]
    seed: u64,

    /// Set a parameter of the model. Repeat for several. Values: 0.1, true, the name of a state, or 1,2,3 for
    /// a vector or an array. `list` shows the names
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<Assignment>,

    /// Read the initial values of a substate from a GeoTIFF or an ESRI ASCII grid. Repeat for several. NAME
    /// can be a component, such as outflow.3. NAME:0=FILE replaces NODATA by 0. Grids hold bool as 0 or 1,
    /// and a state as its number
    #[arg(long, value_name = "NAME=FILE")]
    pub(crate) initial: Vec<Initial>,

    /// Read options from a TOML file, whose keys are the names of options. The command line wins
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
}

/// Options of a run: its length and its output.
#[derive(Args, Debug, Clone)]
pub(crate) struct RunArguments {
    /// Number of steps [default: the model's]
    #[arg(long, value_name = "N", value_parser = steps)]
    pub(crate) steps: Option<u64>,

    /// Output directory [default: out/NAME]. Overwrites an earlier run, unless it can be resumed
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,

    /// Overwrite an earlier run even if it can be resumed
    #[arg(long)]
    pub(crate) overwrite: bool,

    /// Write observables and a frame every N steps [default: 20 times in the run]
    #[arg(long, value_name = "N", value_parser = interval)]
    pub(crate) every: Option<u64>,

    /// Write a checkpoint every N steps (500) or every TIME (30s, 10min, 2h), for `resume`. Keeps the last
    /// two [default: no checkpoints]
    #[arg(long, value_name = "N|TIME")]
    pub(crate) checkpoint_every: Option<Interval>,

    /// Output formats, such as vtk,png. A + adds to the model's formats: +asc. `list` shows them
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub(crate) formats: Vec<String>,

    /// Continue when a substate becomes NaN or infinite. By default the run stops at the next output or
    /// checkpoint
    #[arg(long)]
    pub(crate) allow_non_finite: bool,

    /// Print the code that the engine generates (gpu engine: shaders) and exit
    #[arg(long)]
    pub(crate) print_source: bool,

    #[command(flatten)]
    pub(crate) voice: Voice,
}

impl ModelArguments {
    pub(crate) fn given(&self, steps: Option<u64>) -> Given {
        Given { seed: self.seed, precision: self.precision, steps, parameters: self.set.clone() }
    }
}

fn seed(text: &str) -> Result<u64, String> {
    let wanted = || format!("a seed must be a whole number from 0 to {}", u64::MAX);
    text.parse().map_err(|_| wanted())
}

pub(super) fn steps(text: &str) -> Result<u64, &'static str> {
    text.parse().map_err(|_| "the number of steps must be a whole number")
}

pub(super) fn interval(text: &str) -> Result<u64, String> {
    match text.parse() {
        Ok(0) => Err("the interval must be at least 1 step".to_owned()),
        Ok(number) => Ok(number),
        Err(_) => Err("the interval must be a whole number of steps, at least 1".to_owned()),
    }
}
