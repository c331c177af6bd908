//! Passes over the rows, each in the wake of the previous one. All passes use a row while it is in the cache.
//! This is temporal blocking, with skewed blocks and the gaps between them.
//!
//! The rows form layers, which are passed one after the other. A pass may update a layer once the previous
//! pass has done all layers that see it or that it sees: those within a lag. Within a block of layers, each
//! pass follows the previous one at this distance. Before a cut it ends at that distance, because the layers
//! beyond belong to another block. The undone layers on both sides of each cut form a gap, which is done
//! afterwards. All blocks can run at the same time, then all gaps.
//!
//! In a part of a space, blocks end at its borders in the same way. The layers that are left there are done
//! pass by pass, each with the edges of the other part after the previous pass.
//!
//! If a few layers exceed the cache, a block is done in columns, one after the other. In each later pass a
//! column shifts towards the first row, as far as rows see each other. It then needs nothing from later
//! columns, and overwrites nothing that they need.

use std::ops::Range;

/// The order of the rows, and the distance between passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lag {
    /// The number of rows in a layer.
    pub layer: usize,
    /// The largest distance between layers that see each other.
    pub layers: usize,
    /// Whether the first and the last layers also see each other.
    pub is_ring: bool,
    /// The largest distance between rows that see each other, in a layer or in layers that see each other.
    /// `None` if all rows may see each other, which excludes columns.
    pub along: Option<usize>,
    /// Whether another part of the space lies before the first layer, and after the last one.
    pub borders: [bool; 2],
}

impl Lag {
    /// Whether another part of the space lies before the first layer or after the last one.
    pub fn has_border(self) -> bool {
        self.borders != [false; 2]
    }

    /// For passes that do not affect each other.
    pub const NONE: Self = Self { layer: 1, layers: 0, is_ring: false, along: None, borders: [false; 2] };
}

/// The number of consecutive passes, and their distances.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Depth {
    /// The number of passes.
    pub passes: usize,
    /// The distance between two of them.
    pub lag: Lag,
    /// The number of layers that a pass does before the next one follows, at least one.
    pub chunk: usize,
    /// The number of rows of a layer in a column, at least one. `None` without columns.
    pub column: Option<usize>,
}

impl Depth {
    /// The least number of layers in a block. The gaps at its two ends must not overlap, nor what is left at
    /// borders.
    pub fn least_block(self) -> usize {
        let passes = if self.lag.has_border() { self.passes } else { self.passes.saturating_sub(1) };
        (2 * passes * self.lag.layers).max(1)
    }

    /// The layers that blocks and gaps leave out in a pass: each pass leaves out more, because it sees what
    /// the one before has left out. `layers` is the number of all layers.
    pub fn layers_at_borders(self, pass: usize, layers: usize) -> impl Iterator<Item = Range<usize>> {
        let Lag { layers: lag, borders: [low, high], .. } = self.lag;
        let width = lag * (pass + 1);
        [low.then_some(0..width), high.then_some(layers - width..layers)].into_iter().flatten()
    }

    /// The columns of a layer, by index.
    fn columns(self) -> Range<usize> {
        let shift = self.passes.saturating_sub(1) * self.lag.along.unwrap_or(0);
        0..self.column.map_or(1, |rows| (self.lag.layer + shift).div_ceil(rows))
    }

    /// The rows of a layer that belong to a column in a pass.
    fn rows(self, column: usize, pass: usize) -> Range<usize> {
        let (Some(rows), Some(along)) = (self.column, self.lag.along) else { return 0..self.lag.layer };
        let edge = |column: usize| (column * rows).saturating_sub(pass * along).min(self.lag.layer);
        edge(column)..edge(column + 1)
    }
}

/// Several passes over all rows. Their order gives the same result as one pass after the other.
#[derive(Debug, Clone)]
pub struct Wavefront {
    depth: Depth,
    /// The blocks of layers, in order.
    blocks: Vec<Range<usize>>,
}

/// A block or a gap: the work of one thread at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Piece {
    low: Edge,
    high: Edge,
    /// The first pass with layers here.
    first: usize,
}

/// The start or end of a piece: a layer in the first pass, shifted by `slope` layers in each later pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Edge {
    layer: isize,
    slope: isize,
}

