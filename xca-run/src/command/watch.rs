//! The subcommand `watch`. Its options are known in each program; what shows the run is built with the
//! feature `terminal`.

#[cfg(feature = "terminal")]
mod show;

use super::arguments::{RunArguments, interval, steps};
use super::choice::RunInvocation;
use super::definition::Definition;
use super::engine::with_engine;
use super::help::{with_help, with_model};
use super::look::LookArguments;
use super::outcome::{Ended, Unable};
use super::voice::Voice;
use clap::{Args, Command};

pub(super) const NAME: &str = "watch";

const ABOUT: &str = "Run the model and show it in the terminal";

const KEYS: &str = "\
Shows cells layer by layer, and items from the front (--axis changes the direction).
The colour scale grows with the values, unless --range fixes its ends. Colours follow
COLORTERM and NO_COLOR.

Keys:
  space      pause, go on
  n .        one step, and pause
  + -        more or fewer steps a picture
  tab        the next substate
  [ ]        the layer below or above (also page down and page up)
  a          look along the next axis
  z          closer: a cell is half a character; arrows then move
  s          begin the scale of colours anew
  r          begin the run anew
  q          quit (also Esc), with exit code 0
  Ctrl-C     quit, with exit code 130";

/// What is watched.
#[derive(Args, Debug, Clone)]
pub(super) struct WatchArguments {
    /// Stop after N steps [default: when the model stops]
    #[arg(long, value_name = "N", value_parser = steps)]
    steps: Option<u64>,

    /// Draw every N steps, and at least every half second [default: 1/1000 of the model's steps]
    #[arg(long, value_name = "N", value_parser = interval)]
    every: Option<u64>,

    /// Maximum number of pictures per second
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u16).range(1..=60))]
    fps: u16,

    #[command(flatten)]
    look: LookArguments,
}

impl WatchArguments {
    /// What a run would be told.
    pub(super) fn as_of_run(&self) -> RunArguments {
        RunArguments {
            steps: self.steps,
            out: None,
            every: None,
            checkpoint_every: None,
            formats: Vec::new(),
            allow_non_finite: true,
            overwrite: false,
            print_source: false,
            voice: Voice::default(),
        }
    }
}

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let command = with_engine(with_model(Command::new(NAME), definition), definition.engines);
    let command = WatchArguments::augment_args(command).next_help_heading(None::<&str>);
    let examples = [format!("{name} watch"), format!("{name} watch --every 1 --fps 10 --engine reference")];
    with_help(command, ABOUT, &examples).long_about(format!("{ABOUT}\n\n{KEYS}"))
}

/// Shows a run in the terminal.
#[cfg(feature = "terminal")]
pub(super) fn watch(invocation: &RunInvocation<'_>, arguments: &WatchArguments) -> Result<Ended, Unable> {
    show::show(invocation, arguments)
}

/// Says that the program cannot.
#[cfg(not(feature = "terminal"))]
pub(super) fn watch(_invocation: &RunInvocation<'_>, _arguments: &WatchArguments) -> Result<Ended, Unable> {
    Err(Unable::refused(crate::engines::MissingFeature::TERMINAL))
}
