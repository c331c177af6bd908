//! Models: what a scientist defines and an engine runs.

mod builder;
mod check;
mod error;
mod filling;
mod filling_check;
mod group;
mod initial;
mod names;
mod schedules;
mod structure;

pub use builder::ModelBuilder;
pub use error::ModelError;
pub use group::{Group, GroupKind, WriteOutside};
pub use initial::InitialError;
pub(crate) use structure::Structure;

use crate::engine::SubstateId;
use crate::parameter_set::ParameterSet;
use crate::plan::Plan;
use crate::steering::{Schedule, Steering};
use std::any::TypeId;
use xca_process::Geometry;
use xca_process::Process;
use xca_process::Substates;
use xca_process::{ParameterError, Parameters};
use xca_values::Field;
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
    structure: Structure,
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

impl Model {
    /// The model's name.
    pub fn name(&self) -> &str {
        self.structure.name()
    }

    /// The cellular space.
    pub fn geometry(&self) -> &Geometry {
        self.structure.geometry()
    }

    /// The structs of substates, in the order of their addition.
    pub fn groups(&self) -> &[Group] {
        self.structure.groups()
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

    /// The space and the substates, for a state.
    pub(crate) fn structure(&self) -> &Structure {
        &self.structure
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
        let all = self.structure.groups.iter().enumerate().flat_map(of_group);
        all.filter(|substate| !self.may_be_non_finite.contains(substate))
    }

    /// The model's message for a fault code.
    pub fn fault_text(&self, code: u32) -> Option<&str> {
        self.fault_texts.iter().find(|(known, _)| *known == code).map(|(_, text)| text.as_str())
    }

    /// The number of the group of this type, if the model has it.
    pub fn group_number(&self, type_id: TypeId) -> Option<usize> {
        self.structure.group_number(type_id)
    }

    /// The number of the group of the struct `S`, if the model has it.
    pub fn group_of<S: Substates>(&self) -> Option<usize> {
        self.structure.group_of::<S>()
    }

    /// The machine type of a substate.
    pub fn stored(&self, substate: SubstateId, precision: Precision) -> StoredType {
        self.structure.stored(substate, precision)
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
        let group = self.structure.groups.iter().find(|group| group.schema.name == population)?;
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
        for group in &mut self.structure.groups {
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
        Err(ModelError::NoPopulation {
            model: self.structure.name.clone(),
            population: population.to_owned(),
        })
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
