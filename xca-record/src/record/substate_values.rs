//! The values of a substate, with what is known of it.

use super::source::Source;
use super::values::{Plane, hide, number_type};
use std::borrow::Cow;
use std::cell::Cell;
use std::io::{self, Write};
use xca_checkpoint::components::state_names;
use xca_core::engine::SubstateId;
use xca_core::{EngineFailure, Field, StoredType};
use xca_io::vtk::{DataArray, ValueSource, Values};

/// What is known of a substate.
#[derive(Debug, Clone)]
struct Definition {
    field: &'static Field,
    /// Of an array; VTK has names of its own for the lanes of a vector.
    components: Vec<String>,
    states: Vec<String>,
}

impl Definition {
    fn new(field: &'static Field) -> Self {
        let components = field.value_type.length.map(|_| field.value_type.component_suffixes());
        let states = state_names(field.value_type.scalar);
        Self { field, components: components.unwrap_or_default(), states }
    }

    fn array<'a>(&'a self, values: Values<'a>) -> DataArray<'a> {
        let array = DataArray::new(self.field.name, values);
        array.with_components(&self.components).with_states(&self.states)
    }
}

/// The values of a substate of items.
#[derive(Debug, Clone)]
pub struct SubstateValues {
    definition: Definition,
    plane: Plane,
}

impl SubstateValues {
    pub(super) fn new(field: &'static Field, plane: Plane) -> Self {
        Self { definition: Definition::new(field), plane }
    }

    /// The definition of the substate: its name, type, unit and documentation.
    pub fn field(&self) -> &'static Field {
        self.definition.field
    }

    /// One value for each item, by label.
    pub fn values(&self) -> &Plane {
        &self.plane
    }

    /// What `bool` and states are called, by number; nothing of numbers.
    pub fn states(&self) -> &[String] {
        &self.definition.states
    }

    pub(crate) fn array(&self) -> DataArray<'_> {
        self.definition.array(self.plane.as_values())
    }
}

/// A substate of cells, whose values are read when they are needed. Where there is no ground, floats are NaN
/// and whole numbers 0.
#[derive(Debug)]
pub struct CellSubstate<'a> {
    definition: Definition,
    source: Source<'a>,
    substate: SubstateId,
    stored: StoredType,
    cells: usize,
    missing: Option<&'a [bool]>,
}

impl<'a> CellSubstate<'a> {
    pub(super) fn new(
        field: &'static Field,
        (source, substate): (Source<'a>, SubstateId),
        stored: StoredType,
        cells: usize,
        missing: Option<&'a [bool]>,
    ) -> Self {
        Self { definition: Definition::new(field), source, substate, stored, cells, missing }
    }

    /// The definition of the substate: its name, type, unit and documentation.
    pub fn field(&self) -> &'static Field {
        self.definition.field
    }

    /// What `bool` and states are called, by number; nothing of numbers.
    pub fn states(&self) -> &[String] {
        &self.definition.states
    }

    /// One value for each cell, the index along x fastest. [`Self::blocks`] needs less memory.
    ///
    /// # Errors
    /// Where the engine has lost its state.
    pub fn values(&self) -> Result<Plane, EngineFailure> {
        let mut values = Vec::new();
        self.blocks(|block| {
            values.extend_from_slice(block);
            Ok::<(), EngineFailure>(())
        })?;
        Ok(Plane::all(self.stored, &values))
    }

    /// Passes on the values of all cells, the index along x fastest, as they are stored: in blocks of some
    /// megabytes where the engine has the space in parts or reads rows, else at once.
    ///
    /// # Errors
    /// Where the engine has lost its state, or that of `take`.
    pub fn blocks<E: From<EngineFailure>>(
        &self,
        mut take: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let first = Cell::new(0);
        self.source.blocks(self.substate, |block| {
            let cells = first.get()..first.get() + block.len() / self.stored.size();
            first.set(cells.end);
            match self.missing.and_then(|missing| missing.get(cells)) {
                None => take(block),
                Some(missing) => {
                    let mut block = block.to_vec();
                    hide(&mut block, self.stored, missing);
                    take(&block)
                }
            }
        })
    }

    pub(crate) fn array(&self) -> DataArray<'_> {
        let numbers = number_type(self.stored.scalar);
        self.definition.array(Values::of_source(numbers, self.stored.components(), self.cells, self))
    }
}

impl ValueSource for CellSubstate<'_> {
    fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        let numbers = number_type(self.stored.scalar);
        self.blocks(|block| {
            let block = if cfg!(target_endian = "big") {
                Cow::Owned(numbers.of_this_machine(block.to_vec()))
            } else {
                Cow::Borrowed(block)
            };
            Ok(out.write_all(&block)?)
        })
        .map_err(|Unwritten(error)| error)
    }
}

/// Why values do not get into a file.
pub(crate) struct Unwritten(pub(crate) io::Error);

impl From<io::Error> for Unwritten {
    fn from(error: io::Error) -> Self {
        Self(error)
    }
}

impl From<EngineFailure> for Unwritten {
    fn from(failure: EngineFailure) -> Self {
        Self(io::Error::other(failure))
    }
}
