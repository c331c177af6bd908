//! Processes prepared for a pass: the addresses of their substates.
#![allow(unsafe_code)]

use crate::group::Group;
use crate::layout::Layout;
use xca_core::engine::SubstateId;
use xca_core::kernel::{Access, Entry, Memory, MemoryOf, RowKernel};
use xca_core::{Model, Precision, Process};

/// The address of a substate's memory, shared by the threads.
#[derive(Clone, Copy)]
pub(super) struct Shared {
    pub(super) substate: SubstateId,
    /// Null if the process writes in place, and reads there too.
    pub(super) read: *const u8,
    /// Null if the process does not write.
    pub(super) write: *mut u8,
    pub(super) memory: Memory,
    /// Whether the written rows must be continued into the halo.
    pub(super) continued: bool,
}

// SAFETY: the pointers lead to memory that is written through rows alone, and rows are disjoint, see
// `pass.rs`.
unsafe impl Send for Shared {}
// SAFETY: as above.
unsafe impl Sync for Shared {}

impl Shared {
    /// The entry for the row with this first cell (padded index) and this first item.
    pub(super) fn entry(&self, first_cell: usize, first_item: usize) -> Entry {
        let (element, length) = (self.memory.element, self.memory.length);
        let (read, write) = match self.memory.of {
            MemoryOf::Cells { .. } => (first_cell * element, first_cell * element),
            MemoryOf::Items { .. } => (0, first_item * element * length),
        };
        let moved = |pointer: *mut u8, by: usize| {
            if pointer.is_null() { pointer } else { pointer.wrapping_add(by) }
        };
        Entry {
            read: moved(self.read.cast_mut(), read).cast_const(),
            write: moved(self.write, write),
            memory: self.memory,
        }
    }
}

/// A process prepared for a pass.
pub(super) struct Prepared<'a> {
    pub(super) process: &'a Process,
    /// Its index in the step.
    pub(super) index: usize,
    /// Its index in the pass.
    pub(super) number: usize,
    pub(super) kernel: RowKernel,
    pub(super) substates: Vec<Shared>,
    /// Whether one of them must be continued into the halo.
    pub(super) continues: bool,
    pub(super) population: Option<usize>,
}

/// Prepares the process with index `number` in the pass and `index` in the model.
pub(super) fn prepare<'a>(
    model: &'a Model,
    layout: &Layout,
    groups: &mut [Group],
    (number, index): (usize, usize),
    precision: Precision,
    written: &[(SubstateId, bool)],
) -> Prepared<'a> {
    let process = &model.processes()[index];
    let plan = model.plan().process(index);
    let accesses = process.access.iter().zip(&plan.accesses);
    let substates: Vec<Shared> =
        accesses.map(|(access, &substate)| shared(layout, groups, access, substate, written)).collect();
    let halo_repeats = layout.halo_repeats() != [false; 2];
    let continues = halo_repeats && substates.iter().any(|shared| shared.continued);
    let (kernel, population) = (process.kernel(precision), plan.population);
    Prepared { process, index, number, kernel, substates, continues, population }
}

fn shared(
    layout: &Layout,
    groups: &mut [Group],
    access: &Access,
    substate: SubstateId,
    written: &[(SubstateId, bool)],
) -> Shared {
    let (current, next, stored, of, continued) = match &mut groups[substate.group] {
        Group::Cells(planes) => {
            let plane = &mut planes[substate.field];
            let continued = access.write && plane.read_elsewhere;
            let stride = layout.cells();
            let of = MemoryOf::Cells { read_stride: stride, write_stride: stride, around: access.others };
            (&mut plane.current, plane.next.as_mut(), plane.stored, of, continued)
        }
        Group::Population(population) => {
            let stored = population.types[substate.field];
            let next = &mut population.next[substate.field];
            let of = MemoryOf::Items { all: access.others, count: population.items.labels.len() };
            (&mut population.items.fields[substate.field], Some(next), stored, of, false)
        }
    };
    let (read, write) = match next {
        _ if !access.write => (current.as_ptr(), std::ptr::null_mut()),
        Some(next) if written.contains(&(substate, true)) => (current.as_ptr(), next.as_mut_ptr()),
        _ => (std::ptr::null(), current.as_mut_ptr()),
    };
    let memory = Memory { element: stored.element_size(), length: stored.length as usize, of };
    Shared { substate, read, write, memory, continued }
}
