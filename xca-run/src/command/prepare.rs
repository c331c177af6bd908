//! What comes before a run, whether it begins or goes on: the engine, and the model with its parameters.

use super::choice::RunInvocation;
use super::outcome::Unable;
use super::working_directory::WorkingDirectory;
use crate::called;
use crate::engines::EngineChoice;
use crate::program::Given;
use crate::terminal;
use xca_checkpoint::Identity;
use xca_core::{Engine, RunError, RunOptions};
use xca_machine::check_memory;
use xca_record::record::FolderError;
use xca_record::{BeginError, Run, SetUp};

/// A run that can begin.
pub(super) struct Prepared {
    pub(super) engine: Box<dyn Engine>,
    pub(super) run: Run,
}

impl Prepared {
    /// Makes the model of a run, for an engine that need not be the one that its command line names.
    pub(super) fn new(invocation: &RunInvocation<'_>, on: &EngineChoice) -> Result<Self, Unable> {
        let engine = on.engine(invocation.model.definition)?;
        let given = invocation.model.arguments.given(invocation.run.steps);
        let set_up = set_up(invocation, &*engine, &given)?;
        Ok(Self { engine, run: run_of(invocation, &given, set_up)? })
    }
}

/// A run as its command line says it, on no engine.
pub(super) fn described(invocation: &RunInvocation<'_>) -> Result<Run, Unable> {
    let given = invocation.model.arguments.given(invocation.run.steps);
    let set_up = set_up_of(invocation, &given)?;
    run_of(invocation, &given, set_up)
}

fn run_of(invocation: &RunInvocation<'_>, given: &Given, set_up: SetUp) -> Result<Run, Unable> {
    let definition = invocation.model.definition;
    let identity = Identity {
        program: definition.name.to_owned(),
        version: definition.version.to_owned(),
        command_line: invocation.command_line.clone(),
        directory: WorkingDirectory::present(),
        options: invocation.model.options.clone(),
    };
    let arguments = &invocation.run;
    let options = RunOptions { precision: given.precision, seed: given.seed };
    let mut run = Run::new(set_up).map_err(Unable::refused)?.identity(identity).options(options);
    if let Some(steps) = given.steps {
        run = run.steps(steps);
    }
    if let Some(every) = arguments.every {
        run = run.every(every);
    }
    if let Some(interval) = arguments.checkpoint_every {
        run = run.checkpoint_every(interval);
    }
    if arguments.allow_non_finite {
        run = run.allow_non_finite();
    }
    Ok(if arguments.overwrite { run.overwrite() } else { run })
}

/// The model, with the formats of its files.
fn set_up_of(invocation: &RunInvocation<'_>, given: &Given) -> Result<SetUp, Unable> {
    let mut set_up = invocation.model.set_up(given)?;
    let names = &invocation.run.formats;
    let added: Vec<&str> = names.iter().filter_map(|name| name.strip_prefix('+')).collect();
    if added.is_empty() && !names.is_empty() {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        set_up.formats.choose(&names).map_err(Unable::refused)?;
    } else if added.len() == names.len() {
        set_up.formats.choose_too(&added).map_err(Unable::refused)?;
    } else {
        return Err(Unable::refused(
            "--formats adds to those of the model, or takes their place: write + before all names, or before none",
        ));
    }
    Ok(set_up)
}

/// The model, where the machine has room for it.
fn set_up(invocation: &RunInvocation<'_>, engine: &dyn Engine, given: &Given) -> Result<SetUp, Unable> {
    let set_up = set_up_of(invocation, given)?;
    check_room(engine, set_up.least_memory(engine, given.precision))?;
    Ok(set_up)
}

/// Refuses a run that the machine has no room for, which takes so many bytes.
pub(super) fn check_room(engine: &dyn Engine, memory: u128) -> Result<(), Unable> {
    check_memory(memory, &format!("this run on the {} engine", engine.name())).map_err(Unable::refused)
}

/// Prints the warnings of a set-up, also where nothing else is said.
pub(super) fn warn(set_up: &SetUp) {
    for warning in &set_up.warnings {
        terminal::remark(&format!("warning: {warning}"));
    }
}

/// What cannot begin is a mistake in what was given. The command is offered that resumes an unfinished run.
pub(super) fn not_begun(program: &str, error: BeginError) -> Unable {
    match error {
        BeginError::Start(error) => not_started(error),
        BeginError::Folder(FolderError::Unfinished { ref folder }) => {
            let offer = format!("resume it with\n  {}", called::resume(program, folder));
            Unable::RefusedOffering(error.into(), offer)
        }
        other => Unable::refused(other),
    }
}

/// An initial state that cannot be made is a mistake in what was given.
pub(super) fn not_started(error: RunError) -> Unable {
    match error {
        RunError::Steering { step: 0, source } => Unable::Refused(source),
        other => Unable::refused(other),
    }
}
