//! The subcommand `list`.

use super::parse::{Choice, with_help, with_model};
use super::{Definition, Ended, Unable};
use crate::components::type_text;
use crate::engines::EngineName;
use crate::report;
use crate::table::table;
use crate::terminal;
use clap::{Args, Command, ValueEnum};
use serde_json::json;
use xca_core::model::GroupKind;
use xca_core::{Model, Process, ProcessKind};
use xca_gpu::GpuError;

pub(super) const NAME: &str = "list";

const ABOUT: &str = "Tell what there is: engines, and the model's substates, parameters and processes";

/// How it is told.
#[derive(Args, Debug, Clone)]
pub(super) struct ListArguments {
    /// As JSON
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
    let model = choice.set_up(&choice.arguments.given(None))?.model;
    let text = if arguments.json { as_json(&model).map_err(Unable::failed)? } else { as_text(&model) };
    terminal::say(&text);
    Ok(Ended::Done)
}

/// Names and descriptions of the engines.
fn engines() -> impl Iterator<Item = (String, String)> {
    EngineName::value_variants().iter().map(|engine| {
        let value = engine.to_possible_value();
        let about = value.as_ref().and_then(|value| value.get_help()).map(ToString::to_string);
        (engine.to_string(), about.unwrap_or_default())
    })
}

/// The adapters of the gpu engine.
fn adapters() -> String {
    let adapters = xca_gpu::adapters();
    if adapters.is_empty() {
        return GpuError::NoAdapter.to_string();
    }
    let rows = adapters.into_iter().map(|adapter| {
        let name = format!("{}, {}", adapter.name, adapter.kind);
        let floats = match (adapter.has_f64, adapter.may_be_strict) {
            (true, true) => "f32, f64, strict if proved",
            (true, false) => "f32, f64, relaxed",
            (false, true) => "f32, strict if proved",
            (false, false) => "f32, relaxed",
        };
        let megabytes = |bytes: u64| format!("{} MB", bytes >> 20);
        let (buffer, reach) = (megabytes(adapter.largest_buffer), megabytes(adapter.largest_binding));
        let number = adapter.number.to_string();
        [number, name, adapter.interface, floats.to_owned(), buffer, reach, adapter.buffers.to_string()]
    });
    let header = ["adapter", "", "interface", "floats", "largest buffer", "in reach at once", "buffers"];
    table(header, rows, &[])
}

fn as_json(model: &Model) -> serde_json::Result<String> {
    let engines = engines().map(|(name, about)| json!({ "name": name, "about": about }));
    let adapters = xca_gpu::adapters().into_iter().map(|adapter| {
        json!({
            "number": adapter.number,
            "name": adapter.name,
            "driver": adapter.driver,
            "interface": adapter.interface,
            "kind": adapter.kind.to_string(),
            "f64": adapter.has_f64,
            "may_be_strict": adapter.may_be_strict,
            "largest_buffer": adapter.largest_buffer,
            "largest_binding": adapter.largest_binding,
            "buffers": adapter.buffers,
        })
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
        "adapters": adapters.collect::<Vec<_>>(),
        "model": report::of_model(model),
        "parameters": report::of_parameters(model.parameters()),
        "processes": processes.collect::<Vec<_>>(),
    }))
}

fn as_text(model: &Model) -> String {
    let geometry = model.geometry();
    let [x, y, z] = geometry.extents();
    let space = format!(
        "{}: {x} x {y} x {z} cells of side {}; boundaries: {}; {}",
        model.name(),
        geometry.side(),
        geometry.boundaries(),
        geometry.neighbourhood()
    );
    let engines = table(["engine", ""], engines().map(|(name, about)| [name, about]), &[]);
    let adapters = adapters();
    let substates = model.groups().iter().flat_map(|group| {
        let of = match group.kind() {
            GroupKind::Cells { .. } => "cells".to_owned(),
            GroupKind::Population { slots, .. } => format!("items, {slots} slots in a cell"),
        };
        let name = group.schema().name;
        group
            .schema()
            .fields
            .iter()
            .map(move |field| [format!("{name}.{}", field.name), type_text(field.value_type), of.clone()])
    });
    let parameters = model.parameters();
    let named = parameters.names().into_iter().zip(parameters.fields()).zip(parameters.values());
    let fields = named.map(|((name, field), value)| [name, type_text(field.value_type), value.to_string()]);
    let processes = model.processes().iter().enumerate().map(|(number, process)| {
        let [reads, elsewhere, writes] = accesses(model, number).map(|names| names.join(" "));
        let subject = match process.every {
            1 => subject(process).to_owned(),
            every => format!("{}, every {every} steps", subject(process)),
        };
        [process.name.to_owned(), subject, reads, elsewhere, writes]
    });
    let mut parts = vec![space, engines, adapters, table(["substate", "type", "of"], substates, &[])];
    if parameters.count() > 0 {
        parts.push(table(["parameter", "type", "value"], fields, &[]));
    }
    let header = ["process", "for each", "reads", "reads elsewhere", "writes"];
    parts.push(table(header, processes, &[]));
    parts.join("\n\n")
}

