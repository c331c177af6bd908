//! The whole state block by block, for files that need not be in memory as a whole.

use super::Simulation;
use super::snapshot::{GroupSnapshot, ItemCounts, Outline};
use crate::engine::{EngineFailure, Plane, SubstateId};
use crate::model::{Group, GroupKind};
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
                    let counts = block.chunks_exact(width * size_of::<u32>());
                    items.extend(counts.map(|row| {
                        row.as_chunks()
                            .0
                            .iter()
                            .map(|count| u32::from_ne_bytes(*count) as usize)
                            .sum::<usize>()
                    }));
                }
                take(*plane, &block)?;
                start = end;
            }
        }
        Ok(())
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
