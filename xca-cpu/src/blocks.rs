//! Distribution of the rows of a pass over the threads.

use crate::activity::DueRow;
use crate::layout::Layout;
use crate::population::Population;
use std::ops::Range;
use xca_wavefront::Depth;

/// The number of blocks per thread. Enough to keep the wait for the last block short, few enough that a block
/// is worth its start.
const BLOCKS_PER_THREAD: usize = 32;

/// The work of an item, in cells.
const CELLS_PER_ITEM: usize = 16;

/// Blocks of consecutive rows with about the same work. The items of the populations may all be in a few
/// rows.
pub(crate) fn blocks(layout: &Layout, populations: &[&Population], threads: usize) -> Vec<Range<usize>> {
    blocks_of_same_work(layout, populations, threads * BLOCKS_PER_THREAD)
}

/// The factor by which blocks exceed their least length, if there are enough rows. Work in the gaps between
/// blocks reads memory once more.
const LONGER_THAN_LEAST: usize = 4;

/// Blocks of layers without items, long enough for passes of this depth.
pub(crate) fn long_blocks(layout: &Layout, threads: usize, depth: Depth) -> Vec<Range<usize>> {
    let (layers, least) = (layout.rows() / depth.lag.layer, depth.least_block());
    let of_thread = layers / (least * LONGER_THAN_LEAST * threads);
    let count = match of_thread {
        0 => (layers / least).clamp(1, threads),
        of_thread => of_thread.min(BLOCKS_PER_THREAD) * threads,
    };
    (0..count).map(|number| number * layers / count..(number + 1) * layers / count).collect()
}

fn blocks_of_same_work(layout: &Layout, populations: &[&Population], count: usize) -> Vec<Range<usize>> {
    let rows = layout.rows();
    let work_before = |row: usize| {
        let items: usize = populations.iter().map(|population| population.rows[row] as usize).sum();
        row * layout.width() + items * CELLS_PER_ITEM
    };
    let work = work_before(rows) as u128;
    let count = count.min(rows) as u128;
    let mut blocks = Vec::with_capacity(count as usize);
    let mut start = 0;
    for number in 1..=count {
        let share = (work * number / count) as usize;
        let end = first(start..rows, |row| work_before(row) >= share);
        if start < end {
            blocks.push(start..end);
            start = end;
        }
    }
    blocks
}

/// The number of tiles that are worth the start of a block.
const TILES_PER_BLOCK: usize = 48;

/// Blocks of indices into `due` with about the same work. One thread needs only one.
pub(crate) fn blocks_of_due(due: &[DueRow], threads: usize) -> Vec<Range<usize>> {
    if threads == 1 {
        return (!due.is_empty()).then_some(0..due.len()).into_iter().collect();
    }
    let tiles: usize = due.iter().map(|row| row.tiles).sum();
    let share = (tiles / (threads * BLOCKS_PER_THREAD)).max(TILES_PER_BLOCK);
    let mut blocks = Vec::new();
    let (mut start, mut work) = (0, 0);
    for (number, row) in due.iter().enumerate() {
        work += row.tiles;
        if work >= share || number + 1 == due.len() {
            blocks.push(start..number + 1);
            (start, work) = (number + 1, 0);
        }
    }
    blocks
}

/// The first index that satisfies the condition, or the end of the range.
fn first(mut range: Range<usize>, condition: impl Fn(usize) -> bool) -> usize {
    while !range.is_empty() {
        let middle = range.start + range.len() / 2;
        if condition(middle) {
            range.end = middle;
        } else {
            range.start = middle + 1;
        }
    }
    range.start
}

#[cfg(test)]
mod tests {
    use super::{BLOCKS_PER_THREAD, CELLS_PER_ITEM, DueRow, TILES_PER_BLOCK, blocks, blocks_of_due};
    use crate::layout::Layout;
    use crate::population::Population;
    use std::ops::Range;
    use xca_core::engine::Population as Items;
    use xca_core::prelude::*;

    #[derive(Substates, Clone, Copy)]
    struct Site {
        value: u32,
    }

    #[derive(Substates, Clone, Copy)]
    struct Grain {
        #[position]
        position: Vector3<Real>,
    }

    fn model(extents: [usize; 3]) -> Model {
        let builder = Model::builder("rows").extents(extents).substates::<Site>();
        builder.population::<Grain>(8).build().unwrap()
    }

    fn layout(extents: [usize; 3]) -> Layout {
        Layout::new(model(extents).geometry())
    }

    fn work(layout: &Layout, population: &Population, rows: Range<usize>) -> usize {
        let items = population.row(rows.end - 1).1 - population.row(rows.start).0;
        rows.len() * layout.width() + items * CELLS_PER_ITEM
    }

    #[test]
    fn items_in_a_few_rows_are_shared_evenly() {
        let layout = layout([10, 40, 50]);
        let model = model([10, 40, 50]);
        let mut population = Population::new(&model.groups()[1], Precision::F64, &layout, None);
        // All items are in the last tenth of the rows, with increasing density.
        let counts: Vec<u32> = (0..20_000_u32)
            .map(|cell| if cell < 18_000 { 0 } else { (cell / 10 - 1800) % 8 + (cell % 3) })
            .collect();
        let items: u32 = counts.iter().sum();
        population.set(
            &layout,
            &Items { counts, labels: (0..items).collect(), fields: vec![vec![0; 24 * items as usize]] },
        );
        let heaviest_row = (0..2000).map(|row| work(&layout, &population, row..row + 1)).max().unwrap();
        for threads in [1, 2, 3, 16] {
            let blocks = blocks(&layout, &[&population], threads);
            let all: Vec<usize> = blocks.iter().cloned().flatten().collect();
            assert_eq!(all, (0..2000).collect::<Vec<_>>(), "every row once, in order");
            let share = work(&layout, &population, 0..2000) / (threads * BLOCKS_PER_THREAD);
            for block in blocks {
                assert!(work(&layout, &population, block) <= share + heaviest_row + 1);
            }
        }
    }

    #[test]
    fn due_rows_are_shared_in_blocks_that_are_worth_it() {
        let due: Vec<DueRow> = (0..500).map(|row| DueRow { row: 3 * row, tiles: 1 + row % 7 }).collect();
        let tiles = |blocks: &Range<usize>| due[blocks.clone()].iter().map(|row| row.tiles).sum::<usize>();
        assert_eq!(blocks_of_due(&due, 1), vec![0..500]);
        for threads in [2, 16] {
            let blocks = blocks_of_due(&due, threads);
            assert_eq!(blocks.iter().cloned().flatten().collect::<Vec<_>>(), (0..500).collect::<Vec<_>>());
            let (last, others) = blocks.split_last().unwrap();
            let all: usize = due.iter().map(|row| row.tiles).sum();
            let share = (all / (threads * BLOCKS_PER_THREAD)).max(TILES_PER_BLOCK);
            assert!(others.iter().all(|block| (share..share + 7).contains(&tiles(block))));
            assert!(tiles(last) < share + 7);
        }
        assert_eq!([1, 2].map(|threads| blocks_of_due(&[], threads)), [vec![], vec![]]);
    }

    #[test]
    fn fewer_rows_than_blocks() {
        assert_eq!(blocks(&layout([5, 3, 1]), &[], 4), [0..1, 1..2, 2..3]);
    }
}
