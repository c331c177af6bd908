//! The subcommand `inspect`.

mod arguments;
mod findings;
mod frames;
mod numbers;
mod state;
mod words;

pub(super) use arguments::{InspectArguments, NAME, command};

use super::definition::Definition;
use super::outcome::{Ended, Unable};
use crate::terminal::{self, short_lines};
use findings::{Findings, Inside, Listed};
use std::path::Path;
use xca_checkpoint::{Checkpoint, CheckpointFile, CheckpointFolder};
use xca_record::record::REPORT;
use xca_record::report::{self, Earlier};

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
        let read = match state {
            None => Checkpoint::read(&path).map(Some),
            Some(_) => CheckpointFile::open(&path).map(|_| None),
        };
        if let Ok(Some(checkpoint)) = &read {
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
