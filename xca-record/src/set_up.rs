//! A model with what its program shows of it.

use crate::failure::Failure;
use crate::format::{Formats, Subject, Writer, is_row};
use crate::place::{place_of, unplaced};
use crate::record::Shown;
use crate::view::{AnyView, CellView, ItemView, ViewError};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;
use xca_checkpoint::InputFile;
use xca_checkpoint::Outputs;
use xca_core::{Model, State, Substates};
use xca_io::map::{CoarsePlace, Map, MapUnit, Placement, PlacementDifference};
use xca_observe::Observable;

type Observe = dyn Fn(&State<'_>) -> Result<Vec<Observable>, Failure> + Send + Sync;

/// A model, its number of steps, and what its files and pictures show.
///
/// ```
/// # use xca_core::prelude::*;
/// # #[derive(Substates, Clone)]
/// # struct Colony { size: Real }
/// # #[elementary_process]
/// # fn grow(cell: &mut Cell<Colony>) { cell.size *= 1.01; }
/// # let builder = Model::builder("growth").extents([8, 8, 1]).substates::<Colony>();
/// # let model = builder.process(grow).fill(|_| Colony { size: 1.0 }).build()?;
/// use xca_record::{CellView, Observable, SetUp};
///
/// let set_up = SetUp::new(model, 1000)
///     .title("growth of a colony")
///     .every(100)
///     .time_step(60.0)
///     .observables(|state| Ok(vec![Observable::new("total size", "mm2", state.sum(Colony::SIZE)?)]))
///     .cells(CellView::named("colony").draw(Colony::SIZE, "size (mm2)"));
/// assert_eq!(set_up.title, "growth of a colony");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Defaults follow from the model's substates. Statistics of each are observed; for `bool` and states, their
/// counts. Every population and all substates of cells are saved, and the first of them is drawn.
#[non_exhaustive]
pub struct SetUp {
    /// The model.
    pub model: Model,
    /// The title in pictures and in the terminal.
    pub title: String,
    /// The number of steps.
    pub steps: u64,
    /// The steps after which files are written. Default: 20 times in the run.
    pub outputs: Option<Outputs>,
    /// Whether the model stops the run. `steps` is then the limit.
    pub is_until_stopped: bool,
    /// The length of a step in s. Default: time counts in steps.
    pub time_step: Option<f64>,
    pub(crate) observe: Option<Box<Observe>>,
    pub(crate) views: Vec<AnyView>,
    /// The input files.
    pub inputs: Vec<InputFile>,
    /// The place of the space on a map, and the cells without ground.
    pub map: Option<Map>,
    /// The formats of the files.
    pub formats: Formats,
    /// Entries of `run.json` in addition to options and parameters.
    pub notes: serde_json::Map<String, serde_json::Value>,
    /// Reasons to doubt the results, in sentences.
    pub warnings: Vec<String>,
    /// Warnings of the end of a run.
    pub final_warnings: Vec<FinalWarning>,
}

/// A warning after the last step, if an observable is not zero then.
#[derive(Debug, Clone, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct FinalWarning {
    pub observable: String,
    pub text: String,
}

impl SetUp {
    /// A model that runs for this number of steps, unless the command line gives another.
    pub fn new(model: Model, steps: u64) -> Self {
        let mut formats = Formats::default();
        if is_row(&model) {
            // It is known.
            let _ = formats.choose_too(&["spacetime"]);
        }
        Self {
            title: model.name().to_owned(),
            model,
            steps,
            outputs: None,
            is_until_stopped: false,
            time_step: None,
            observe: None,
            views: Vec::new(),
            inputs: Vec::new(),
            map: None,
            formats,
            notes: serde_json::Map::new(),
            warnings: Vec::new(),
            final_warnings: Vec::new(),
        }
    }

    /// A model that runs until it stops itself ([`xca_core::ModelBuilder::stop_when`]), or for at most this
    /// number of steps.
    ///
    /// The length of the run is unknown, so the intervals between outputs grow ([`Outputs::Growing`]).
    pub fn until_stopped(model: Model, most: u64) -> Self {
        Self { is_until_stopped: true, outputs: Some(Outputs::Growing), ..Self::new(model, most) }
    }

    /// Sets the title in pictures and in the terminal. Default: the model's name.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Writes a row of observables and a frame at this interval of steps, at least 1, unless the command line
    /// gives another.
    #[must_use]
    pub fn every(self, steps: u64) -> Self {
        Self { outputs: Some(Outputs::Every(steps.max(1))), ..self }
    }

    /// Sets the length of a step in s, a positive number. Default: time counts in steps.
    #[must_use]
    pub fn time_step(mut self, seconds: f64) -> Self {
        self.time_step = Some(seconds);
        self
    }

