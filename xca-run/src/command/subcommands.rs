//! The whole command, with all its subcommands.

use super::definition::Definition;
use super::help::EXIT_CODES;
use super::{compare, inspect, list, new, render, resume, run, sweep, watch};
use clap::Command;

/// The whole command.
pub(super) fn command(definition: &Definition<'_>) -> Command {
    let Definition { name, about, version, .. } = definition;
    let steps = [
        (format!("{name} run"), format!("runs the model; output in out/{name}")),
        (format!("{name} render out/{name}"), "draws pictures of that run".to_owned()),
        (format!("{name} list"), "lists parameters, substates and engines".to_owned()),
    ];
    let width = steps.iter().map(|(words, _)| words.len()).max().unwrap_or(0);
    let steps = steps.map(|(words, about)| format!("\n  {words:width$}  {about}")).concat();
    Command::new(*name)
        .about(*about)
        .version(*version)
        .subcommand_required(true)
        .arg_required_else_help(true)
        .after_help(format!(
            "First steps:{steps}\n\n`{name} run --help` lists the options of a run. Each command has its own \
             --help.\n\n{EXIT_CODES}"
        ))
        .subcommands([
            run::command(definition),
            resume::command(definition),
            render::command(definition),
            watch::command(definition),
            list::command(definition),
            inspect::command(definition),
            compare::command(definition),
            sweep::command(definition),
            new::command(definition),
        ])
}
