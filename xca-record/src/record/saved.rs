//! What a view sees of the states that a run has saved: its frames.

use super::cells::{self, DrawnValues};
use super::saved_run::SavedRun;
use super::seen::Seen;
use super::shown::Shown;
use super::values::{Plane, stored_of};
use super::{FRAMES, Recorder};
use crate::failure::Failure;
use crate::format::{Formats, OutputFile, SavedState, SavedView, View, Writer};
use crate::view::{AnyCellView, AnyItemView, AnyView, Computation, Quantity, StoredBytes};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use xca_checkpoint::components::{DrawnPart, Part, state_names};
use xca_core::model::Group;
use xca_core::{Geometry, GroupSnapshot, Model, Precision, ScalarType, Snapshot, StoredType};
use xca_io::vtk::{NumberType, ReadArray};

/// A saved state that cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum SavedError {
    #[error(transparent)]
    Read(Failure),
    #[error("{} is missing in all formats that can be read back", path.display())]
    Missing { path: PathBuf },
    #[error(
        "{} does not hold the substate `{substate}`, but {saved}: \
         the view of `{view}` saves only these; a checkpoint holds everything",
        path.display()
    )]
    NotSaved { path: PathBuf, substate: &'static str, saved: String, view: String },
    #[error("{} does not fit the model: {what}", path.display())]
    OtherShape { path: PathBuf, what: String },
}

impl Recorder {
    /// Whether a state has all values that the model's views may look at.
    pub fn fits(&self, precision: Precision, snapshot: &Snapshot) -> bool {
        let cells = self.model().geometry().cells();
        let of_group = |(group, state): (&Group, &GroupSnapshot)| {
            let (count, fields) = match state {
                GroupSnapshot::Cells(fields) => (cells, fields),
                GroupSnapshot::Population(population, _) => {
                    let items = population.counts.iter().map(|count| *count as usize).sum::<usize>();
                    if population.counts.len() != cells || population.labels.len() != items {
                        return false;
                    }
                    (items, &population.fields)
                }
            };
            let stored = group.stored(precision);
            let lengths = fields.iter().map(Vec::len);
            lengths.eq(stored.iter().map(|stored| count * stored.size()))
        };
        let groups = self.model().groups();
        groups.len() == snapshot.groups.len() && groups.iter().zip(&snapshot.groups).all(of_group)
    }

    /// The formats that give states of a view back, and the files in which they do.
    fn readers(&self, view: View<'_>) -> Vec<Reader<'_>> {
        let subject = self.subject();
        let reader = |writer: &'_ dyn Writer| writer.state_files(subject, view);
        let all = self.formats.chosen().map(|writer| Reader { writer, files: reader(writer) });
        all.filter(|reader| !reader.files.is_empty()).collect()
    }

    /// Whether a format of the run gives states of a view back.
    pub(super) fn has_reader(&self, shown: &Shown) -> bool {
        self.subject().original(shown).is_some_and(|view| !self.readers(view).is_empty())
    }

    /// The names of the formats of the run.
    pub fn format_names(&self) -> Vec<&'static str> {
        self.formats.names()
    }

    /// The steps of the states of a view that a run has saved.
    pub(super) fn saved_steps(&self, shown: &Shown, run: &SavedRun) -> Vec<u64> {
        let Some(view) = self.subject().original(shown) else { return Vec::new() };
        let readers = self.readers(view);
        let steps: BTreeSet<u64> = readers.iter().flat_map(|reader| reader.steps(run)).collect();
        steps.into_iter().collect()
    }

    /// The formats of the model.
    pub fn into_formats(self) -> Formats {
        self.formats
    }

    /// What a view draws of a saved state.
    pub(super) fn seen_in(&self, shown: &Shown, run: &SavedRun, step: u64) -> Result<Seen, SavedError> {
        let subject = self.subject();
        let missing = || SavedError::Missing { path: run.folder.join(FRAMES).join(shown.view.stem()) };
        let view = subject.original(shown).ok_or_else(missing)?;
        let saved = SavedView { subject, view, run, step };
        for reader in self.readers(view) {
            let path = saved.path(&reader.files[0]);
            if reader.has(saved)
                && let Some(state) = reader.writer.read_state(saved)
            {
                return shown.seen_of(self.model(), &path, &state.map_err(SavedError::Read)?);
            }
        }
        Err(missing())
    }
}

