//! The parts that the help of all commands shares.

use super::arguments::ModelArguments;
use super::definition::Definition;
use clap::{Args, Command};

/// The exit codes, as every program's `--help` lists them.
pub(super) const EXIT_CODES: &str = "\
Exit codes:
  0    success; a run did all its steps, or its model stopped it
  1    the run failed: a fault of the model, or output that could not be written
  2    invalid command line, input file, checkpoint or model; nothing was run
  3    compare: an engine differs from the first by more than rounding
  130  interrupted. Ctrl-C or SIGTERM stops after the current step, with complete
       files; a second one stops at once";

/// Adds the options of the model, its own and those of every model.
pub(super) fn with_model(command: Command, definition: &Definition<'_>) -> Command {
    let command = (definition.options)(command.next_help_heading("Options of this model"));
    ModelArguments::augment_args(command.next_help_heading("Options of every model"))
}

/// Adds the shared parts of the help of a subcommand.
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
