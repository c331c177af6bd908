//! The subcommand `render`.

mod film;
mod kept;
mod running;
mod saved;

pub(super) use saved::draw;

use super::arguments::{EngineArguments, RunArguments, interval, steps};
use super::parse::{RunInvocation, with_help, with_model};
use super::prepare::Prepared;
use super::{Definition, Ended, Unable};
use crate::interrupt::Interrupt;
use crate::output::animation::{write_apng, write_gif};
use crate::output::atomic::WriteError;
use crate::record::{Drawing, Look, Recorder, RunFolder, ViewKind};
use crate::report::Earlier;
use crate::terminal;
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command, ValueEnum};
use film::Film;
use running::Running;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(super) const NAME: &str = "render";

/// What has been run already: a name that no field of a model has.
const SAVED: &str = "DIR|CHECKPOINT";

const ABOUT: &str = "Draw a run: pictures of its states, and an animation of them";

const STATES: &str = "\
With the folder of a run, the states that it has saved (its frames) are drawn, and
with a checkpoint, the state in it; nothing is run. The model is that of the run.
Frames are exact, but hold what the model's views save of it, and no more; a
checkpoint holds everything.

Without, the model is run for its pictures. All pictures have one scale of colours;
to find it, the model is run twice, which gives the same numbers both times. With
--range it is run once.

--substate, --view, --axis, --layer and --range can be given several times, for as
many panels side by side; what is given once holds for all of them.";

/// How many pictures there are, unless the command line says how often.
const PICTURES: u64 = 60;

/// How pictures are put in motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Animation {
    /// An animated PNG: every colour as it is
    Apng,
    /// An animated GIF of at most 256 colours, which more programs show
    Gif,
    /// Not at all
    None,
}

/// What is drawn.
#[derive(Args, Debug, Clone)]
pub(super) struct RenderArguments {
    /// The folder of a run, or a checkpoint, that is drawn as it is; the model is run unless it is given
    #[arg(id = SAVED, value_name = "DIR|CHECKPOINT")]
    of: Option<PathBuf>,

    /// How many steps are done; the model says how many unless it is given
    #[arg(long, value_name = "N", value_parser = steps)]
    steps: Option<u64>,

    /// Draw a picture every so many steps; 60 times unless it is given, and of a folder all states
    #[arg(long, value_name = "N", value_parser = interval)]
    every: Option<u64>,

    /// The substate that gives the colours: a number, or the length of a vector
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    substate: Vec<String>,

    /// How it is drawn; cells as a slice and items as spheres unless it is given
    #[arg(long, value_enum, value_name = "VIEW", value_delimiter = ',')]
    view: Vec<ViewKind>,

    /// Of a slice: the axis that layers are counted along
    #[arg(long, value_name = "x|y|z", value_parser = axis, value_delimiter = ',')]
    axis: Vec<usize>,

    /// Of a slice: the layer, from 0; the middle one unless it is given
    #[arg(long, value_name = "N", value_delimiter = ',')]
    layer: Vec<usize>,

    /// The ends of the scale of colours; the least and the largest value of all pictures unless it is given
    #[arg(long, value_name = "LOW,HIGH", value_parser = range)]
    range: Vec<[f64; 2]>,

    /// The size of the pictures in pixels
    #[arg(long, value_name = "WxH", value_parser = pixels)]
    pixels: Option<[usize; 2]>,

    /// What is made of the pictures beside the PNG files
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = Animation::Apng)]
    animation: Animation,

    /// How many pictures the animation shows a second; of a GIF, 50 at most
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u16).range(1..=100))]
    fps: u16,

    /// The folder of the pictures; out/NAME_pictures unless it is given, and of a run DIR_pictures. Pictures that are there are replaced
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Say nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

impl RenderArguments {
    /// What is drawn without a run.
    pub(super) fn saved(&self) -> Option<PathBuf> {
        self.of.clone()
    }

    /// What is to be drawn of a model.
    fn drawing<'a>(&self, recorder: &'a Recorder) -> Result<Drawing<'a>, Unable> {
        if self.animation == Animation::Gif && self.fps > GIF_FPS {
            return Err(Unable::refused(format!(
                "a GIF shows {GIF_FPS} pictures a second at most; give --fps {GIF_FPS} or less"
            )));
        }
        recorder.drawing(&self.looks()?, self.pixels).map_err(Unable::refused)
    }

    /// What each panel shows.
    fn looks(&self) -> Result<Vec<Look>, Unable> {
        let Self { substate, view, axis, layer, range, .. } = self;
        let options = [
            ("--substate", substate.len()),
            ("--view", view.len()),
            ("--axis", axis.len()),
            ("--layer", layer.len()),
            ("--range", range.len()),
        ];
        let (most, panels) = options.into_iter().max_by_key(|(_, count)| *count).unwrap_or_default();
        for (option, count) in options.into_iter().filter(|(_, count)| *count > 1) {
            if count != panels {
                return Err(Unable::refused(format!(
                    "{most} is given {panels} times and {option} {count} times; give each once, or once for each panel"
                )));
            }
        }
        let look = |panel| Look {
            substate: of_panel(substate, panel),
            view: of_panel(view, panel),
            axis: of_panel(axis, panel),
            layer: of_panel(layer, panel),
            // Said once, it is for those panels that are slices.
            slices_only: panels > 1 && axis.len() < 2 && layer.len() < 2,
            range: of_panel(range, panel),
        };
        Ok((0..panels.max(1)).map(look).collect())
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

/// What a list of values says of a panel.
fn of_panel<T: Clone>(values: &[T], panel: usize) -> Option<T> {
    if let [value] = values { Some(value.clone()) } else { values.get(panel).cloned() }
}

/// Programs show a GIF that is faster much slower.
const GIF_FPS: u16 = 50;

impl Animation {
    /// The name of its file.
    fn file(self) -> Option<&'static str> {
        match self {
            Self::Apng => Some("animation.png"),
            Self::Gif => Some("animation.gif"),
            Self::None => None,
        }
    }

    /// Makes it of pictures in PNG files.
    fn write(self, path: &Path, pictures: &[PathBuf], fps: u16) -> Result<(), WriteError> {
        match self {
            Self::Apng => write_apng(path, pictures, fps),
            Self::Gif => write_gif(path, pictures, fps),
            Self::None => Ok(()),
        }
    }
}

