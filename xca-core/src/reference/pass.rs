//! One process over all cells, one cell at a time.
//!
//! The kernels run on rows; here a row is a single cell, whose neighbourhood has been gathered into a list.
#![allow(unsafe_code)]

use super::{GroupState, Neighbour, ReferenceExecution, neighbourhood};
use crate::engine::{Fault, StepContext, SubstateId};
use crate::storage::Buffer;
use std::panic::{AssertUnwindSafe, catch_unwind};
use xca_process::Stream;
use xca_process::kernel::{Access, Entry, Frame, Memory, MemoryOf, Row, RowItems, Scratch};
use xca_process::{Process, ProcessKind};
use xca_values::StoredType;

/// Where a process's substates are read and written during a pass.
struct Pass {
    substate: SubstateId,
    access: Access,
    stored: StoredType,
    /// Of cells, read at neighbours: the gathered values, element after element.
    gathered: Option<Buffer>,
    /// Written, and read elsewhere: the new values.
    next: Option<Buffer>,
}

impl ReferenceExecution {
    /// Runs a process. For a migration the result is the answer for each place of the population.
    pub(super) fn pass(
        &mut self,
        process: &Process,
        stream: Stream,
        context: &StepContext<'_>,
    ) -> Result<Vec<u32>, Fault> {
        let geometry = self.model.geometry().clone();
        let mut passes: Vec<Pass> =
            process.access.iter().map(|access| self.prepare(process, access)).collect();
        let population = self.population_of(process);
        let places = population.map_or(0, |group| self.groups[group].labels.len());
        let mut answers = vec![0; if process.kind == ProcessKind::Migration { places } else { 0 }];
        let size = geometry.neighbourhood().size();
        let offsets: Vec<isize> = (0..size as isize).collect();
        let frame = Frame {
            geometry: &geometry,
            extents: geometry.extents().map(|extent| extent as u32),
            side: geometry.side(),
            toroidal: geometry.toroidal(),
            step: context.step,
            seed: context.seed,
            stream,
            parameters: context.parameters,
            offsets: &offsets,
            filter: None,
        };
        let kernel = process.kernel(self.precision);
        let scratch = Scratch::default();
        for cell in 0..geometry.cells() {
            let indices = geometry.indices(cell);
            let around: Vec<Neighbour> = neighbourhood(&geometry, indices).collect();
            let entries: Vec<Entry> = passes.iter_mut().map(|pass| self.entry(pass, cell, &around)).collect();
            let ranges: Option<(Vec<u32>, Vec<u32>)> =
                population.map(|group| self.groups[group].ranges(&around));
            let own = population.map_or((0, 0), |group| self.groups[group].range(cell));
            let cells = vec![cell as u32; own.1 - own.0];
            let items = population.zip(ranges.as_ref()).map(|(group, (starts, ends))| RowItems {
                starts: starts.as_ptr(),
                ends: ends.as_ptr(),
                labels: &self.groups[group].labels,
                own,
                cells: &cells,
                near: None,
            });
            let destinations =
                if process.kind == ProcessKind::Migration { Some(&mut answers[own.0..own.1]) } else { None };
            let origin = indices.map(|index| index as u32);
            // SAFETY: `entries` follow the process's accesses. Of cells, `read` is the gathered list of as
            // many values as offsets, or the cell's own value where no neighbour is read; `write` is one
            // value, of this cell, in memory apart from the gathered list. Of items, `read` starts a plane of
            // as many values as labels, and `write` is this cell's part of it, or of another plane where
            // others are read. Ranges are lists of as many values as offsets. All of it outlives the row, and
            // nothing else touches it meanwhile: pointers were taken last from each buffer.
            let row = unsafe { Row::new(&frame, &entries, items, destinations, &scratch, origin, 1) };
            // A fault, and a panic too, leaves an unfinished step behind. What was reported before a panic
            // comes first.
            let panic = catch_unwind(AssertUnwindSafe(|| kernel(&row))).err();
            if let Some(fault) = row.first_fault() {
                return Err(Fault::reported(process, fault, &geometry));
            }
            if let Some(panic) = panic {
                return Err(Fault::panicked(process, row.stopped_at(), &*panic, &geometry));
            }
        }
        for pass in passes {
            if let Some(next) = pass.next {
                self.groups[pass.substate.group].planes[pass.substate.field] = next;
            }
        }
        Ok(answers)
    }

