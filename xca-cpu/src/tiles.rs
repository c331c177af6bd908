//! Tiles: pieces of rows that are updated or skipped as a whole.

use crate::layout::Layout;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use xca_core::Geometry;

/// The number of tiles, or of rows, in a word.
pub(crate) const BITS: usize = u64::BITS as usize;

/// The tiles of rows. A row has a bit for each tile, in as many words as needed.
#[derive(Debug, Clone)]
pub(crate) struct Tiles {
    /// The number of cells in a tile. The last tile of a row may have fewer.
    width: usize,
    /// The number of cells in a row.
    cells: usize,
    /// The reach of the neighbourhood along x.
    reach: usize,
    /// Whether the row is a ring.
    is_ring: bool,
    /// The number of tiles in a row.
    count: usize,
    /// The number of words for a row.
    words: usize,
}

impl Tiles {
    /// Tiles of `width` cells.
    pub(crate) fn new(geometry: &Geometry, layout: &Layout, width: usize) -> Self {
        Self::of_row([width, layout.width()], layout.reach()[0], geometry.toroidal()[0])
    }

    fn of_row([width, cells]: [usize; 2], reach: usize, is_ring: bool) -> Self {
        let count = cells.div_ceil(width);
        Self { width, cells, reach, is_ring, count, words: count.div_ceil(BITS) }
    }

    /// The number of tiles in a row.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The number of words for a row.
    pub(crate) fn words(&self) -> usize {
        self.words
    }

    /// A word of a row with all tiles marked.
    pub(crate) fn full(&self, word: usize) -> u64 {
        let tiles = (self.count() - word * BITS).min(BITS);
        u64::MAX >> (BITS - tiles)
    }

    /// The cells of some tiles of a row.
    pub(crate) fn cells(&self, tiles: &Range<usize>) -> Range<usize> {
        tiles.start * self.width..(tiles.end * self.width).min(self.cells)
    }

    /// The cells at both ends of a tile that other tiles see.
    pub(crate) fn ends(&self, tile: &Range<usize>) -> [Range<usize>; 2] {
        let reach = self.reach.min(tile.len());
        [tile.start..tile.start + reach, tile.end - reach..tile.end]
    }

    /// Marks a tile.
    pub(crate) fn mark(words: &mut [u64], tile: usize) {
        words[tile / BITS] |= 1 << (tile % BITS);
    }

    /// Marks the tile of a cell.
    pub(crate) fn mark_cell(&self, words: &mut [u64], cell: usize) {
        Self::mark(words, cell / self.width);
    }

    /// Marks the tiles that see these cells.
    pub(crate) fn mark_around(&self, words: &mut [u64], cells: &Range<usize>) {
        if cells.is_empty() {
            return;
        }
        let mut mark = |cells: Range<usize>| {
            (cells.start / self.width..=(cells.end - 1) / self.width)
                .for_each(|tile| Self::mark(words, tile));
        };
        mark(cells.start.saturating_sub(self.reach)..(cells.end + self.reach).min(self.cells));
        let (below, above) =
            (self.reach.saturating_sub(cells.start), (cells.end + self.reach).saturating_sub(self.cells));
        if self.is_ring && below > 0 {
            mark(self.cells.saturating_sub(below)..self.cells);
        }
        if self.is_ring && above > 0 {
            mark(0..above.min(self.cells));
        }
    }

    /// The next marked tile of a row and the marked tiles after it, at most `most`.
    pub(crate) fn next(&self, words: &[u64], from: usize, most: usize) -> Option<Range<usize>> {
        let start = self.first(words, from, false)?;
        let end = self.first(words, start, true).unwrap_or(self.count);
        Some(start..end.min(start.saturating_add(most)))
    }

    /// The first tile from `from` on that is marked, or with `inverted` not marked.
    fn first(&self, words: &[u64], from: usize, inverted: bool) -> Option<usize> {
        let mut from = from;
        while from < self.count {
            let word = if inverted { !words[from / BITS] } else { words[from / BITS] } >> (from % BITS);
            if word != 0 {
                return Some(from + word.trailing_zeros() as usize).filter(|tile| *tile < self.count);
            }
            from += BITS - from % BITS;
        }
        None
    }
}

