//! Passes over the rows, each in the wake of the one before, so that a row is met by all of them while it is in
//! the processor's cache: temporal blocking with skewed blocks and the gaps between them.
//!
//! A pass may work on a row when the pass before has done all rows that see it or that it sees: those within a
//! lag. Within a block of rows each pass follows the one before at this distance, and ends at that distance
//! before a cut, since what lies beyond is another block's. What that leaves undone on both sides of each cut is
//! done afterwards. All blocks can be worked on at the same time, and then all gaps.

use std::ops::Range;

/// The distance that passes keep from each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Lag {
    /// Rows that see each other are at most so many apart.
    pub(crate) rows: usize,
    /// Whether the first rows and the last ones see each other, too.
    pub(crate) is_ring: bool,
}

/// How many passes follow each other, and how.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Depth {
    pub(crate) passes: usize,
    pub(crate) lag: Lag,
    /// How many rows a pass does before the next one follows, at least one.
    pub(crate) chunk: usize,
}

impl Depth {
    /// The rows that a block must have at least: the gaps at its two ends must not overlap.
    pub(crate) fn least_block(self) -> usize {
        (2 * self.passes.saturating_sub(1) * self.lag.rows).max(1)
    }
}

/// Some passes over all rows, in an order in which no row can notice that they are not done one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Wavefront {
    depth: Depth,
    /// One after the other.
    blocks: Vec<Range<usize>>,
}

/// A block or a gap: what one thread does at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Piece {
    low: Edge,
    high: Edge,
    /// The first pass that has rows here.
    first: usize,
}

/// Where a piece begins or ends: a row in the first pass, and so many rows further in each one that follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Edge {
    row: isize,
    slope: isize,
}

/// Rows that one pass does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Portion {
    pub(crate) pass: usize,
    pub(crate) rows: Range<usize>,
}

impl Edge {
    fn at(self, pass: usize) -> isize {
        self.row + pass as isize * self.slope
    }
}

impl Wavefront {
    /// Each block has to have at least [`Depth::least_block`] rows.
    pub(crate) fn new(depth: Depth, blocks: Vec<Range<usize>>) -> Self {
        Self { depth, blocks }
    }

    /// A single pass.
    pub(crate) fn of_one_pass(blocks: Vec<Range<usize>>) -> Self {
        let chunk = blocks.iter().map(ExactSizeIterator::len).max().unwrap_or(0).max(1);
        Self { depth: Depth { passes: 1, lag: Lag { rows: 0, is_ring: false }, chunk }, blocks }
    }

    /// The pieces: first those of one list, in any order or at the same time, then those of the other.
    pub(crate) fn pieces(&self) -> [Vec<Piece>; 2] {
        let Depth { passes, lag: Lag { rows: lag, is_ring }, .. } = self.depth;
        let lag = lag as isize;
        let rows = self.rows();
        let is_cut = |row: usize| passes > 1 && (is_ring || !(row == 0 || row == rows));
        let block = |block: &Range<usize>| {
            let slope = |row: usize| if is_cut(row) { lag } else { 0 };
            Piece {
                low: Edge { row: block.start as isize, slope: slope(block.start) },
                high: Edge { row: block.end as isize, slope: -slope(block.end) },
                first: 0,
            }
        };
        let gap = |block: &Range<usize>| {
            let edge = |slope: isize| Edge { row: block.start as isize, slope };
            is_cut(block.start).then(|| Piece { low: edge(-lag), high: edge(lag), first: 1 })
        };
        [self.blocks.iter().map(block).collect(), self.blocks.iter().filter_map(gap).collect()]
    }

    fn rows(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.end)
    }

    /// What is done in a piece, in order.
    pub(crate) fn portions(&self, piece: Piece) -> impl Iterator<Item = Portion> {
        let Depth { passes, lag, chunk } = self.depth;
        let (lag, rows) = (lag.rows as isize, self.rows() as isize);
        let passes = piece.first..passes;
        // A pass is so far behind the front.
        let behind = move |pass: usize| pass as isize * lag;
        let start = passes.clone().map(|pass| piece.low.at(pass) + behind(pass)).min().unwrap_or(0);
        let end = passes.clone().map(|pass| piece.high.at(pass) + behind(pass)).max().unwrap_or(0);
        let fronts = (start..end).step_by(chunk);
        fronts.flat_map(move |front| {
            passes.clone().flat_map(move |pass| {
                let here = front - behind(pass);
                let (low, high) =
                    (here.max(piece.low.at(pass)), (here + chunk as isize).min(piece.high.at(pass)));
                round(low..high, rows).map(move |rows| Portion { pass, rows })
            })
        })
    }
}