/// A format that gives states of a view back.
struct Reader<'a> {
    writer: &'a dyn Writer,
    /// The files that hold a state together; one at least.
    files: Vec<OutputFile>,
}

impl Reader<'_> {
    /// The steps of the states of which all files are there.
    fn steps(&self, run: &SavedRun) -> Vec<u64> {
        let mut of_files = self.files.iter().map(|file| file.steps(run));
        let mut steps = of_files.next().unwrap_or_default();
        for others in of_files {
            steps.retain(|step| others.contains(step));
        }
        steps
    }

    /// Whether all files of a state are there.
    fn has(&self, saved: SavedView<'_>) -> bool {
        let is_there =
            |file: &OutputFile| file.can_be_of(saved.run, saved.step) && saved.path(file).is_file();
        self.files.iter().all(is_there)
    }
}

impl Shown {
    /// What it draws of a state that was read from a file.
    fn seen_of(&self, model: &Model, path: &Path, state: &SavedState) -> Result<Seen, SavedError> {
        let (group, geometry) = (&model.groups()[self.group], model.geometry());
        match &self.view {
            AnyView::Items(view) => items(view, group, self.ground().corner, (path, state)),
            AnyView::Cells(view) => of_cells(view, group, geometry, self.ground().missing, (path, state)),
        }
    }
}

fn of_cells(
    view: &AnyCellView,
    group: &Group,
    geometry: &Geometry,
    missing: Option<&[bool]>,
    (path, state): (&Path, &SavedState),
) -> Result<Seen, SavedError> {
    if state.cells != Some(geometry.extents()) {
        let found = state.cells.map_or("no cells".to_owned(), |cells| format!("{cells:?} cells"));
        let what = format!("it has {found}, not {:?}", geometry.extents());
        return Err(SavedError::OtherShape { path: path.to_owned(), what });
    }
    let arrays = Arrays { path, view: &view.name, group, arrays: &state.arrays };
    let plane = |field: usize| -> Result<Plane, SavedError> {
        let array = arrays.of_field(field)?;
        Ok(cells::drawn(view, geometry, stored_of(array), &array.bytes))
    };
    let heights = view.relief.map(|(field, _)| plane(field)).transpose()?;
    let drawn = match view.quantity() {
        Quantity::Part(Part { field, component }) => {
            let part = DrawnPart::of(group.schema().fields[field].value_type, component);
            DrawnValues::of_part(&plane(field)?, part)
        }
        Quantity::Computed(computation) => {
            let count = geometry.extents().iter().product();
            let all = arrays.all(None, count)?;
            DrawnValues::of_numbers(all.computed(&computation, cells::drawn_cells(view, geometry)))
        }
    };
    let hidden = missing.map(|missing| cells::drawn_mask(view, geometry, missing));
    Ok(cells::seen(drawn, heights, hidden))
}

fn items(
    view: &AnyItemView,
    group: &Group,
    [x, y]: [f64; 2],
    (path, state): (&Path, &SavedState),
) -> Result<Seen, SavedError> {
    let positions = state.positions.as_ref().ok_or_else(|| SavedError::OtherShape {
        path: path.to_owned(),
        what: "it has no items".to_owned(),
    })?;
    let arrays = Arrays { path, view: &view.name, group, arrays: &state.arrays };
    let schema = group.schema();
    // In the model, the corner of the map is at 0, 0.
    let positions = Plane::of_array(positions).shifted([-x, -y]);
    let values = match view.colour(schema).map(|drawn| drawn.quantity) {
        None => Vec::new(),
        Some(Quantity::Computed(computation)) => {
            let count = positions.count();
            arrays.all(Some(&positions), count)?.computed(&computation, 0..count)
        }
        Some(Quantity::Part(Part { field, component })) => {
            let drawn = DrawnPart::of(schema.fields[field].value_type, component);
            if schema.position == Some(field) && !arrays.has(field) {
                positions.drawn(drawn)
            } else {
                Plane::of_array(arrays.of_field(field)?).drawn(drawn)
            }
        }
    };
    Ok(Seen::Items { positions: positions.to_points(), values })
}