/// Rows that one pass does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Portion {
    /// The index of the pass.
    pub pass: usize,
    /// The rows, in order.
    pub rows: Range<usize>,
}

impl Edge {
    fn at(self, pass: usize) -> isize {
        self.layer + pass as isize * self.slope
    }
}

impl Wavefront {
    /// Each block must have at least [`Depth::least_block`] layers.
    pub fn new(depth: Depth, blocks: Vec<Range<usize>>) -> Self {
        Self { depth, blocks }
    }

    /// A single pass over blocks of rows.
    pub fn of_one_pass(blocks: Vec<Range<usize>>) -> Self {
        let chunk = blocks.iter().map(ExactSizeIterator::len).max().unwrap_or(0).max(1);
        Self { depth: Depth { passes: 1, lag: Lag::NONE, chunk, column: None }, blocks }
    }

    /// The pieces. Those of the first list can run in any order or at the same time, then those of the second
    /// list.
    pub fn pieces(&self) -> [Vec<Piece>; 2] {
        let Depth { passes, lag: Lag { layers: lag, is_ring, .. }, .. } = self.depth;
        let lag = lag as isize;
        let layers = self.layers();
        let is_cut = |layer: usize| passes > 1 && (is_ring || !(layer == 0 || layer == layers));
        let [low, high] = self.depth.lag.borders;
        let block = |block: &Range<usize>| {
            // The first pass ends before a border too, as it would see another part there.
            let edge = |layer: usize, is_border: bool, sign: isize| Edge {
                layer: layer as isize + if is_border { sign * lag } else { 0 },
                slope: if is_border || is_cut(layer) { sign * lag } else { 0 },
            };
            Piece {
                low: edge(block.start, low && block.start == 0, 1),
                high: edge(block.end, high && block.end == layers, -1),
                first: 0,
            }
        };
        let gap = |block: &Range<usize>| {
            let edge = |slope: isize| Edge { layer: block.start as isize, slope };
            is_cut(block.start).then(|| Piece { low: edge(-lag), high: edge(lag), first: 1 })
        };
        [self.blocks.iter().map(block).collect(), self.blocks.iter().filter_map(gap).collect()]
    }

    fn layers(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.end)
    }

    /// The work of a piece, in order.
    pub fn portions(&self, piece: Piece) -> impl Iterator<Item = Portion> {
        let Self { depth, .. } = *self;
        self.turns(piece).flat_map(move |turn| {
            let layer = depth.lag.layer;
            let rows = depth.rows(turn.column, turn.pass);
            let is_whole = rows.len() == layer;
            let (whole, parts) = if is_whole { (Some(turn.layers), 0..0) } else { (None, turn.layers) };
            let whole = whole.map(|layers| layers.start * layer..layers.end * layer);
            let parts = parts.map(move |number| number * layer + rows.start..number * layer + rows.end);
            let all = whole.into_iter().chain(parts).filter(|rows| !rows.is_empty());
            all.map(move |rows| Portion { pass: turn.pass, rows })
        })
    }

    /// The turns of the passes in a piece, in order.
    fn turns(&self, piece: Piece) -> impl Iterator<Item = Turn> {
        let Depth { passes, lag, chunk, .. } = self.depth;
        let (lag, layers) = (lag.layers as isize, self.layers() as isize);
        let passes = piece.first..passes;
        // The distance of a pass behind the front.
        let behind = move |pass: usize| pass as isize * lag;
        let start = passes.clone().map(|pass| piece.low.at(pass) + behind(pass)).min().unwrap_or(0);
        let end = passes.clone().map(|pass| piece.high.at(pass) + behind(pass)).max().unwrap_or(0);
        let columns = self.depth.columns();
        let fronts =
            columns.flat_map(move |column| (start..end).step_by(chunk).map(move |front| (column, front)));
        fronts.flat_map(move |(column, front)| {
            passes.clone().flat_map(move |pass| {
                let here = front - behind(pass);
                let (low, high) =
                    (here.max(piece.low.at(pass)), (here + chunk as isize).min(piece.high.at(pass)));
                round(low..high, layers).map(move |layers| Turn { column, pass, layers })
            })
        })
    }
}

/// Layers of a column that one pass does.
struct Turn {
    column: usize,
    pass: usize,
    layers: Range<usize>,
}

