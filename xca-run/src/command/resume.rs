//! The subcommand `resume`.

mod arguments;

pub(super) use arguments::{NAME, ResumeArguments, command};

use super::choice::RunInvocation;
use super::definition::Definition;
use super::engine::{OtherChoice, help};
use super::outcome::{Ended, Unable};
use super::parse;
use super::prepare::{Prepared, check_room, described};
use super::under_way::UnderWay;
use super::working_directory::WorkingDirectory;
use crate::called;
use crate::engines::EngineChoice;
use serde_json::json;
use std::path::{Path, PathBuf};
use xca_checkpoint::{CheckpointError, CheckpointFile, CheckpointFolder, Description, Difference};
use xca_core::Model;
use xca_io::numbers::counted;
use xca_record::record::REPORT;
use xca_record::report::{self, Earlier};
use xca_record::{BeginError, Failure, ReadReportError, Resumed, Run};

/// Goes on with a run.
pub(super) fn resume(
    definition: &Definition<'_>,
    arguments: &ResumeArguments,
    on: &OtherChoice,
) -> Result<Ended, Unable> {
    let folder = &arguments.folder;
    if !folder.is_dir() {
        return Err(Unable::refused(format!("there is no folder {}", folder.display())));
    }
    let report_file = folder.join(REPORT);
    let report = report::read(&report_file).map_err(unread)?.unwrap_or_else(|| json!({}));
    let earlier: Earlier = report::parts(&report_file, &report).map_err(unread)?;
    if arguments.checkpoint.is_none() && arguments.steps.is_none() && earlier.has_ended() {
        if let Some(program) = earlier.program.as_ref().filter(|program| **program != definition.name) {
            let (folder, name) = (folder.display(), definition.name);
            return Err(Unable::refused(format!("{folder} holds a run of `{program}`, not of `{name}`")));
        }
        let (folder, steps) = (folder.display(), counted(earlier.taken().steps, "step"));
        let can_continue = earlier.stop_reason().is_none() && latest(arguments).is_some();
        let how = if can_continue { "; --steps continues past its end" } else { "" };
        arguments.voice.tell(&report, || format!("the run in {folder} has ended after {steps}{how}"))?;
        return Ok(Ended::Done);
    }
    let path = chosen(arguments)?;
    let found = Found { definition, arguments, path: &path };
    let checkpoint = CheckpointFile::open(&path).map_err(|error| found.refused(error.into(), None, false))?;
    let begun = found.begun(&checkpoint, &earlier)?;
    let on = on.or_as_begun(&begun.engine);
    definition.engines.check([&*on.name], NAME).map_err(Unable::refused)?;
    if let Some(helper) = on.helper(definition)? {
        return help(&*helper, || found.model(&checkpoint, &begun));
    }
    found.under_way(&checkpoint, earlier, &begun, &on)?.go()
}

/// A report that may be of someone else is not replaced; a lost one is no obstacle.
fn unread(error: ReadReportError) -> Unable {
    Unable::RefusedOffering(error.into(), "move it away to resume without it".to_owned())
}

/// The latest checkpoint of the run.
fn latest(arguments: &ResumeArguments) -> Option<PathBuf> {
    CheckpointFolder::of_run(&arguments.folder).into_iter().next()
}

fn chosen(arguments: &ResumeArguments) -> Result<PathBuf, Unable> {
    arguments.checkpoint.clone().or_else(|| latest(arguments)).ok_or_else(|| {
        let folder = arguments.folder.display();
        Unable::refused(format!("there is no checkpoint in {folder}; `run --checkpoint-every` writes them"))
    })
}

/// A checkpoint to go on from.
struct Found<'a> {
    definition: &'a Definition<'a>,
    arguments: &'a ResumeArguments,
    path: &'a Path,
}

