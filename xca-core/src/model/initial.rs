//! Initial values that come from outside of the model, from a file for example.

use super::{Group, GroupKind, Model};
use crate::engine::SubstateId;
use crate::schema::{Field, Schema};
use crate::steering::{Schedule, Steering};
use crate::value::ValueType;

/// Initial values that a substate cannot have.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InitialError {
    /// No substate has this name.
    #[error("no substate of cells is called `{name}`; there are {known}")]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// Those that there are.
        known: String,
    },
    /// Several structs of substates have a field of this name.
    #[error("several substates are called `{name}`; say which one: {known}")]
    Ambiguous {
        /// The name that was asked for.
        name: String,
        /// Those that it may mean.
        known: String,
    },
    /// The substate is a vector or an array.
    #[error("`{name}` is a {value_type}; only single numbers and states can be given")]
    Several {
        /// The substate.
        name: String,
        /// Its type.
        value_type: ValueType,
    },
    /// Not as many values as cells.
    #[error("`{name}` has {cells} values, one for each cell, but {given} are given")]
    WrongNumber {
        /// The substate.
        name: String,
        /// How many cells there are.
        cells: usize,
        /// How many values were given.
        given: usize,
    },
    /// A number that is no value of the substate's type.
    #[error("{value} in cell {cell:?} is no value for `{name}`, which is {}", value_type.described())]
    Value {
        /// The substate.
        name: String,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The number.
        value: f64,
        /// The type of the substate.
        value_type: ValueType,
    },
}

impl Model {
    /// Has a scalar substate of cells begin with these values (by linear index, x fastest), in place of those that the model gives it. They
    /// are set once all that the model does to make its initial state is done.
    ///
    /// The substate is named by its field, or by struct and field (`Heat.temperature`).
    ///
    /// # Errors
    /// Where there is no such substate, or the values are not one for each cell and of its type.
    pub fn set_initial(&mut self, substate: &str, values: Vec<f64>) -> Result<(), InitialError> {
        let (id, field) = self.scalar_of_cells(substate)?;
        let (name, value_type) = (field.name.to_owned(), field.value_type);
        let cells = self.geometry.cells();
        if values.len() != cells {
            return Err(InitialError::WrongNumber { name, cells, given: values.len() });
        }
        if let Some(cell) = values.iter().position(|value| !value_type.scalar.fits(*value)) {
            let value = values[cell];
            return Err(InitialError::Value { name, cell: self.geometry.indices(cell), value, value_type });
        }
        self.steering.push(Steering::new(Schedule::Start, move |state| {
            let stored = value_type.stored(state.precision);
            let mut bytes = vec![0; stored.size() * values.len()];
            for (value, bytes) in values.iter().zip(bytes.chunks_exact_mut(stored.size())) {
                stored.scalar.encode(*value, bytes);
            }
            Ok(state.execution.write(id, &bytes)?)
        }));
        Ok(())
    }

    fn scalar_of_cells(&self, wanted: &str) -> Result<(SubstateId, &'static Field), InitialError> {
        let all = self.of_cells();
        let found: Vec<_> = all.iter().filter(|known| known.is_meant_by(wanted)).collect();
        let name = wanted.to_owned();
        match found.as_slice() {
            [] => Err(InitialError::Unknown { name, known: names(&all) }),
            [Named { id, field, .. }] => match field.value_type {
                ValueType { lanes: 1, length: None, .. } => Ok((*id, field)),
                value_type => Err(InitialError::Several { name, value_type }),
            },
            several => Err(InitialError::Ambiguous { name, known: names(several.iter().copied()) }),
        }
    }

    /// All substates of cells.
    fn of_cells(&self) -> Vec<Named> {
        let groups = self.groups.iter().enumerate();
        let groups = groups.filter(|(_, group)| matches!(group.kind, GroupKind::Cells { .. }));
        let named = |(group, of): (usize, &Group)| {
            let of = of.schema;
            let named = move |(index, field)| Named { of, id: SubstateId { group, field: index }, field };
            of.fields.iter().enumerate().map(named)
        };
        groups.flat_map(named).collect()
    }
}

/// A substate with its names.
struct Named {
    of: &'static Schema,
    id: SubstateId,
    field: &'static Field,
}

impl Named {
    fn name(&self) -> String {
        format!("{}.{}", self.of.name, self.field.name)
    }

    fn is_meant_by(&self, name: &str) -> bool {
        name == self.field.name || name == self.name()
    }
}

fn names<'a>(substates: impl IntoIterator<Item = &'a Named>) -> String {
    substates.into_iter().map(Named::name).collect::<Vec<_>>().join(", ")
}
