//! Models: what a scientist defines and an engine runs.

mod builder;
mod check;
mod error;
mod filling;
mod initial;
mod names;

pub use builder::ModelBuilder;
pub use error::ModelError;
pub use initial::InitialError;

use crate::engine::SubstateId;
use crate::parameter_set::ParameterSet;
use crate::plan::Plan;
use crate::steering::{Schedule, Steering};
use std::any::TypeId;
use std::fmt;
use std::sync::Arc;
use xca_process::Process;
use xca_process::Substates;
use xca_process::{Faces, Geometry};
use xca_process::{ParameterError, Parameters};
use xca_values::{Field, Schema};
use xca_values::{Precision, ScalarType, StoredType};

/// An Extended Cellular Automaton, checked and ready to run on any engine.
///
/// [`Model::builder`] defines one. Its parameters and slots can change before a run:
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Colony {
///     size: Real,
/// }
///
/// #[derive(Parameters, Clone, Debug)]
/// struct Growth {
///     #[parameter(range = 0.0..)]
///     rate: Real,
/// }
///
/// #[elementary_process]
/// fn grow(cell: &mut Cell<Colony>, p: &Growth) {
///     cell.size += p.rate * cell.size;
/// }
///
/// let mut model = Model::builder("growth")
///     .extents([4, 4, 1])
///     .substates::<Colony>()
///     .parameters(Growth { rate: 0.5 })
///     .process(grow)
///     .fill(|_| Colony { size: 1.0 })
///     .build()?;
/// model.set_parameter("rate", "1.0")?;
/// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// simulation.step()?;
/// assert_eq!(simulation.state().get(Colony::SIZE, [0, 0, 0])?, 2.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The space has three dimensions. A two-dimensional model is one layer of cells. Simulations copy the model,
/// so one model serves many runs.
#[derive(Clone, Debug)]
pub struct Model {
    name: String,
    geometry: Geometry,
    groups: Vec<Group>,
    processes: Vec<Process>,
    parameters: ParameterSet,
    plan: Plan,
    steering: Vec<Steering>,
    /// When the substates are checked for NaN and infinities.
    watches: Vec<Schedule>,
    /// Those that may be NaN or infinite.
    may_be_non_finite: Vec<SubstateId>,
    fault_texts: Vec<(u32, String)>,
}

/// The substates of one struct, in a model.
#[derive(Clone)]
pub struct Group {
    type_id: TypeId,
    /// With its path, for messages.
    type_name: &'static str,
    schema: &'static Schema,
    kind: GroupKind,
}

/// Writes the value of the field with this number, in its stored type.
pub type WriteOutside = dyn Fn(usize, Precision, &mut [u8]) + Send + Sync;

/// The owners of a group's substates.
#[derive(Clone)]
pub enum GroupKind {
    /// The cells.
    Cells {
        /// Writes the outside value of a field, for each flat face.
        outside: Faces<Arc<WriteOutside>>,
    },
    /// The items of a population.
    Population {
        /// The most items in a cell.
        slots: usize,
        /// Whether a migration may send items out of the space.
        may_leave: bool,
    },
}

impl fmt::Debug for GroupKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cells { .. } => f.write_str("Cells"),
            Self::Population { slots, may_leave } => {
                f.debug_struct("Population").field("slots", slots).field("may_leave", may_leave).finish()
            }
        }
    }
}

impl Group {
    /// The type of the struct.
    pub fn type_id(&self) -> TypeId {
        self.type_id
    }

    /// The fields.
    pub fn schema(&self) -> &'static Schema {
        self.schema
    }

    /// Whether the substates belong to cells or to a population.
    pub fn kind(&self) -> &GroupKind {
        &self.kind
    }

    /// The machine types of the fields.
    pub fn stored(&self, precision: Precision) -> Vec<StoredType> {
        self.schema.fields.iter().map(|field| field.value_type.stored(precision)).collect()
    }

    /// The stored bytes of a field beyond each flat face. `None` for a population.
    pub fn outside(&self, field: usize, precision: Precision) -> Option<Faces<Vec<u8>>> {
        let GroupKind::Cells { outside } = &self.kind else { return None };
        let size = self.schema.fields[field].value_type.stored(precision).size();
        Some(outside.map(|write| {
            let mut bytes = vec![0; size];
            write(field, precision, &mut bytes);
            bytes
        }))
    }
}

impl fmt::Debug for Group {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Group").field("substates", &self.schema.name).field("kind", &self.kind).finish()
    }
}

