//! Names for the neighbour indices of the ready-made neighbourhoods of radius 1, in processes and on the
//! host.
//!
//! North is +y, east +x, up +z. Each module belongs to one neighbourhood. In another neighbourhood, the same
//! index means another direction.
//!
//! ```
//! use xca_core::prelude::*;
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Air {
//!     smoke: Real,
//! }
//!
//! /// Smoke drifts to the north-east.
//! #[elementary_process]
//! fn drift(cell: &mut Cell<Air>) {
//!     cell.smoke = cell.neighbour(directions::moore_2d::SOUTH_WEST).smoke;
//! }
//! ```

/// For [`Neighbourhood::von_neumann_2d`](crate::Neighbourhood::von_neumann_2d) with radius 1.
#[expect(missing_docs, reason = "the names say it")]
pub mod von_neumann_2d {
    pub const CENTRE: usize = 0;
    pub const SOUTH: usize = 1;
    pub const WEST: usize = 2;
    pub const EAST: usize = 3;
    pub const NORTH: usize = 4;
}

/// For [`Neighbourhood::von_neumann`](crate::Neighbourhood::von_neumann) with radius 1.
#[expect(missing_docs, reason = "the names say it")]
pub mod von_neumann {
    pub const CENTRE: usize = 0;
    pub const DOWN: usize = 1;
    pub const SOUTH: usize = 2;
    pub const WEST: usize = 3;
    pub const EAST: usize = 4;
    pub const NORTH: usize = 5;
    pub const UP: usize = 6;
}

/// For [`Neighbourhood::moore_2d`](crate::Neighbourhood::moore_2d) with radius 1.
#[expect(missing_docs, reason = "the names say it")]
pub mod moore_2d {
    pub const CENTRE: usize = 0;
    pub const SOUTH_WEST: usize = 1;
    pub const SOUTH: usize = 2;
    pub const SOUTH_EAST: usize = 3;
    pub const WEST: usize = 4;
    pub const EAST: usize = 5;
    pub const NORTH_WEST: usize = 6;
    pub const NORTH: usize = 7;
    pub const NORTH_EAST: usize = 8;
}

/// For [`Neighbourhood::moore`](crate::Neighbourhood::moore) with radius 1.
#[expect(missing_docs, reason = "the names say it")]
pub mod moore {
    pub const CENTRE: usize = 0;
    pub const DOWN_SOUTH_WEST: usize = 1;
    pub const DOWN_SOUTH: usize = 2;
    pub const DOWN_SOUTH_EAST: usize = 3;
    pub const DOWN_WEST: usize = 4;
    pub const DOWN: usize = 5;
    pub const DOWN_EAST: usize = 6;
    pub const DOWN_NORTH_WEST: usize = 7;
    pub const DOWN_NORTH: usize = 8;
    pub const DOWN_NORTH_EAST: usize = 9;
    pub const SOUTH_WEST: usize = 10;
    pub const SOUTH: usize = 11;
    pub const SOUTH_EAST: usize = 12;
    pub const WEST: usize = 13;
    pub const EAST: usize = 14;
    pub const NORTH_WEST: usize = 15;
    pub const NORTH: usize = 16;
    pub const NORTH_EAST: usize = 17;
    pub const UP_SOUTH_WEST: usize = 18;
    pub const UP_SOUTH: usize = 19;
    pub const UP_SOUTH_EAST: usize = 20;
    pub const UP_WEST: usize = 21;
    pub const UP: usize = 22;
    pub const UP_EAST: usize = 23;
    pub const UP_NORTH_WEST: usize = 24;
    pub const UP_NORTH: usize = 25;
    pub const UP_NORTH_EAST: usize = 26;
}

/// For [`Neighbourhood::hexagonal`](crate::Neighbourhood::hexagonal).
pub mod hexagonal {
    /// For [`Hexagons::CornerUp`](crate::Hexagons::CornerUp).
    #[expect(missing_docs, reason = "the names say it")]
    pub mod corner_up {
        pub const CENTRE: usize = 0;
        pub const SOUTH_WEST: usize = 1;
        pub const SOUTH_EAST: usize = 2;
        pub const WEST: usize = 3;
        pub const EAST: usize = 4;
        pub const NORTH_WEST: usize = 5;
        pub const NORTH_EAST: usize = 6;
    }

    /// For [`Hexagons::SideUp`](crate::Hexagons::SideUp).
    #[expect(missing_docs, reason = "the names say it")]
    pub mod side_up {
        pub const CENTRE: usize = 0;
        pub const SOUTH_WEST: usize = 1;
        pub const NORTH_WEST: usize = 2;
        pub const SOUTH: usize = 3;
        pub const NORTH: usize = 4;
        pub const SOUTH_EAST: usize = 5;
        pub const NORTH_EAST: usize = 6;
    }
}