    /// The group of the items that a process runs for or sums up.
    pub(super) fn population_of(&self, process: &Process) -> Option<usize> {
        self.model.group_number((process.population()?.type_id)())
    }

    fn prepare(&self, process: &Process, access: &Access) -> Pass {
        let argument = process.substates[access.argument];
        let group = self.model.group_number((argument.type_id)()).unwrap_or_default();
        let substate = SubstateId { group, field: access.field };
        let group = &self.groups[substate.group];
        let stored = group.types[substate.field];
        let of_cells = !group.is_population();
        let gathered = (of_cells && access.others)
            .then(|| Buffer::zeroed(stored.size() * self.model.geometry().neighbourhood().size()));
        let next = (access.write && access.others).then(|| group.planes[substate.field].clone());
        Pass { substate, access: *access, stored, gathered, next }
    }

    fn entry(&mut self, pass: &mut Pass, cell: usize, around: &[Neighbour]) -> Entry {
        let group = &mut self.groups[pass.substate.group];
        let (field, size) = (pass.substate.field, pass.stored.size());
        let place = cell * group.slots;
        let write_plane = pass.next.as_mut().unwrap_or(&mut group.planes[field]);
        let write = if pass.access.write {
            write_plane.as_mut_ptr().wrapping_add(place * size)
        } else {
            std::ptr::null_mut()
        };
        let read = if let Some(gathered) = &mut pass.gathered {
            let element = pass.stored.element_size();
            for (number, at) in around.iter().enumerate() {
                let value = match at {
                    Neighbour::Cell(cell) => group.value(field, *cell),
                    Neighbour::Outside(face) => &group.outside[field][*face],
                };
                for (plane, value) in value.chunks_exact(element).enumerate() {
                    let place = (plane * around.len() + number) * element;
                    gathered.bytes_mut()[place..place + element].copy_from_slice(value);
                }
            }
            gathered.as_ptr()
        } else if pass.access.write && pass.next.is_none() {
            // In place: the kernel reads through `write` alone.
            std::ptr::null()
        } else if group.is_population() {
            group.planes[field].as_ptr()
        } else {
            group.planes[field].as_ptr().wrapping_add(place * size)
        };
        let of = match (group.is_population(), pass.access.others) {
            (true, all) => MemoryOf::Items { all, count: group.labels.len() },
            // What is gathered stands element after element; the elements of one cell, one after the other.
            (false, true) => MemoryOf::Cells { read_stride: around.len(), write_stride: 1, around: true },
            (false, false) => MemoryOf::Cells { read_stride: 1, write_stride: 1, around: false },
        };
        let length = pass.stored.length as usize;
        Entry { read, write, memory: Memory { element: pass.stored.element_size(), length, of } }
    }
}

impl GroupState {
    pub(super) fn is_population(&self) -> bool {
        !self.counts.is_empty()
    }

    /// The occupied places of a cell.
    pub(super) fn range(&self, cell: usize) -> (usize, usize) {
        (cell * self.slots, cell * self.slots + self.counts[cell] as usize)
    }

    fn ranges(&self, around: &[Neighbour]) -> (Vec<u32>, Vec<u32>) {
        around
            .iter()
            .map(|at| match at {
                Neighbour::Cell(cell) => self.range(*cell),
                Neighbour::Outside(_) => (0, 0),
            })
            .map(|(start, end)| (start as u32, end as u32))
            .unzip()
    }
}
