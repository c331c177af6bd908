//! Processes over cells in the due pieces of a row, and their changes there.
#![allow(unsafe_code)]

use super::pass::Pass;
use super::prepared::{Prepared, Shared};
use super::tools::{Cells, Work};
use crate::activity::Activity;
use crate::population::Population;
use crate::tiles::Tiles;
use std::ops::Range;
use xca_core::kernel::MemoryOf;

/// The work of a process in a row.
#[derive(Default)]
pub(super) struct Done {
    /// The number of updated cells.
    pub(super) cells: usize,
    /// The largest radius of a search.
    pub(super) widest: f64,
}

impl Pass<'_> {
    /// Runs a process over the due cells of a row.
    pub(super) fn run_pieces(
        &self,
        activity: &Activity,
        prepared: &Prepared<'_>,
        (row, cells): (usize, &Cells),
        population: Option<&Population>,
        work: &mut Work<'_>,
    ) -> Done {
        let tiles = activity.tiles();
        let mut pieces = std::mem::take(&mut work.pieces);
        activity.take(prepared.index, row, &mut pieces.due);
        pieces.changes.resize_with(prepared.substates.len(), Default::default);
        for marks in pieces.changes.iter_mut().flatten() {
            marks.clear();
            marks.resize(tiles.words(), 0);
        }
        // One tile at a time: if a cell requests a random number, only its tile stays due.
        let most = if prepared.process.uses_step { 1 } else { usize::MAX };
        let mut done = Done::default();
        let mut from = 0;
        while let Some(run) = tiles.next(&pieces.due, from, most) {
            from = run.end;
            let Range { start, end } = tiles.cells(&run);
            let [_, y, z] = cells.origin;
            let piece = Cells {
                row,
                first: cells.first + start,
                origin: [start as u32, y, z],
                length: end - start,
                own: cells.own,
            };
            pieces.before.clear();
            prepared.substates.iter().for_each(|shared| keep(shared, &piece, &mut pieces.before));
            let outcome = self.run_row(prepared, &piece, population, work);
            if outcome.asked_for_step {
                run.clone().for_each(|tile| activity.keep(prepared.index, row, tile));
            }
            done.cells += piece.length;
            done.widest = done.widest.max(outcome.widest);
            let mut before = &pieces.before[..];
            for (shared, changes) in prepared.substates.iter().zip(&mut pieces.changes) {
                before = compare(shared, &piece, before, (tiles, &run), changes);
            }
        }
        if done.cells > 0 {
            self.continue_row(prepared, row);
        }
        for (shared, [here, around]) in prepared.substates.iter().zip(&pieces.changes) {
            if here.iter().any(|word| *word != 0) {
                let following = self.prepared[prepared.number + 1..].iter().map(|prepared| prepared.index);
                activity.change(shared.substate, row, [here, around], following);
            }
        }
        work.pieces = pieces;
        done
    }
}

/// The bytes of a piece in each plane that a process writes. Includes the earlier bytes if they are in other
/// memory.
fn planes<'a>(shared: &'a Shared, piece: &Cells) -> impl Iterator<Item = Plane<'a>> {
    let element = shared.memory.element;
    let (first, bytes) = (piece.first * element, piece.length * element);
    let planes = if shared.write.is_null() { 0 } else { shared.memory.length };
    let [read_stride, write_stride] = match shared.memory.of {
        MemoryOf::Cells { read_stride, write_stride, .. } => [read_stride, write_stride],
        MemoryOf::Items { .. } => [0, 0],
    };
    (0..planes).map(move |number| {
        // SAFETY: the cells of the piece, in a plane that the process writes, and in the one that it reads
        // where this is another. They are this thread's alone, as the row is; what it reads no one writes.
        // The kernel has not begun or has ended.
        unsafe {
            let now = shared.write.wrapping_add(first + number * write_stride * element).cast_const();
            let before = shared.read.wrapping_add(first + number * read_stride * element);
            let apart = !shared.read.is_null();
            Plane {
                now: std::slice::from_raw_parts(now, bytes),
                before: apart.then(|| std::slice::from_raw_parts(before, bytes)),
            }
        }
    })
}

/// A piece of a plane.
struct Plane<'a> {
    now: &'a [u8],
    before: Option<&'a [u8]>,
}

/// Copies the values that a process is about to overwrite in place.
fn keep(shared: &Shared, piece: &Cells, before: &mut Vec<u8>) {
    for plane in planes(shared, piece).filter(|plane| plane.before.is_none()) {
        before.extend_from_slice(plane.now);
    }
}

/// Marks the tiles in which a substate has changed. Returns the unused rest of the copies.
fn compare<'a>(
    shared: &Shared,
    piece: &Cells,
    mut kept: &'a [u8],
    (tiles, run): (&Tiles, &Range<usize>),
    [here, around]: &mut [Vec<u64>; 2],
) -> &'a [u8] {
    let element = shared.memory.element;
    for plane in planes(shared, piece) {
        let before = match plane.before {
            Some(before) => before,
            None => {
                let (before, rest) = kept.split_at(plane.now.len());
                kept = rest;
                before
            }
        };
        for tile in run.clone() {
            let cells = tiles.cells(&(tile..tile + 1));
            let start = piece.origin[0] as usize;
            let differs = |cells: &Range<usize>| {
                let bytes = (cells.start - start) * element..(cells.end - start) * element;
                plane.now[bytes.clone()] != before[bytes]
            };
            if differs(&cells) {
                Tiles::mark(here, tile);
                // Few tiles see a change in the middle of another tile.
                let ends = [cells.start, cells.end.saturating_sub(tiles.reach()).max(cells.start)];
                let [low, high] = ends.map(|end| end..(end + tiles.reach()).min(cells.end));
                let seen = if cells.len() <= 2 * tiles.reach() {
                    cells
                } else {
                    let start = if differs(&low) { cells.start } else { low.end };
                    let end = if differs(&high) { cells.end } else { high.start };
                    start..end
                };
                tiles.mark_around(around, &seen);
            }
        }
    }
    kept
}
