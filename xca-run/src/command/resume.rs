//! The subcommand `resume`.

use super::arguments::ResumeArguments;
use super::parse::{self, with_help};
use super::prepare::Prepared;
use super::under_way::{Checkpoints, UnderWay};
use super::{Definition, Ended, Unable};
use crate::checkpoint::{Checkpoint, CheckpointError, CheckpointFolder, Description, Difference};
use crate::program::Failure;
use crate::record::{REPORT, RunFolder};
use crate::report::{self, Earlier, ReadReportError};
use clap::{Args, Command};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use xca_core::Simulation;

pub(super) const NAME: &str = "resume";

const ABOUT: &str = "Go on with a run that was interrupted or killed, from its latest checkpoint";

const FILES: &str = "\
The files of the run become those that it would have had without the interruption,
byte by byte. What the results depend on (the model with its options, seed,
precision, steps) is what the run was told; engine and threads are free.";

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let examples = [
        format!("{name} resume out/{name}"),
        format!("{name} resume out/{name} --engine reference"),
        format!("{name} resume out/{name} --checkpoint out/{name}/checkpoints/step_00000500.checkpoint"),
    ];
    with_help(ResumeArguments::augment_args(Command::new(NAME)), ABOUT, &examples)
        .long_about(format!("{ABOUT}\n\n{FILES}"))
}

/// Goes on with a run.
pub(super) fn resume(definition: &Definition<'_>, arguments: &ResumeArguments) -> Result<Ended, Unable> {
    let begin = Instant::now();
    let folder = &arguments.folder;
    if !folder.is_dir() {
        return Err(Unable::refused(format!("there is no folder {}", folder.display())));
    }
    let report_file = folder.join(REPORT);
    let report = report::read(&report_file).map_err(unread)?.unwrap_or_else(|| json!({}));
    let earlier: Earlier = report::parts(&report_file, &report).map_err(unread)?;
    if arguments.checkpoint.is_none() && earlier.has_ended() {
        arguments
            .voice
            .tell(&report, || format!("the run in {} has come to its end already", folder.display()))?;
        return Ok(Ended::Done);
    }
    let path = chosen(arguments)?;
    let found = Found { definition, arguments, path: &path };
    let checkpoint = Checkpoint::read(&path).map_err(|error| found.refused(error.into(), None))?;
    found.under_way(checkpoint, earlier, begin)?.go()
}

/// A report that may be of someone else is not replaced; a lost one is no obstacle.
fn unread(error: ReadReportError) -> Unable {
    Unable::RefusedOffering(error.into(), "move it away to resume without it".to_owned())
}

/// A run that should not go on in this way.
#[derive(Debug, thiserror::Error)]
enum ResumeError {
    #[error(
        "the run was begun with rounding that is {found}, and would go on with rounding that is {wanted}, to other files; choose the engine with \
         --engine, --adapter and --arithmetic, or add --allow-rounding"
    )]
    Rounding { found: String, wanted: String },
}

fn chosen(arguments: &ResumeArguments) -> Result<PathBuf, Unable> {
    let latest = || CheckpointFolder::of_run(&arguments.folder).into_iter().next();
    arguments.checkpoint.clone().or_else(latest).ok_or_else(|| {
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
    /// Puts the run together as it was.
    fn under_way(
        &self,
        checkpoint: Checkpoint,
        earlier: Earlier,
        begin: Instant,
    ) -> Result<UnderWay, Unable> {
        let Checkpoint { description, snapshot } = &checkpoint;
        let of_program = description.run.other_program(self.definition.identity());
        self.same(of_program, description)?;
        self.same(earlier.difference(&description.run.command_line), description)?;
        let run = parse::recorded(self.definition, &description.run.command_line, "checkpoint")?;
        let on = self.arguments.engine(&run.engine);
        let Prepared { engine, mut recorder, options, origin, mut report } = Prepared::new(&run, &on)?;
        self.same(description.run.mismatch(&origin), description)?;
        if !self.arguments.allow_rounding
            && let Some(Difference { found, wanted, .. }) = description.run.other_rounding(&origin)
        {
            return Err(Unable::refused(ResumeError::Rounding { found, wanted }));
        }
        let refused = |error: Failure| self.refused(error, Some(description));
        let folder = RunFolder::open(&self.arguments.folder).map_err(Unable::refused)?;
        let simulation = Simulation::resume(recorder.model(), &*engine, options, snapshot);
        let simulation = simulation.map_err(|error| refused(error.into()))?;
        let every = self.arguments.checkpoint_every.or(run.run.checkpoint_every);
        let checkpoints = every.map(|interval| Checkpoints::new(interval, &folder, Some(self.path)));
        let checkpoints = checkpoints.transpose().map_err(Unable::refused)?;
        recorder.resume(folder.clone(), &description.recorded).map_err(|error| refused(error.into()))?;
        report.checkpoint_every = every.map(|interval| interval.to_string());
        report.files.insert(0, CheckpointFolder::files());
        report.go_on(&earlier, description.step, self.path);
        Ok(UnderWay {
            simulation,
            recorder,
            report,
            folder,
            origin,
            checkpoints,
            allow_non_finite: self.arguments.allow_non_finite || run.run.allow_non_finite,
            voice: self.arguments.voice,
            note: engine.note(),
            earlier,
            begin,
            set_up: begin.elapsed(),
            stepping: Duration::ZERO,
        })
    }

    /// Refuses a checkpoint that differs from what this program would have written.
    fn same(&self, difference: Option<Difference>, description: &Description) -> Result<(), Unable> {
        let Some(Difference { what, found, wanted }) = difference else { return Ok(()) };
        let error = CheckpointError::Foreign { path: self.path.to_owned(), what, found, wanted };
        Err(self.refused(error.into(), Some(description)))
    }

    /// A checkpoint that cannot be used, with the latest other one that may be.
    fn refused(&self, error: Failure, description: Option<&Description>) -> Unable {
        let might_do = |path: &PathBuf| {
            let other = Checkpoint::read(path).map(|other| other.description);
            other.is_ok_and(|other| {
                other.run.other_program(self.definition.identity()).is_none()
                    && description.is_none_or(|refused| refused.run != other.run || refused.step > other.step)
            })
        };
        let is_other = |path: &PathBuf| path.file_name() != self.path.file_name();
        let others = CheckpointFolder::of_run(&self.arguments.folder).into_iter().filter(is_other);
        let Some(older) = others.into_iter().find(might_do) else { return Unable::Refused(error) };
        let (name, folder) = (self.definition.name, self.arguments.folder.display());
        Unable::RefusedOffering(
            error,
            format!(
                "another checkpoint is whole; go on from it with\n  {name} resume {folder} --checkpoint {}",
                older.display()
            ),
        )
    }
}
