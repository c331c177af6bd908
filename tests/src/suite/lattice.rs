//! What a cell of a self-checking automaton knows of the space around it, in processes' own words.
//!
//! Nothing here asks the engine or the geometry: displacements, boundary rules and order are stated a second
//! time, from the documentation, so that both statements check each other.

use xca_core::prelude::*;

/// What stands in the first lane of the place of a cell that is none; in the others stands the number of the
/// face that it lies beyond.
pub const NOWHERE: i32 = -7;

/// The neighbourhoods that the automata know, by the number of [`Lattice::shape`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Shape {
    Alone,
    VonNeumann,
    Moore,
    VonNeumann2D,
    Moore2D,
    WideVonNeumann,
    WideMoore,
    HexagonsCornerUp,
    HexagonsSideUp,
    Skewed,
    Paired,
}

const VON_NEUMANN: u32 = Shape::VonNeumann as u32;
const MOORE: u32 = Shape::Moore as u32;
const VON_NEUMANN_2D: u32 = Shape::VonNeumann2D as u32;
const MOORE_2D: u32 = Shape::Moore2D as u32;
const WIDE_VON_NEUMANN: u32 = Shape::WideVonNeumann as u32;
const WIDE_MOORE: u32 = Shape::WideMoore as u32;
const HEXAGONS_CORNER_UP: u32 = Shape::HexagonsCornerUp as u32;
const HEXAGONS_SIDE_UP: u32 = Shape::HexagonsSideUp as u32;
const SKEWED: u32 = Shape::Skewed as u32;
const PAIRED: u32 = Shape::Paired as u32;

impl Shape {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Alone,
        Self::VonNeumann,
        Self::Moore,
        Self::VonNeumann2D,
        Self::Moore2D,
        Self::WideVonNeumann,
        Self::WideMoore,
        Self::HexagonsCornerUp,
        Self::HexagonsSideUp,
        Self::Skewed,
        Self::Paired,
    ];

    /// The neighbourhood as a model is given it.
    pub fn neighbourhood(self) -> Neighbourhood {
        match self {
            Self::Alone => Neighbourhood::von_neumann(0),
            Self::VonNeumann => Neighbourhood::von_neumann(1),
            Self::Moore => Neighbourhood::moore(1),
            Self::VonNeumann2D => Neighbourhood::von_neumann_2d(1),
            Self::Moore2D => Neighbourhood::moore_2d(1),
            Self::WideVonNeumann => Neighbourhood::von_neumann(2),
            Self::WideMoore => Neighbourhood::moore(2),
            Self::HexagonsCornerUp => Neighbourhood::hexagonal(Hexagons::CornerUp),
            Self::HexagonsSideUp => Neighbourhood::hexagonal(Hexagons::SideUp),
            Self::Skewed => {
                let displacements = vec![[0, 0, 0], [2, -1, 0], [-1, 0, 1], [0, 1, -2], [1, 1, 1]];
                Neighbourhood::custom(displacements).unwrap_or_else(|_| Neighbourhood::von_neumann(0))
            }
            Self::Paired => {
                // Those of the cube, each followed by its opposite.
                let mut displacements = vec![[0, 0, 0]];
                for [x, y, z] in &Neighbourhood::moore(1).displacements([0; 3])[1..14] {
                    displacements.extend([[*x, *y, *z], [-x, -y, -z]]);
                }
                Neighbourhood::custom(displacements).unwrap_or_else(|_| Neighbourhood::von_neumann(0))
            }
        }
    }

    /// The number of cells in it.
    pub fn size(self) -> u32 {
        match self {
            Self::Alone => 1,
            Self::VonNeumann | Self::HexagonsCornerUp | Self::HexagonsSideUp => 7,
            Self::Moore | Self::Paired => 27,
            Self::VonNeumann2D | Self::Skewed => 5,
            Self::Moore2D => 9,
            Self::WideVonNeumann => 25,
            Self::WideMoore => 125,
        }
    }

    /// How far it reaches along x, y, z.
    pub fn reach(self) -> [usize; 3] {
        match self {
            Self::Alone => [0, 0, 0],
            Self::VonNeumann | Self::Moore | Self::Paired => [1, 1, 1],
            Self::VonNeumann2D | Self::Moore2D | Self::HexagonsCornerUp | Self::HexagonsSideUp => [1, 1, 0],
            Self::WideVonNeumann | Self::WideMoore => [2, 2, 2],
            Self::Skewed => [2, 1, 2],
        }
    }
}

