//! Continuation of rows into the halo.
#![allow(unsafe_code)]

use super::pass::Pass;
use super::prepared::{Prepared, Shared};

impl Pass<'_> {
    /// Continues the rows that a process has written into the halo, while they are in the cache.
    pub(super) fn continue_row(&self, prepared: &Prepared<'_>, row: usize) {
        let first = self.layout.first(row);
        for shared in prepared.substates.iter().filter(|shared| shared.continued) {
            let element = shared.memory.element;
            let planes = (0..shared.memory.length).map(|number| number * self.layout.cells());
            let starts = planes.map(|plane| shared.write.wrapping_add((plane + first) * element));
            let size = element as isize;
            let copies = starts.flat_map(|start| self.continuation.iter().map(move |copy| (start, copy)));
            for (start, (target, source)) in copies {
                // SAFETY:
                // - Source and target are cells of one padded line of a plane: the source in the row, the
                //   target in the halo beside it.
                // - No kernel writes the halo, and only this thread has the row. No one therefore writes
                //   either of them meanwhile.
                // - No one reads the target meanwhile. A plane that is read elsewhere in this pass is written
                //   to the second buffer, from which nothing is read, or is not written (`stages`). Another
                //   pass is at rows that see this one only before or after (`Wavefront`).
                unsafe {
                    copy_value(element, start.offset(source * size), start.offset(target * size));
                }
            }
            if self.continues_lines {
                self.continue_line(shared, row);
            }
        }
    }

    /// Copies the padded line of a row to the halo lines that repeat it.
    fn continue_line(&self, shared: &Shared, row: usize) {
        let element = shared.memory.element;
        let source = self.layout.line(self.layout.row(row).map(|index| index as isize));
        for image in self.layout.images(row) {
            let target = self.layout.line(image);
            for plane in (0..shared.memory.length).map(|number| number * self.layout.cells()) {
                let [from, to] = [source.start, target.start]
                    .map(|start| shared.write.wrapping_add((plane + start) * element));
                // SAFETY:
                // - Both are padded lines of a plane, of one length: the one of the row, and another in the
                //   halo.
                // - A line of the halo shows one row, whose only thread this is; no kernel writes it.
                // - It is read from rows that see the row, and those are read and written by no pass
                //   meanwhile (`Wavefront`).
                unsafe {
                    std::ptr::copy_nonoverlapping(from, to, source.len() * element);
                }
            }
        }
    }
}

/// Copies one value. If the compiler knows the size, the copy is a register move.
///
/// # Safety
/// So many bytes can be read at `from` and written at `to`, and they do not overlap.
unsafe fn copy_value(size: usize, from: *const u8, to: *mut u8) {
    // SAFETY: as the function.
    unsafe {
        match size {
            1 => std::ptr::copy_nonoverlapping(from, to, 1),
            4 => std::ptr::copy_nonoverlapping(from, to, 4),
            8 => std::ptr::copy_nonoverlapping(from, to, 8),
            _ => std::ptr::copy_nonoverlapping(from, to, size),
        }
    }
}
