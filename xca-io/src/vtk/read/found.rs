//! The content of VTK files.

use super::{Grid, HexagonGrid, NumberType};

/// An array with its values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadArray {
    /// Its name.
    pub name: String,
    /// The type of its numbers.
    pub numbers: NumberType,
    /// The number of components of a value.
    pub components: usize,
    /// The suffixes of the names of the components, if the file gives them. [`Self::component_name`] also
    /// gives defaults.
    pub component_names: Vec<String>,
    /// The names of the states, by value, if the values are states.
    pub states: Vec<String>,
    /// The numbers, in the byte order of this machine.
    pub bytes: Vec<u8>,
}

impl ReadArray {
    /// The suffix of the name of a component: empty for a scalar, otherwise `.x`, `[3]` or `[3].x`.
    pub fn component_name(&self, component: usize) -> String {
        let given = self.component_names.get(component).cloned();
        given.unwrap_or_else(|| default_name(component, self.components))
    }
}

/// A file that [`super::super::write_dense`] has written.
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

/// A file that [`super::super::write_hexagons`] has written.
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

/// The content of a `.vtp` file.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum PolyDataFile {
    Particles(ParticleFile),
    Hexagons(HexagonFile),
}

/// A file that [`super::super::write_particles`] has written.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleFile {
    /// The simulated time.
    pub time: f64,
    /// The positions of the particles.
    pub positions: ReadArray,
    /// One value for each particle.
    pub arrays: Vec<ReadArray>,
}

/// The suffix of the name of a component that the file does not name.
pub(super) fn default_name(number: usize, components: usize) -> String {
    match (components, [".x", ".y", ".z", ".w"].get(number)) {
        (1, _) => String::new(),
        (2..=4, Some(lane)) => (*lane).to_owned(),
        _ => format!("[{number}]"),
    }
}
