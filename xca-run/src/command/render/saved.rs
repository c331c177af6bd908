//! What a run has left, drawn without running it again.

use super::film::{Film, Look, States};
use super::kept::{Kept, KeptRun};
use super::{RenderArguments, default_folder, pictures_folder};
use crate::command::definition::Definition;
use crate::command::outcome::{Ended, Unable};
use crate::command::voice::Voice;
use crate::interrupt::Interrupt;
use serde_json::{Value, json};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use xca_checkpoint::{Checkpoint, CheckpointFolder};
use xca_io::atomic::{OutputFolder, write_atomically};
use xca_io::numbers::counted;
use xca_record::Failure;
use xca_record::record::LockedFolder;
use xca_record::record::{Drawing, FRAMES, RunFolder, SavedError, SavedRun};

/// Draws the saved states of a run, or the state of a checkpoint.
pub(in crate::command) fn draw(
    definition: &Definition<'_>,
    path: &Path,
    arguments: &RenderArguments,
    command_line: &[String],
) -> Result<Ended, Unable> {
    if path.is_dir() {
        folder(definition, path, arguments, command_line)
    } else if path.exists() {
        checkpoint(definition, path, arguments)
    } else {
        Err(Unable::refused(format!(
            "{} does not exist; give the output directory of a run, or a checkpoint",
            path.display()
        )))
    }
}

fn folder(
    definition: &Definition<'_>,
    path: &Path,
    arguments: &RenderArguments,
    command_line: &[String],
) -> Result<Ended, Unable> {
    let KeptRun { kept, saved, report: of_run } = Kept::of_folder(path)?;
    let recorder = kept.recorder(definition)?;
    let drawing = arguments.drawing(&recorder)?;
    if let Some(view) = drawing.unreadable() {
        let (run, formats) = (path.display(), recorder.format_names().join(", "));
        return Err(Unable::refused(format!(
            "the formats of the run in {run} ({formats}) do not give `{view}` back; run it with --formats +vtk, or draw \
             a checkpoint"
        )));
    }
    let states = Frames {
        drawing: &drawing,
        steps: steps(&saved, &drawing, arguments.every)?,
        run: saved,
        interrupt: Interrupt::install().map_err(Unable::failed)?,
        voice: arguments.voice,
    };
    // What cannot be drawn is found before earlier pictures are removed.
    states.look_at_first().map_err(Unable::refused)?;
    let film =
        Film { drawing: &drawing, states: &states, animation: arguments.animation, fps: arguments.fps };
    let out = arguments.out.clone().unwrap_or_else(|| pictures_of(path));
    let folder = pictures_folder(&out, &film.files(), &recorder.set_up().inputs)?;
    let mut report = Report { of_run, folder: &folder };
    report.of_run["command_line"] = json!(command_line);
    report.of_run["drawn"] = json!(path.display().to_string());
    report.of_run["files"] = json!(film.files());
    report.write("running", 0)?;
    let made = film.make(&folder);
    let outcome = match &made {
        Ok(_) if states.interrupt.is_raised() => "interrupted",
        Ok(_) => "done",
        Err(_) => "failed",
    };
    report.write(outcome, made.as_ref().map_or(0, |made| made.pictures))?;
    let made = made.map_err(unable)?;
    arguments.voice.tell(&report.of_run, || {
        let interrupted = if states.interrupt.is_raised() { ", interrupted" } else { "" };
        let (of, places) = (path.display(), film.places(&folder));
        let pictures = counted(made.pictures as u64, "picture");
        format!("{pictures} of the states in {of}{interrupted}; {places}")
    })?;
    Ok(if outcome == "interrupted" { Ended::Interrupted } else { Ended::Done })
}

/// The steps of the states that are drawn; one at least.
fn steps(run: &SavedRun, drawing: &Drawing<'_>, every: Option<u64>) -> Result<Vec<u64>, Unable> {
    let saved = drawing.saved_steps(run);
    let folder = run.folder.join(FRAMES);
    let folder = folder.display();
    if saved.is_empty() {
        let checkpoint = CheckpointFolder::of_run(&run.folder).into_iter().next();
        let other = checkpoint.map(|path| format!("; there is a checkpoint to draw: {}", path.display()));
        return Err(Unable::refused(format!("no state is saved in {folder}{}", other.unwrap_or_default())));
    }
    let every = every.unwrap_or(1);
    let steps: Vec<u64> = saved.into_iter().filter(|step| step.is_multiple_of(every)).collect();
    let none = || Unable::refused(format!("no state in {folder} is of a step that {every} divides"));
    if steps.is_empty() { Err(none()) } else { Ok(steps) }
}