/// A state, of cells, of items and of parameters.
#[derive(States, Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "they mean nothing")]
pub enum Terrain {
    Rock,
    Soil,
    Water,
}

/// The state that some bits stand for.
#[helper]
pub fn terrain_of(bits: u32) -> Terrain {
    match bits % 3 {
        0 => Terrain::Rock,
        1 => Terrain::Soil,
        _ => Terrain::Water,
    }
}

/// What the automata are told of the model that they stand in.
#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// The number of the [`Shape`].
    pub shape: u32,
    /// The size of the neighbourhood.
    pub neighbours: u32,
    /// Whether all that is nearer than the radius is in the neighbourhood: 1, else 0.
    pub covered: u32,
    /// The boundary of the first face across each axis: 0 flat, 1 toroidal, 2 reflecting.
    pub low: Vector3<i32>,
    /// Likewise of the second face.
    pub high: Vector3<i32>,
    /// How items of the second class move in a step, in quarters of a cell.
    pub forward: Vector3<i32>,
    /// How items of the third class move in a step, in quarters of a cell.
    pub backward: Vector3<i32>,
    /// The radius of searches in quarters of a cell.
    pub quarters: i32,
    /// The same radius in metres.
    pub radius: Real,
    /// Of sixteen places for an item how many are taken at the start.
    pub density: u32,
}

impl Lattice {
    /// For a neighbourhood and boundaries; nothing moves and nothing is searched.
    pub fn new(shape: Shape, boundaries: Faces<Boundary>) -> Self {
        let number = |boundary| match boundary {
            Boundary::Flat => 0,
            Boundary::Toroidal => 1,
            Boundary::Reflecting => 2,
        };
        let Faces { west, east, south, north, bottom, top } = boundaries;
        let place = |x, y, z| Vector3::new(number(x), number(y), number(z));
        Self {
            shape: shape as u32,
            neighbours: shape.size(),
            covered: 0,
            low: place(west, south, bottom),
            high: place(east, north, top),
            forward: Vector3::splat(0),
            backward: Vector3::splat(0),
            quarters: 0,
            radius: 0.0,
            density: 0,
        }
    }
}

/// Mixes two numbers so that any difference shows.
#[helper]
pub fn mix(a: u32, b: u32) -> u32 {
    let mut bits = a.wrapping_mul(0x9E37_79B1).wrapping_add(b);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x85EB_CA6B);
    bits = (bits ^ (bits >> 13)).wrapping_mul(0xC2B2_AE35);
    bits ^ (bits >> 16)
}

/// The linear index of a cell.
#[helper]
pub fn linear(place: Vector3<i32>, extents: Vector3<i32>) -> i32 {
    (place.z * extents.y + place.y) * extents.x + place.x
}

/// The place with this number in a block of cells `width` by `width`, x fastest, seen from its middle. The
/// middle is left out: numbers start with 1.
#[helper]
fn in_block(n: usize, width: i32, layers: i32) -> Vector3<i32> {
    let half = (width * width * layers - 1) / 2;
    let mut m = n as i32 - 1;
    if m >= half {
        m += 1;
    }
    Vector3::new(m % width - width / 2, m / width % width - width / 2, m / (width * width) - layers / 2)
}

/// The place with this number, from 0, in a cross of five.
#[helper]
fn in_cross(n: usize, z: i32) -> Vector3<i32> {
    match n {
        0 => Vector3::new(0, -1, z),
        1 => Vector3::new(-1, 0, z),
        2 => Vector3::new(0, 0, z),
        3 => Vector3::new(1, 0, z),
        _ => Vector3::new(0, 1, z),
    }
}

/// The `n`th cell at most two steps away along the axes.
#[helper]
fn in_wide_von_neumann(n: usize) -> Vector3<i32> {
    match n {
        1 => Vector3::new(0, 0, -2),
        2..=6 => in_cross(n - 2, -1),
        7 => Vector3::new(0, -2, 0),
        8..=10 => Vector3::new(n as i32 - 9, -1, 0),
        11 => Vector3::new(-2, 0, 0),
        12 => Vector3::new(-1, 0, 0),
        13 => Vector3::new(1, 0, 0),
        14 => Vector3::new(2, 0, 0),
        15..=17 => Vector3::new(n as i32 - 16, 1, 0),
        18 => Vector3::new(0, 2, 0),
        19..=23 => in_cross(n - 19, 1),
        _ => Vector3::new(0, 0, 2),
    }
}