/// Marks on the tiles of all rows. Unless a method says otherwise, threads set marks in their own rows.
#[derive(Debug)]
pub(crate) struct Marks {
    words: Vec<AtomicU64>,
    of_row: usize,
    /// A bit for each row: whether it may have marks. Most rows of most models have none.
    rows: Vec<AtomicU64>,
}

impl Marks {
    /// No marks.
    pub(crate) fn new(tiles: &Tiles, rows: usize) -> Self {
        let of_row = tiles.words();
        let [words, rows] = [rows * of_row, rows.div_ceil(BITS)].map(zeros);
        Self { words, of_row, rows }
    }

    /// Marks all tiles.
    pub(crate) fn fill(&mut self, tiles: &Tiles) {
        for row in self.words.chunks_exact_mut(self.of_row) {
            row.iter_mut().enumerate().for_each(|(number, word)| *word.get_mut() = tiles.full(number));
        }
        let rows = self.words.len() / self.of_row;
        (0..rows).for_each(|row| self.notice(row));
    }

    fn row(&self, row: usize) -> &[AtomicU64] {
        &self.words[row * self.of_row..(row + 1) * self.of_row]
    }

    /// The number of marked tiles.
    pub(crate) fn count(&self) -> usize {
        self.words.iter().map(marked).sum()
    }

    /// The rows that may have marks, as bits, in 64 rows from `64 * number` on.
    pub(crate) fn rows(&self, number: usize) -> u64 {
        self.rows[number].load(Ordering::Relaxed)
    }

    /// The number of marked tiles of a row. No other thread may use the marks meanwhile.
    pub(crate) fn count_row(&self, row: usize) -> usize {
        let count = self.row(row).iter().map(marked).sum();
        if count == 0 {
            self.rows[row / BITS].fetch_and(!(1 << (row % BITS)), Ordering::Relaxed);
        }
        count
    }

    /// Records that a row may have marks.
    fn notice(&self, row: usize) {
        let (word, bit) = (&self.rows[row / BITS], 1 << (row % BITS));
        if word.load(Ordering::Relaxed) & bit == 0 {
            word.fetch_or(bit, Ordering::Relaxed);
        }
    }

    /// Adds marks to a row.
    pub(crate) fn add(&self, row: usize, marks: impl IntoIterator<Item = u64>) {
        self.notice(row);
        for (word, marks) in self.row(row).iter().zip(marks) {
            word.store(word.load(Ordering::Relaxed) | marks, Ordering::Relaxed);
        }
    }

    /// Adds marks to a row, which other threads may do at the same time.
    pub(crate) fn add_shared(&self, row: usize, marks: &[u64]) {
        self.notice(row);
        for (word, marks) in self.row(row).iter().zip(marks) {
            // A read is cheaper, and the rows beside have often made the same marks.
            if word.load(Ordering::Relaxed) & marks != *marks {
                word.fetch_or(*marks, Ordering::Relaxed);
            }
        }
    }

    /// Adds the marks of a row of other marks to a row.
    pub(crate) fn add_row(&self, row: usize, (others, other): (&Self, usize)) {
        self.add(row, others.row(other).iter().map(|word| word.load(Ordering::Relaxed)));
    }

    /// Whether a tile of a row is marked.
    pub(crate) fn is_marked(&self, row: usize) -> bool {
        self.row(row).iter().any(|word| word.load(Ordering::Relaxed) != 0)
    }

    /// Clears the marks of a row.
    pub(crate) fn clear(&self, row: usize) {
        self.row(row).iter().for_each(|word| word.store(0, Ordering::Relaxed));
    }

    /// Adds a mark to a tile.
    pub(crate) fn add_tile(&self, row: usize, tile: usize) {
        self.notice(row);
        let word = &self.row(row)[tile / BITS];
        word.store(word.load(Ordering::Relaxed) | 1 << (tile % BITS), Ordering::Relaxed);
    }

