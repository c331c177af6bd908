//! What `render` is told.

use crate::command::arguments::{RunArguments, interval, steps};
use crate::command::look::{axis, range};
use crate::command::outcome::Unable;
use crate::command::voice::Voice;
use clap::builder::Resettable;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use xca_io::atomic::WriteError;
use xca_picture::animation::{write_apng, write_gif};
use xca_record::record::{Drawing, Look, Recorder, ViewKind};

/// What has been run already: a name that no field of a model has.
pub(super) const SAVED: &str = "DIR|CHECKPOINT";

/// How a state is drawn.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum ViewArgument {
    /// One layer of cells
    Slice,
    /// All cells as cubes; those that are not 0 of a whole number, else with an octant cut out
    Isometric,
    /// The items of a population
    Spheres,
}

impl From<ViewArgument> for ViewKind {
    fn from(view: ViewArgument) -> Self {
        match view {
            ViewArgument::Slice => Self::Slice,
            ViewArgument::Isometric => Self::Isometric,
            ViewArgument::Spheres => Self::Spheres,
        }
    }
}

/// How pictures are put in motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Animation {
    /// An animated PNG: every colour as it is
    Apng,
    /// An animated GIF of at most 256 colours, which more programs show
    Gif,
    /// Not at all
    None,
}

/// What is drawn.
#[derive(Args, Debug, Clone)]
pub(in crate::command) struct RenderArguments {
    /// The folder of a run, or a checkpoint, that is drawn as it is; the model is run unless it is given
    #[arg(id = SAVED, value_name = "DIR|CHECKPOINT", help_heading = Resettable::Reset)]
    of: Option<PathBuf>,

    /// How many steps are done; the model says how many unless it is given
    #[arg(long, value_name = "N", value_parser = steps)]
    steps: Option<u64>,

    /// Draw a picture every so many steps; 60 times unless it is given, and of a folder all states
    #[arg(long, value_name = "N", value_parser = interval)]
    pub(super) every: Option<u64>,

    /// Substate to draw, or a component of it: outflow, outflow.3, velocity.x. Of a whole vector the length
    /// is drawn, of an array the sum of its elements
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    substate: Vec<String>,

    /// How it is drawn; cells as a slice and items as spheres unless it is given
    #[arg(long, value_enum, value_name = "VIEW", value_delimiter = ',')]
    view: Vec<ViewArgument>,

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
    pub(super) animation: Animation,

    /// How many pictures the animation shows a second; of a GIF, 50 at most
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u16).range(1..=100))]
    pub(super) fps: u16,

    /// The folder of the pictures; out/NAME_pictures unless it is given, and DIR_pictures of the folder of a
    /// run. Pictures that are there are replaced
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,

    #[command(flatten)]
    pub(super) voice: Voice,
}

impl RenderArguments {
    /// What is drawn without a run.
    pub(in crate::command) fn saved(&self) -> Option<PathBuf> {
        self.of.clone()
    }

    /// What is to be drawn of a model.
    pub(super) fn drawing<'a>(&self, recorder: &'a Recorder) -> Result<Drawing<'a>, Unable> {
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
            view: of_panel(view, panel).map(ViewKind::from),
            axis: of_panel(axis, panel),
            layer: of_panel(layer, panel),
            // Said once, it is for those panels that are slices.
            slices_only: panels > 1 && axis.len() < 2 && layer.len() < 2,
            range: of_panel(range, panel),
        };
        Ok((0..panels.max(1)).map(look).collect())
    }

    /// What a run would be told.
    pub(in crate::command) fn as_of_run(&self) -> RunArguments {
        RunArguments {
            steps: self.steps,
            out: self.out.clone(),
            every: self.every,
            checkpoint_every: None,
            formats: Vec::new(),
            allow_non_finite: true,
            print_source: false,
            voice: self.voice,
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
    pub(super) fn file(self) -> Option<&'static str> {
        match self {
            Self::Apng => Some("animation.png"),
            Self::Gif => Some("animation.gif"),
            Self::None => None,
        }
    }

    /// Makes it of pictures in PNG files.
    pub(super) fn write(self, path: &Path, pictures: &[PathBuf], fps: u16) -> Result<(), WriteError> {
        match self {
            Self::Apng => write_apng(path, pictures, fps),
            Self::Gif => write_gif(path, pictures, fps),
            Self::None => Ok(()),
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
