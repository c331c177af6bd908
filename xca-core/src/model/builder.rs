//! The definition of a model, and its checks.

use super::filling::Filling;
use super::names::check_names;
use super::{Group, GroupKind, Model, ModelError};
use crate::geometry::{Boundary, Geometry};
use crate::kernel::{NOWHERE, Of};
use crate::neighbourhood::{Neighbourhood, Parity};
use crate::parameters::{AnyParameters, Parameters};
use crate::process::{ElementaryProcess, Process, ProcessKind};
use crate::random::Stream;
use crate::state::State;
use crate::steering::{Schedule, Steering, SteeringError};
use crate::substates::Substates;
use std::any::TypeId;
use std::fmt;
use std::sync::Arc;

/// Collects the definition of a model. Mistakes are reported by [`ModelBuilder::build`].
#[must_use = "call `build` to get the model"]
pub struct ModelBuilder {
    name: String,
    extents: Option<[usize; 3]>,
    side: f64,
    boundaries: [Boundary; 3],
    neighbourhood: Neighbourhood,
    groups: Vec<Group>,
    processes: Vec<Process>,
    parameters: Box<dyn AnyParameters>,
    steering: Vec<Steering>,
    pub(super) fillings: Vec<Filling>,
    fault_texts: Vec<(u32, String)>,
    mistake: Option<ModelError>,
}

const AXES: [char; 3] = ['x', 'y', 'z'];

impl ModelBuilder {
    pub(super) fn new(name: String) -> Self {
        Self {
            name,
            extents: None,
            side: 1.0,
            boundaries: [Boundary::Flat; 3],
            neighbourhood: Neighbourhood::von_neumann(0),
            groups: Vec::new(),
            processes: Vec::new(),
            parameters: Box::new(()),
            steering: Vec::new(),
            fillings: Vec::new(),
            fault_texts: Vec::new(),
            mistake: None,
        }
    }

    /// The number of cells along x, y, z. A two-dimensional model is one layer deep: `[x, y, 1]`.
    pub fn extents(mut self, extents: [usize; 3]) -> Self {
        self.extents = Some(extents);
        self
    }

    /// The side of a cell in metres; 1 unless it is given.
    pub fn cell_side(mut self, side: f64) -> Self {
        self.side = side;
        self
    }

    /// Which cells a cell sees; only itself unless it is given.
    pub fn neighbourhood(mut self, neighbourhood: Neighbourhood) -> Self {
        self.neighbourhood = neighbourhood;
        self
    }

    /// The same boundary along all axes; flat unless it is given.
    pub fn boundary(self, boundary: Boundary) -> Self {
        self.boundaries([boundary; 3])
    }

    /// The boundary along x, y, z.
    pub fn boundaries(mut self, boundaries: [Boundary; 3]) -> Self {
        self.boundaries = boundaries;
        self
    }

    /// Adds the substates `S` of cells. Beyond flat boundaries they are zero.
    pub fn substates<S: Substates>(self) -> Self {
        self.add_group::<S>(GroupKind::Cells { outside: Arc::new(|_, _, bytes| bytes.fill(0)) })
    }

    /// Adds the substates `S` of cells, which beyond flat boundaries have these values.
    pub fn substates_with_outside<S: Substates>(self, outside: S) -> Self {
        self.add_group::<S>(GroupKind::Cells {
            outside: Arc::new(move |field, precision, bytes| outside.encode(field, precision, bytes)),
        })
    }

    /// Adds a population of items with the substates `S`, at most `slots` of them in a cell.
    pub fn population<S: Substates>(mut self, slots: usize) -> Self {
        if slots == 0 {
            self.mistake.get_or_insert(ModelError::NoSlots { substates: S::SCHEMA.name });
        }
        self.add_group::<S>(GroupKind::Population { slots, may_leave: false })
    }

