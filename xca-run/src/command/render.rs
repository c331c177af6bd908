//! The subcommand `render`.

use super::arguments::{EngineArguments, RunArguments, interval, steps};
use super::look::LookArguments;
use super::parse::{RunInvocation, with_help, with_model};
use super::prepare::Prepared;
use super::under_way::Batch;
use super::{Definition, Ended, Unable};
use crate::interrupt::Interrupt;
use crate::output::animation::write_animation;
use crate::output::atomic::OutputFolder;
use crate::program::Failure;
use crate::progress::Progress;
use crate::record::{Drawing, Look, RunFolder, ViewKind};
use crate::report::Report;
use crate::terminal;
use clap::{Args, Command};
use std::path::PathBuf;
use std::time::Instant;
use xca_core::{Engine, RunOptions, Simulation, Snapshot};

pub(super) const NAME: &str = "render";

const ABOUT: &str = "Run the model, and draw it: a picture every so many steps, and an animation of them";

const SCALE: &str = "\
All pictures have one scale of colours. To find it, the model is run twice, which
gives the same numbers both times; with --range it is run once.";

/// How many pictures there are, unless the command line says how often.
const PICTURES: u64 = 60;

const ANIMATION: &str = "animation.png";

/// What is drawn.
#[derive(Args, Debug, Clone)]
pub(super) struct RenderArguments {
    /// How many steps are done; the model says how many unless it is given
    #[arg(long, value_name = "N", value_parser = steps)]
    steps: Option<u64>,

    /// Draw a picture every so many steps; 60 times unless it is given
    #[arg(long, value_name = "N", value_parser = interval)]
    every: Option<u64>,

    #[command(flatten)]
    look: LookArguments,

    /// How it is drawn; cells as a slice and items as spheres unless it is given
    #[arg(long, value_enum, value_name = "VIEW")]
    view: Option<ViewKind>,

    /// The size of the pictures in pixels
    #[arg(long, value_name = "WxH", value_parser = pixels)]
    pixels: Option<[usize; 2]>,

    /// How many pictures the animation shows a second
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u16).range(1..=100))]
    fps: u16,

    /// The folder of the pictures; out/NAME_pictures unless it is given. Pictures that are there are replaced
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Say nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

impl RenderArguments {
    fn look(&self) -> Look {
        Look { view: self.view, size: self.pixels, ..self.look.look() }
    }

    /// What a run would be told.
    pub(super) fn as_of_run(&self) -> RunArguments {
        RunArguments {
            steps: self.steps,
            out: self.out.clone(),
            every: self.every,
            checkpoint_every: None,
            print_wgsl: false,
            quiet: self.quiet,
        }
    }
}

fn pixels(text: &str) -> Result<[usize; 2], &'static str> {
    const WANTED: &str = "it must be width and height in pixels, from 320x280 to 4096x4096, such as 640x480";
    let (width, height) = text.split_once('x').ok_or(WANTED)?;
    match [width, height].map(str::parse) {
        [Ok(width @ 320..=4096), Ok(height @ 280..=4096)] => Ok([width, height]),
        _ => Err(WANTED),
    }
}

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let command = EngineArguments::augment_args(with_model(Command::new(NAME), definition));
    let command = RenderArguments::augment_args(command).next_help_heading(None::<&str>);
    let examples = [
        format!("{name} render"),
        format!("{name} render --steps 200 --every 2 --fps 20 --pixels 640x560"),
        format!("{name} render --view isometric --out out/block   (cells in three dimensions)"),
    ];
    with_help(command, ABOUT, &examples).long_about(format!("{ABOUT}\n\n{SCALE}"))
}