/// The arrays of a frame.
struct Arrays<'a> {
    path: &'a Path,
    view: &'a str,
    group: &'a Group,
    arrays: &'a [ReadArray],
}

impl<'a> Arrays<'a> {
    /// Whether the file has a substate, as it has the positions of items apart.
    fn has(&self, field: usize) -> bool {
        let name = self.group.schema().fields[field].name;
        self.arrays.iter().any(|array| array.name == name)
    }

    /// The array of a substate.
    fn of_field(&self, field: usize) -> Result<&'a ReadArray, SavedError> {
        let definition = &self.group.schema().fields[field];
        let array = self.arrays.iter().find(|array| array.name == definition.name).ok_or_else(|| {
            let saved: Vec<&str> = self.arrays.iter().map(|array| array.name.as_str()).collect();
            SavedError::NotSaved {
                path: self.path.to_owned(),
                substate: definition.name,
                saved: saved.join(", "),
                view: self.view.to_owned(),
            }
        })?;
        let components = definition.value_type.components();
        if array.components != components {
            let what = format!("`{}` has {} components, not {components}", array.name, array.components);
            return Err(SavedError::OtherShape { path: self.path.to_owned(), what });
        }
        let (states, found) = (state_names(definition.value_type.scalar), &array.states);
        if *found != states {
            let what = format!("`{}` has the states {}, not {}", array.name, listed(found), listed(&states));
            return Err(SavedError::OtherShape { path: self.path.to_owned(), what });
        }
        Ok(array)
    }

    /// All substates of so many cells or items, as a simulation stores them. The file has the positions of
    /// items apart.
    fn all(&self, positions: Option<&Plane>, count: usize) -> Result<AllStored, SavedError> {
        let schema = self.group.schema();
        // The types of `Real` tell the precision of the run.
        let mut precision = Precision::F64;
        let mut found = Vec::new();
        for (field, definition) in schema.fields.iter().enumerate() {
            if positions.is_some() && schema.position == Some(field) && !self.has(field) {
                found.push(None);
                continue;
            }
            let array = self.of_field(field)?;
            if definition.value_type.scalar == ScalarType::Real && array.numbers == NumberType::F32 {
                precision = Precision::F32;
            }
            found.push(Some(array));
        }
        let stored = self.group.stored(precision);
        let mut bytes = Vec::new();
        for ((definition, stored), array) in schema.fields.iter().zip(&stored).zip(found) {
            let of_field = match (array, positions) {
                (Some(array), _) => array.bytes.clone(),
                (None, Some(positions)) => positions.stored_as(*stored),
                (None, None) => Vec::new(),
            };
            let is_other = array.is_some_and(|array| stored_of(array).scalar != stored.scalar);
            if is_other || of_field.len() != count * stored.size() {
                let what = format!("`{}` is not stored as it is in the model", definition.name);
                return Err(SavedError::OtherShape { path: self.path.to_owned(), what });
            }
            bytes.push(of_field);
        }
        Ok(AllStored { precision, stored, bytes })
    }
}

/// All substates of a file, as a simulation stores them.
struct AllStored {
    precision: Precision,
    stored: Vec<StoredType>,
    bytes: Vec<Vec<u8>>,
}

impl AllStored {
    fn computed(&self, computation: &Computation, which: impl Iterator<Item = usize>) -> Vec<f64> {
        let fields = self.stored.iter().zip(&self.bytes);
        let fields: Vec<StoredBytes<'_>> =
            fields.map(|(stored, bytes)| StoredBytes { stored: *stored, bytes }).collect();
        computation.values(self.precision, &fields, which)
    }
}

fn listed(states: &[String]) -> String {
    if states.is_empty() { "of numbers".to_owned() } else { states.join(", ") }
}