impl Found<'_> {
    /// The run as it was begun.
    fn begun(&self, checkpoint: &CheckpointFile, earlier: &Earlier) -> Result<RunInvocation<'_>, Unable> {
        let description = checkpoint.description();
        let of_program = description.run.other_program(self.definition.identity());
        self.same(of_program, description)?;
        self.same(earlier.difference(&description.run.command_line), description)?;
        parse::recorded(self.definition, &description.run.command_line, "checkpoint")
    }

    /// The model alone.
    fn model(&self, checkpoint: &CheckpointFile, begun: &RunInvocation<'_>) -> Result<Model, Unable> {
        let there = WorkingDirectory::enter(&checkpoint.description().run.directory)?;
        let run = described(begun)?;
        drop(there);
        Ok(self.with_slots(run)?.model().clone())
    }

    fn with_slots(&self, run: Run) -> Result<Run, Unable> {
        match self.arguments.slots {
            Some(slots) => run.slots(slots).map_err(Unable::refused),
            None => Ok(run),
        }
    }

    /// Puts the run together as it was.
    fn under_way(
        &self,
        checkpoint: &CheckpointFile,
        earlier: Earlier,
        begun: &RunInvocation<'_>,
        on: &EngineChoice,
    ) -> Result<UnderWay, Unable> {
        let description = checkpoint.description();
        let there = WorkingDirectory::enter(&description.run.directory)?;
        let Prepared { engine, mut run } = Prepared::new(begun, on)?;
        drop(there);
        run = run.steps(self.steps(description, &earlier)?);
        run = self.with_slots(run)?;
        if self.arguments.slots.is_some() {
            check_room(&*engine, run.least_memory(&*engine))?;
        }
        if let Some(interval) = self.arguments.checkpoint_every {
            run = run.checkpoint_every(interval);
        }
        if self.arguments.allow_non_finite {
            run = run.allow_non_finite();
        }
        if self.arguments.allow_rounding {
            run = run.allow_rounding();
        }
        let resumed = Resumed { checkpoint, earlier };
        let recording = run.resume_from(&self.arguments.folder, &*engine, resumed);
        let recording = recording.map_err(|error| self.not_resumed(error, description))?;
        Ok(UnderWay { recording, voice: self.arguments.voice, note: engine.note() })
    }

    /// How many steps the run has in the end.
    fn steps(&self, description: &Description, earlier: &Earlier) -> Result<u64, Unable> {
        let taken = earlier.taken();
        let wanted = taken.steps_wanted.unwrap_or(description.run.steps_wanted);
        let Some(steps) = self.arguments.steps else { return Ok(wanted) };
        let done = if earlier.has_ended() { taken.steps } else { description.step };
        if let Some(reason) = earlier.stop_reason() {
            return Err(Unable::refused(format!(
                "the model has stopped the run after {}: {reason}; it cannot continue, even with --steps",
                counted(done, "step")
            )));
        }
        if steps < done {
            let done = counted(done, "step");
            return Err(Unable::refused(format!("{done} of the run are done; --steps must be larger")));
        }
        Ok(steps)
    }

    /// What stands in the way of a run that is to go on.
    fn not_resumed(&self, error: BeginError, description: &Description) -> Unable {
        match error {
            BeginError::Rounding { .. } => Unable::refused(format!(
                "{error}; choose that engine with --engine and its options, or add --allow-rounding"
            )),
            BeginError::Folder(_) | BeginError::Write(_) => Unable::refused(error),
            BeginError::Checkpoint(error @ CheckpointError::Foreign { .. }) => {
                self.refused(error.into(), Some(description), true)
            }
            other => self.refused(other.into(), Some(description), false),
        }
    }

    /// Refuses a checkpoint that differs from what this program would have written.
    fn same(&self, difference: Option<Difference>, description: &Description) -> Result<(), Unable> {
        let Some(Difference { what, found, wanted }) = difference else { return Ok(()) };
        let error = CheckpointError::Foreign { path: self.path.to_owned(), what, found, wanted };
        Err(self.refused(error.into(), Some(description), true))
    }

    /// A checkpoint that cannot be used, with the latest other one that may be. A difference of the run, such
    /// as a changed input file, is that of all its checkpoints.
    fn refused(&self, error: Failure, description: Option<&Description>, is_of_run: bool) -> Unable {
        let might_do = |path: &PathBuf| {
            CheckpointFile::open(path).is_ok_and(|other| {
                let other = other.description();
                other.run.other_program(self.definition.identity()).is_none()
                    && description.is_none_or(|refused| {
                        refused.run != other.run || (!is_of_run && refused.step > other.step)
                    })
            })
        };
        let is_other = |path: &PathBuf| path.file_name() != self.path.file_name();
        let others = CheckpointFolder::of_run(&self.arguments.folder).into_iter().filter(is_other);
        let Some(older) = others.into_iter().find(might_do) else { return Unable::Refused(error) };
        let [folder, older] = [&self.arguments.folder, &older].map(|path| path.display().to_string());
        let words = [NAME, &folder, "--checkpoint", &older];
        let command = called::command(self.definition.name, &words);
        let offer = format!("another checkpoint is intact; resume from it with\n  {command}");
        Unable::RefusedOffering(error, offer)
    }
}