    /// Allows that a migration sends items of the population `S` out of the space. They are counted.
    pub fn items_may_leave<S: Substates>(mut self) -> Self {
        let group = self.groups.iter_mut().find(|group| group.type_id == TypeId::of::<S>());
        match group.map(|group| &mut group.kind) {
            Some(GroupKind::Population { may_leave, .. }) => *may_leave = true,
            _ => {
                self.mistake.get_or_insert(ModelError::NotAdded { substates: S::SCHEMA.name });
            }
        }
        self
    }

    fn add_group<S: Substates>(mut self, kind: GroupKind) -> Self {
        let type_id = TypeId::of::<S>();
        if self.groups.iter().any(|group| group.type_id == type_id) {
            self.mistake.get_or_insert(ModelError::SubstatesTwice { substates: S::SCHEMA.name });
        }
        let type_name = std::any::type_name::<S>();
        self.groups.push(Group { type_id, type_name, schema: S::SCHEMA, kind });
        self
    }

    /// The parameters, with their values at the start.
    pub fn parameters<P: Parameters>(mut self, parameters: P) -> Self {
        self.parameters = Box::new(parameters);
        self
    }

    /// Adds an elementary process or a migration. They run in the order in which they are added.
    pub fn process<P: ElementaryProcess>(mut self, _process: P) -> Self {
        self.processes.push(P::process());
        self
    }

