//! All states of the items as extended XYZ.

use super::{Moment, OutputFile, RecordedState, SavedState, SavedView, Subject, View, Writer};
use crate::failure::Failure;
use crate::record::{ItemBlock, ItemState, NoValue, Plane, SubstateValues, Unwritten, retyped};
use std::collections::BTreeSet;
use std::path::Path;
use xca_core::{Precision, ScalarType, StoredScalar};
use xca_io::extended_xyz::{self, Column, ReadColumn, ReadValues, Space, Values};
use xca_io::particle_csv::LABEL;
use xca_io::vtk::{NumberType, ReadArray};

/// `frames/NAME_00000050.xyz` for each view of items.
#[derive(Debug)]
pub(super) struct ExtendedXyz;

/// A model without items.
#[derive(Debug, thiserror::Error)]
#[error("the format xyz is for models with items, and `{model}` has none")]
struct NoItems {
    model: String,
}

fn file(view: View<'_>) -> OutputFile {
    OutputFile::of_view(Moment::Each, view, "xyz")
}

impl Writer for ExtendedXyz {
    fn name(&self) -> &'static str {
        "xyz"
    }

    fn about(&self) -> &'static str {
        "all states of items for OVITO and ASE: frames (.xyz)"
    }

    fn check(&self, subject: Subject<'_>) -> Result<(), Failure> {
        let has_items = subject.views().any(|view| view.shows_items());
        let error = || NoItems { model: subject.model().name().to_owned() };
        if has_items { Ok(()) } else { Err(error().into()) }
    }

    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
        subject.views().filter(View::shows_items).map(file).collect()
    }

    fn record(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        for view in state.subject().views() {
            if let Some(items) = state.items(view) {
                write(state, view, &items)?;
            }
        }
        Ok(())
    }

    fn read(&self, path: &Path) -> Option<Result<SavedState, Failure>> {
        (path.extension()? == "xyz").then(|| read(path))
    }

    fn read_state(&self, saved: SavedView<'_>) -> Option<Result<SavedState, Failure>> {
        Some(read_typed(saved))
    }
}