fn subject(process: &Process) -> &'static str {
    match process.kind {
        ProcessKind::Cells => "cell",
        ProcessKind::Items => "item",
        ProcessKind::Migration => "item, to move it",
    }
}

/// The substates that a process reads of its own cell or item, those that it reads elsewhere, and those that it writes.
///
/// Where it takes several structs, the names of these stand before those of the substates.
fn accesses(model: &Model, number: usize) -> [Vec<String>; 3] {
    let process = &model.processes()[number];
    let mut names = [Vec::new(), Vec::new(), Vec::new()];
    for (access, substate) in process.access.iter().zip(&model.plan().process(number).accesses) {
        let schema = model.groups()[substate.group].schema();
        let field = schema.fields[substate.field].name;
        let name = match process.substates {
            [_] => field.to_owned(),
            _ => format!("{}.{field}", schema.name),
        };
        for (list, uses) in names.iter_mut().zip([access.centre, access.others, access.write]) {
            if uses && !list.contains(&name) {
                list.push(name.clone());
            }
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;
    use xca_core::prelude::*;

    #[derive(Substates, Clone, Copy)]
    struct Ground {
        water: Real,
    }

    #[derive(Substates, Clone, Copy)]
    struct Sky {
        water: Real,
        wind: Real,
    }

    #[derive(Parameters, Clone, Debug)]
    struct Soil {
        rate: Real,
    }

    #[derive(Parameters, Clone, Debug)]
    struct Air {
        rate: Real,
        calm: Real,
    }

    #[elementary_process]
    fn soak(ground: &mut Cell<Ground>, sky: &Cell<Sky>, soil: &Soil) {
        ground.water += soil.rate * sky.water * sky.neighbour(1).wind;
    }

    #[elementary_process]
    fn blow(sky: &mut Cell<Sky>, air: &Air) {
        sky.wind *= air.rate + air.calm;
    }

    fn model() -> Model {
        Model::builder("weather")
            .extents([3, 3, 1])
            .neighbourhood(Neighbourhood::von_neumann_2d(1))
            .substates::<Ground>()
            .substates::<Sky>()
            .parameters(Soil { rate: 0.5 })
            .parameters(Air { rate: 0.25, calm: 1.5 })
            .process(soak)
            .process_every(6, blow)
            .build()
            .unwrap()
    }

    /// What several structs share is told apart, and processes say in which steps they are run.
    #[test]
    fn several_structs() {
        let told: Value = serde_json::from_str(&as_json(&model()).unwrap()).unwrap();
        assert_eq!(told["parameters"], json!({ "Soil.rate": 0.5, "Air.rate": 0.25, "calm": 1.5 }));
        let [first, second] = [0, 1].map(|number| &told["processes"][number]);
        assert_eq!(first["reads"], json!(["Sky.water", "Ground.water"]));
        assert_eq!(first["reads_elsewhere"], json!(["Sky.wind"]));
        assert_eq!(first["writes"], json!(["Ground.water"]));
        assert_eq!((&first["every"], &second["every"]), (&json!(1), &json!(6)));
        assert_eq!(second["writes"], json!(["wind"]));
        let text = as_text(&model());
        let row = |first: &str| {
            let line = text.lines().find(|line| line.trim_start().starts_with(first)).unwrap();
            line.split_whitespace().map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(row("Air.rate"), ["Air.rate", "Real", "0.25"]);
        assert_eq!(row("blow"), ["blow", "cell,", "every", "6", "steps", "wind", "wind"]);
    }
}
