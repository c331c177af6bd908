//! What is observed of a model that does not say it.

use crate::measured_field::MeasuredField;
use crate::observable::Observable;
use std::borrow::Cow;
use xca_core::engine::{Plane, SubstateId};
use xca_core::model::{Group, GroupKind};
use xca_core::{EngineFailure, ItemCounts, Precision, Simulation};

/// The number of bytes that are read at a time.
const BLOCK: usize = 4 << 20;

/// Measures a state whose model names no observables.
///
/// Of each substate: minimum, mean and maximum of floats; minimum, sum and maximum of whole numbers; the
/// mean of each component of a vector or an array of numbers; how many are true; how many are in each
/// state. Of a population: the number of items, and the number in the fullest cell. Cells without ground,
/// where `missing` is true, have no part in them. Floating numbers are added row by row, as in reductions.
///
/// # Errors
/// Returns an error if the engine lost its state.
pub fn measure(simulation: &Simulation, missing: Option<&[bool]>) -> Result<Vec<Observable>, EngineFailure> {
    let (model, precision) = (simulation.model(), simulation.options().precision);
    let width = model.geometry().extents()[0];
    let of_group = |group| MeasuredGroup::new(group, precision, width, missing);
    let mut groups: Vec<MeasuredGroup<'_>> = model.groups().iter().map(of_group).collect();
    simulation.read_blocks(BLOCK, |plane, block| {
        groups[plane.group()].add(plane, block);
        Ok::<(), EngineFailure>(())
    })?;
    let mut observables = Vec::new();
    let counts = simulation.outline().populations;
    for (number, (group, counts)) in groups.iter().zip(counts).enumerate() {
        let name = group.definition.schema().name.to_lowercase();
        let prefix = if groups.len() > 1 { format!("{name}_") } else { String::new() };
        if let Some(counts) = counts {
            observables.extend(group.counts(&prefix, counts));
        }
        for (field, measured) in group.fields.iter().enumerate() {
            // The sum may be too large where the mean is not.
            let again = |component| group.numbers(simulation, SubstateId { group: number, field }, component);
            observables.extend(measured.observables(&prefix, again)?);
        }
    }
    Ok(observables)
}

/// The values, of this size, of the cells that have ground.
fn kept<'a>(bytes: &'a [u8], size: usize, missing: &[bool]) -> Cow<'a, [u8]> {
    if !missing.contains(&true) {
        return bytes.into();
    }
    let values = bytes.chunks_exact(size).zip(missing).filter(|(_, is_missing)| !**is_missing);
    values.flat_map(|(value, _)| value).copied().collect()
}

/// What is measured of a group, plane by plane and row by row.
struct MeasuredGroup<'a> {
    definition: &'a Group,
    fields: Vec<MeasuredField>,
    /// The number of cells in a row.
    width: usize,
    /// Of a population: the number of items of each row, once that is known.
    items: Option<Vec<usize>>,
    largest_occupancy: u32,
    /// The cells without ground, of cells.
    missing: Option<&'a [bool]>,
}

impl<'a> MeasuredGroup<'a> {
    fn new(definition: &'a Group, precision: Precision, width: usize, missing: Option<&'a [bool]>) -> Self {
        let is_population = matches!(definition.kind(), GroupKind::Population { .. });
        Self {
            definition,
            fields: definition.schema().fields.iter().map(|f| MeasuredField::new(f, precision)).collect(),
            width,
            items: is_population.then(Vec::new),
            largest_occupancy: 0,
            missing: missing.filter(|_| !is_population),
        }
    }

    /// Adds a block of whole rows.
    fn add(&mut self, plane: Plane, block: &[u8]) {
        match (plane, &mut self.items) {
            (Plane::Counts(_), Some(items)) => {
                for row in block.chunks_exact(self.width * size_of::<u32>()) {
                    let counts = row.as_chunks().0.iter().map(|count| u32::from_ne_bytes(*count));
                    self.largest_occupancy = counts.clone().fold(self.largest_occupancy, u32::max);
                    items.push(counts.map(|count| count as usize).sum());
                }
            }
            (Plane::Values(substate), items) => {
                let measured = &mut self.fields[substate.field];
                let (size, mut rest) = (measured.stored().size(), block);
                while !rest.is_empty() {
                    let row = measured.rows();
                    let count = items.as_ref().map_or(self.width, |items| items[row]);
                    let (values, after) = rest.split_at(count * size);
                    let missing = self.missing.map(|missing| &missing[row * self.width..][..self.width]);
                    measured.add_row(&missing.map_or(values.into(), |missing| kept(values, size, missing)));
                    rest = after;
                }
            }
            _ => {}
        }
    }

    /// All numbers of a component of a floating substate.
    fn numbers(
        &self,
        simulation: &Simulation,
        substate: SubstateId,
        component: usize,
    ) -> Result<Vec<f64>, EngineFailure> {
        let measured = &self.fields[substate.field];
        let (size, mut missing) = (measured.stored().size(), self.missing.unwrap_or_default());
        let mut numbers = Vec::new();
        simulation.read_substate(substate, BLOCK, |block| {
            let (of_block, rest) = missing.split_at(missing.len().min(block.len() / size));
            let block = if of_block.is_empty() { block.into() } else { kept(block, size, of_block) };
            numbers.extend(measured.floats(&block, component));
            missing = rest;
            Ok::<(), EngineFailure>(())
        })?;
        Ok(numbers)
    }

    fn counts(&self, prefix: &str, ItemCounts { items, left }: ItemCounts) -> Vec<Observable> {
        let number = |name: &str, value: f64| Observable::number(format!("{prefix}{name}"), value);
        let mut observables = vec![number("items", items as f64)];
        if matches!(self.definition.kind(), GroupKind::Population { may_leave: true, .. }) {
            observables.push(number("left", left as f64));
        }
        observables.push(number("largest_occupancy", f64::from(self.largest_occupancy)));
        observables
    }
}
