//! The definition of a model.

use super::check::{check_geometry, check_group, check_opposites, check_process};
use super::filling_check::Filling;
use super::names::check_names;
use super::{Group, GroupKind, Model, ModelError, Structure, WriteOutside};
use crate::engine::SubstateId;
use crate::parameter_set::ParameterSet;
use crate::plan::Plan;
use crate::steering::{Schedule, Steering};
use std::any::TypeId;
use std::fmt;
use std::sync::Arc;
use xca_process::Neighbourhood;
use xca_process::Parameters;
use xca_process::Stream;
use xca_process::Substates;
use xca_process::{Boundary, Face, Faces, Geometry};
use xca_process::{Process, Processes};
use xca_values::Precision;

/// Collects the definition of a model. [`Model::builder`] makes one; [`ModelBuilder::build`] checks it and
/// reports mistakes.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Heat {
///     temperature: Real,
/// }
///
/// #[elementary_process]
/// fn conduct(cell: &mut Cell<Heat>) {
///     let mut sum = 0.0;
///     for n in 1..cell.neighbour_count() {
///         sum += cell.neighbour(n).temperature - cell.temperature;
///     }
///     cell.temperature += 0.2 * sum;
/// }
///
/// let model = Model::builder("plate")
///     .extents([32, 32, 1])
///     .cell_side(0.01)
///     .neighbourhood(Neighbourhood::von_neumann_2d(1))
///     .boundary(Boundary::Reflecting)
///     .substates::<Heat>()
///     .process(conduct)
///     .fill(|_| Heat { temperature: 20.0 })
///     .steer(Schedule::Every(1), |state| Ok(state.set(Heat::TEMPERATURE, [16, 16, 0], 100.0)?))
///     .build()?;
/// assert_eq!(model.geometry().cells(), 1024);
/// # Ok::<(), ModelError>(())
/// ```
///
/// Defaults: cell side 1 m, no neighbours, flat boundaries.
#[must_use = "call `build` to get the model"]
pub struct ModelBuilder {
    name: String,
    extents: Option<[usize; 3]>,
    side: f64,
    boundaries: Faces<Boundary>,
    neighbourhood: Neighbourhood,
    pub(super) groups: Vec<Group>,
    /// The faces that were given outside values of their own.
    outsides: Vec<Outside>,
    processes: Vec<Process>,
    parameters: ParameterSet,
    pub(super) steering: Vec<Steering>,
    pub(super) watches: Vec<Schedule>,
    pub(super) may_be_non_finite: Vec<SubstateId>,
    pub(super) fillings: Vec<Filling>,
    fault_texts: Vec<(u32, String)>,
    pub(super) mistake: Option<ModelError>,
}

/// Substates that have values of their own beyond a face.
struct Outside {
    substates: &'static str,
    face: Face,
}

impl Model {
    /// Starts the definition of a model.
    pub fn builder(name: impl Into<String>) -> ModelBuilder {
        ModelBuilder::new(name.into())
    }
}

impl ModelBuilder {
    fn new(name: String) -> Self {
        Self {
            name,
            extents: None,
            side: 1.0,
            boundaries: Faces::all(Boundary::Flat),
            neighbourhood: Neighbourhood::von_neumann(0),
            groups: Vec::new(),
            outsides: Vec::new(),
            processes: Vec::new(),
            parameters: ParameterSet::default(),
            steering: Vec::new(),
            watches: Vec::new(),
            may_be_non_finite: Vec::new(),
            fillings: Vec::new(),
            fault_texts: Vec::new(),
            mistake: None,
        }
    }

    /// The number of cells along x, y, z. A two-dimensional model is one layer: `[x, y, 1]`.
    pub fn extents(mut self, extents: [usize; 3]) -> Self {
        self.extents = Some(extents);
        self
    }

    /// The side of a cell in metres. Default: 1.
    pub fn cell_side(mut self, side: f64) -> Self {
        self.side = side;
        self
    }

    /// The cells that a process sees. Default: the cell itself.
    pub fn neighbourhood(mut self, neighbourhood: Neighbourhood) -> Self {
        self.neighbourhood = neighbourhood;
        self
    }

    /// The same boundary at all faces. Default: flat.
    pub fn boundary(self, boundary: Boundary) -> Self {
        self.boundaries(Faces::all(boundary))
    }

    /// The boundaries of all faces: one for each of the axes x, y, z, or one for each face.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// Model::builder("channel").boundaries([Boundary::Toroidal, Boundary::Flat, Boundary::Flat]);
    /// Model::builder("slope")
    ///     .boundaries(Faces { north: Boundary::Flat, ..Faces::all(Boundary::Reflecting) });
    /// ```
    pub fn boundaries(mut self, boundaries: impl Into<Faces<Boundary>>) -> Self {
        self.boundaries = boundaries.into();
        self
    }

    /// Sets the boundary of one face and keeps those of the others. A toroidal boundary joins two faces, so
    /// both faces of the axis need it.
    pub fn face(mut self, face: Face, boundary: Boundary) -> Self {
        self.boundaries[face] = boundary;
        self
    }

    /// Adds the substates `S` of cells. Their value beyond flat faces is zero.
    pub fn substates<S: Substates>(self) -> Self {
        self.add_group::<S>(GroupKind::Cells { outside: Faces::all(Arc::new(|_, _, bytes| bytes.fill(0))) })
    }

    /// Adds the substates `S` of cells, with these values beyond all flat faces.
    pub fn substates_with_outside<S: Substates>(self, outside: S) -> Self {
        self.add_group::<S>(GroupKind::Cells { outside: Faces::all(encoder(outside)) })
    }

