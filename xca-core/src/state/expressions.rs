//! Reductions of an expression: of something that is computed from several substates of a cell or an item.

use super::{State, StateError};
use crate::engine::{Population, SubstateId};
use crate::reduction::{Reduced, ReducedRows, Reducible, Reduction};
use xca_process::Substates;

impl State<'_> {
    /// Counts the cells, or the items of a population, that meet a condition.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Lava { thickness: Real, temperature: Real }
    /// # let builder = Model::builder("lava").extents([4, 4, 1]).substates::<Lava>();
    /// # let model = builder.fill(|_| Lava { thickness: 0.5, temperature: 700.0 }).build()?;
    /// # let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// let state = simulation.state();
    /// let crusted = state.count_where(|lava: &Lava| lava.thickness > 0.0 && lava.temperature < 800.0)?;
    /// assert_eq!(crusted, 16);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// Copies all substates of the struct to the host. [`Self::count`] reads one substate, and counts on the
    /// engine.
    ///
    /// # Errors
    /// Returns an error if the model does not have these substates.
    pub fn count_where<S: Substates>(&self, condition: impl Fn(&S) -> bool) -> Result<u64, StateError> {
        let mut count = 0;
        self.for_each(|_, state: &S| count += u64::from(condition(state)))?;
        Ok(count)
    }

    /// Sums an expression over the cells, or over the items of a population: `f64`, or `i64` for integers.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Lava { thickness: Real, temperature: Real }
    /// # let builder = Model::builder("lava").extents([4, 4, 1]).substates::<Lava>();
    /// # let model = builder.fill(|_| Lava { thickness: 0.5, temperature: 700.0 }).build()?;
    /// # let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// let state = simulation.state();
    /// let heat = state.sum_of(|lava: &Lava| lava.thickness * lava.temperature)?;
    /// assert_eq!(heat, 16.0 * 350.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// Rows are summed one by one, then combined in order, as in [`Self::sum`]. All engines therefore give
    /// the same bits. Copies all substates of the struct to the host; [`Self::sum`] reads one substate, and
    /// adds on the engine.
    ///
    /// # Errors
    /// Returns an error if the model does not have these substates.
    pub fn sum_of<S: Substates, V: Reducible>(&self, value: impl Fn(&S) -> V) -> Result<V::Sum, StateError> {
        let mut results: Vec<Reduced> = Vec::new();
        self.for_each(|row, state: &S| {
            let value = value(state);
            results.resize((row + 1) * V::COMPONENTS, Reduced::Nothing);
            for (lane, result) in results[row * V::COMPONENTS..].iter_mut().enumerate() {
                *result = result.combine(value.reduced(lane), &Reduction::Sum);
            }
        })?;
        let rows = ReducedRows { components: V::COMPONENTS, results };
        Ok(V::total(&self.noted(rows.combined(&Reduction::Sum)), 0))
    }

    /// Visits the cells, or the items of a population, row by row, with the number of the row.
    fn for_each<S: Substates>(&self, mut visit: impl FnMut(usize, &S)) -> Result<(), StateError> {
        let group = self.group::<S>()?;
        let stored = self.structure.groups()[group].stored(self.precision);
        let width = self.geometry().extents()[0];
        let (fields, lengths) = if self.is_population(group) {
            let Population { counts, fields, .. } = self.execution.population(group)?;
            let items = |row: &[u32]| row.iter().map(|count| *count as usize).sum();
            (fields, counts.chunks_exact(width).map(items).collect())
        } else {
            let fields = (0..stored.len()).map(|field| self.execution.read(SubstateId { group, field }));
            (fields.collect::<Result<Vec<_>, _>>()?, vec![width; self.geometry().cells() / width])
        };
        let rows = lengths.into_iter().enumerate().flat_map(|(row, length)| std::iter::repeat_n(row, length));
        for (place, row) in rows.enumerate() {
            let bytes = |field: usize| {
                let size = stored[field].size();
                &fields[field][place * size..(place + 1) * size]
            };
            visit(row, &S::decode(self.precision, bytes));
        }
        Ok(())
    }
}