/// Rows that may lie beyond the first or the last one of a ring.
fn round(range: Range<isize>, rows: isize) -> impl Iterator<Item = Range<usize>> {
    let parts = [-1, 0, 1].map(|turn| {
        let (start, end) = (range.start + turn * rows, range.end + turn * rows);
        start.clamp(0, rows) as usize..end.clamp(0, rows) as usize
    });
    parts.into_iter().filter(|part| part.start < part.end)
}

#[cfg(test)]
mod tests {
    use super::{Depth, Lag, Portion, Wavefront};

    /// Numbers without a pattern.
    struct Chance(u64);

    impl Chance {
        fn below(&mut self, limit: usize) -> usize {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) as usize % limit
        }
    }

    /// Whether two rows see each other.
    fn see(a: usize, b: usize, rows: usize, lag: Lag) -> bool {
        let apart = a.abs_diff(b);
        apart <= lag.rows || (lag.is_ring && rows - apart <= lag.rows)
    }

    /// A pass does a row: all passes before have done those that it sees, and none has gone on to overwrite them.
    fn check(portion: &Portion, done: &mut [usize], lag: Lag) {
        for row in portion.rows.clone() {
            assert_eq!(done[row], portion.pass, "row {row} twice, or left out");
            for (other, done) in
                done.iter().enumerate().filter(|(other, _)| see(row, *other, done.len(), lag))
            {
                let is_between = (portion.pass..=portion.pass + 1).contains(done);
                assert!(is_between, "pass {} of row {row} meets pass {done} of row {other}", portion.pass);
            }
            done[row] += 1;
        }
    }

    #[test]
    fn no_row_notices_in_whatever_order_the_pieces_are_worked_on() {
        let mut chance = Chance(1);
        let mut cuts = 0;
        for case in 0..400 {
            let lag = Lag { rows: chance.below(4), is_ring: case % 2 == 0 };
            let depth = Depth { passes: 1 + chance.below(5), lag, chunk: 1 + chance.below(7) };
            let lengths: Vec<usize> =
                (0..=chance.below(4)).map(|_| depth.least_block() + chance.below(9)).collect();
            let blocks = lengths.iter().scan(0, |start, length| {
                *start += length;
                Some(*start - length..*start)
            });
            let wavefront = Wavefront::new(depth, blocks.collect());
            let mut done = vec![0; wavefront.rows()];
            for pieces in wavefront.pieces() {
                cuts += pieces.iter().filter(|piece| piece.first == 1).count();
                let mut under_way: Vec<_> =
                    pieces.into_iter().map(|piece| wavefront.portions(piece).peekable()).collect();
                while !under_way.is_empty() {
                    let number = chance.below(under_way.len());
                    match under_way[number].next() {
                        Some(portion) => check(&portion, &mut done, lag),
                        None => drop(under_way.swap_remove(number)),
                    }
                }
            }
            assert!(done.iter().all(|done| *done == depth.passes), "{depth:?} {lengths:?} {done:?}");
        }
        assert!(cuts > 300, "{cuts}");
    }

    #[test]
    fn a_single_pass_is_a_portion_for_each_block() {
        let wavefront = Wavefront::of_one_pass(vec![0..5, 5..6, 6..20]);
        let [blocks, gaps] = wavefront.pieces();
        let rows: Vec<_> = blocks
            .into_iter()
            .flat_map(|block| wavefront.portions(block))
            .map(|portion| portion.rows)
            .collect();
        assert_eq!(rows, [0..5, 5..6, 6..20]);
        assert_eq!(gaps, []);
    }

    #[test]
    fn passes_follow_in_chunks() {
        let lag = Lag { rows: 2, is_ring: false };
        let wavefront = Wavefront::new(Depth { passes: 2, lag, chunk: 3 }, std::iter::once(0..7).collect());
        let [blocks, _] = wavefront.pieces();
        let portions = blocks.into_iter().flat_map(|block| wavefront.portions(block));
        let portions: Vec<_> = portions.map(|portion| (portion.pass, portion.rows)).collect();
        assert_eq!(portions, [(0, 0..3), (1, 0..1), (0, 3..6), (1, 1..4), (0, 6..7), (1, 4..7)]);
    }
}