/// A file that is not one of a run.
#[derive(Debug, thiserror::Error)]
enum OtherFile {
    #[error("{path} has {frames} frames, not 1")]
    Frames { path: String, frames: usize },
    #[error("{path}: `{column}` has more than {} names of states", NAMES)]
    Names { path: String, column: String },
    #[error("{path}: {number} of particle {particle} is no value of `{substate}`")]
    Value { path: String, substate: &'static str, number: f64, particle: usize },
}

/// No substate has more states.
const NAMES: usize = 256;

/// What a file holds. The format has one type of whole numbers, and floating ones as decimals.
fn read(path: &Path) -> Result<SavedState, Failure> {
    let file = || path.display().to_string();
    let mut frames = extended_xyz::read(path)?;
    let (Some(frame), true) = (frames.pop(), frames.is_empty()) else {
        return Err(OtherFile::Frames { path: file(), frames: frames.len() + 1 }.into());
    };
    let mut arrays = Vec::new();
    for column in frame.columns {
        let name = column.name.clone();
        let array = array(column).ok_or_else(|| OtherFile::Names { path: file(), column: name })?;
        arrays.push(array);
    }
    let positions = frame.positions.as_flattened().iter().flat_map(|number| number.to_ne_bytes()).collect();
    let positions = ReadArray {
        name: "position".to_owned(),
        numbers: NumberType::F64,
        components: 3,
        component_names: Vec::new(),
        states: Vec::new(),
        bytes: positions,
    };
    Ok(SavedState::of_items(frame.time.unwrap_or_default(), positions, arrays))
}

/// A column as an array; none of one with more names than states can have.
fn array(column: ReadColumn) -> Option<ReadArray> {
    let own = column.name.strip_suffix('_').filter(|name| RESERVED.contains(name));
    let name = if column.name == IDENTIFIER { LABEL } else { own.unwrap_or(&column.name) };
    let mut states = Vec::new();
    let (numbers, bytes) = match column.values {
        ReadValues::Real(values) => {
            (NumberType::F64, values.iter().flat_map(|value| value.to_ne_bytes()).collect())
        }
        ReadValues::Whole(values) => of_whole(&values),
        ReadValues::Bool(values) => {
            states = ["false", "true"].map(str::to_owned).to_vec();
            (NumberType::U8, values.into_iter().map(u8::from).collect())
        }
        ReadValues::Text(values) => {
            let names: BTreeSet<&String> = values.iter().collect();
            states = names.into_iter().take(NAMES + 1).cloned().collect();
            let number = |value| u8::try_from(states.binary_search(value).ok()?).ok();
            (NumberType::U8, values.iter().map(number).collect::<Option<_>>()?)
        }
    };
    let (name, component_names) = (name.to_owned(), Vec::new());
    Some(ReadArray { name, numbers, components: column.components, component_names, states, bytes })
}

/// The narrowest type that holds all of these numbers.
fn of_whole(values: &[i64]) -> (NumberType, Vec<u8>) {
    let as_u32 = values.iter().map(|value| u32::try_from(*value).ok()).collect::<Option<Vec<u32>>>();
    let as_i32 = values.iter().map(|value| i32::try_from(*value).ok()).collect::<Option<Vec<i32>>>();
    match (as_u32, as_i32) {
        (Some(values), _) => (NumberType::U32, values.iter().flat_map(|value| value.to_ne_bytes()).collect()),
        (None, Some(values)) => {
            (NumberType::I32, values.iter().flat_map(|value| value.to_ne_bytes()).collect())
        }
        (None, None) => {
            (NumberType::F64, values.iter().flat_map(|value| (*value as f64).to_ne_bytes()).collect())
        }
    }
}

/// A state of a view, whose substates have the types of the model.
fn read_typed(saved: SavedView<'_>) -> Result<SavedState, Failure> {
    let path = saved.path(&file(saved.view()));
    let fields = saved.subject().model().groups()[saved.view().shown.group].schema().fields;
    let state = read(&path)?;
    let mut arrays = Vec::new();
    for array in state.arrays {
        let Some(field) = fields.iter().find(|field| field.name == array.name) else {
            arrays.push(array);
            continue;
        };
        let of_model = retyped(field, saved.precision(), array);
        arrays.push(of_model.map_err(|NoValue { index, number }| OtherFile::Value {
            path: path.display().to_string(),
            substate: field.name,
            number,
            particle: index + 1,
        })?);
    }
    Ok(SavedState { arrays, ..state })
}

/// Columns that the format gives a meaning.
const IDENTIFIER: &str = "id";
const RADIUS: &str = "radius";
const RESERVED: [&str; 2] = [IDENTIFIER, "pos"];

fn write(state: RecordedState<'_>, view: View<'_>, items: &ItemState<'_>) -> Result<(), Failure> {
    let [origin, sides] = items.space();
    let space = Space { origin, sides, periodic: state.subject().model().geometry().toroidal() };
    let (path, precision, count) = (state.path(&file(view)), state.precision(), items.count()?);
    items.with_none(|none| {
        with_columns(none, items.radius(), precision, |columns| {
            extended_xyz::write_rows(&path, state.time(), Some(&space), (count, columns), |rows| {
                let written = items.blocks(|block| {
                    let positions = block.positions_on_map().to_points();
                    let add = |columns: &[Column<'_>]| rows.add(&positions, columns);
                    Ok::<(), Unwritten>(with_columns(block, items.radius(), precision, add)?)
                });
                written.map_err(|Unwritten(error)| error)
            })
        })
    })?;
    Ok(())
}

/// Makes columns of items, and does something with them.
fn with_columns<T>(
    items: &ItemBlock<'_>,
    radius: Option<f64>,
    precision: Precision,
    work: impl FnOnce(&[Column<'_>]) -> T,
) -> T {
    let labels: Vec<i64> = items.labels().iter().map(|label| i64::from(*label)).collect();
    let substates = items.substates();
    let named: Vec<NamedNumbers<'_>> =
        substates.iter().map(|substate| NamedNumbers::new(substate, precision)).collect();
    // A substate of this name is the radius of each item.
    let radius = radius.filter(|_| named.iter().all(|column| column.name != RADIUS));
    let radii = vec![radius.unwrap_or_default(); labels.len()];
    let mut columns = vec![Column::new(IDENTIFIER, 1, Values::Whole(&labels))];
    if radius.is_some() {
        columns.push(Column::new(RADIUS, 1, Values::F64(&radii)));
    }
    columns.extend(named.iter().map(NamedNumbers::column));
    work(&columns)
}

/// A substate as a column.
struct NamedNumbers<'a> {
    name: String,
    components: usize,
    numbers: Numbers<'a>,
}

/// The values of a column.
enum Numbers<'a> {
    F64(Vec<f64>),
    F32(Vec<f32>),
    Whole(Vec<i64>),
    Bool(Vec<bool>),
    Text(Vec<&'a str>),
}

impl<'a> NamedNumbers<'a> {
    fn new(substate: &'a SubstateValues, precision: Precision) -> Self {
        let (field, plane) = (substate.field(), substate.values());
        let is_reserved = RESERVED.contains(&field.name);
        let name = if is_reserved { format!("{}_", field.name) } else { field.name.to_owned() };
        let stored = field.value_type.stored(precision).scalar;
        let numbers = match (field.value_type.scalar, stored) {
            (ScalarType::Bool, _) => Numbers::Bool(all(plane).map(|number| number != 0.0).collect()),
            (ScalarType::State(names), _) => {
                let name = |number: f64| names.states.get(number as usize).copied().unwrap_or("?");
                Numbers::Text(all(plane).map(name).collect())
            }
            (_, StoredScalar::F64) => Numbers::F64(all(plane).collect()),
            (_, StoredScalar::F32) => Numbers::F32(all(plane).map(|number| number as f32).collect()),
            _ => Numbers::Whole(all(plane).map(|number| number as i64).collect()),
        };
        Self { name, components: plane.components(), numbers }
    }

    fn column(&self) -> Column<'_> {
        let values = match &self.numbers {
            Numbers::F64(numbers) => Values::F64(numbers),
            Numbers::F32(numbers) => Values::F32(numbers),
            Numbers::Whole(numbers) => Values::Whole(numbers),
            Numbers::Bool(numbers) => Values::Bool(numbers),
            Numbers::Text(names) => Values::Text(names),
        };
        Column::new(&self.name, self.components, values)
    }
}

/// All numbers, one item after the other.
fn all(plane: &Plane) -> impl Iterator<Item = f64> {
    (0..plane.count()).flat_map(|index| plane.value(index))
}