/// Draws a run.
pub(super) fn render(invocation: &RunInvocation<'_>, arguments: &RenderArguments) -> Result<Ended, Unable> {
    let begin = Instant::now();
    let Prepared { engine, recorder, options, origin, mut report } =
        Prepared::new(invocation, &invocation.engine)?;
    let wanted = origin.steps_wanted;
    report.every = arguments.every.unwrap_or(wanted.div_ceil(PICTURES).max(1));
    report.files = vec![ANIMATION.to_owned(), "frames/frame_*.png".to_owned()];
    let drawing = recorder.drawing(arguments.look()).map_err(Unable::refused)?;
    let default = || PathBuf::from("out").join(format!("{}_pictures", invocation.model.definition.name));
    let path = arguments.out.clone().unwrap_or_else(default);
    let folder = RunFolder::prepare(&path, &report.files, &recorder.set_up().inputs);
    let folder = folder.map_err(Unable::refused)?;
    report.write(&folder.report()).map_err(Unable::failed)?;
    let film = Film {
        engine: &*engine,
        options,
        drawing: &drawing,
        steps: [wanted, report.every],
        interrupt: Interrupt::install().map_err(Unable::failed)?,
        quiet: arguments.quiet,
    };
    let result = film.make(&folder.frames, &folder.top.file(ANIMATION), arguments.fps);
    report.progress.wall_seconds = begin.elapsed().as_secs_f64();
    match &result {
        Ok(made) => {
            report.progress.outcome = if made.interrupted { "interrupted" } else { "done" };
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
    if !arguments.quiet {
        terminal::say(&made.summary(&report, &folder));
    }
    Ok(if made.interrupted { Ended::Interrupted } else { Ended::Done })
}

/// How pictures are made.
struct Film<'a> {
    engine: &'a dyn Engine,
    options: RunOptions,
    drawing: &'a Drawing<'a>,
    /// How many there are, and how many there are from picture to picture.
    steps: [u64; 2],
    interrupt: Interrupt,
    quiet: bool,
}

/// What was made.
struct Made {
    pictures: usize,
    steps: u64,
    interrupted: bool,
}

impl Made {
    fn summary(&self, report: &Report, folder: &RunFolder) -> String {
        let (pictures, end) = (self.pictures, if self.interrupted { ", interrupted" } else { "" });
        let folder = folder.top.path().display();
        format!(
            "{pictures} pictures of {} steps, one every {}{end}; they are in {folder}/frames, and in motion in {folder}/{ANIMATION}",
            self.steps, report.every
        )
    }
}

impl Film<'_> {
    /// Finds the scale, draws the pictures, and makes an animation of them.
    fn make(&self, frames: &OutputFolder, animation: &std::path::Path, fps: u16) -> Result<Made, Failure> {
        let mut range = self.drawing.fixed_range();
        if range.is_none() {
            self.each("measuring", |simulation, snapshot| {
                range = self.drawing.widened(range, simulation, snapshot);
                Ok(())
            })?;
        }
        let mut pictures = Vec::new();
        let steps = self.each("drawing", |simulation, snapshot| {
            if let Some(picture) = self.drawing.picture(simulation, snapshot, range)? {
                let path = frames.numbered("frame", snapshot.step, "png");
                picture.write(&path)?;
                pictures.push(path);
            }
            Ok(())
        })?;
        write_animation(animation, &pictures, fps)?;
        Ok(Made { pictures: pictures.len(), steps, interrupted: self.interrupt.is_raised() })
    }

    /// Runs the model once, and looks at each state that is to be drawn. Gives the number of steps done.
    fn each(
        &self,
        doing: &str,
        mut look: impl FnMut(&Simulation, &Snapshot) -> Result<(), Failure>,
    ) -> Result<u64, Failure> {
        let [wanted, every] = self.steps;
        let mut simulation = Simulation::new(self.drawing.model(), self.engine, self.options)?;
        let line = if self.quiet { Progress::hidden() } else { Progress::new(Some(wanted)) };
        line.message(doing);
        let mut batch = Batch::default();
        loop {
            let done = simulation.step_number();
            line.at(done);
            if done.is_multiple_of(every) {
                look(&simulation, &simulation.snapshot()?)?;
            }
            if done >= wanted || simulation.stop_reason().is_some() || self.interrupt.is_raised() {
                line.finish();
                return Ok(done);
            }
            let next = (done / every + 1).saturating_mul(every).min(wanted);
            let begin = Instant::now();
            simulation.run(batch.steps.min(next - done))?;
            batch.adapt(begin.elapsed());
        }
    }
}
