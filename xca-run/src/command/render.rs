//! The subcommand `render`.

mod arguments;
mod film;
mod kept;
mod running;
mod saved;

pub(super) use arguments::RenderArguments;
pub(super) use kept::formats_of;
pub(super) use saved::draw;

use super::choice::RunInvocation;
use super::definition::Definition;
use super::engine::with_engine;
use super::help::{with_help, with_model};
use super::outcome::{Ended, Unable};
use super::prepare::{Prepared, warn};
use crate::interrupt::Interrupt;
use arguments::SAVED;
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command};
use film::Film;
use running::Running;
use std::path::{Path, PathBuf};
use std::time::Instant;
use xca_io::numbers::counted;
use xca_record::record::RunFolder;
use xca_record::record::{Claim, Kind};
use xca_record::{InputFile, Outputs};

pub(super) const NAME: &str = "render";

const ABOUT: &str = "Draw pictures of a run, and an animation";

const STATES: &str = "\
DIR draws the saved frames of a run, CHECKPOINT draws the state of a checkpoint.
Nothing runs. Frames hold the substates that the model's views save; a checkpoint
holds everything.

Without DIR or CHECKPOINT, render runs the model twice. The first run finds the ends
of the colour scale, which all pictures share. With --range it runs once.

Repeat --substate, --view, --axis, --layer or --range for panels side by side, each
with its own scale. A value given once holds for all panels.";

/// How many pictures there are, unless the command line says how often.
const PICTURES: u64 = 60;

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let command = with_engine(with_model(Command::new(NAME), definition), definition.engines);
    // Which a run that is drawn has been given already.
    let command = command.mut_args(|option| {
        if option.is_required_set() { option.required(false).required_unless_present(SAVED) } else { option }
    });
    let command = command.next_help_heading("Options of the pictures");
    let command = RenderArguments::augment_args(command).next_help_heading(None::<&str>);
    let examples = [
        format!("{name} render"),
        format!("{name} render out/{name}"),
        format!("{name} render out/{name}/checkpoints/step_00000500.checkpoint"),
        format!("{name} render --steps 200 --every 2 --fps 20 --pixels 640x560 --animation gif"),
        format!("{name} render --view slice,isometric --out out/block   (a model in three dimensions)"),
    ];
    with_help(command, ABOUT, &examples).long_about(format!("{ABOUT}\n\n{STATES}"))
}

/// Refuses options that nothing would heed, where a run is drawn that has been done.
pub(super) fn check_saved(command: &Command, matches: &ArgMatches, saved: &Path) -> Result<(), Unable> {
    let own = RenderArguments::augment_args(Command::new(NAME));
    let all = command.find_subcommand(NAME).into_iter().flat_map(Command::get_arguments);
    let given =
        all.filter(|option| matches.value_source(option.get_id().as_str()) == Some(ValueSource::CommandLine));
    for option in given {
        let id = option.get_id();
        let is_own = own.get_arguments().any(|option| option.get_id() == id);
        let reason = match id.as_str() {
            "every" | "animation" | "fps" if saved.is_file() => {
                "for several pictures; a checkpoint gives one"
            }
            "config" => continue,
            id if is_own && id != "steps" => continue,
            _ => "for a new run; this one is drawn from its files, with its own options",
        };
        let name = option.get_long().unwrap_or(id.as_str());
        return Err(Unable::refused(format!("--{name} is {reason}")));
    }
    Ok(())
}

fn default_folder(definition: &Definition<'_>) -> PathBuf {
    PathBuf::from("out").join(format!("{}_pictures", definition.name))
}

/// How far apart the states are that are drawn.
fn distance(outputs: Outputs) -> String {
    match outputs {
        Outputs::Every(steps) => format!(", one every {steps}"),
        Outputs::Growing => ", ever further apart".to_owned(),
    }
}

/// Makes the folder for these files.
fn pictures_folder(path: &Path, files: &[String], inputs: &[InputFile]) -> Result<RunFolder, Unable> {
    RunFolder::prepare(path, &Claim { kind: Kind::Pictures, files, inputs, program: None, overwrite: false })
        .map_err(Unable::refused)
}

/// Runs a model, and draws it.
pub(super) fn render(invocation: &RunInvocation<'_>, arguments: &RenderArguments) -> Result<Ended, Unable> {
    let begin = Instant::now();
    let Prepared { engine, run } = Prepared::new(invocation, &invocation.engine)?;
    let origin = run.origin().on(&*engine);
    let (mut report, options) = (run.report(&*engine, &origin), run.run_options());
    let recorder = run.into_recorder();
    let steps = origin.steps_wanted;
    report.every = match (arguments.every, recorder.set_up().outputs) {
        (Some(every), _) => Outputs::Every(every),
        (None, Some(Outputs::Growing)) => Outputs::Growing,
        (None, _) => Outputs::Every(steps.div_ceil(PICTURES).max(1)),
    };
    let drawing = arguments.drawing(&recorder)?;
    let interrupt = Interrupt::install().map_err(Unable::failed)?;
    let (drawing, interrupt, every) = (&drawing, &interrupt, report.every);
    let states = Running {
        engine: &*engine,
        options,
        drawing,
        steps,
        every,
        is_known: !recorder.set_up().is_until_stopped,
        interrupt,
        voice: arguments.voice,
    };
    let film = Film { drawing, states: &states, animation: arguments.animation, fps: arguments.fps };
    report.files = film.files();
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(invocation.model.definition));
    let folder = pictures_folder(&path, &report.files, &recorder.set_up().inputs)?;
    warn(recorder.set_up());
    report.write(&folder.report()).map_err(Unable::failed)?;
    let result = film.make(&folder);
    report.progress.wall_seconds = begin.elapsed().as_secs_f64();
    match &result {
        Ok(made) => {
            report.progress.outcome = if interrupt.is_raised() { "interrupted" } else { "done" };
            (report.progress.steps, report.progress.frames) = (made.steps, made.pictures);
            report.progress.time = recorder.time(made.steps);
        }
        Err(error) => {
            report.progress.outcome = "failed";
            report.progress.reason = Some(error.to_string());
        }
    }
    report.write(&folder.report()).map_err(Unable::failed)?;
    let made = result.map_err(Unable::Failed)?;
    arguments.voice.tell(&report, || {
        let end = if interrupt.is_raised() { ", interrupted" } else { "" };
        let places = film.places(&folder);
        let (pictures, steps) = (counted(made.pictures as u64, "picture"), counted(made.steps, "step"));
        format!("{pictures} of {steps}{}{end}; {places}", distance(every))
    })?;
    Ok(if interrupt.is_raised() { Ended::Interrupted } else { Ended::Done })
}

#[cfg(test)]
mod tests;
