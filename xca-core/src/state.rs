//! The state of a run as steering and the host see it.

mod cells;
mod error;
mod expressions;
mod initial;
mod parameters;
mod rows;

pub use error::StateError;

use crate::engine::{Execution, Population, SubstateId};
use crate::model::{GroupKind, Structure};
use crate::parameter_set::ParameterSet;
use crate::reduction::{Reduced, Reducible, Reduction};
use xca_process::Geometry;
use xca_process::{Draw, Stream, uniform};
use xca_process::{HostScalar, HostValue};
use xca_process::{Substate, Substates};
use xca_values::{Precision, StoredScalar};

#[doc = include_str!("../docs/state.md")]
pub struct State<'a> {
    pub(crate) structure: &'a Structure,
    pub(crate) execution: &'a mut dyn Execution,
    pub(crate) left_before: &'a [u64],
    pub(crate) parameters: &'a mut ParameterSet,
    pub(crate) precision: Precision,
    pub(crate) seed: u64,
    pub(crate) step: u64,
    /// The number of the steering operation that has the state; for the host beyond all of them.
    pub(crate) operation: u32,
    pub(crate) stop: &'a mut Option<String>,
    /// Whether a reduction has given NaN.
    pub(crate) reduced_nan: std::cell::Cell<bool>,
    /// Whether a stop criterion has asked for such a reduction.
    pub(crate) undecided: bool,
}

/// An item of a population, as [`State::items`] returns it.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Debug, PartialEq)]
/// struct Grain {
///     mass: Real,
/// }
///
/// let item = Item { label: 7, cell: [1, 0, 0], state: Grain { mass: 0.5 } };
/// let builder = Model::builder("grains").extents([3, 1, 1]).population::<Grain>(4);
/// let given = item.clone();
/// let model = builder.initialise(move |state| Ok(state.set_items(vec![given.clone()])?)).build()?;
/// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// assert_eq!(simulation.state().items::<Grain>()?, [item]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Item<S> {
    /// Its label.
    pub label: u32,
    /// The indices of its cell.
    pub cell: [usize; 3],
    /// Its substates.
    pub state: S,
}

