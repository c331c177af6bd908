//! The options of `resume`, and its help.

use crate::command::arguments::steps;
use crate::command::definition::Definition;
use crate::command::engine::with_other_engine;
use crate::command::help::with_help;
use crate::command::voice::Voice;
use clap::{Args, Command};
use std::path::PathBuf;
use xca_record::Interval;

pub(in crate::command) const NAME: &str = "resume";

const ABOUT: &str = "Resume an interrupted run from its latest checkpoint";

const FILES: &str = "\
The output becomes, byte for byte, that of a run without the interruption. The model
with its options, seed and precision stay those of the run. Engine and threads are
free.

--steps continues past the end of the run. --slots continues a run that ended with a
full cell. The input files must be unchanged. Relative paths start at the directory
in which the run was started, if it still exists.";

/// Options of `resume`.
#[derive(Args, Debug, Clone)]
pub(in crate::command) struct ResumeArguments {
    /// Output directory of the run
    #[arg(value_name = "DIR")]
    pub(super) folder: PathBuf,

    /// Checkpoint to resume from [default: the latest]
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,

    /// Total number of steps of the run. May exceed the original number [default: as before]
    #[arg(long, value_name = "N", value_parser = steps)]
    pub(super) steps: Option<u64>,

    /// Slots of a cell, after a run that ended with a full cell [default: as before]
    #[arg(long, value_name = "N", value_parser = slots)]
    pub(super) slots: Option<usize>,

    /// Resume on an engine that rounds differently. The results will differ from those of an uninterrupted
    /// run
    #[arg(long)]
    pub(super) allow_rounding: bool,

    /// Continue when a substate becomes NaN or infinite [default: as before]
    #[arg(long)]
    pub(super) allow_non_finite: bool,

    /// Write a checkpoint every N steps or every TIME [default: as before]
    #[arg(long, value_name = "N|TIME")]
    pub(super) checkpoint_every: Option<Interval>,

    #[command(flatten)]
    pub(super) voice: Voice,
}

pub(in crate::command) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let examples = [
        format!("{name} resume out/{name}"),
        format!("{name} resume out/{name} --steps 100000"),
        format!("{name} resume out/{name} --engine reference"),
        format!("{name} resume out/{name} --checkpoint out/{name}/checkpoints/step_00000500.checkpoint"),
    ];
    let command = with_other_engine(Command::new(NAME), definition.engines);
    with_help(ResumeArguments::augment_args(command), ABOUT, &examples)
        .long_about(format!("{ABOUT}\n\n{FILES}"))
}

fn slots(text: &str) -> Result<usize, &'static str> {
    text.parse()
        .ok()
        .filter(|slots| *slots > 0)
        .ok_or("the number of slots must be a whole number, at least 1")
}
