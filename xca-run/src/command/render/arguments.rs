//! The options of `render`.

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

/// The saved run: a name that no field of a model has.
pub(super) const SAVED: &str = "DIR|CHECKPOINT";

/// How a state is drawn.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum ViewArgument {
    /// One layer of cells
    Slice,
    /// All cells as cubes: the non-zero ones of integers; otherwise all, with an octant cut out
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

/// The format of the animation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Animation {
    /// Animated PNG, with all colours
    Apng,
    /// Animated GIF, with at most 256 colours; more programs show it
    Gif,
    /// No animation
    None,
}

/// Options of `render`.
#[derive(Args, Debug, Clone)]
pub(in crate::command) struct RenderArguments {
    /// Draw this output directory of a run, or this checkpoint [default: run the model]
    #[arg(id = SAVED, value_name = "DIR|CHECKPOINT", help_heading = Resettable::Reset)]
    of: Option<PathBuf>,

    /// Number of steps [default: the model's]
    #[arg(long, value_name = "N", value_parser = steps)]
    steps: Option<u64>,

    /// Draw a picture every N steps [default: 60 pictures, or all saved states of DIR]
    #[arg(long, value_name = "N", value_parser = interval)]
    pub(super) every: Option<u64>,

    /// Substate to draw, or one component: outflow, outflow.3, velocity.x. A whole vector is drawn as its
    /// length, a whole array as its sum
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    substate: Vec<String>,

    /// Kind of view [default: slice for cells, spheres for items]
    #[arg(long, value_enum, value_name = "VIEW", value_delimiter = ',')]
    view: Vec<ViewArgument>,

    /// Slice views: the axis normal to the slice
    #[arg(long, value_name = "x|y|z", value_parser = axis, value_delimiter = ',')]
    axis: Vec<usize>,

    /// Slice views: the layer, from 0 [default: the middle one]
    #[arg(long, value_name = "N", value_delimiter = ',')]
    layer: Vec<usize>,

    /// Ends of the colour scale [default: smallest and largest value of all pictures]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range)]
    range: Vec<[f64; 2]>,

    /// Size of the pictures in pixels
    #[arg(long, value_name = "WxH", value_parser = pixels)]
    pixels: Option<[usize; 2]>,

    /// Animation, in addition to the PNG files
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = Animation::Apng)]
    pub(super) animation: Animation,

    /// Pictures per second of the animation; at most 50 for a GIF
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u16).range(1..=100))]
    pub(super) fps: u16,

    /// Output directory [default: out/NAME_pictures, or DIR_pictures]. Overwrites earlier pictures
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
            overwrite: false,
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
