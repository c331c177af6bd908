//! The options that every model's program has.

use super::initial::Initial;
use super::voice::Voice;
use crate::program::{Assignment, Given};
use clap::Args;
use std::path::PathBuf;
use xca_core::Precision;
use xca_record::Interval;

/// What bears on the model itself.
#[derive(Args, Debug, Clone)]
pub(crate) struct ModelArguments {
    /// What `Real` is: f32 or f64
    #[arg(long, value_name = "TYPE", default_value_t = Precision::F64)]
    precision: Precision,

    /// The seed of random numbers
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed)]
    seed: u64,

    /// Set a parameter of the model; can be given several times. Values: 0.1, true, Water (a state by its
    /// name); the components of a vector or an array as a list: 1,2,3. An unknown name lists the known ones
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<Assignment>,

    /// Start a substate of a one-layer model from a GeoTIFF or an ESRI ASCII grid; can be given several
    /// times. NAME can be a component: outflow.3. bool is 0 or 1 in a grid, a state its number. NAME:0=FILE
    /// takes 0 where the grid has no value
    #[arg(long, value_name = "NAME=FILE")]
    pub(crate) initial: Vec<Initial>,

    /// Take options from a TOML file. Its keys are these options; those on the command line win
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
}

/// How long it is run, and what is written.
#[derive(Args, Debug, Clone)]
pub(crate) struct RunArguments {
    /// How many steps are done; the model says how many unless it is given
    #[arg(long, value_name = "N", value_parser = steps)]
    pub(crate) steps: Option<u64>,

    /// The folder of the files; out/NAME unless it is given. Files of an earlier run there are replaced
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,

    /// Write observables and a frame every so many steps; 20 times in the run unless it is given
    #[arg(long, value_name = "N", value_parser = interval)]
    pub(crate) every: Option<u64>,

    /// Write a checkpoint every so many steps (500) or after so much time (30s, 10min, 2h), from which
    /// `resume` goes on; the last two are kept. None unless it is given
    #[arg(long, value_name = "N|TIME")]
    pub(crate) checkpoint_every: Option<Interval>,

    /// Write these formats, as `list` tells them: vtk,png. With a + before each name, write them beside those
    /// of the model: +asc
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub(crate) formats: Vec<String>,

    /// Run on where a substate becomes NaN or infinite. Without it, that ends the run at the next output or
    /// checkpoint
    #[arg(long)]
    pub(crate) allow_non_finite: bool,

    /// Print what the engine makes of the processes (the gpu engine: shaders), and do nothing else
    #[arg(long)]
    pub(crate) print_source: bool,

    #[command(flatten)]
    pub(crate) voice: Voice,
}

/// Which run goes on, and how.
#[derive(Args, Debug, Clone)]
pub(crate) struct ResumeArguments {
    /// The folder of the run
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,

    /// The checkpoint to go on from; the latest of the folder unless it is given
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,

    /// How many steps the run has in the end, also more than it was begun with; as the run was told unless it
    /// is given
    #[arg(long, value_name = "N", value_parser = steps)]
    pub(crate) steps: Option<u64>,

    /// Give the cells at least so many slots for items, where the run ended with a full cell; as before
    /// unless it is given
    #[arg(long, value_name = "N", value_parser = slots)]
    pub(crate) slots: Option<usize>,

    /// Go on although the engine rounds floating numbers otherwise than the one that the run was begun on;
    /// the files will not be those of an uninterrupted run
    #[arg(long)]
    pub(crate) allow_rounding: bool,

    /// Go on where a substate becomes NaN or infinite; as the run was told unless it is given
    #[arg(long)]
    pub(crate) allow_non_finite: bool,

    /// Write a checkpoint every so many steps or after so much time; as often as the run was told unless it
    /// is given
    #[arg(long, value_name = "N|TIME")]
    pub(crate) checkpoint_every: Option<Interval>,

    #[command(flatten)]
    pub(crate) voice: Voice,
}

impl ModelArguments {
    pub(crate) fn given(&self, steps: Option<u64>) -> Given {
        Given { seed: self.seed, precision: self.precision, steps, parameters: self.set.clone() }
    }
}

fn seed(text: &str) -> Result<u64, String> {
    let wanted = || {
        format!("a seed is a whole number from 0 to {}, such as 7; each gives other random numbers", u64::MAX)
    };
    text.parse().map_err(|_| wanted())
}

pub(super) fn steps(text: &str) -> Result<u64, &'static str> {
    text.parse().map_err(|_| "it must be a whole number of steps")
}

fn slots(text: &str) -> Result<usize, &'static str> {
    text.parse().ok().filter(|slots| *slots > 0).ok_or("it must be a whole number of slots, at least 1")
}

pub(super) fn interval(text: &str) -> Result<u64, String> {
    match text.parse() {
        Ok(0) => Err("every 0 steps never comes; give at least 1".to_owned()),
        Ok(number) => Ok(number),
        Err(_) => Err("it must be a whole number of steps, at least 1".to_owned()),
    }
}
