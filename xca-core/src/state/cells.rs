//! Single cells of the state: looked at, set, changed.

use super::{State, StateError};
use crate::engine::SubstateId;
use std::collections::HashMap;
use xca_process::HostValue;
use xca_process::{Substate, Substates};

impl State<'_> {
    /// The value of a substate in one cell.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Pond { depth: Real }
    /// # let model = Model::builder("pond").extents([8, 8, 1]).substates::<Pond>().build()?;
    /// # let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// let depth = simulation.state().get(Pond::DEPTH, [3, 4, 0])?;
    /// assert_eq!(depth, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the model does not have the substate, or the space does not have the cell.
    pub fn get<S: Substates, V: HostValue>(
        &self,
        substate: Substate<S, V>,
        cell: [usize; 3],
    ) -> Result<V, StateError> {
        let id = self.of_cells(substate)?;
        let bytes = self.execution.read_cells(id, &[self.cell(cell)?])?;
        Ok(V::decode(self.structure.stored(id, self.precision), &bytes))
    }

    /// The values of a substate in several cells, in their order. The engine reads them in one go.
    ///
    /// # Errors
    /// As [`Self::get`].
    pub fn get_cells<S: Substates, V: HostValue>(
        &self,
        substate: Substate<S, V>,
        cells: &[[usize; 3]],
    ) -> Result<Vec<V>, StateError> {
        let id = self.of_cells(substate)?;
        self.values_of(id, &self.numbers(cells)?)
    }

    /// Sets the value of a substate in one cell.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Pond { depth: Real }
    /// # let model = Model::builder("pond").extents([8, 8, 1]).substates::<Pond>().build()?;
    /// # let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// let mut state = simulation.state();
    /// state.set(Pond::DEPTH, [3, 4, 0], 1.5)?;
    /// assert_eq!(state.get(Pond::DEPTH, [3, 4, 0])?, 1.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::get`].
    pub fn set<S: Substates, V: HostValue>(
        &mut self,
        substate: Substate<S, V>,
        cell: [usize; 3],
        value: V,
    ) -> Result<(), StateError> {
        self.set_cells(substate, [(cell, value)])
    }

    /// Sets the values of a substate in several cells. The engine writes them in one go.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Pond { depth: Real }
    /// # let model = Model::builder("pond").extents([8, 8, 1]).substates::<Pond>().build()?;
    /// # let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// let mut state = simulation.state();
    /// let shore = (0..8).map(|x| ([x, 0, 0], 0.1));
    /// state.set_cells(Pond::DEPTH, shore)?;
    /// assert!((state.sum(Pond::DEPTH)? - 0.8).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// If a cell is listed twice, the last value counts.
    ///
    /// # Errors
    /// As [`Self::get`]. After an error no cell has changed.
    pub fn set_cells<S: Substates, V: HostValue>(
        &mut self,
        substate: Substate<S, V>,
        values: impl IntoIterator<Item = ([usize; 3], V)>,
    ) -> Result<(), StateError> {
        let id = self.of_cells(substate)?;
        let (cells, values): (Vec<_>, Vec<V>) = values.into_iter().unzip();
        let numbers = self.numbers(&cells)?;
        self.set_values_of(id, &numbers, &values)
    }

    /// Changes the values of a substate in several cells: adds lava at the vents, heat at a source.
    ///
    /// ```
    /// use xca_core::prelude::*;
    ///
    /// #[derive(Substates, Clone, Copy)]
    /// struct Lava {
    ///     thickness: Real,
    /// }
    ///
    /// const VENTS: [[usize; 3]; 2] = [[3, 4, 0], [5, 4, 0]];
    ///
    /// let model = Model::builder("lava")
    ///     .extents([8, 8, 1])
    ///     .substates::<Lava>()
    ///     .steer(Schedule::Every(1), |state| {
    ///         Ok(state.update(Lava::THICKNESS, &VENTS, |_cell, thickness| thickness + 0.5)?)
    ///     })
    ///     .build()?;
    /// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// simulation.run(3)?;
    /// assert_eq!(simulation.state().sum(Lava::THICKNESS)?, 3.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// The engine reads all cells in one go and writes them in one go. A cell that is listed twice changes
    /// twice.
    ///
    /// # Errors
    /// As [`Self::get`]. After an error no cell has changed.
    pub fn update<S: Substates, V: HostValue>(
        &mut self,
        substate: Substate<S, V>,
        cells: &[[usize; 3]],
        mut change: impl FnMut([usize; 3], V) -> V,
    ) -> Result<(), StateError> {
        let id = self.of_cells(substate)?;
        let mut numbers = self.numbers(cells)?;
        let mut places = HashMap::new();
        numbers.retain(|number| {
            let place = places.len();
            let first = !places.contains_key(number);
            places.entry(*number).or_insert(place);
            first
        });
        let mut values: Vec<V> = self.values_of(id, &numbers)?;
        for cell in cells {
            let value = &mut values[places[&self.geometry().linear(*cell)]];
            *value = change(*cell, *value);
        }
        self.set_values_of(id, &numbers, &values)
    }

    /// A substate of cells.
    fn of_cells<S: Substates, V: HostValue>(
        &self,
        substate: Substate<S, V>,
    ) -> Result<SubstateId, StateError> {
        self.cells_of::<S>()?;
        self.id(substate)
    }

    /// The linear indices of cells.
    fn numbers(&self, cells: &[[usize; 3]]) -> Result<Vec<usize>, StateError> {
        cells.iter().map(|cell| self.cell(*cell)).collect()
    }

    fn values_of<V: HostValue>(&self, id: SubstateId, numbers: &[usize]) -> Result<Vec<V>, StateError> {
        let stored = self.structure.stored(id, self.precision);
        let bytes = self.execution.read_cells(id, numbers)?;
        Ok(bytes.chunks_exact(stored.size()).map(|bytes| V::decode(stored, bytes)).collect())
    }

    fn set_values_of<V: HostValue>(
        &mut self,
        id: SubstateId,
        numbers: &[usize],
        values: &[V],
    ) -> Result<(), StateError> {
        let stored = self.structure.stored(id, self.precision);
        let mut bytes = vec![0; stored.size() * values.len()];
        for (value, bytes) in values.iter().zip(bytes.chunks_exact_mut(stored.size())) {
            value.encode(stored, bytes);
        }
        Ok(self.execution.write_cells(id, numbers, &bytes)?)
    }
}
