//! The whole state block by block, for files that need not be in memory as a whole.

use super::snapshot::{GroupSnapshot, ItemCounts, Outline};
use super::{RunError, RunOptions, Simulation};
use crate::engine::{Engine, EngineFailure, Plane, Population, SubstateId, check_plane};
use crate::model::{Group, GroupKind, Model};
use std::ops::Range;

impl Simulation {
    /// The state without its planes.
    pub fn outline(&self) -> Outline {
        let of_group = |(group, definition): (usize, &Group)| match definition.kind() {
            GroupKind::Cells { .. } => None,
            GroupKind::Population { .. } => {
                Some(ItemCounts { items: self.execution.items(group), left: self.left(group) })
            }
        };
        Outline {
            step: self.step,
            populations: self.model.groups().iter().enumerate().map(of_group).collect(),
            parameters: self.parameters.bits(),
            stop: self.stop.clone(),
            broken: self.is_broken(),
        }
    }

    /// Passes on all planes, in the order of the groups and of [`Plane::of_group`]. An engine that reads rows
    /// gives blocks of whole rows, of up to `size` bytes if a row has no more. Others give whole planes.
    ///
    /// ```
    /// use xca_core::prelude::*;
    ///
    /// #[derive(Substates, Clone)]
    /// struct Site {
    ///     age: u32,
    /// }
    ///
    /// let builder = Model::builder("site").extents([8, 8, 1]).substates::<Site>();
    /// let model = builder.fill(|site| Site { age: site.cell()[0] as u32 }).build()?;
    /// let simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// let mut bytes = 0;
    /// simulation.read_blocks(1 << 20, |_plane, block| {
    ///     bytes += block.len();
    ///     Ok::<(), xca_core::EngineFailure>(())
    /// })?;
    /// assert_eq!(bytes, 8 * 8 * 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the engine lost its state, or that of `take`.
    pub fn read_blocks<E: From<EngineFailure>>(
        &self,
        size: usize,
        mut take: impl FnMut(Plane, &[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        for (number, group) in self.model.groups().iter().enumerate() {
            let planes = Plane::of_group(number, group);
            let Some(first) = planes.first() else { continue };
            if self.execution.read_rows(*first, 0..0)?.is_some() {
                self.read_rows_of(&planes, size, &mut take)?;
            } else if let GroupKind::Cells { .. } = group.kind() {
                for field in 0..group.schema().fields.len() {
                    let substate = SubstateId { group: number, field };
                    take(Plane::Values(substate), &self.execution.read(substate)?)?;
                }
            } else {
                self.snapshot_of(number, group)?.planes(number, &mut take)?;
            }
        }
        Ok(())
    }

    /// Passes on all values of a substate: of cells in blocks as those of [`Self::read_blocks`], of items at
    /// once.
    ///
    /// # Errors
    /// As [`Self::read_blocks`], or if there is no such substate.
    pub fn read_substate<E: From<EngineFailure>>(
        &self,
        substate: SubstateId,
        size: usize,
        mut take: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let plane = Plane::Values(substate);
        check_plane(&self.model, plane).map_err(EngineFailure::Input)?;
        let is_of_cells = matches!(self.model.groups()[substate.group].kind(), GroupKind::Cells { .. });
        if is_of_cells && self.execution.read_rows(plane, 0..0)?.is_some() {
            self.read_rows_of(&[plane], size, &mut |_, block| take(block))
        } else {
            take(&self.execution.read(substate)?)
        }
    }

    /// The values of a substate in the cells with these linear indices, in their order.
    ///
    /// # Errors
    /// Returns an error if there is no such substate or cell, or the engine lost its state.
    pub fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure> {
        self.execution.read_cells(substate, cells)
    }

    /// Passes on the planes of a group by rows.
    fn read_rows_of<E: From<EngineFailure>>(
        &self,
        planes: &[Plane],
        size: usize,
        take: &mut impl FnMut(Plane, &[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let [width, height, depth] = self.model.geometry().extents();
        let mut items = Vec::new();
        for plane in planes {
            let mut start = 0;
            while start < height * depth {
                let lengths = self.lengths(*plane, &items, start..height * depth);
                let end = start + rows_in_block(lengths, size);
                let block = self.execution.read_rows(*plane, start..end)?.unwrap_or_default();
                if let Plane::Counts(_) = plane {
                    items.extend(items_of_rows(&block, width));
                }
                take(*plane, &block)?;
                start = end;
            }
        }
        Ok(())
    }

    /// Starts a model on an engine in a state whose planes are read block by block: in the order, and with
    /// the bytes, of [`Self::read_blocks`]. An engine that takes rows gets blocks of whole rows of cells, of
    /// up to `size` bytes if a row has no more. Others get whole planes, and populations are whole on any
    /// engine.
    ///
    /// ```
    /// use xca_core::prelude::*;
    ///
    /// #[derive(Substates, Clone)]
    /// struct Site {
    ///     age: u32,
    /// }
    ///
    /// let model = Model::builder("site").extents([8, 8, 1]).substates::<Site>().build()?;
    /// let outline = Simulation::new(&model, &Reference, RunOptions::default())?.outline();
    /// let mut ages = (0..64_u32).flat_map(u32::to_ne_bytes);
    /// let read = |_, block: &mut [u8]| {
    ///     block.iter_mut().zip(&mut ages).for_each(|(byte, next)| *byte = next);
    ///     Ok::<(), RunError>(())
    /// };
    /// let options = RunOptions::default();
    /// let mut simulation = Simulation::resume_blocks(&model, &Reference, options, &outline, 64, read)?;
    /// assert_eq!(simulation.state().get(Site::AGE, [7, 7, 0])?, 63);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the engine cannot run the model, as [`Self::restore`], or that of `read`.
    pub fn resume_blocks<E: From<RunError>>(
        model: &Model,
        engine: &dyn Engine,
        options: RunOptions,
        outline: &Outline,
        size: usize,
        mut read: impl FnMut(Plane, &mut [u8]) -> Result<(), E>,
    ) -> Result<Self, E> {
        outline.check(model, options.precision).map_err(RunError::from)?;
        let mut simulation = Self::empty(model, engine, options)?;
        for (group, population) in outline.populations.iter().enumerate() {
            match population {
                None => simulation.read_cells_of(group, size, &mut read)?,
                Some(counts) => simulation.read_items_of(group, *counts, size, &mut read)?,
            }
        }
        simulation.take_over(outline);
        Ok(simulation)
    }

    /// Reads the substates of cells of a group.
    fn read_cells_of<E: From<RunError>>(
        &mut self,
        group: usize,
        size: usize,
        read: &mut impl FnMut(Plane, &mut [u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let [width, height, depth] = self.model.geometry().extents();
        let stored = self.model.groups()[group].stored(self.options.precision);
        let mut block = Vec::new();
        for (field, stored) in stored.iter().enumerate() {
            let substate = SubstateId { group, field };
            let by_rows = self.execution.write_rows(substate, 0..0, &[]).map_err(RunError::from)?;
            let length = width * stored.size();
            let most = if by_rows { (size / length.max(1)).max(1) } else { height * depth };
            for start in (0..height * depth).step_by(most) {
                let rows = start..(start + most).min(height * depth);
                block.resize(rows.len() * length, 0);
                read(Plane::Values(substate), &mut block)?;
                let written = match by_rows {
                    true => self.execution.write_rows(substate, rows, &block).map(drop),
                    false => self.execution.write(substate, &block),
                };
                written.map_err(|failure| self.unfit(failure))?;
            }
        }
        Ok(())
    }

    /// Reads the items of a population.
    fn read_items_of<E: From<RunError>>(
        &mut self,
        group: usize,
        ItemCounts { items, left }: ItemCounts,
        size: usize,
        read: &mut impl FnMut(Plane, &mut [u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        if self.execution.collect_items(Plane::Counts(group), 0..0, &[]).map_err(RunError::from)? {
            self.collect_items_of(group, items, size, read)?;
            self.left_before[group] = left.wrapping_sub(self.execution.left(group));
            return Ok(());
        }
        let (mut counts, mut labels) = (vec![0; self.model.geometry().cells()], vec![0; items]);
        read(Plane::Counts(group), bytemuck::cast_slice_mut::<u32, u8>(&mut counts))?;
        read(Plane::Labels(group), bytemuck::cast_slice_mut::<u32, u8>(&mut labels))?;
        let mut fields = Vec::new();
        for (field, stored) in self.model.groups()[group].stored(self.options.precision).iter().enumerate() {
            let mut values = vec![0; items * stored.size()];
            read(Plane::Values(SubstateId { group, field }), &mut values)?;
            fields.push(values);
        }
        self.put_items(group, &Population { counts, labels, fields }, left)?;
        Ok(())
    }

    /// Reads the items of a population by rows.
    fn collect_items_of<E: From<RunError>>(
        &mut self,
        group: usize,
        count: usize,
        size: usize,
        read: &mut impl FnMut(Plane, &mut [u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let [width, height, depth] = self.model.geometry().extents();
        let (mut items, mut labels, mut block) = (Vec::new(), Vec::new(), Vec::new());
        for plane in Plane::of_group(group, &self.model.groups()[group]) {
            let mut start = 0;
            while start < height * depth {
                let rows = start..height * depth;
                let end = start + rows_in_block(self.lengths(plane, &items, rows), size);
                block.resize(self.lengths(plane, &items, start..end).sum(), 0);
                read(plane, &mut block)?;
                match plane {
                    Plane::Counts(_) => items.extend(items_of_rows(&block, width)),
                    Plane::Labels(_) => {
                        labels.extend(block.as_chunks().0.iter().map(|label| u32::from_ne_bytes(*label)));
                    }
                    Plane::Values(_) => {}
                }
                let taken = self.execution.collect_items(plane, start..end, &block);
                taken.map_err(|failure| self.unfit(failure))?;
                start = end;
            }
            let in_cells: usize = items.iter().sum();
            if in_cells != count {
                let reason = format!("it has {count} items, but {in_cells} in its cells");
                return Err(self.unfit_because(reason).into());
            }
        }
        labels.sort_unstable();
        if let Some([label, _]) = labels.array_windows().find(|[one, other]| one == other) {
            return Err(self.unfit_because(format!("the label {label} stands on two items")).into());
        }
        let set = self.execution.set_collected_items(group);
        Ok(set.map_err(|fault| self.unfit_items(fault))?)
    }

    /// The size of each of these rows of a plane, in bytes. `items` are the numbers of items in all rows.
    fn lengths<'a>(
        &self,
        plane: Plane,
        items: &'a [usize],
        rows: Range<usize>,
    ) -> impl Iterator<Item = usize> + use<'a> {
        let width = self.model.geometry().extents()[0];
        let (size, of_items) = match plane {
            Plane::Counts(_) => (size_of::<u32>(), false),
            Plane::Labels(_) => (size_of::<u32>(), true),
            Plane::Values(substate) => {
                let kind = self.model.groups()[substate.group].kind();
                let size = self.model.stored(substate, self.options.precision).size();
                (size, matches!(kind, GroupKind::Population { .. }))
            }
        };
        rows.map(move |row| size * if of_items { items.get(row).copied().unwrap_or(0) } else { width })
    }
}

/// The number of items in each row of so many cells, from the bytes of the numbers in the cells.
fn items_of_rows(counts: &[u8], width: usize) -> impl Iterator<Item = usize> {
    let rows = counts.chunks_exact(width * size_of::<u32>());
    rows.map(|row| row.as_chunks().0.iter().map(|count| u32::from_ne_bytes(*count) as usize).sum())
}

/// How many of the rows with these lengths are a block: at least one.
fn rows_in_block(lengths: impl Iterator<Item = usize>, size: usize) -> usize {
    let ends = lengths.scan(0_usize, |end, length| {
        *end = end.saturating_add(length);
        Some(*end)
    });
    ends.take_while(|end| *end <= size).count().max(1)
}

impl GroupSnapshot {
    /// Passes on the planes of the group with this number.
    ///
    /// # Errors
    /// That of `take`.
    pub fn planes<E>(
        &self,
        group: usize,
        take: &mut impl FnMut(Plane, &[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let fields = match self {
            Self::Cells(fields) => fields,
            Self::Population(population, _) => {
                take(Plane::Counts(group), bytemuck::cast_slice(&population.counts))?;
                take(Plane::Labels(group), bytemuck::cast_slice(&population.labels))?;
                &population.fields
            }
        };
        let mut fields = fields.iter().enumerate();
        fields.try_for_each(|(field, bytes)| take(Plane::Values(SubstateId { group, field }), bytes))
    }
}