    /// Takes the marks of a row, and clears them.
    pub(crate) fn take(&self, row: usize, marks: &mut Vec<u64>) {
        marks.clear();
        for word in self.row(row) {
            marks.push(word.load(Ordering::Relaxed));
            word.store(0, Ordering::Relaxed);
        }
    }
}

pub(crate) fn zeros(count: usize) -> Vec<AtomicU64> {
    (0..count).map(|_| AtomicU64::new(0)).collect()
}

/// The number of bits set in a word.
fn marked(word: &AtomicU64) -> usize {
    word.load(Ordering::Relaxed).count_ones() as usize
}

#[cfg(test)]
mod tests {
    use super::{Marks, Tiles};

    fn tiles(width: usize, cells: usize, reach: usize, is_ring: bool) -> Tiles {
        Tiles::of_row([width, cells], reach, is_ring)
    }

    fn bits(words: &[u64], count: usize) -> Vec<usize> {
        (0..count).filter(|tile| words[tile / 64] >> (tile % 64) & 1 == 1).collect()
    }

    /// Cell by cell: the tiles with a cell that sees one of the cells.
    #[test]
    fn cells_are_seen_from_the_tiles_within_reach() {
        for (width, cells, reach) in [(3, 10, 2), (1, 70, 1), (4, 4, 3), (5, 21, 5), (32, 33, 3), (2, 1, 2)] {
            for is_ring in [false, true] {
                let tiles = tiles(width, cells, reach, is_ring);
                for start in 0..cells {
                    for end in start + 1..=cells.min(start + 4) {
                        let mut words = vec![0; tiles.words()];
                        tiles.mark_around(&mut words, &(start..end));
                        let sees = |cell: usize| {
                            (start..end).any(|seen| {
                                let straight = cell.abs_diff(seen);
                                straight <= reach || (is_ring && cells - straight.min(cells) <= reach)
                            })
                        };
                        let mut wanted: Vec<usize> =
                            (0..cells).filter(|cell| sees(*cell)).map(|cell| cell / width).collect();
                        wanted.dedup();
                        assert_eq!(bits(&words, tiles.count()), wanted, "{tiles:?} {start}..{end}");
                    }
                }
            }
        }
    }

    #[test]
    fn marked_tiles_come_in_runs() {
        let tiles = tiles(2, 401, 1, false);
        let mut words = vec![0; tiles.words()];
        let marked = [0, 1, 2, 62, 63, 64, 65, 130, 199, 200];
        marked.iter().for_each(|tile| Tiles::mark(&mut words, *tile));
        for most in [1, 2, 1000] {
            let mut runs = Vec::new();
            let mut from = 0;
            while let Some(run) = tiles.next(&words, from, most) {
                assert!(run.len() <= most);
                from = run.end;
                runs.push(run);
            }
            assert_eq!(runs.into_iter().flatten().collect::<Vec<_>>(), marked);
        }
        assert_eq!(tiles.cells(&(199..201)), 398..401);
        assert_eq!((0..4).map(|word| tiles.full(word).count_ones()).sum::<u32>(), 201);
    }

    #[test]
    fn rows_with_marks_are_noticed_until_they_have_none() {
        let tiles = tiles(2, 401, 1, false);
        let marks = Marks::new(&tiles, 130);
        marks.add_tile(0, 200);
        marks.add_shared(63, &[0, 3, 0, 1]);
        marks.add_row(64, (&marks, 63));
        marks.add(129, [1]);
        let noticed = || [0, 1, 2].map(|number| marks.rows(number));
        assert_eq!(noticed(), [1 | 1 << 63, 1, 2]);
        assert_eq!([0, 63, 64, 129].map(|row| marks.count_row(row)), [1, 3, 3, 1]);
        assert_eq!(noticed(), [1 | 1 << 63, 1, 2]);
        marks.clear(63);
        assert_eq!(marks.count_row(63), 0);
        assert_eq!(noticed(), [1, 1, 2]);
    }
}
