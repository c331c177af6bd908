//! Which part of a plane of cells is on the screen, and how large.

use xca_picture::fitted;

/// How many times larger things are when one comes closer to a space that is on the screen as a whole.
const CLOSER: f64 = 4.0;

/// A part of a plane of cells, and the pixels that show it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Window {
    /// The first cell across and down; the lowest row is the first.
    pub(super) first: [usize; 2],
    /// How many cells there are.
    pub(super) cells: [usize; 2],
    pub(super) pixels: [usize; 2],
}

/// What of the plane one wants to see.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// A part of the plane, in place of the whole.
    pub(super) is_close: bool,
    /// The middle of that part, as shares of the plane.
    pub(super) middle: [f64; 2],
}

impl Default for Place {
    fn default() -> Self {
        Self { is_close: false, middle: [0.5; 2] }
    }
}

impl Window {
    /// The whole plane, as large as there is room; or, close, a part of it in which a cell is a pixel, or
    /// four times as large where it is one already. Cells that are drawn have a whole number of pixels, where
    /// there are as many. None where there are no cells or no room.
    pub(super) fn new(
        plane: [usize; 2],
        room: [usize; 2],
        place: Place,
        are_cells_drawn: bool,
    ) -> Option<Self> {
        if plane.contains(&0) || room.contains(&0) {
            return None;
        }
        let share = (room[0] as f64 / plane[0] as f64).min(room[1] as f64 / plane[1] as f64);
        let whole = if are_cells_drawn && share > 1.0 { share.floor() } else { share };
        if !place.is_close {
            let smooth = std::array::from_fn(|i| pixels(plane[i], whole, room[i]));
            let pixels = if are_cells_drawn { fitted(plane, room) } else { smooth };
            return Some(Self { first: [0; 2], cells: plane, pixels });
        }
        let side = if whole < 1.0 { 1.0 } else { CLOSER * whole };
        let cells: [usize; 2] =
            std::array::from_fn(|i| ((room[i] as f64 / side) as usize).clamp(1, plane[i]));
        let first = std::array::from_fn(|i| {
            let from = place.middle[i] * plane[i] as f64 - cells[i] as f64 / 2.0;
            // Casts of negative numbers and of NaN give zero.
            (from.round() as usize).min(plane[i] - cells[i])
        });
        let pixels = std::array::from_fn(|i| pixels(cells[i], side, room[i]));
        Some(Self { first, cells, pixels })
    }

    /// The place after a move by a quarter of what is seen, each way.
    pub(super) fn moved(&self, plane: [usize; 2], [right, up]: [i8; 2]) -> Place {
        let middle = std::array::from_fn(|i| {
            let (cells, all) = (self.cells[i] as f64, plane[i] as f64);
            let by = f64::from([right, up][i]) * (cells / 4.0).floor().max(1.0);
            // From what is seen, which is within the plane: so one that was pushed beyond the edge turns at
            // once.
            (self.first[i] as f64 + cells / 2.0 + by) / all
        });
        Place { is_close: true, middle }
    }
}

/// How many pixels cells of this side take.
fn pixels(cells: usize, side: f64, room: usize) -> usize {
    ((cells as f64 * side).round() as usize).clamp(1, room)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CLOSE: Place = Place { is_close: true, middle: [0.5; 2] };

    fn window(first: [usize; 2], cells: [usize; 2], pixels: [usize; 2]) -> Option<Window> {
        Some(Window { first, cells, pixels })
    }

    #[test]
    fn a_whole_space_is_as_large_as_there_is_room() {
        let whole = |plane, room| Window::new(plane, room, Place::default(), true);
        assert_eq!(whole([8, 8], [80, 40]), window([0; 2], [8; 2], [40, 40]));
        assert_eq!(whole([8, 8], [80, 39]), window([0; 2], [8; 2], [32, 32]));
        assert_eq!(whole([256, 256], [80, 40]), window([0; 2], [256; 2], [40, 40]));
        assert_eq!(whole([1000, 1], [80, 40]), window([0; 2], [1000, 1], [80, 1]));
        assert_eq!(whole([1000, 1], [80, 0]), None);
        assert_eq!(whole([0, 5], [80, 40]), None);
    }

    #[test]
    fn close_a_cell_is_a_pixel() {
        assert_eq!(Window::new([256, 256], [80, 40], CLOSE, true), window([88, 108], [80, 40], [80, 40]));
        assert_eq!(Window::new([256, 20], [80, 40], CLOSE, true), window([88, 0], [80, 20], [80, 20]));
        // Eight pixels each already.
        assert_eq!(Window::new([10, 5], [80, 40], CLOSE, true), window([4, 2], [2, 1], [64, 32]));
    }

    #[test]
    fn what_is_not_drawn_cell_by_cell_takes_all_the_room() {
        let smooth = |place| Window::new([20, 20], [100, 50], place, false);
        assert_eq!(smooth(Place::default()), window([0; 2], [20; 2], [50; 2]));
        // Ten pixels each.
        assert_eq!(smooth(CLOSE), window([5, 8], [10, 5], [100, 50]));
        assert_eq!(Window::new([200, 100], [50, 50], CLOSE, false), window([75, 25], [50; 2], [50; 2]));
    }

    #[test]
    fn moves_end_at_the_edge_and_turn_at_once() {
        let (plane, room) = ([256, 256], [80, 40]);
        let mut place = CLOSE;
        for _ in 0..50 {
            place = Window::new(plane, room, place, true).unwrap().moved(plane, [-1, 1]);
        }
        let corner = Window::new(plane, room, place, true).unwrap();
        assert_eq!(corner.first, [0, 216]);
        let back = Window::new(plane, room, corner.moved(plane, [1, -1]), true).unwrap();
        assert_eq!(back.first, [20, 206]);
    }

    proptest! {
        #[test]
        fn a_window_is_within_its_plane_and_its_room(
            plane in prop::array::uniform2(1_usize..300),
            room in prop::array::uniform2(1_usize..300),
            middle in prop::array::uniform2(-1.0..2.0),
            is_close in any::<bool>(),
            are_cells_drawn in any::<bool>(),
        ) {
            let window = Window::new(plane, room, Place { is_close, middle }, are_cells_drawn).unwrap();
            for i in 0..2 {
                prop_assert!(window.cells[i] >= 1 && window.first[i] + window.cells[i] <= plane[i]);
                prop_assert!((1..=room[i]).contains(&window.pixels[i]));
            }
        }
    }
}
