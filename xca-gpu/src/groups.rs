//! The state of a model in the device's memory: all its substates, and what the device notes of the run.

use crate::device::{Binding, Buffer, Device, DeviceError, UNTOUCHED};
use crate::plane::Plane;
use crate::population::Population;
use crate::space::Section;
use xca_core::engine::SubstateId;

/// The substates of one struct.
#[derive(Debug)]
pub(crate) enum Group {
    /// Of cells.
    Cells(Vec<Plane>),
    /// Of items.
    Population(Box<Population>),
}

/// The bytes of a journal, and the distance to the next one: what bindings are aligned to at most.
pub(crate) const JOURNAL: u64 = 256;
/// The words of a journal that are read back: see `shaders/common.wgsl`.
pub(crate) const JOURNAL_WORDS: usize = 15;

/// The bytes of the note about loops that were ended early.
pub(crate) const ENDED_EARLY: u64 = size_of_val(&UNTOUCHED) as u64;

/// A note that says that no loop was ended early.
fn note(device: &Device) -> Result<Buffer, DeviceError> {
    let note = device.buffer("loops ended early", ENDED_EARLY)?;
    device.upload(&note, 0, bytemuck::cast_slice(&UNTOUCHED))?;
    Ok(note)
}

/// The bytes before the records of faults, and some more.
const HEAD: u64 = 16;

/// Memory for faults, without any.
fn no_faults(device: &Device, records: u64) -> Result<Buffer, DeviceError> {
    let faults = device.buffer("faults", HEAD + records)?;
    device.upload(&faults, 0, bytemuck::cast_slice(&[u32::MAX, 0]))?;
    Ok(faults)
}

/// All of it.
#[derive(Debug)]
pub(crate) struct Groups {
    groups: Vec<Group>,
    /// A journal of the model, then one for each group.
    journals: Buffer,
    faults: Buffer,
    /// Where the device ends loops early: whose it ended first.
    ended_early: Option<Buffer>,
}

impl Groups {
    /// Around planes and populations, with room for so many bytes of records of faults.
    pub(crate) fn new(device: &Device, groups: Vec<Group>, records: u64) -> Result<Self, DeviceError> {
        let journals = device.buffer("journals", JOURNAL * (groups.len() as u64 + 1))?;
        let ended_early = device.turns().map(|_| note(device)).transpose()?;
        Ok(Self { groups, journals, faults: no_faults(device, records)?, ended_early })
    }

    /// Makes room for so many bytes of records of faults.
    pub(crate) fn make_room(&mut self, device: &Device, records: u64) -> Result<(), DeviceError> {
        if self.faults.size() < HEAD + records {
            self.faults = no_faults(device, records)?;
        }
        Ok(())
    }

    pub(crate) fn group(&self, number: usize) -> &Group {
        &self.groups[number]
    }

    pub(crate) fn population(&self, number: usize) -> Option<&Population> {
        match self.groups.get(number)? {
            Group::Cells(_) => None,
            Group::Population(population) => Some(population),
        }
    }

    pub(crate) fn population_mut(&mut self, number: usize) -> Option<&mut Population> {
        match self.groups.get_mut(number)? {
            Group::Cells(_) => None,
            Group::Population(population) => Some(population),
        }
    }

    /// The numbers of the populations.
    pub(crate) fn populations(&self) -> impl Iterator<Item = usize> + use<'_> {
        (0..self.groups.len()).filter(|number| self.population(*number).is_some())
    }

    /// The plane of a substate.
    pub(crate) fn plane(&self, substate: SubstateId) -> &Plane {
        match &self.groups[substate.group] {
            Group::Cells(planes) => &planes[substate.field],
            Group::Population(population) => &population.fields[substate.field],
        }
    }

    pub(crate) fn plane_mut(&mut self, substate: SubstateId) -> &mut Plane {
        match &mut self.groups[substate.group] {
            Group::Cells(planes) => &mut planes[substate.field],
            Group::Population(population) => &mut population.fields[substate.field],
        }
    }

    /// Whether a substate belongs to cells.
    pub(crate) fn of_cells(&self, substate: SubstateId) -> bool {
        matches!(self.groups[substate.group], Group::Cells(_))
    }

    /// What a process is bound to for a substate: its results, or its present values.
    pub(crate) fn substate(
        &self,
        substate: SubstateId,
        results: bool,
        section: Option<&Section>,
    ) -> Option<Binding> {
        let plane = self.plane(substate);
        let buffer = if results { plane.next() } else { plane.now() };
        Some(match section.filter(|_| self.of_cells(substate)) {
            Some(section) => plane.section(buffer, section),
            None => buffer.into(),
        })
    }

    /// How many items a population has.
    pub(crate) fn items(&self, number: usize) -> usize {
        self.population(number).map_or(0, |population| population.items)
    }

    /// The journal of a population, or of the model.
    pub(crate) fn journal(&self, population: Option<usize>) -> Binding {
        let number = population.map_or(0, |group| group as u64 + 1);
        Binding::part(&self.journals, number * JOURNAL, JOURNAL)
    }

    /// All journals.
    pub(crate) fn journals(&self) -> &Buffer {
        &self.journals
    }

    /// Where it is noted whose loops the device ended early, if it does such a thing.
    pub(crate) fn ended_early(&self) -> Option<&Buffer> {
        self.ended_early.as_ref()
    }

    /// What processes report.
    pub(crate) fn faults(&self) -> &Buffer {
        &self.faults
    }

    /// The bytes that it takes.
    pub(crate) fn memory(&self) -> usize {
        let of_groups = self.groups.iter().map(|group| match group {
            Group::Cells(planes) => planes.iter().map(Plane::memory).sum(),
            Group::Population(population) => population.memory(),
        });
        of_groups.sum::<usize>() + (self.journals.size() + self.faults.size()) as usize
    }
}