    /// Sets the quantities measured before the first step, at every output and after the last step.
    ///
    /// Return the same quantities in the same order each time. Compute them from the state alone; otherwise a
    /// resumed run would differ.
    #[must_use]
    pub fn observables(
        mut self,
        observe: impl Fn(&State<'_>) -> Result<Vec<Observable>, Failure> + Send + Sync + 'static,
    ) -> Self {
        self.observe = Some(Box::new(observe));
        self
    }

    /// Sets how the items of a population are saved and drawn.
    #[must_use]
    pub fn items<S: Substates>(mut self, view: ItemView<S>) -> Self {
        self.views.push(AnyView::Items(view.into_any()));
        self
    }

    /// Sets how substates of cells are saved and drawn.
    #[must_use]
    pub fn cells<S: Substates>(mut self, view: CellView<S>) -> Self {
        self.views.push(AnyView::Cells(view.into_any()));
        self
    }

    /// Where the space of a model of one layer lies on a map, and which of its cells have no ground: the
    /// place of a grid and its cells without a value (`&grid`), or a [`Map`].
    ///
    /// Frames lie at this place. Files, pictures and default observables leave out the cells without ground.
    /// The final state is written as ESRI ASCII grids too, one for each substate of cells
    /// (`final_altitude.asc`); any other model of one layer does so with `run --formats +asc`, and its corner
    /// is at 0, 0. `--formats +tif` writes GeoTIFF.
    ///
    /// A map that is not in metres adds a warning, because a model counts in metres.
    #[must_use]
    pub fn map(mut self, map: impl Into<Map>) -> Self {
        let map = map.into();
        if map.unit() != MapUnit::Metre {
            let (unit, side) = (map.unit(), map.placement().side);
            self.warnings.push(format!(
                "the map is in {unit}, but the model counts in metres and takes its cells as {side} m wide; \
                 warp it to a system in metres, such as UTM zone 33N: `gdalwarp -t_srs EPSG:32633`"
            ));
        }
        self.map = Some(map);
        // It is known, unless the program has taken it away.
        let _ = self.formats.choose_too(&["asc"]);
        self
    }

    /// Adds an output format, such as one of your own.
    #[must_use]
    pub fn format(mut self, writer: impl Writer + 'static) -> Self {
        self.formats.add(writer);
        self
    }

    /// Declares an input file. A run never overwrites it. A run does not resume once the file has changed.
    #[must_use]
    pub fn input(mut self, path: impl Into<PathBuf>) -> Self {
        self.inputs.push(InputFile::new(path));
        self
    }

    /// Warns of a reason to doubt the results, such as a large time step. The run goes on.
    ///
    /// A program prints it on stderr at the start, also with `--quiet`; `run.json` keeps it in `warnings`.
    /// Say what is wrong, with the number, and what to do.
    #[must_use]
    pub fn warning(mut self, text: impl Into<String>) -> Self {
        self.warnings.push(text.into());
        self
    }

    /// Warns after the last step if an observable is not zero then, such as the number of cells in which lava
    /// has reached the edge of the map.
    ///
    /// A program prints the text with the value on stderr; `run.json` keeps it in `warnings`.
    #[must_use]
    pub fn warning_unless_zero(mut self, observable: impl Into<String>, text: impl Into<String>) -> Self {
        self.final_warnings.push(FinalWarning { observable: observable.into(), text: text.into() });
        self
    }

    /// Adds an entry to `run.json`.
    ///
    /// # Errors
    /// Returns an error if the value has no form in JSON.
    pub fn note(mut self, name: &str, value: impl Serialize) -> Result<Self, Failure> {
        self.notes.insert(name.to_owned(), serde_json::to_value(value)?);
        Ok(self)
    }
}

/// An invalid set-up.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SetUpError {
    /// A view does not fit the model.
    #[error(transparent)]
    View(#[from] ViewError),
    /// A format cannot hold the model.
    #[error(transparent)]
    Format(Failure),
    /// Two outputs have this file. Capitals do not count.
    #[error("two outputs would be written to {0}; rename a view or a substate")]
    SameFile(String),
    /// The time step is not a positive number.
    #[error("the time step is {seconds} s; it must be a positive number")]
    TimeStep {
        /// The time step, in s.
        seconds: f64,
    },
    /// The map has other cells than the model.
    #[error("the map does not fit the model: {0}")]
    Map(PlacementDifference),
    /// The map is too far from the origin.
    #[error(transparent)]
    Place(#[from] CoarsePlace),
    /// The model has several layers, so it has no map.
    #[error("a map is for models of one layer, and `{model}` has {layers}")]
    Layers {
        /// The model.
        model: String,
        /// Its layers.
        layers: usize,
    },
}

impl SetUp {
    /// Checks what no method has checked yet.
    ///
    /// # Errors
    /// Where the time step is not a positive number, or the map does not fit the model.
    pub fn check(&self) -> Result<(), SetUpError> {
        if let Some(seconds) = self.time_step.filter(|seconds| !(seconds.is_finite() && *seconds > 0.0)) {
            return Err(SetUpError::TimeStep { seconds });
        }
        let Some(map) = &self.map else { return Ok(()) };
        let layers = self.model.geometry().extents()[2];
        if layers > 1 {
            return Err(SetUpError::Layers { model: self.model.name().to_owned(), layers });
        }
        let placement = map.placement().checked()?;
        let cells = Placement { corner: placement.corner, ..unplaced(&self.model) };
        placement.difference(&cells).map_or(Ok(()), |difference| Err(SetUpError::Map(difference)))
    }

    /// The place of the model's cells on the map.
    pub fn placement(&self) -> Placement {
        place_of(&self.model, self.map.as_ref())
    }

    /// What formats get of the set-up.
    pub(crate) fn subject<'a>(&'a self, shown: &'a [Shown]) -> Subject<'a> {
        let Self { model, title, time_step, .. } = self;
        Subject { model, title, map: self.map.as_ref(), time_step: *time_step, shown }
    }

    /// The cells without ground, if there are any.
    pub(crate) fn missing(&self) -> Option<&[bool]> {
        self.map.as_ref().and_then(Map::missing)
    }
}

impl fmt::Debug for SetUp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SetUp")
            .field("model", &self.model.name())
            .field("steps", &self.steps)
            .field("time_step", &self.time_step)
            .field("views", &self.views)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Recorder;
    use xca_core::prelude::*;

    #[derive(Substates, Clone)]
    struct Ground {
        altitude: Real,
    }

    #[derive(Substates, Clone)]
    struct Ab {
        altitude: Real,
        ground_altitude: Real,
    }

    /// `Ground.altitude` needs its struct in its name, which is then that of another substate.
    #[test]
    fn outputs_have_files_of_their_own() {
        let set_up = |second: &str| {
            let model = Model::builder("two").extents([4, 1, 1]).substates::<Ground>().substates::<Ab>();
            let model = model.fill(|_| Ground { altitude: 1.0 });
            let model = model.fill(|_| Ab { altitude: 1.0, ground_altitude: 2.0 }).build().unwrap();
            let views = SetUp::new(model, 1).cells(CellView::<Ground>::named("first"));
            views.cells(CellView::<Ab>::named(second))
        };
        let refused = |mut set_up: SetUp, format: &str| {
            set_up.formats.choose_too(&[format]).unwrap();
            Recorder::new(set_up).map(|_| ()).map_err(|error| error.to_string())
        };
        let said = "two outputs would be written to final_ground_altitude.tif; rename a view or a substate";
        assert_eq!(refused(set_up("second"), "tif"), Err(said.to_owned()));
        assert_eq!(refused(set_up("second"), "spacetime"), Ok(()));
        let said = refused(set_up("Spacetime"), "spacetime").unwrap_err();
        assert!(said.starts_with("two outputs would be written to final_spacetime.png"), "{said}");
    }

    fn set_up(extents: [usize; 3], placement: Placement) -> Result<(), String> {
        let model = Model::builder("ground").extents(extents).cell_side(10.0).substates::<Ground>();
        let model = model.fill(|_| Ground { altitude: 1.0 }).build().unwrap();
        SetUp::new(model, 1).map(Map::new(placement)).check().map_err(|error| error.to_string())
    }

    #[test]
    fn a_map_must_have_the_cells_of_the_model() {
        let place = Placement { extents: [4, 3], corner: [2600.0, 5100.0], side: 10.0 };
        assert_eq!(set_up([4, 3, 1], place), Ok(()));
        let said = set_up([3, 4, 1], place).unwrap_err();
        assert_eq!(said, "the map does not fit the model: it has 4 x 3 cells, not 3 x 4");
        let said = set_up([4, 3, 1], Placement { side: 20.0, ..place }).unwrap_err();
        assert_eq!(said, "the map does not fit the model: its cells have a side of 20, not 10");
        let said = set_up([4, 3, 1], Placement { corner: [0.0, -1e20], ..place }).unwrap_err();
        assert!(said.starts_with("a coordinate of 1e20 is too large for cells with a side of 10"), "{said}");
        let said = set_up([4, 3, 2], place).unwrap_err();
        assert_eq!(said, "a map is for models of one layer, and `ground` has 2");
    }
}
