//! All states of the items as extended XYZ.

use super::{Moment, OutputFile, RecordedState, Subject, View, Writer};
use crate::observable::Failure;
use crate::record::{ItemState, Plane, SubstateValues};
use xca_core::{Precision, ScalarType, StoredScalar};
use xca_io::extended_xyz::{self, Column, Space, Values};

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
}

/// Columns that the format gives a meaning.
const IDENTIFIER: &str = "id";
const RADIUS: &str = "radius";
const RESERVED: [&str; 2] = [IDENTIFIER, "pos"];

fn write(state: RecordedState<'_>, view: View<'_>, items: &ItemState<'_>) -> Result<(), Failure> {
    let [origin, sides] = items.space();
    let periodic = state.subject().model().geometry().toroidal();
    let labels: Vec<i64> = items.labels().iter().map(|label| i64::from(*label)).collect();
    let substates = items.substates();
    let named: Vec<NamedNumbers<'_>> =
        substates.iter().map(|substate| NamedNumbers::new(substate, state.precision())).collect();
    // A substate of this name is the radius of each item.
    let radius = items.radius().filter(|_| named.iter().all(|column| column.name != RADIUS));
    let radii = vec![radius.unwrap_or_default(); labels.len()];
    let mut columns = vec![Column::new(IDENTIFIER, 1, Values::Whole(&labels))];
    if radius.is_some() {
        columns.push(Column::new(RADIUS, 1, Values::F64(&radii)));
    }
    columns.extend(named.iter().map(NamedNumbers::column));
    let positions = items.positions_on_map().to_points();
    let space = Space { origin, sides, periodic };
    extended_xyz::write(&state.path(&file(view)), state.time(), Some(&space), &positions, &columns)?;
    Ok(())
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
