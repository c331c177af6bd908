//! Neighbourhoods that kernels know at compile time. Their loops over neighbours need no table.

/// The number of a shape, for constant generics of kernels.
pub type ShapeNumber = u8;

/// Any neighbourhood, known only at run time.
pub const ANY: ShapeNumber = 0;

/// The six cells around a hexagon. Their displacements differ between rows or columns.
pub const HEXAGONAL: ShapeNumber = 6;

/// The largest number of cells of a shape.
pub const MOST: usize = 27;

/// Cells at most one step away along each axis, in the order of the ready-made neighbourhoods.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    pub size: usize,
    pub displacements: [[i32; 3]; MOST],
}

impl Shape {
    /// The cells of one layer or of three that differ along at most `steps` axes.
    const fn ball(layers: i32, steps: i32) -> Self {
        let mut shape = Self { size: 1, displacements: [[0; 3]; MOST] };
        let mut z = -layers;
        while z <= layers {
            let mut y = -1;
            while y <= 1 {
                let mut x = -1_i32;
                while x <= 1 {
                    let away = x * x + y * y + z * z;
                    if away > 0 && away <= steps {
                        shape.displacements[shape.size] = [x, y, z];
                        shape.size += 1;
                    }
                    x += 1;
                }
                y += 1;
            }
            z += 1;
        }
        shape
    }

    /// The index of the neighbour in the opposite direction. The list is symmetric.
    pub const fn opposite(&self, index: usize) -> usize {
        if index == 0 { 0 } else { self.size - index }
    }
}

/// The shape with this number. Its size is 0 if the neighbourhood is known only at run time.
pub const fn shape(number: ShapeNumber) -> Shape {
    match number {
        1 => Shape::ball(0, 1),
        2 => Shape::ball(1, 1),
        3 => Shape::ball(0, 2),
        4 => Shape::ball(1, 2),
        5 => Shape::ball(1, 3),
        HEXAGONAL => Shape { size: 7, displacements: [[0; 3]; MOST] },
        _ => Shape { size: 0, displacements: [[0; 3]; MOST] },
    }
}

/// The shape of a neighbourhood that is the same for all cells.
pub fn number_of(displacements: &[[i32; 3]]) -> ShapeNumber {
    let known = |number: &ShapeNumber| {
        let shape = shape(*number);
        shape.displacements[..shape.size] == *displacements
    };
    (1..HEXAGONAL).find(known).unwrap_or(ANY)
}
