//! The subcommand `watch`. Its options are known in each program; what shows the run is built with the
//! feature `terminal`.

mod arguments;
#[cfg(feature = "terminal")]
mod show;

pub(super) use arguments::WatchArguments;

use super::choice::RunInvocation;
use super::definition::Definition;
use super::engine::with_engine;
use super::help::{with_help, with_model};
use super::outcome::{Ended, Unable};
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
