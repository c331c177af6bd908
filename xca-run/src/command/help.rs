//! What is the same in the help of all commands.

use super::arguments::ModelArguments;
use super::definition::Definition;
use clap::{Args, Command};

/// What every program's `--help` says of its exit codes.
pub(super) const EXIT_CODES: &str = "\
Exit codes:
  0    what was asked for is done: of a run, all steps, or the model stopped it
  1    the run failed: a fault of the model, or files or results that could not be
       written
  2    the command line, a file, a checkpoint or the model makes no sense, or does
       not fit; nothing was run
  3    of a comparison: an engine differs from the first one by more than rounding
  130  interrupted: the first Ctrl-C (or SIGTERM) ends the run after its current
       step with all files complete, a second one ends it at once";

/// Adds the options of the model, its own and those of every model.
pub(super) fn with_model(command: Command, definition: &Definition<'_>) -> Command {
    let command = (definition.options)(command.next_help_heading("Options of this model"));
    ModelArguments::augment_args(command.next_help_heading("Options of every model"))
}

/// What is the same in the help of all subcommands.
pub(super) fn with_help(command: Command, about: &'static str, examples: &[String]) -> Command {
    let examples: String = examples.iter().map(|example| format!("\n  {example}")).collect();
    command
        // An option's text comes from its own description, never from that of the struct.
        .about(about)
        .long_about(None::<&str>)
        .mut_args(|option| {
            // `--steps -1` is a wrong number, not an unknown option.
            let takes_values = option.get_action().takes_values();
            if takes_values { option.allow_negative_numbers(true) } else { option }
        })
        .after_help(format!("Examples:{examples}\n\n{EXIT_CODES}"))
}
