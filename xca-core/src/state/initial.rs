//! Whole structs of substates, and whole populations, made cell by cell.

use super::{State, StateError};
use crate::engine::{Population, SubstateId};
use crate::site::{Site, Sites};
use xca_process::Parameters;
use xca_process::Substates;

/// The size of the blocks in which cells are filled, in bytes.
const BLOCK: usize = 1 << 22;

impl State<'_> {
    fn sites(&self, group: usize) -> Sites<'_> {
        let (geometry, step) = (self.structure.geometry(), self.step);
        Sites { geometry, group, step, seed: self.seed }
    }

    /// Sets the state of every cell.
    ///
    /// # Errors
    /// Returns an error if the model does not have these substates of cells.
    pub fn fill<S: Substates>(&mut self, state: impl Fn(Site) -> S) -> Result<(), StateError> {
        let group = self.cells_of::<S>()?;
        let [width, height, depth] = self.geometry().extents();
        let sizes = self.structure.groups()[group].sizes(self.precision);
        // An engine that takes rows needs no second copy of the whole group.
        let by_rows =
            !sizes.is_empty() && self.execution.write_rows(SubstateId { group, field: 0 }, 0..0, &[])?;
        let size_of_row = width * sizes.iter().sum::<usize>();
        let step = if by_rows { (BLOCK / size_of_row.max(1)).max(1) } else { height * depth };
        for start in (0..height * depth).step_by(step) {
            let rows = start..(start + step).min(height * depth);
            let sites = self.sites(group).within(rows.start * width..rows.end * width);
            let fields = self.encoded(group, sites.map(&state));
            for (field, bytes) in fields.iter().enumerate() {
                let substate = SubstateId { group, field };
                if by_rows {
                    self.execution.write_rows(substate, rows.clone(), bytes)?;
                } else {
                    self.execution.write(substate, bytes)?;
                }
            }
        }
        Ok(())
    }

    /// Sets the state of every cell from the parameters.
    ///
    /// # Errors
    /// As [`Self::fill`], or if the model does not have the parameters.
    pub fn fill_with<S: Substates, P: Parameters>(
        &mut self,
        state: impl Fn(Site, &P) -> S,
    ) -> Result<(), StateError> {
        let parameters = self.parameters::<P>()?;
        self.fill(|site| state(site, &parameters))
    }

    /// Replaces all items of a population. The function returns the items of each cell.
    ///
    /// Labels count from 0, cell by cell (x fastest), in the order of the items within a cell.
    ///
    /// # Errors
    /// Returns an error if the model does not have the population, or a cell has too few slots.
    pub fn populate<S: Substates, I: IntoIterator<Item = S>>(
        &mut self,
        items: impl Fn(Site) -> I,
    ) -> Result<(), StateError> {
        let group = self.population_of::<S>()?;
        let width = self.geometry().extents()[0];
        let mut first = 0_u32;
        self.set_items_of_rows(group, |state, rows| {
            let (mut counts, mut states) = (Vec::with_capacity(width * rows.len()), Vec::new());
            for site in state.sites(group).within(rows.start * width..rows.end * width) {
                let before = states.len();
                states.extend(items(site));
                counts.push((states.len() - before) as u32);
            }
            let count = states.len() as u32;
            let labels = (0..count).map(|number| first.wrapping_add(number)).collect();
            first = first.wrapping_add(count);
            Population { counts, labels, fields: state.encoded(group, states.into_iter()) }
        })
    }

    /// As [`Self::populate`], with the parameters.
    ///
    /// # Errors
    /// As [`Self::populate`], or if the model does not have the parameters.
    pub fn populate_with<S: Substates, P: Parameters, I: IntoIterator<Item = S>>(
        &mut self,
        items: impl Fn(Site, &P) -> I,
    ) -> Result<(), StateError> {
        let parameters = self.parameters::<P>()?;
        self.populate(|site| items(site, &parameters))
    }

    /// The stored bytes of each field of these states.
    pub(super) fn encoded<S: Substates>(
        &self,
        group: usize,
        states: impl Iterator<Item = S>,
    ) -> Vec<Vec<u8>> {
        let sizes = self.structure.groups()[group].sizes(self.precision);
        let count = states.size_hint().0;
        let mut fields: Vec<Vec<u8>> = sizes.iter().map(|size| Vec::with_capacity(size * count)).collect();
        for state in states {
            for (field, (bytes, size)) in fields.iter_mut().zip(&sizes).enumerate() {
                let start = bytes.len();
                bytes.resize(start + size, 0);
                state.encode(field, self.precision, &mut bytes[start..]);
            }
        }
        fields
    }
}
