//! Operators, and what an engine provides to a process.

/// Functions and values that an engine provides to a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Builtin {
    /// `cell.neighbour_count()`: the number of cells in the neighbourhood, including the central one,
    /// `usize`.
    NeighbourCount,
    /// `cell.opposite(n)`: the index of the neighbour in the opposite direction, `usize`.
    Opposite,
    /// `cell.displacement(n)`: from the cell to a neighbour, `Vector3<i32>`.
    Displacement,
    /// `cell.exists(n)`: whether a neighbour is a cell of the space, `bool`.
    Exists,
    /// `cell.index()`: the cell's indices x, y, z, `Vector3<i32>`.
    Index,
    /// `me.label()`: the item's label, `u32`.
    Label,
    /// `cell.random(draw)`: uniform in [0, 1), `Real`.
    Random,
    /// `cell.random_bits(draw)`: 32 random bits, `u32`.
    RandomBits,
    /// `space.side()`: the side of a cell in metres, `Real`.
    Side,
    /// `space.extents()`: the number of cells along x, y, z, `Vector3<i32>`.
    Extents,
    /// `space.step()`: the number of the step, from 0, `u32` (its low 32 bits).
    Step,
    /// `space.nearest_image(separation)`: the separation to the nearest image, `Vector3<Real>`.
    NearestImage,
    /// `space.wrapped(position)`: a position inside the space, `Vector3<Real>`.
    Wrapped,
    /// `space.cell_containing(position)`: a destination.
    CellContaining,
    /// `Destination::Stay`
    Stay,
    /// `Destination::Outside`
    Outside,
}

/// Operators of one operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnaryOperator {
    /// `-`
    Negate,
    /// `!`
    Not,
}

/// Operators of two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum BinaryOperator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    And,
    Or,
    BitAnd,
    BitOr,
    BitXor,
    ShiftLeft,
    ShiftRight,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}