/// The two neighbours in a row beside a hexagon's own: those at `shift - 1` and `shift`.
#[helper]
fn in_hexagons(n: usize, shift: i32) -> Vector3<i32> {
    match n {
        1 => Vector3::new(shift - 1, -1, 0),
        2 => Vector3::new(shift, -1, 0),
        3 => Vector3::new(-1, 0, 0),
        4 => Vector3::new(1, 0, 0),
        5 => Vector3::new(shift - 1, 1, 0),
        _ => Vector3::new(shift, 1, 0),
    }
}

/// The displacement of the neighbour with this number, from the cell `here`.
#[helper]
pub fn displacement(shape: u32, n: usize, here: Vector3<i32>) -> Vector3<i32> {
    if n == 0 {
        return Vector3::new(0, 0, 0);
    }
    match shape {
        VON_NEUMANN => match n {
            1 => Vector3::new(0, 0, -1),
            2 => Vector3::new(0, -1, 0),
            3 => Vector3::new(-1, 0, 0),
            4 => Vector3::new(1, 0, 0),
            5 => Vector3::new(0, 1, 0),
            _ => Vector3::new(0, 0, 1),
        },
        VON_NEUMANN_2D => match n {
            1 => Vector3::new(0, -1, 0),
            2 => Vector3::new(-1, 0, 0),
            3 => Vector3::new(1, 0, 0),
            _ => Vector3::new(0, 1, 0),
        },
        MOORE => in_block(n, 3, 3),
        MOORE_2D => in_block(n, 3, 1),
        WIDE_MOORE => in_block(n, 5, 5),
        WIDE_VON_NEUMANN => in_wide_von_neumann(n),
        HEXAGONS_CORNER_UP => in_hexagons(n, here.y % 2),
        HEXAGONS_SIDE_UP => {
            // The same grid with x and y exchanged, in the same order.
            let turned = in_hexagons(n, here.x % 2);
            Vector3::new(turned.y, turned.x, 0)
        }
        SKEWED => match n {
            1 => Vector3::new(2, -1, 0),
            2 => Vector3::new(-1, 0, 1),
            3 => Vector3::new(0, 1, -2),
            _ => Vector3::new(1, 1, 1),
        },
        PAIRED => {
            let one = in_block(n / 2 + n % 2, 3, 3);
            if n % 2 == 1 { one } else { -one }
        }
        _ => Vector3::new(NOWHERE, NOWHERE, NOWHERE),
    }
}

/// The neighbour in the opposite direction: the one whose displacement leads back from where this one leads.
#[helper]
pub fn opposite(p: &Lattice, n: usize, here: Vector3<i32>) -> usize {
    let way = displacement(p.shape, n, here);
    // Two further is a row and a column of the same kind, and not negative.
    let there = here + way + Vector3::splat(2);
    let mut found = 0;
    for m in 0..p.neighbours as usize {
        let back = displacement(p.shape, m, there);
        if back.x == -way.x && back.y == -way.y && back.z == -way.z {
            found = m;
        }
    }
    found
}

/// Where an index beyond the faces leads along one axis; -1 where it leads outside, before the first face,
/// and -2 behind the second.
#[helper]
pub fn fold(index: i32, extent: i32, low: i32, high: i32) -> i32 {
    if index < 0 {
        return match low {
            1 => index + extent,
            2 => -1 - index,
            _ => -1,
        };
    }
    if index >= extent {
        return match high {
            1 => index - extent,
            2 => 2 * extent - 1 - index,
            _ => -2,
        };
    }
    index
}

/// What stands in the place of a cell beyond the face with this number.
#[helper]
pub fn outside_place(face: i32) -> Vector3<i32> {
    Vector3::new(NOWHERE, face, face)
}

/// The place of a neighbour, by its displacement and the boundary rules.
#[helper]
pub fn neighbour_place(p: &Lattice, here: Vector3<i32>, extents: Vector3<i32>, n: usize) -> Vector3<i32> {
    let there = here + displacement(p.shape, n, here);
    let x = fold(there.x, extents.x, p.low.x, p.high.x);
    let y = fold(there.y, extents.y, p.low.y, p.high.y);
    let z = fold(there.z, extents.z, p.low.z, p.high.z);
    if z < 0 {
        return outside_place(3 - z);
    }
    if y < 0 {
        return outside_place(1 - y);
    }
    if x < 0 {
        return outside_place(-1 - x);
    }
    Vector3::new(x, y, z)
}
