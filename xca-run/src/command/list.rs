//! The subcommand `list`.

mod accesses;
mod text;

use super::choice::Choice;
use super::definition::Definition;
use super::help::{with_help, with_model};
use super::outcome::{Ended, Unable};
use super::prepare::warn;
use crate::engines::Engines;
use crate::terminal;
use accesses::{accesses, subject};
use clap::{Args, Command};
use serde_json::{Map, Value, json};
use text::as_text;
use xca_checkpoint::ModelReport;
use xca_checkpoint::components::state_names;
use xca_core::model::GroupKind;
use xca_core::{End, Model};
use xca_record::SetUp;
use xca_record::format::Formats;
use xca_record::report;

pub(super) const NAME: &str = "list";

const ABOUT: &str = "List engines and formats, and the model's substates, parameters and processes";

/// How it is told.
#[derive(Args, Debug, Clone)]
pub(super) struct ListArguments {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let command = with_model(Command::new(NAME), definition).next_help_heading(None::<&str>);
    let examples = [format!("{name} list"), format!("{name} list --json")];
    with_help(ListArguments::augment_args(command), ABOUT, &examples)
}

/// Tells what a program has, with the options that are given.
pub(super) fn list(choice: &Choice<'_>, arguments: &ListArguments) -> Result<Ended, Unable> {
    let set_up = choice.set_up(&choice.arguments.given(None))?;
    warn(&set_up);
    let SetUp { model, formats, .. } = set_up;
    let engines = choice.definition.engines;
    let text = if arguments.json {
        as_json(&model, engines, &formats).map_err(Unable::failed)?
    } else {
        as_text(&model, engines, &formats)
    };
    terminal::say(&text).map_err(Unable::failed)?;
    Ok(Ended::Done)
}

/// What is known of each substate.
fn substates(model: &Model) -> impl Iterator<Item = Value> {
    model.groups().iter().flat_map(|group| {
        let of = match group.kind() {
            GroupKind::Cells { .. } => "cells",
            GroupKind::Population { .. } => "items",
        };
        let schema = group.schema();
        schema.fields.iter().map(move |field| {
            json!({
                "name": format!("{}.{}", schema.name, field.name),
                "of": of,
                "type": field.value_type.to_string(),
                "states": state_names(field.value_type.scalar),
                "unit": field.unit,
                "documentation": field.documentation,
            })
        })
    })
}

/// What is known of each parameter, by name.
fn parameters(model: &Model) -> Map<String, Value> {
    let parameters = model.parameters();
    let mut values = report::of_parameters(parameters);
    for (name, field) in parameters.names().into_iter().zip(parameters.fields()) {
        let end = |end: Option<End>| end.map(|end| json!({ "number": end.number, "included": end.included }));
        let value = values.remove(&name);
        let known = json!({
            "value": value,
            "type": field.value_type.to_string(),
            "states": state_names(field.value_type.scalar),
            "unit": field.unit,
            "low": end(field.range.low),
            "high": end(field.range.high),
            "computed": field.computed,
            "documentation": field.documentation,
        });
        values.insert(name, known);
    }
    values
}

fn as_json(model: &Model, engines: &Engines, formats: &Formats) -> serde_json::Result<String> {
    let engines = engines.kinds().map(|kind| {
        let devices = kind.devices().unwrap_or_default().data;
        let options = kind.options().iter().map(|option| option.name).collect::<Vec<_>>();
        json!({ "name": kind.name(), "about": kind.about(), "options": options, "devices": devices })
    });
    let chosen = formats.names();
    let formats = formats.all().map(|format| {
        json!({ "name": format.name(), "about": format.about(), "chosen": chosen.contains(&format.name()) })
    });
    let processes = model.processes().iter().enumerate().map(|(number, process)| {
        let [reads, reads_elsewhere, writes] = accesses(model, number);
        json!({
            "name": process.name,
            "for_each": subject(process),
            "every": process.every,
            "local_interaction": process.local_interaction,
            "reads": reads,
            "reads_elsewhere": reads_elsewhere,
            "writes": writes,
        })
    });
    serde_json::to_string_pretty(&json!({
        "engines": engines.collect::<Vec<_>>(),
        "formats": formats.collect::<Vec<_>>(),
        "model": ModelReport::new(model),
        "substates": substates(model).collect::<Vec<_>>(),
        "parameters": parameters(model),
        "processes": processes.collect::<Vec<_>>(),
    }))
}

#[cfg(test)]
mod tests;