    /// Adds a global operation, run at the times of the schedule.
    pub fn steer(
        mut self,
        schedule: Schedule,
        operation: impl Fn(&mut State<'_>) -> Result<(), SteeringError> + Send + Sync + 'static,
    ) -> Self {
        if matches!(schedule, Schedule::Every(0) | Schedule::EveryFromStart(0)) {
            self.mistake.get_or_insert(ModelError::ZeroInterval);
        }
        self.steering.push(Steering::new(schedule, operation));
        self
    }

    /// Adds a global operation that makes the initial state, before the first step.
    pub fn initialise(
        self,
        operation: impl Fn(&mut State<'_>) -> Result<(), SteeringError> + Send + Sync + 'static,
    ) -> Self {
        self.steer(Schedule::Start, operation)
    }

    /// Stops the run when the condition gives a reason.
    pub fn stop_when(
        self,
        schedule: Schedule,
        condition: impl Fn(&mut State<'_>) -> Result<Option<String>, SteeringError> + Send + Sync + 'static,
    ) -> Self {
        self.steer(schedule, move |state| {
            if let Some(reason) = condition(state)? {
                state.stop(reason);
            }
            Ok(())
        })
    }

    /// Says what a fault code means, for messages.
    pub fn fault_text(mut self, code: u32, text: impl Into<String>) -> Self {
        self.fault_texts.push((code, text.into()));
        self
    }

    /// Checks the definition.
    ///
    /// # Errors
    /// The first mistake that is found; its message says what to change.
    pub fn build(self) -> Result<Model, ModelError> {
        if let Some(mistake) = self.mistake {
            return Err(mistake);
        }
        let extents = self.extents.ok_or_else(|| ModelError::NoExtents { model: self.name.clone() })?;
        let geometry = Geometry::new(extents, self.side, self.boundaries, self.neighbourhood);
        check_geometry(&geometry)?;
        if self.groups.is_empty() {
            return Err(ModelError::NoSubstates { model: self.name });
        }
        let (groups, processes) = (self.groups.len(), self.processes.len());
        if groups > Stream::GROUPS {
            return Err(ModelError::TooManyGroups { groups, limit: Stream::GROUPS });
        }
        if processes > Stream::PROCESSES {
            return Err(ModelError::TooManyProcesses { processes, limit: Stream::PROCESSES });
        }
        for group in &self.groups {
            check_group(group, &geometry)?;
        }
        check_names(&self.groups)?;
        for filling in &self.fillings {
            filling.check(&self.groups, &*self.parameters)?;
        }
        for process in &self.processes {
            check_process(process, &self.groups, &*self.parameters)?;
        }
        Ok(Model {
            name: self.name,
            geometry,
            groups: self.groups,
            processes: self.processes,
            parameters: self.parameters,
            steering: self.steering,
            fault_texts: self.fault_texts,
        })
    }
}

fn check_geometry(geometry: &Geometry) -> Result<(), ModelError> {
    let extents = geometry.extents();
    if let Some(axis) = extents.iter().position(|&extent| extent == 0) {
        return Err(ModelError::ZeroExtent { axis: AXES[axis], extents });
    }
    let limit = u64::from(NOWHERE);
    let cells = extents.iter().try_fold(1_u64, |cells, &extent| cells.checked_mul(extent as u64));
    if cells.is_none_or(|cells| cells >= limit) {
        return Err(ModelError::TooManyCells { extents, limit });
    }
    let side = geometry.side();
    if !(side.is_finite() && side > 0.0) {
        return Err(ModelError::CellSide { side });
    }
    let neighbourhood = geometry.neighbourhood();
    for (axis, reach) in neighbourhood.reach().into_iter().enumerate() {
        let (extent, boundary) = (extents[axis], geometry.boundaries()[axis]);
        let fits = match boundary {
            Boundary::Toroidal => reach == 0 || 2 * reach < extent,
            Boundary::Flat | Boundary::Reflecting => reach <= extent,
        };
        if !fits {
            let neighbourhood = neighbourhood.to_string();
            return Err(ModelError::NeighbourhoodTooWide {
                neighbourhood,
                axis: AXES[axis],
                reach,
                extent,
                boundary,
            });
        }
    }
    let alternating = match neighbourhood.parity() {
        Parity::None => return Ok(()),
        Parity::Row => 1,
        Parity::Column => 0,
    };
    match geometry.boundaries()[alternating] {
        Boundary::Toroidal if extents[alternating] % 2 == 1 => {
            Err(ModelError::OddHexagonalTorus { axis: AXES[alternating], extent: extents[alternating] })
        }
        Boundary::Reflecting => Err(ModelError::ReflectedHexagons { axis: AXES[alternating] }),
        _ => Ok(()),
    }
}

fn check_group(group: &Group, geometry: &Geometry) -> Result<(), ModelError> {
    if let GroupKind::Population { .. } = group.kind
        && let Some(axis) =
            geometry.boundaries().iter().position(|boundary| *boundary == Boundary::Reflecting)
    {
        return Err(ModelError::ReflectedPopulation { substates: group.schema.name, axis: AXES[axis] });
    }
    Ok(())
}

fn check_process(
    process: &Process,
    groups: &[Group],
    parameters: &dyn AnyParameters,
) -> Result<(), ModelError> {
    let name = process.name;
    let subject_over_items = process.kind != ProcessKind::Cells;
    let involved = [
        Some((process.subject, subject_over_items)),
        process.companion.map(|group| (group, !subject_over_items)),
    ];
    for (wanted, over_items) in involved.into_iter().flatten() {
        let substates = wanted.schema.name;
        let type_id = (wanted.type_id)();
        let Some(group) = groups.iter().find(|group| group.type_id == type_id) else {
            return Err(ModelError::UnknownSubstates { process: name, substates });
        };
        match (&group.kind, over_items) {
            (GroupKind::Population { .. }, false) => {
                return Err(ModelError::CellsOfPopulation { process: name, substates });
            }
            (GroupKind::Cells { .. }, true) => {
                return Err(ModelError::ItemsOfCells { process: name, substates });
            }
            _ => {}
        }
    }
    if let Some(wanted) = process.parameters
        && (wanted.type_id)() != parameters.parameters_type()
    {
        return Err(ModelError::Parameters {
            process: name,
            wanted: wanted.schema.name,
            given: parameters.schema().name,
        });
    }
    // A substate stands in two accesses only where one of them is the position for a search.
    for (number, access) in process.access.iter().enumerate() {
        let twice = process.access[..number]
            .iter()
            .find(|other| other.of == Of::Subject && access.of == other.of && other.field == access.field);
        if let Some(other) = twice
            && (other.write || access.write)
        {
            let substate = process.subject.schema.fields[access.field].name;
            return Err(ModelError::SearchOfWritten { process: name, substate });
        }
    }
    Ok(())
}

impl fmt::Debug for ModelBuilder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ModelBuilder").field("name", &self.name).finish_non_exhaustive()
    }
}
