//! Processes over cells in the due pieces of a row, and their changes there.
#![allow(unsafe_code)]

use super::pass::{Followed, Pass};
use super::prepared::{Prepared, Shared};
use super::tools::{Cells, Pieces, Work};
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
        Followed { activity, processes, .. }: Followed<'_>,
        prepared: &Prepared<'_>,
        (row, cells): (usize, &Cells),
        population: Option<&Population>,
        work: &mut Work<'_>,
    ) -> Done {
        let tiles = activity.tiles();
        let mut pieces = std::mem::take(&mut work.buffers.pieces);
        let Pieces { due, before: kept, changes } = &mut pieces;
        activity.take(prepared.index, row, due);
        let written = || prepared.substates.iter().filter(|shared| !shared.write.is_null());
        changes.clear();
        changes.resize(2 * tiles.words() * prepared.substates.len(), 0);
        // One tile at a time: if a cell requests a random number, only its tile stays due.
        let most = if prepared.process.uses_step { 1 } else { usize::MAX };
        let mut done = Done::default();
        let mut from = 0;
        while let Some(run) = tiles.next(due, from, most) {
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
            kept.clear();
            written().for_each(|shared| keep(shared, &piece, kept));
            let outcome = self.run_row(prepared, &piece, population, work);
            if outcome.asked_for_step {
                run.clone().for_each(|tile| activity.keep(prepared.index, row, tile));
            }
            done.cells += piece.length;
            done.widest = done.widest.max(outcome.widest);
            let mut before = &kept[..];
            for (shared, changes) in written().zip(changes.chunks_exact_mut(2 * tiles.words())) {
                before = compare(shared, &piece, before, (tiles, &run), changes.split_at_mut(tiles.words()));
            }
        }
        if done.cells > 0 && prepared.continues {
            self.continue_row(prepared, row);
        }
        for (shared, changes) in written().zip(changes.chunks_exact(2 * tiles.words())) {
            let (here, around) = changes.split_at(tiles.words());
            if here.iter().any(|word| *word != 0) {
                activity.change(shared.substate, row, [here, around], (processes, Some(prepared.number)));
            }
        }
        work.buffers.pieces = pieces;
        done
    }
}

/// The bytes of a piece in each plane of a substate that a process writes. The earlier ones are in other
/// memory, or else copied in `kept`.
fn planes<'a>(shared: &'a Shared, piece: &Cells, kept: &'a [u8]) -> impl Iterator<Item = Plane<'a>> {
    let element = shared.memory.element;
    let (first, bytes) = (piece.first * element, piece.length * element);
    let [read_stride, write_stride] = match shared.memory.of {
        MemoryOf::Cells { read_stride, write_stride, .. } => [read_stride, write_stride],
        MemoryOf::Items { .. } => [0, 0],
    };
    (0..shared.memory.length).map(move |number| {
        // SAFETY: the cells of the piece, in a plane that the process writes, and in the one that it reads
        // where this is another. They are this thread's alone, as the row is; what it reads no one writes.
        // The kernel has not begun or has ended.
        unsafe {
            let now = shared.write.wrapping_add(first + number * write_stride * element).cast_const();
            let before = shared.read.wrapping_add(first + number * read_stride * element);
            let is_apart = !shared.read.is_null();
            Plane {
                now: std::slice::from_raw_parts(now, bytes),
                before: match kept.get(number * bytes..(number + 1) * bytes) {
                    _ if is_apart => std::slice::from_raw_parts(before, bytes),
                    Some(kept) => kept,
                    None => &[],
                },
            }
        }
    })
}

/// A piece of a plane.
struct Plane<'a> {
    now: &'a [u8],
    before: &'a [u8],
}

/// Copies the values that a process is about to overwrite in place.
fn keep(shared: &Shared, piece: &Cells, before: &mut Vec<u8>) {
    if shared.read.is_null() {
        planes(shared, piece, &[]).for_each(|plane| before.extend_from_slice(plane.now));
    }
}

/// Marks the tiles in which a substate has changed, and those that see the change. Returns the unused rest of
/// the copies.
fn compare<'a>(
    shared: &Shared,
    piece: &Cells,
    kept: &'a [u8],
    (tiles, run): (&Tiles, &Range<usize>),
    (here, around): (&mut [u64], &mut [u64]),
) -> &'a [u8] {
    let element = shared.memory.element;
    let copies = if shared.read.is_null() { shared.memory.length } else { 0 };
    let (kept, rest) = kept.split_at(copies * piece.length * element);
    for tile in run.clone() {
        let cells = tiles.cells(&(tile..tile + 1));
        let [low, high] = tiles.ends(&cells);
        let [mut changed, mut changed_low, mut changed_high] = [false; 3];
        for Plane { now, before } in planes(shared, piece, kept) {
            let differs = |cells: &Range<usize>| {
                let [start, end] = [cells.start, cells.end].map(|x| (x - piece.origin[0] as usize) * element);
                now[start..end] != before[start..end]
            };
            if differs(&cells) {
                changed = true;
                changed_low = changed_low || differs(&low);
                changed_high = changed_high || differs(&high);
            }
            if changed_low && changed_high {
                break;
            }
        }
        if changed {
            Tiles::mark(here, tile);
            Tiles::mark(around, tile);
        }
        // Few tiles see a change in the middle of another tile.
        if changed_low {
            tiles.mark_around(around, &low);
        }
        if changed_high {
            tiles.mark_around(around, &high);
        }
    }
    rest
}