impl Model {
    /// Starts the definition of a model.
    pub fn builder(name: impl Into<String>) -> ModelBuilder {
        ModelBuilder::new(name.into())
    }

    /// The model's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The cellular space.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The structs of substates, in the order of their addition.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The elementary processes, in the order in which they run.
    pub fn processes(&self) -> &[Process] {
        &self.processes
    }

    /// The initial parameters.
    pub fn parameters(&self) -> &ParameterSet {
        &self.parameters
    }

    /// The plan that engines derive from the processes.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    pub(crate) fn steering(&self) -> &[Steering] {
        &self.steering
    }

    pub(crate) fn watches(&self) -> &[Schedule] {
        &self.watches
    }

    /// The floating substates that have to be finite, in the order of the model.
    pub(crate) fn finite_substates(&self) -> impl Iterator<Item = SubstateId> {
        let of_group = |(group, definition): (usize, &Group)| {
            let floating = |(field, description): (usize, &Field)| {
                let scalar = description.value_type.scalar;
                matches!(scalar, ScalarType::F32 | ScalarType::F64 | ScalarType::Real)
                    .then_some(SubstateId { group, field })
            };
            definition.schema.fields.iter().enumerate().filter_map(floating).collect::<Vec<_>>()
        };
        let all = self.groups.iter().enumerate().flat_map(of_group);
        all.filter(|substate| !self.may_be_non_finite.contains(substate))
    }

    /// The model's message for a fault code.
    pub fn fault_text(&self, code: u32) -> Option<&str> {
        self.fault_texts.iter().find(|(known, _)| *known == code).map(|(_, text)| text.as_str())
    }

    /// The number of the group of this type, if the model has it.
    pub fn group_number(&self, type_id: TypeId) -> Option<usize> {
        self.groups.iter().position(|group| group.type_id == type_id)
    }

    /// The number of the group of the struct `S`, if the model has it.
    pub fn group_of<S: Substates>(&self) -> Option<usize> {
        self.group_number(TypeId::of::<S>())
    }

    /// The machine type of a substate.
    pub fn stored(&self, substate: SubstateId, precision: Precision) -> StoredType {
        self.groups[substate.group].schema.fields[substate.field].value_type.stored(precision)
    }

    /// Replaces the parameters of the struct `P`. Initial states that use them change with them.
    ///
    /// # Errors
    /// Returns an error if the model has no parameters of this type, or a value is out of its range.
    pub fn with_parameters<P: Parameters>(mut self, parameters: P) -> Result<Self, ParameterError> {
        self.parameters.replace(Precision::F64, parameters)?;
        Ok(self)
    }

    /// The number of slots in a cell for the items of a population, by the name of its struct.
    pub fn slots(&self, population: &str) -> Option<usize> {
        let group = self.groups.iter().find(|group| group.schema.name == population)?;
        match group.kind {
            GroupKind::Population { slots, .. } => Some(slots),
            GroupKind::Cells { .. } => None,
        }
    }

    /// Sets the number of slots in a cell for the items of a population, by the name of its struct.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Fish { age: u32 }
    /// let mut model = Model::builder("sea").extents([8, 8, 1]).population::<Fish>(2).build()?;
    /// model.set_slots("Fish", 6)?;
    /// assert_eq!(model.slots("Fish"), Some(6));
    /// # Ok::<(), ModelError>(())
    /// ```
    ///
    /// The result of a run does not depend on it, as long as no cell is full.
    ///
    /// # Errors
    /// Returns an error if no population has the name, or `slots` is 0.
    pub fn set_slots(&mut self, population: &str, slots: usize) -> Result<(), ModelError> {
        for group in &mut self.groups {
            if let (true, GroupKind::Population { slots: own, .. }) =
                (group.schema.name == population, &mut group.kind)
            {
                if slots == 0 {
                    return Err(ModelError::NoSlots { substates: group.schema.name });
                }
                *own = slots;
                return Ok(());
            }
        }
        Err(ModelError::NoPopulation { model: self.name.clone(), population: population.to_owned() })
    }

    /// Sets a parameter by name, from text. Initial states that use it change with it.
    ///
    /// # Errors
    /// Returns an error if the name is unknown or ambiguous, the parameter is computed, or the text is not a
    /// value of its type and range.
    pub fn set_parameter(&mut self, name: &str, text: &str) -> Result<(), ParameterError> {
        self.parameters.change(Precision::F64, |parameters| parameters.set_by_name(name, text))
    }
}