pub(super) fn axis(text: &str) -> Result<usize, &'static str> {
    ["x", "y", "z"].iter().position(|name| *name == text).ok_or("it must be x, y or z")
}

pub(super) fn range(text: &str) -> Result<[f64; 2], &'static str> {
    const WANTED: &str = "it must be two numbers, the lower one first, such as 0,20";
    let (low, high) = text.split_once(',').ok_or(WANTED)?;
    let ends = [low, high].map(|end| end.trim().parse().unwrap_or(f64::NAN));
    // Not so for what is no number.
    if ends[0] < ends[1] && ends.iter().all(|end| end.is_finite()) { Ok(ends) } else { Err(WANTED) }
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
    // Which a run that is drawn has been given already.
    let command = command.mut_args(|option| {
        if option.is_required_set() { option.required(false).required_unless_present(SAVED) } else { option }
    });
    let command = RenderArguments::augment_args(command).next_help_heading(None::<&str>);
    let examples = [
        format!("{name} render"),
        format!("{name} render out/{name}"),
        format!("{name} render out/{name}/checkpoints/step_00000500.checkpoint"),
        format!("{name} render --steps 200 --every 2 --fps 20 --pixels 640x560 --animation gif"),
        format!("{name} render --view slice,isometric --out out/block   (cells in three dimensions)"),
    ];
    with_help(command, ABOUT, &examples).long_about(format!("{ABOUT}\n\n{STATES}"))
}

/// Refuses options that only a run could heed, where one is drawn that has been done.
pub(super) fn check_saved(command: &Command, matches: &ArgMatches) -> Result<(), Unable> {
    let own = RenderArguments::augment_args(Command::new(NAME));
    let is_heeded = |id: &str| {
        id == "config" || (id != "steps" && own.get_arguments().any(|option| option.get_id() == id))
    };
    let all = command.find_subcommand(NAME).into_iter().flat_map(Command::get_arguments);
    let given = |option: &&clap::Arg| {
        matches.value_source(option.get_id().as_str()) == Some(ValueSource::CommandLine)
    };
    match all.filter(given).find(|option| !is_heeded(option.get_id().as_str())) {
        None => Ok(()),
        Some(option) => Err(Unable::refused(format!(
            "--{} is for a run that is done now; one that is drawn from its files has its own options",
            option.get_long().unwrap_or(option.get_id().as_str())
        ))),
    }
}

fn default_folder(definition: &Definition<'_>) -> PathBuf {
    PathBuf::from("out").join(format!("{}_pictures", definition.name))
}

/// Makes the folder for these files. That of a run is not taken: its files would be gone.
fn pictures_folder(path: &Path, files: &[String], inputs: &[PathBuf]) -> Result<RunFolder, Unable> {
    if Earlier::read(path).is_of(super::run::NAME) {
        let path = path.display();
        return Err(Unable::refused(format!(
            "{path} is the folder of a run, whose files would be replaced; give another one with --out"
        )));
    }
    RunFolder::prepare(path, files, inputs).map_err(Unable::refused)
}

/// Runs a model, and draws it.
pub(super) fn render(invocation: &RunInvocation<'_>, arguments: &RenderArguments) -> Result<Ended, Unable> {
    let begin = Instant::now();
    let Prepared { engine, recorder, options, origin, mut report } =
        Prepared::new(invocation, &invocation.engine)?;
    let steps = origin.steps_wanted;
    report.every = arguments.every.unwrap_or(steps.div_ceil(PICTURES).max(1));
    let drawing = arguments.drawing(&recorder)?;
    let interrupt = Interrupt::install().map_err(Unable::failed)?;
    let (drawing, interrupt, every) = (&drawing, &interrupt, report.every);
    let states =
        Running { engine: &*engine, options, drawing, steps, every, interrupt, quiet: arguments.quiet };
    let film = Film { drawing, states: &states, animation: arguments.animation, fps: arguments.fps };
    report.files = film.files();
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(invocation.model.definition));
    let folder = pictures_folder(&path, &report.files, &recorder.set_up().inputs)?;
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
    if !arguments.quiet {
        let end = if interrupt.is_raised() { ", interrupted" } else { "" };
        terminal::say(&format!(
            "{} pictures of {} steps, one every {every}{end}; {}",
            made.pictures,
            made.steps,
            film.places(&folder)
        ));
    }
    Ok(if interrupt.is_raised() { Ended::Interrupted } else { Ended::Done })
}

#[cfg(test)]
mod tests;