impl State<'_> {
    /// The number of steps done.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// The seed of the run's random numbers.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The precision of the run.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// The cellular space.
    pub fn geometry(&self) -> &Geometry {
        self.structure.geometry()
    }

    /// A random number in [0, 1) for steering: a function of seed, step, operation and `draw`.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Rain { depth: Real }
    /// # let builder = Model::builder("rain").extents([8, 8, 1]).substates::<Rain>();
    /// builder.steer(Schedule::Every(1), |state| {
    ///     let x = (8.0 * state.random(0)) as usize;
    ///     Ok(state.update(Rain::DEPTH, &[[x, 0, 0]], |_cell, depth| depth + 1.0)?)
    /// });
    /// ```
    ///
    /// It is independent of the draws of processes and initial states. It has 53 bits in either precision.
    pub fn random(&self, draw: usize) -> f64 {
        uniform(self.words(draw))
    }

    /// The 32 random bits of which [`Self::random`] makes its number.
    pub fn random_bits(&self, draw: usize) -> u32 {
        self.words(draw)[0]
    }

    fn words(&self, draw: usize) -> [u32; 4] {
        let (stream, step, owner) = (Stream::STEERING, self.step, self.operation);
        Draw { stream, step, owner, number: draw as u32 }.words(self.seed)
    }

    /// Ends the run. The reason appears in the report.
    pub fn stop(&mut self, reason: impl Into<String>) {
        self.stop.get_or_insert(reason.into());
    }

    fn group<S: Substates>(&self) -> Result<usize, StateError> {
        self.structure.group_of::<S>().ok_or(StateError::UnknownSubstates(S::SCHEMA.name))
    }

    fn is_population(&self, group: usize) -> bool {
        matches!(self.structure.groups()[group].kind(), GroupKind::Population { .. })
    }

    fn population_of<S: Substates>(&self) -> Result<usize, StateError> {
        let group = self.group::<S>()?;
        if self.is_population(group) { Ok(group) } else { Err(StateError::NotAPopulation(S::SCHEMA.name)) }
    }

    fn cells_of<S: Substates>(&self) -> Result<usize, StateError> {
        let group = self.group::<S>()?;
        if self.is_population(group) { Err(StateError::NotOfCells(S::SCHEMA.name)) } else { Ok(group) }
    }

    fn id<S: Substates, V: HostValue>(&self, substate: Substate<S, V>) -> Result<SubstateId, StateError> {
        Ok(SubstateId { group: self.group::<S>()?, field: substate.index() })
    }

    fn cell(&self, cell: [usize; 3]) -> Result<usize, StateError> {
        let extents = self.geometry().extents();
        if cell.iter().zip(extents).all(|(index, extent)| *index < extent) {
            Ok(self.geometry().linear(cell))
        } else {
            Err(StateError::NoSuchCell { cell, extents })
        }
    }

    /// All values of a substate. Cells come by linear index (x fastest), items by cell and label.
    ///
    /// # Errors
    /// Returns an error if the model does not have the substate.
    pub fn read<S: Substates, V: HostValue>(&self, substate: Substate<S, V>) -> Result<Vec<V>, StateError> {
        let id = self.id(substate)?;
        let stored = self.structure.stored(id, self.precision);
        Ok(self
            .execution
            .read(id)?
            .chunks_exact(stored.size())
            .map(|bytes| V::decode(stored, bytes))
            .collect())
    }

    /// Replaces all values of a substate, in the order of [`Self::read`].
    ///
    /// # Errors
    /// Returns an error if the model does not have the substate, or the number of values is wrong.
    pub fn write<S: Substates, V: HostValue>(
        &mut self,
        substate: Substate<S, V>,
        values: &[V],
    ) -> Result<(), StateError> {
        let id = self.id(substate)?;
        let stored = self.structure.stored(id, self.precision);
        let wanted = if self.is_population(id.group) {
            self.execution.items(id.group)
        } else {
            self.geometry().cells()
        };
        if values.len() != wanted {
            return Err(StateError::WrongNumber { substate: substate.name(), wanted, given: values.len() });
        }
        let mut bytes = vec![0; stored.size() * values.len()];
        for (value, bytes) in values.iter().zip(bytes.chunks_exact_mut(stored.size())) {
            value.encode(stored, bytes);
        }
        Ok(self.execution.write(id, &bytes)?)
    }

    /// The items of a population, by cell and label.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Fish { age: u32 }
    /// # let builder = Model::builder("sea").extents([4, 4, 1]).population::<Fish>(2);
    /// # let model = builder.populate(|_| [Fish { age: 3 }]).build()?;
    /// # let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// let old = simulation.state().items::<Fish>()?.iter().filter(|item| item.state.age > 2).count();
    /// # assert_eq!(old, 16);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the model does not have the population.
    pub fn items<S: Substates>(&self) -> Result<Vec<Item<S>>, StateError> {
        let group = self.population_of::<S>()?;
        let sizes = self.structure.groups()[group].sizes(self.precision);
        let population = self.execution.population(group)?;
        let mut items = Vec::with_capacity(population.labels.len());
        let cells =
            population.counts.iter().enumerate().flat_map(|(cell, count)| (0..*count).map(move |_| cell));
        for (index, (cell, label)) in cells.zip(&population.labels).enumerate() {
            let bytes =
                |field: usize| &population.fields[field][index * sizes[field]..(index + 1) * sizes[field]];
            let state = S::decode(self.precision, bytes);
            items.push(Item { label: *label, cell: self.geometry().indices(cell), state });
        }
        Ok(items)
    }

    /// Replaces the items of a population, in any order.
    ///
    /// # Errors
    /// Returns an error if the model does not have the population, two items have one label, or a cell is
    /// outside the space or has too few slots.
    pub fn set_items<S: Substates>(&mut self, mut items: Vec<Item<S>>) -> Result<(), StateError> {
        let group = self.population_of::<S>()?;
        let mut labels: Vec<u32> = items.iter().map(|item| item.label).collect();
        labels.sort_unstable();
        if let Some(pair) = labels.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(StateError::LabelTwice(pair[0]));
        }
        let mut counts = vec![0; self.geometry().cells()];
        for item in &items {
            counts[self.cell(item.cell)?] += 1;
        }
        let geometry = self.geometry();
        items.sort_unstable_by_key(|item| (geometry.linear(item.cell), item.label));
        let width = geometry.extents()[0];
        let mut items = items.into_iter();
        self.set_items_of_rows(group, |state, rows| {
            let counts = counts[rows.start * width..rows.end * width].to_vec();
            let count = counts.iter().map(|count| *count as usize).sum();
            let (labels, states): (Vec<u32>, Vec<S>) =
                items.by_ref().take(count).map(|item| (item.label, item.state)).unzip();
            Population { counts, labels, fields: state.encoded(group, states.into_iter()) }
        })
    }

    /// The number of items of a population.
    ///
    /// # Errors
    /// As [`Self::items`].
    pub fn count_items<S: Substates>(&self) -> Result<usize, StateError> {
        Ok(self.execution.items(self.population_of::<S>()?))
    }

    /// The number of items of a population that left the space.
    ///
    /// # Errors
    /// As [`Self::items`].
    pub fn count_left<S: Substates>(&self) -> Result<u64, StateError> {
        let group = self.population_of::<S>()?;
        Ok(self.left_before[group].wrapping_add(self.execution.left(group)))
    }

    /// The largest number of items in a cell.
    ///
    /// # Errors
    /// As [`Self::items`].
    pub fn largest_occupancy<S: Substates>(&self) -> Result<u32, StateError> {
        Ok(self.execution.largest_occupancy(self.population_of::<S>()?)?)
    }

    /// Applies any [`Reduction`] to a substate, component by component.
    ///
    /// # Errors
    /// Returns an error if the model does not have the substate, or for bits of floating-point numbers.
    pub fn reduce<S: Substates, V: HostValue>(
        &self,
        substate: Substate<S, V>,
        reduction: &Reduction,
    ) -> Result<Vec<Reduced>, StateError> {
        let id = self.id(substate)?;
        let of_bits = matches!(reduction, Reduction::BitAnd | Reduction::BitOr | Reduction::BitXor);
        let scalar = self.structure.stored(id, self.precision).scalar;
        if of_bits && matches!(scalar, StoredScalar::F32 | StoredScalar::F64) {
            return Err(StateError::BitsOfFloats(substate.name()));
        }
        Ok(self.noted(self.execution.reduce(id, reduction)?))
    }

    /// Remembers for stop criteria whether a result is NaN.
    fn noted(&self, results: Vec<Reduced>) -> Vec<Reduced> {
        let is_nan = |result: &Reduced| result.number().is_some_and(f64::is_nan);
        self.reduced_nan.set(self.reduced_nan.get() || results.iter().any(is_nan));
        results
    }

    /// The sum of a substate: `f64`, or `i64` for integers.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Pond { depth: Real }
    /// # let builder = Model::builder("pond").extents([4, 4, 1]).substates::<Pond>();
    /// # let model = builder.fill(|_| Pond { depth: 0.5 }).build()?;
    /// # let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// assert_eq!(simulation.state().sum(Pond::DEPTH)?, 8.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn sum<S: Substates, V: Reducible>(&self, substate: Substate<S, V>) -> Result<V::Sum, StateError> {
        Ok(V::total(&self.reduce(substate, &Reduction::Sum)?, 0))
    }

    /// The product of a substate: `f64`, or `i64` for integers. 1 for an empty population.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn product<S: Substates, V: Reducible>(
        &self,
        substate: Substate<S, V>,
    ) -> Result<V::Sum, StateError> {
        Ok(V::total(&self.reduce(substate, &Reduction::Product)?, 1))
    }

    /// The smallest value of a substate, component by component. `None` for an empty population.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn minimum<S: Substates, V: Reducible>(
        &self,
        substate: Substate<S, V>,
    ) -> Result<Option<V>, StateError> {
        Ok(V::same(&self.reduce(substate, &Reduction::Minimum)?))
    }

    /// The largest value of a substate, component by component. `None` for an empty population.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn maximum<S: Substates, V: Reducible>(
        &self,
        substate: Substate<S, V>,
    ) -> Result<Option<V>, StateError> {
        Ok(V::same(&self.reduce(substate, &Reduction::Maximum)?))
    }

    /// The number of cells or items with this value of a scalar substate.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn count<S: Substates, V: HostValue<Scalar = V> + HostScalar>(
        &self,
        substate: Substate<S, V>,
        value: V,
    ) -> Result<u64, StateError> {
        let stored = self.structure.stored(self.id(substate)?, self.precision);
        let mut bytes = vec![0; stored.size()];
        HostValue::encode(&value, stored, &mut bytes);
        let results = self.reduce(substate, &Reduction::CountEqual(bytes))?;
        Ok(match results.first() {
            Some(Reduced::Integer(count)) => count.unsigned_abs(),
            _ => 0,
        })
    }
}

impl std::fmt::Debug for State<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("State")
            .field("model", &self.structure.name())
            .field("step", &self.step)
            .finish_non_exhaustive()
    }
}
