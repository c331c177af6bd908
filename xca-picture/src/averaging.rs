//! The cells that a pixel shows.

use xca_io::lattice::Lattice;

/// The cells that a pixel shows along one axis.
pub(super) struct Share {
    first: usize,
    last: usize,
    /// The shares of the first and the last cell. The cells between them count in full.
    of_first: f64,
    of_last: f64,
}

impl Share {
    pub(super) fn new(pixel: usize, pixels: usize, cells: usize) -> Self {
        if cells <= pixels {
            let cell = (pixel * cells / pixels).min(cells - 1);
            return Self { first: cell, last: cell, of_first: 1.0, of_last: 1.0 };
        }
        let size = cells as f64 / pixels as f64;
        let (from, to) = (pixel as f64 * size, (pixel + 1) as f64 * size);
        let first = (from as usize).min(cells - 1);
        let last = ((to.ceil() as usize).max(1) - 1).clamp(first, cells - 1);
        Self { first, last, of_first: first as f64 + 1.0 - from, of_last: to - last as f64 }
    }

    /// The cells, each with the share that the pixel shows.
    pub(super) fn cells(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        (self.first..=self.last).map(|cell| {
            let share = if cell == self.first {
                self.of_first
            } else if cell == self.last {
                self.of_last
            } else {
                1.0
            };
            (cell, share)
        })
    }
}

/// The pixels across and down that show cells in a room. Each cell gets a whole number of pixels if there is
/// room.
pub fn fitted(cells: [usize; 2], room: [usize; 2]) -> [usize; 2] {
    let (cells, room) = (cells.map(|n| n.max(1)), room.map(|n| n.max(1)));
    let side = (room[0] / cells[0]).min(room[1] / cells[1]);
    if side > 0 {
        return cells.map(|n| n * side);
    }
    let share = (0..2).map(|i| room[i] as f64 / cells[i] as f64).fold(f64::INFINITY, f64::min);
    std::array::from_fn(|i| ((cells[i] as f64 * share).round() as usize).clamp(1, room[i]))
}

/// The pixels across and down that show a layer in a room. For squares see [`fitted`].
pub(super) fn fitted_layer(lattice: Lattice, cells: [usize; 2], room: [usize; 2]) -> [usize; 2] {
    if lattice == Lattice::Squares {
        return fitted(cells, room);
    }
    let size = lattice.size(cells);
    let scale = (0..2).map(|i| room[i] as f64 / size[i]).fold(f64::INFINITY, f64::min);
    std::array::from_fn(|i| ((size[i] * scale).round() as usize).clamp(1, room[i].max(1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shares_of_all_pixels_are_all_cells() {
        for (pixels, cells) in [(400, 1001), (7, 8), (1, 5), (333, 4096)] {
            let mut found = vec![0.0; cells];
            for share in (0..pixels).map(|pixel| Share::new(pixel, pixels, cells)) {
                let mut sum = 0.0;
                for (cell, part) in share.cells() {
                    found[cell] += part;
                    sum += part;
                }
                assert!((sum - cells as f64 / pixels as f64).abs() < 1e-9, "{pixels} {cells}");
            }
            assert!(found.iter().all(|sum| (sum - 1.0).abs() < 1e-9), "{pixels} {cells}");
        }
    }
}
