//! Initial values from outside the model, such as from a file.

use super::{Group, GroupKind, Model};
use crate::engine::SubstateId;
use crate::steering::{Schedule, Steering};
use xca_values::ValueType;
use xca_values::{Field, Schema};

/// An error of [`Model::set_initial`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InitialError {
    /// No substate has this name.
    #[error("unknown substate of cells `{name}`; there are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// The known names.
        known: String,
    },
    /// Several structs of substates have a field of this name.
    #[error("several substates are called `{name}`; say which one: {known}")]
    Ambiguous {
        /// The name.
        name: String,
        /// The substates of that name.
        known: String,
    },
    /// The substate is a vector or an array, and the name lacks the component.
    #[error("`{name}` is a {value_type}; give one of its components, such as `{name}.{component}`")]
    Several {
        /// The substate.
        name: String,
        /// Its type.
        value_type: ValueType,
        /// The name of its first component.
        component: String,
    },
    /// The number of values differs from that of the cells.
    #[error("`{name}` has {cells} values, one for each cell, but {given} are given")]
    WrongNumber {
        /// The substate.
        name: String,
        /// The number of cells.
        cells: usize,
        /// The number of values.
        given: usize,
    },
    /// A number is not a value of the substate's type.
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
    /// Replaces the initial values of a substate of cells, or of one of its components: a map read from a
    /// file, for example. Values come by linear index, x fastest.
    ///
    /// ```
    /// use xca_core::prelude::*;
    ///
    /// #[derive(Substates, Clone, Copy)]
    /// struct Ground {
    ///     altitude: Real,
    /// }
    ///
    /// let mut model = Model::builder("slope").extents([3, 1, 1]).substates::<Ground>().build()?;
    /// model.set_initial("altitude", [Some(10.0), None, Some(30.0)])?;
    /// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// assert_eq!(simulation.state().read(Ground::ALTITUDE)?, [10.0, 0.0, 30.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// They replace what the model's own initial state sets. A cell with `None` keeps the model's value.
    ///
    /// Name a substate by its field, or by struct and field (`Heat.temperature`). Name a component by what
    /// follows: `velocity.x`, `outflow.3`, `paths.1.x`. `bool` is 0 or 1, a state is its number.
    ///
    /// # Errors
    /// Returns an error if the substate is unknown or ambiguous, the number of values is not that of the
    /// cells, or a value does not fit the type.
    pub fn set_initial(
        &mut self,
        substate: &str,
        values: impl IntoIterator<Item: Into<Option<f64>>>,
    ) -> Result<(), InitialError> {
        let values: Vec<Option<f64>> = values.into_iter().map(Into::into).collect();
        let (id, value_type, component) = self.component_of_cells(substate)?;
        let name = substate.to_owned();
        let cells = self.geometry().cells();
        if values.len() != cells {
            return Err(InitialError::WrongNumber { name, cells, given: values.len() });
        }
        let unfit = |value: &Option<f64>| value.filter(|value| !value_type.scalar.fits(*value));
        if let Some((cell, value)) =
            values.iter().enumerate().find_map(|(cell, value)| Some((cell, unfit(value)?)))
        {
            return Err(InitialError::Value { name, cell: self.geometry().indices(cell), value, value_type });
        }
        self.steering.push(Steering::new(Schedule::Start, move |state| {
            let stored = value_type.stored(state.precision);
            let size = stored.scalar.size();
            let mut bytes = state.execution.read(id)?;
            let given = values.iter().zip(bytes.chunks_exact_mut(stored.size()));
            for (value, bytes) in given.filter_map(|(value, bytes)| Some(((*value)?, bytes))) {
                stored.scalar.encode(value, &mut bytes[component * size..(component + 1) * size]);
            }
            Ok(state.execution.write(id, &bytes)?)
        }));
        Ok(())
    }

    /// The substate that is meant, its type and the number of its component.
    fn component_of_cells(&self, wanted: &str) -> Result<(SubstateId, ValueType, usize), InitialError> {
        let all = self.of_cells();
        let found: Vec<_> = all.iter().filter_map(|known| Some((known, known.rest_of(wanted)?))).collect();
        let name = wanted.to_owned();
        match found.as_slice() {
            [] => Err(InitialError::Unknown { name, known: names(&all) }),
            [(Named { id, field, .. }, component)] => {
                let value_type = field.value_type;
                let single = (value_type.components() == 1).then_some(0);
                let first = || value_type.component_names().into_iter().next().unwrap_or_default();
                component.or(single).map(|component| (*id, value_type, component)).ok_or_else(|| {
                    InitialError::Several { name, value_type, component: first().replace('_', ".") }
                })
            }
            several => {
                Err(InitialError::Ambiguous { name, known: names(several.iter().map(|(known, _)| *known)) })
            }
        }
    }

    /// All substates of cells.
    fn of_cells(&self) -> Vec<Named> {
        let groups = self.groups().iter().enumerate();
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

    /// The component that a name means, if it means this substate; none if it names the whole.
    fn rest_of(&self, name: &str) -> Option<Option<usize>> {
        let component = |rest: &str| match rest {
            "" => Some(None),
            rest if rest.starts_with(['.', '[']) => self.field.value_type.component_named(rest).map(Some),
            _ => None,
        };
        let of_field = name.strip_prefix(self.field.name).and_then(component);
        of_field.or_else(|| name.strip_prefix(&self.name()).and_then(component))
    }
}

fn names<'a>(substates: impl IntoIterator<Item = &'a Named>) -> String {
    substates.into_iter().map(Named::name).collect::<Vec<_>>().join(", ")
}