/// Where the pictures of a run go: beside its folder.
fn pictures_of(run: &Path) -> PathBuf {
    // `.` has no name of its own, and the folder of `checkpoints/…` is not even written.
    let written = if run.as_os_str().is_empty() { Path::new(".") } else { run };
    let whole = if written.file_name().is_some() {
        written.to_owned()
    } else {
        written.canonicalize().unwrap_or_default()
    };
    let mut name = whole.file_name().unwrap_or_default().to_owned();
    name.push("_pictures");
    whole.with_file_name(name)
}

/// Of a file that cannot be used, nothing could be drawn; all else has failed on the way.
fn unable(error: Failure) -> Unable {
    if error.is::<SavedError>() { Unable::Refused(error) } else { Unable::Failed(error) }
}

/// The report of the pictures of a run: that of the run, but for what is drawn now.
struct Report<'a> {
    of_run: Value,
    folder: &'a RunFolder,
}

impl Report<'_> {
    fn write(&mut self, outcome: &str, pictures: usize) -> Result<(), Unable> {
        self.of_run["progress"]["outcome"] = json!(outcome);
        self.of_run["progress"]["frames"] = json!(pictures);
        let text = serde_json::to_string_pretty(&self.of_run).map_err(Unable::failed)?;
        write_atomically(&self.folder.report(), |file| writeln!(file, "{text}")).map_err(Unable::failed)
    }
}

/// The saved states of a run.
struct Frames<'a> {
    drawing: &'a Drawing<'a>,
    steps: Vec<u64>,
    run: SavedRun,
    interrupt: Interrupt,
    voice: Voice,
}

impl Frames<'_> {
    fn look_at_first(&self) -> Result<(), SavedError> {
        self.steps.iter().take(1).try_for_each(|step| self.drawing.seen_in(&self.run, *step).map(drop))
    }
}

impl States for Frames<'_> {
    fn each(&self, doing: &str, look: &mut Look<'_>) -> Result<u64, Failure> {
        let last = self.steps.last().copied().unwrap_or(0);
        let line = self.voice.line(Some(last));
        line.message(doing);
        let mut reached = 0;
        for step in self.steps.iter().copied() {
            look(step, &self.drawing.seen_in(&self.run, step)?)?;
            line.at(step);
            reached = step;
            if self.interrupt.is_raised() {
                break;
            }
        }
        line.finish();
        Ok(reached)
    }
}

fn checkpoint(
    definition: &Definition<'_>,
    path: &Path,
    arguments: &RenderArguments,
) -> Result<Ended, Unable> {
    let Checkpoint { description, snapshot } = Checkpoint::read(path).map_err(Unable::refused)?;
    let recorder = Kept::of_checkpoint(path, &description).recorder(definition)?;
    let precision = description.run.precision;
    if !recorder.fits(precision, &snapshot) {
        return Err(Unable::refused(format!("the state in {} does not fit this model", path.display())));
    }
    let drawing = arguments.drawing(&recorder)?;
    let seen = drawing.seen_at(precision, &snapshot).map_err(Unable::failed)?;
    let mut scales = drawing.fixed_scales();
    drawing.widen(&mut scales, &seen);
    let out = arguments.out.clone().unwrap_or_else(|| {
        // A checkpoint that was moved elsewhere does not tell where its run is.
        let is_of = |run: &&Path| CheckpointFolder::of_run(run).iter().any(|kept| kept == path);
        let run = path.parent().and_then(Path::parent).filter(is_of);
        run.map_or_else(|| default_folder(definition), pictures_of)
    });
    let step = description.step;
    let file = OutputFolder::to_read(&out).numbered("step", step, "png");
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let _locked = LockedFolder::beside(&out, &name).map_err(Unable::refused)?;
    if let Some(picture) = drawing.picture(step, &seen, &scales).map_err(Unable::failed)? {
        picture.write(&file).map_err(Unable::failed)?;
    }
    let (drawn, files) = (path.display().to_string(), [file.display().to_string()]);
    arguments.voice.tell(&json!({ "drawn": drawn, "step": step, "files": files }), || {
        format!("the state after {} is drawn in {}", counted(step, "step"), file.display())
    })?;
    Ok(Ended::Done)
}
