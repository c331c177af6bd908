//! The arrangement of the cells of a layer.

/// The side of a hexagon: the reciprocal of the root of 3.
const SIDE: f64 = 0.577_350_269_189_625_8;

/// The arrangement of the cells of a layer. The unit of length is the distance between neighbouring centres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Lattice {
    /// Squares.
    #[default]
    Squares,
    /// Hexagons in straight rows, with a corner at the top. Odd rows are shifted half a cell to the right.
    HexagonRows,
    /// Hexagons in straight columns, with a side at the top. Odd columns are shifted half a cell upwards.
    HexagonColumns,
}

/// The distance between rows of hexagons.
const ROW: f64 = 1.5 * SIDE;

impl Lattice {
    /// Width and height of a layer with these columns and rows.
    pub fn size(self, [columns, rows]: [usize; 2]) -> [f64; 2] {
        match self {
            Self::Squares => [columns as f64, rows as f64],
            Self::HexagonRows => {
                let shift = if rows > 1 { 0.5 } else { 0.0 };
                [columns as f64 + shift, 2.0 * SIDE + rows.saturating_sub(1) as f64 * ROW]
            }
            Self::HexagonColumns => swapped(Self::HexagonRows.size([rows, columns])),
        }
    }

    /// The centre of a cell, relative to the lower left corner of the layer.
    pub fn centre(self, [column, row]: [usize; 2]) -> [f64; 2] {
        match self {
            Self::Squares => [column as f64 + 0.5, row as f64 + 0.5],
            Self::HexagonRows => [column as f64 + 0.5 + 0.5 * (row % 2) as f64, SIDE + row as f64 * ROW],
            Self::HexagonColumns => swapped(Self::HexagonRows.centre([row, column])),
        }
    }

    /// The corners of a cell, counterclockwise from the right, relative to its centre.
    pub fn corners(self) -> Vec<[f64; 2]> {
        let (half, side) = (0.5, SIDE);
        match self {
            Self::Squares => vec![[half, -half], [half, half], [-half, half], [-half, -half]],
            Self::HexagonRows => vec![
                [half, -0.5 * side],
                [half, 0.5 * side],
                [0.0, side],
                [-half, 0.5 * side],
                [-half, -0.5 * side],
                [0.0, -side],
            ],
            // Mirror images run clockwise.
            Self::HexagonColumns => Self::HexagonRows.corners().into_iter().rev().map(swapped).collect(),
        }
    }

    /// The column and row of the cell that contains a point, if there is one.
    pub fn cell_at(self, [x, y]: [f64; 2], [columns, rows]: [usize; 2]) -> Option<[usize; 2]> {
        match self {
            Self::Squares => Some([whole(x, columns)?, whole(y, rows)?]),
            Self::HexagonRows => {
                let below = ((y - SIDE) / ROW).floor();
                [below, below + 1.0].into_iter().find_map(|row| {
                    let row = whole(row, rows)?;
                    let column = whole(x - 0.5 * (row % 2) as f64, columns)?;
                    let [u, v] = self.centre([column, row]);
                    let (across, up) = ((x - u).abs(), (y - v).abs());
                    (0.5 * across + ROW * up <= 0.5).then_some([column, row])
                })
            }
            Self::HexagonColumns => Self::HexagonRows.cell_at([y, x], [rows, columns]).map(swapped),
        }
    }
}

fn swapped<T: Copy>([one, other]: [T; 2]) -> [T; 2] {
    [other, one]
}

/// The integer part of `number`, if it is in the range `0..of`.
fn whole(number: f64, of: usize) -> Option<usize> {
    let below = number.floor();
    (below >= 0.0 && below < of as f64).then_some(below as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEXAGONS: [Lattice; 2] = [Lattice::HexagonRows, Lattice::HexagonColumns];

    /// Brute force: the nearest centre, if the point lies inside the layer.
    #[test]
    fn a_point_is_in_the_cell_whose_centre_is_nearest() {
        for lattice in [Lattice::Squares, HEXAGONS[0], HEXAGONS[1]] {
            for cells in [[5, 4], [1, 3], [4, 1]] {
                let size = lattice.size(cells);
                let mut inside = 0;
                for i in 0..200 {
                    for j in 0..200 {
                        let point = [
                            (f64::from(i) + 0.37) / 200.0 * size[0],
                            (f64::from(j) + 0.41) / 200.0 * size[1],
                        ];
                        let Some(found) = lattice.cell_at(point, cells) else { continue };
                        inside += 1;
                        let away = |cell: [usize; 2]| {
                            let [x, y] = lattice.centre(cell);
                            (x - point[0]).hypot(y - point[1])
                        };
                        let all = (0..cells[0] * cells[1]).map(|cell| [cell % cells[0], cell / cells[0]]);
                        let nearest = all.map(away).fold(f64::INFINITY, f64::min);
                        assert!(away(found) <= nearest + 1e-12, "{lattice:?} {point:?} {found:?}");
                    }
                }
                // A hexagon of height 1 has the area √3/2.
                let area = if lattice == Lattice::Squares { 1.0 } else { 0.75_f64.sqrt() };
                let wanted = area * (cells[0] * cells[1]) as f64 / (size[0] * size[1]);
                assert!((f64::from(inside) / 4e4 - wanted).abs() < 0.01, "{lattice:?} {cells:?}");
            }
        }
    }

    /// Corners are shared with neighbours, and all lie inside the layer.
    #[test]
    fn corners_meet() {
        for lattice in HEXAGONS {
            let (cells, size) = ([6, 5], lattice.size([6, 5]));
            let mut corners: Vec<[i64; 2]> = Vec::new();
            for cell in 0..30 {
                let [x, y] = lattice.centre([cell % 6, cell / 6]);
                for [u, v] in lattice.corners() {
                    let corner = [x + u, y + v];
                    assert!(corner.iter().zip(size).all(|(at, end)| (-1e-12..=end + 1e-12).contains(at)));
                    corners.push(corner.map(|at| (at * 1e9).round() as i64));
                }
                assert_eq!(lattice.cell_at([x, y], cells), Some([cell % 6, cell / 6]));
            }
            corners.sort_unstable();
            corners.dedup();
            // Euler's formula for a patch of 6 x 5 hexagons, with 30 faces.
            assert!(corners.len() < 100, "{lattice:?}: {}", corners.len());
            let area: f64 = {
                let ring = lattice.corners();
                (0..6).map(|i| ring[i][0] * ring[(i + 1) % 6][1] - ring[(i + 1) % 6][0] * ring[i][1]).sum()
            };
            assert!((area / 2.0 - 0.75_f64.sqrt()).abs() < 1e-12, "{lattice:?}: counterclockwise");
        }
    }
}