    /// Sets the values of the substates `S` beyond one flat face: a moving lid, an inflow.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Heat { temperature: Real }
    /// let builder = Model::builder("oven").extents([8, 8, 8]).substates::<Heat>();
    /// let model = builder.outside(Face::Bottom, Heat { temperature: 200.0 }).build()?;
    /// # Ok::<(), ModelError>(())
    /// ```
    ///
    /// A neighbour beyond several flat faces takes the value of one of them: z before y, y before x.
    pub fn outside<S: Substates>(mut self, face: Face, outside: S) -> Self {
        let substates = S::SCHEMA.name;
        let group = self.groups.iter_mut().find(|group| group.type_id == TypeId::of::<S>());
        let mistake = match group.map(|group| &mut group.kind) {
            Some(GroupKind::Cells { outside: values }) => {
                values[face] = encoder(outside);
                self.outsides.push(Outside { substates, face });
                return self;
            }
            Some(GroupKind::Population { .. }) => ModelError::OutsideOfItems { substates },
            None => ModelError::NotAdded { substates },
        };
        self.mistake.get_or_insert(mistake);
        self
    }

    /// Adds a population of items with the substates `S`. A cell holds at most `slots` of them.
    pub fn population<S: Substates>(mut self, slots: usize) -> Self {
        if slots == 0 {
            self.mistake.get_or_insert(ModelError::NoSlots { substates: S::SCHEMA.name });
        }
        self.add_group::<S>(GroupKind::Population { slots, may_leave: false })
    }

    /// Allows migrations to send items of the population `S` out of the space.
    /// [`crate::State::count_left`] counts them.
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

    /// Adds a struct of parameters with their initial values. A model may have several structs. A second one
    /// of the same type replaces the first.
    pub fn parameters<P: Parameters>(mut self, parameters: P) -> Self {
        self.parameters.add(parameters);
        self
    }

    /// Computes parameters of the struct `P` from its other ones, each time one of them is set. Mark the
    /// results as `#[parameter(computed)]`: nothing else can set them.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Air { speed: Real }
    /// #[derive(Parameters, Clone, Debug)]
    /// struct Flow {
    ///     viscosity: Real,
    ///     #[parameter(computed)]
    ///     relaxation: Real,
    /// }
    ///
    /// let mut model = Model::builder("flow").extents([8, 8, 1]).substates::<Air>()
    ///     .parameters(Flow { viscosity: 0.1, relaxation: 0.0 })
    ///     .compute_parameters(|flow: &mut Flow| flow.relaxation = 0.5 + 3.0 * flow.viscosity)
    ///     .build()?;
    /// model.set_parameter("viscosity", "0.5")?;
    /// assert_eq!(model.parameters().value_by_name("relaxation")?.to_string(), "2");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn compute_parameters<P: Parameters>(
        mut self,
        computation: impl Fn(&mut P) + Send + Sync + 'static,
    ) -> Self {
        self.parameters.compute(computation);
        self
    }

    /// Adds an elementary process or a migration, or a tuple of them. Processes run in the order of addition.
    pub fn process<P: Processes>(mut self, _processes: P) -> Self {
        P::add_to(&mut self.processes);
        self
    }

    /// Adds processes that run at an interval of steps: with 10, in step 10, 20, 30 and so on.
    pub fn process_every<P: Processes>(mut self, interval: u64, _processes: P) -> Self {
        if interval == 0 {
            self.mistake.get_or_insert(ModelError::ZeroInterval);
        }
        let first = self.processes.len();
        P::add_to(&mut self.processes);
        for process in &mut self.processes[first..] {
            process.every = interval;
        }
        self
    }

    /// Adds processes that run several times in each step: `repeat(4, (red, black))` runs red, black, red,
    /// black and so on, four times each.
    pub fn repeat<P: Processes>(mut self, times: u32, _processes: P) -> Self {
        if times == 0 {
            self.mistake.get_or_insert(ModelError::ZeroRepeats);
        }
        for _ in 0..times {
            P::add_to(&mut self.processes);
        }
        self
    }

    /// Sets the message for a fault code.
    pub fn fault_text(mut self, code: u32, text: impl Into<String>) -> Self {
        self.fault_texts.push((code, text.into()));
        self
    }

    /// Checks the definition and makes the model.
    ///
    /// # Errors
    /// Returns the first mistake. Its message says what to change.
    pub fn build(self) -> Result<Model, ModelError> {
        if let Some(mistake) = self.mistake {
            return Err(mistake);
        }
        let extents = self.extents.ok_or_else(|| ModelError::NoExtents { model: self.name.clone() })?;
        let geometry = Geometry::new(extents, self.side, self.boundaries, self.neighbourhood);
        check_geometry(&geometry)?;
        for Outside { substates, face } in self.outsides {
            let boundary = geometry.boundaries()[face];
            if boundary != Boundary::Flat {
                return Err(ModelError::OutsideUnseen { substates, face, boundary });
            }
        }
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
            filling.check(&self.groups, &self.parameters)?;
        }
        for process in &self.processes {
            check_process(process, &self.groups, &self.parameters)?;
            check_opposites(process, geometry.neighbourhood())?;
        }
        let mut parameters = self.parameters;
        parameters.change(Precision::F64, |_| Ok(()))?;
        Ok(Model {
            plan: Plan::new(&self.processes, &self.groups),
            structure: Structure { name: self.name, geometry, groups: self.groups },
            processes: self.processes,
            parameters,
            steering: self.steering,
            watches: self.watches,
            may_be_non_finite: self.may_be_non_finite,
            fault_texts: self.fault_texts,
        })
    }
}

fn encoder<S: Substates>(outside: S) -> Arc<WriteOutside> {
    Arc::new(move |field, precision, bytes| outside.encode(field, precision, bytes))
}

impl fmt::Debug for ModelBuilder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ModelBuilder").field("name", &self.name).finish_non_exhaustive()
    }
}
