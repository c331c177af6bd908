//! What files hold.

use super::{Grid, HexagonGrid};

/// What the numbers of an array are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum NumberType {
    U8,
    I32,
    U32,
    F32,
    F64,
}

/// An array with its values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadArray {
    /// Its name.
    pub name: String,
    /// What its numbers are.
    pub numbers: NumberType,
    /// How many of them a value has.
    pub components: usize,
    /// What follows the name of the array in the names of its components, where the file tells it.
    /// [`Self::component_name`] knows it of all.
    pub component_names: Vec<String>,
    /// What its values are called, by number, if they are states.
    pub states: Vec<String>,
    /// The numbers, in the byte order of this machine.
    pub bytes: Vec<u8>,
}

impl ReadArray {
    /// What follows the name of the array in the name of a component: nothing for a scalar, else `.x`, `[3]`,
    /// `[3].x`.
    pub fn component_name(&self, component: usize) -> String {
        let given = self.component_names.get(component).cloned();
        given.unwrap_or_else(|| default_name(component, self.components))
    }
}

/// What [`super::super::write_dense`] has written.
#[derive(Debug, Clone, PartialEq)]
pub struct DenseFile {
    /// The simulated time.
    pub time: f64,
    /// The cells.
    pub grid: Grid,
    /// Which cells are hidden, if the file has an array [`super::super::GHOST_TYPE`].
    pub hidden: Option<Vec<bool>>,
    /// One value for each cell, x fastest, then y.
    pub arrays: Vec<ReadArray>,
}

/// What [`super::super::write_hexagons`] has written.
#[derive(Debug, Clone, PartialEq)]
pub struct HexagonFile {
    /// The simulated time.
    pub time: f64,
    /// The cells.
    pub grid: HexagonGrid,
    /// Which cells are hidden, if the file has an array [`super::super::GHOST_TYPE`].
    pub hidden: Option<Vec<bool>>,
    /// One value for each cell, x fastest, then y.
    pub arrays: Vec<ReadArray>,
}

/// What a `.vtp` file can hold.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum PolyDataFile {
    Particles(ParticleFile),
    Hexagons(HexagonFile),
}

/// What [`super::super::write_particles`] has written.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleFile {
    /// The simulated time.
    pub time: f64,
    /// Where the particles are.
    pub positions: ReadArray,
    /// One value for each particle.
    pub arrays: Vec<ReadArray>,
}

impl NumberType {
    /// Numbers of a file, which are little-endian, as this machine has them.
    pub(super) fn of_this_machine(self, mut bytes: Vec<u8>) -> Vec<u8> {
        let size = match self {
            Self::U8 => 1,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        };
        if cfg!(target_endian = "big") {
            bytes.chunks_exact_mut(size).for_each(<[u8]>::reverse);
        }
        bytes
    }
}

/// What follows the name of an array for a component that the file does not name.
pub(super) fn default_name(number: usize, components: usize) -> String {
    match (components, [".x", ".y", ".z", ".w"].get(number)) {
        (1, _) => String::new(),
        (2..=4, Some(lane)) => (*lane).to_owned(),
        _ => format!("[{number}]"),
    }
}
