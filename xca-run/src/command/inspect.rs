//! The subcommand `inspect`.

mod frames;
mod numbers;
mod state;
mod words;

use super::definition::Definition;
use super::help::with_help;
use super::outcome::{Ended, Unable};
use crate::terminal::{self, short_lines};
use clap::{Args, Command};
use serde::Serialize;
use serde_json::Value;
use state::{Place, Statistics};
use std::path::{Path, PathBuf};
use xca_checkpoint::Exact;
use xca_checkpoint::{Checkpoint, CheckpointFolder, Parameter};
use xca_record::record::REPORT;
use xca_record::report::{self, Earlier};

pub(super) const NAME: &str = "inspect";

const ABOUT: &str = "Show what a run or a checkpoint holds";

/// What is looked at, and how it is told.
#[derive(Args, Debug, Clone)]
pub(super) struct InspectArguments {
    /// Output directory of a run, or a checkpoint. Shows the state of the latest checkpoint, or else of the
    /// last frames
    #[arg(value_name = "DIR|CHECKPOINT")]
    path: PathBuf,

    /// Show the values of this cell and of its items
    #[arg(long, value_name = "X,Y,Z", value_parser = cell)]
    cell: Option<[usize; 3]>,

    /// Show the values of the items with this label
    #[arg(long, value_name = "N")]
    label: Option<u32>,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let examples = [
        format!("{name} inspect out/{name}"),
        format!("{name} inspect out/{name}/checkpoints/step_00000500.checkpoint --cell 3,4,0"),
        format!("{name} inspect out/{name} --label 17 --json"),
    ];
    with_help(InspectArguments::augment_args(Command::new(NAME)), ABOUT, &examples)
}

fn cell(text: &str) -> Result<[usize; 3], &'static str> {
    const WANTED: &str = "a cell is three whole numbers, such as 3,4,0";
    let indices: Result<Vec<usize>, _> = text.split(',').map(|index| index.trim().parse()).collect();
    indices.map_err(|_| WANTED)?.try_into().map_err(|_| WANTED)
}

/// What there is to tell.
#[derive(Debug, Serialize)]
struct Findings {
    /// `run.json`.
    #[serde(skip_serializing_if = "Option::is_none")]
    run: Option<Value>,
    /// The checkpoints of the folder, the latest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    checkpoints: Vec<Listed>,
    /// The one that is looked into.
    #[serde(skip_serializing_if = "Option::is_none")]
    state: Option<Inside>,
}

/// A checkpoint of a folder.
#[derive(Debug, Serialize)]
struct Listed {
    path: PathBuf,
    /// Why it cannot be used.
    problem: Option<String>,
}

/// What is in a checkpoint.
#[derive(Debug, Serialize)]
struct Inside {
    path: PathBuf,
    program: String,
    version: String,
    step: u64,
    time: Exact,
    steps_wanted: u64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    parameters: Vec<Parameter>,
    substates: Vec<Statistics>,
    /// The cell and the items that were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    places: Vec<Place>,
}

/// Looks into a folder or a checkpoint.
pub(super) fn inspect(definition: &Definition<'_>, arguments: &InspectArguments) -> Result<Ended, Unable> {
    terminal::say(&text(definition, arguments)?).map_err(Unable::failed)?;
    Ok(Ended::Done)
}

/// What there is to tell of a folder or a checkpoint.
pub(super) fn text(definition: &Definition<'_>, arguments: &InspectArguments) -> Result<String, Unable> {
    let findings =
        if arguments.path.is_dir() { in_folder(definition, arguments)? } else { in_file(arguments)? };
    if arguments.json {
        serde_json::to_string_pretty(&findings).map_err(Unable::failed)
    } else {
        Ok(short_lines(&findings.to_string()))
    }
}

fn in_file(arguments: &InspectArguments) -> Result<Findings, Unable> {
    let checkpoint = Checkpoint::read(&arguments.path).map_err(Unable::refused)?;
    let state = Some(inside(&arguments.path, &checkpoint, arguments)?);
    Ok(Findings { run: None, checkpoints: Vec::new(), state })
}

fn in_folder(definition: &Definition<'_>, arguments: &InspectArguments) -> Result<Findings, Unable> {
    let report = arguments.path.join(REPORT);
    let run = report::read(&report).map_err(Unable::refused)?.filter(|run| run.get("xca").is_some());
    if let Some(run) = &run {
        report::parts::<Earlier>(&report, run).map_err(Unable::refused)?;
    }
    let (mut state, mut checkpoints) = (None, Vec::new());
    for path in CheckpointFolder::of_run(&arguments.path) {
        let read = Checkpoint::read(&path);
        if let (None, Ok(checkpoint)) = (&state, &read) {
            state = Some(inside(&path, checkpoint, arguments)?);
        }
        checkpoints.push(Listed { path, problem: read.err().map(|error| error.to_string()) });
    }
    if run.is_none() && checkpoints.is_empty() {
        let folder = arguments.path.display();
        return Err(Unable::refused(format!(
            "{folder} is not the output of a run: it has neither {REPORT} nor checkpoints"
        )));
    }
    if let (None, Some(run)) = (&state, &run) {
        state = frames::inside(definition, run, arguments)?;
    }
    if state.is_none() && (arguments.cell.is_some() || arguments.label.is_some()) {
        let folder = arguments.path.display();
        return Err(Unable::refused(format!("{folder} holds neither a checkpoint nor a frame")));
    }
    Ok(Findings { run, checkpoints, state })
}

fn inside(path: &Path, checkpoint: &Checkpoint, arguments: &InspectArguments) -> Result<Inside, Unable> {
    let mut places = Vec::new();
    if let Some(cell) = arguments.cell {
        places.extend(state::cell(checkpoint, cell).map_err(Unable::refused)?);
    }
    if let Some(label) = arguments.label {
        places.extend(state::items(checkpoint, label).map_err(Unable::refused)?);
    }
    let description = &checkpoint.description;
    Ok(Inside {
        path: path.to_owned(),
        program: description.run.program.clone(),
        version: description.run.version.clone(),
        step: description.step,
        time: description.time,
        steps_wanted: description.run.steps_wanted,
        parameters: description.parameters.clone(),
        substates: state::statistics(checkpoint),
        places,
    })
}