/// Maps layers beyond the first or the last one of a ring to layers of the ring.
fn round(range: Range<isize>, layers: isize) -> impl Iterator<Item = Range<usize>> {
    let parts = [-1, 0, 1].map(|turn| {
        let (start, end) = (range.start + turn * layers, range.end + turn * layers);
        start.clamp(0, layers) as usize..end.clamp(0, layers) as usize
    });
    parts.into_iter().filter(|part| part.start < part.end)
}

#[cfg(test)]
mod tests {
    use super::{Depth, Lag, Portion, Wavefront};

    /// Pseudo-random numbers.
    struct Chance(u64);

    impl Chance {
        fn below(&mut self, limit: usize) -> usize {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) as usize % limit
        }
    }

    /// Whether two rows see each other.
    fn see(a: usize, b: usize, rows: usize, lag: Lag) -> bool {
        let apart = (a / lag.layer).abs_diff(b / lag.layer);
        let layers = apart <= lag.layers || (lag.is_ring && rows / lag.layer - apart <= lag.layers);
        layers && lag.along.is_none_or(|along| (a % lag.layer).abs_diff(b % lag.layer) <= along)
    }

    /// Checks a pass at a row: all earlier passes have done the rows that it sees, and no later pass has
    /// overwritten them.
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
        let (mut cuts, mut columns, mut at_borders) = (0, 0, 0);
        for case in 0..600 {
            let (layer, along) = (1 + chance.below(7), (case % 3 > 0).then(|| chance.below(3)));
            let borders = [case % 4 == 1, case % 8 < 4].map(|is_border| is_border && case % 2 == 1);
            let lag = Lag { layer, layers: chance.below(4), is_ring: case % 2 == 0, along, borders };
            let column = along.map(|_| 1 + chance.below(4));
            let depth = Depth { passes: 1 + chance.below(5), lag, chunk: 1 + chance.below(7), column };
            columns += depth.columns().len() - 1;
            let lengths: Vec<usize> =
                (0..=chance.below(4)).map(|_| depth.least_block() + chance.below(9)).collect();
            let blocks = lengths.iter().scan(0, |start, length| {
                *start += length;
                Some(*start - length..*start)
            });
            let wavefront = Wavefront::new(depth, blocks.collect());
            let mut done = vec![0; wavefront.layers() * layer];
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
            for pass in 0..depth.passes {
                for layers in depth.layers_at_borders(pass, wavefront.layers()) {
                    let rows = layers.start * layer..layers.end * layer;
                    at_borders += rows.len();
                    check(&Portion { pass, rows }, &mut done, lag);
                }
            }
            assert!(done.iter().all(|done| *done == depth.passes), "{depth:?} {lengths:?} {done:?}");
        }
        assert!(cuts > 300 && columns > 600 && at_borders > 5000, "{cuts} {columns} {at_borders}");
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

    fn portions(depth: Depth, layers: usize) -> Vec<(usize, std::ops::Range<usize>)> {
        let wavefront = Wavefront::new(depth, std::iter::once(0..layers).collect());
        let [blocks, _] = wavefront.pieces();
        let portions = blocks.into_iter().flat_map(|block| wavefront.portions(block));
        portions.map(|portion| (portion.pass, portion.rows)).collect()
    }

    #[test]
    fn passes_follow_in_chunks() {
        let depth = Depth { passes: 2, lag: Lag { layers: 2, ..Lag::NONE }, chunk: 3, column: None };
        let wanted = [(0, 0..3), (1, 0..1), (0, 3..6), (1, 1..4), (0, 6..7), (1, 4..7)];
        assert_eq!(portions(depth, 7), wanted);
    }

    #[test]
    fn columns_are_shifted_from_pass_to_pass() {
        let lag = Lag { layer: 10, layers: 1, along: Some(1), ..Lag::NONE };
        let depth = Depth { passes: 2, lag, chunk: 1, column: Some(6) };
        let first = [(0, 0..6), (0, 10..16), (1, 0..5), (1, 10..15)];
        let second = [(0, 6..10), (0, 16..20), (1, 5..10), (1, 15..20)];
        assert_eq!(portions(depth, 2), [first, second].concat());
    }
}
