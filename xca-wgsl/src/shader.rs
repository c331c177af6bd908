//! What the user of this crate gives and gets.

use crate::layout::Layout;
use xca_core::{Boundary, Faces, Parity, Precision, ValueType};

/// What a shader is written for.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Options {
    /// What `Real` stands for.
    pub precision: Precision,
    /// The number of cells in the neighbourhood with the central one; where it is not given, the shader reads
    /// it from the description of the space.
    pub neighbourhood_size: Option<u32>,
    /// For each cell of the neighbourhood the difference of its number from that of the central cell, where
    /// that is the same for all cells. Loops over the neighbours are then written out, each neighbour with
    /// its number, which some drivers do not do by themselves (Mesa's lavapipe runs a loop over 27 neighbours
    /// half as fast).
    pub neighbour_offsets: Option<Vec<i32>>,
    /// The size of a workgroup along x, y and z; of a process over items the product.
    pub workgroup_size: [u32; 3],
    /// How a workgroup of a process over cells finds its cells.
    pub numbering: Numbering,
    /// What lies beyond the faces: round toroidal axes searches for near items go the shorter way, beyond
    /// flat faces no neighbour exists.
    pub boundaries: Faces<Boundary>,
    /// Whether cells in odd rows or columns have another neighbourhood than those in even ones.
    pub parity: Parity,
    /// Whether float zeros are read from memory. Some drivers take `x + 0.0` for `x` and `x * 0.0` for `0.0`
    /// in spite of all decorations (Mesa's lavapipe does), which is wrong for `-0.0`, NaN and infinities; a
    /// zero that they cannot see keeps the bits.
    pub opaque_zero: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            precision: Precision::default(),
            neighbourhood_size: None,
            neighbour_offsets: None,
            workgroup_size: [64, 1, 1],
            numbering: Numbering::Axes,
            boundaries: Faces::all(Boundary::Flat),
            parity: Parity::None,
            opaque_zero: false,
        }
    }
}

/// A process as a module of WGSL.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shader {
    /// The text.
    pub source: String,
    /// The name of the entry point.
    pub entry_point: String,
    /// The buffers that it uses, all in group 0, in the order of their numbers.
    pub bindings: Vec<Binding>,
    /// What one invocation works on.
    pub dispatch: Dispatch,
    /// How its workgroups find their cells, where it runs over cells.
    pub numbering: Numbering,
    /// Whether the module uses 64-bit floats.
    pub needs_f64: bool,
}

/// How a workgroup of a process over cells finds its cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Numbering {
    /// Workgroups lie along x, y and z as the cells do.
    Axes,
    /// Workgroups are numbered, x running fastest, and workgroup `(x, y)` of the dispatch is number
    /// `x + y * (workgroups along x)`: for more workgroups along an axis than a device has room for.
    Row,
    /// Workgroups are numbered as in a row, and look up in a list which tile of the space is theirs; they
    /// note what they change: [`Content::Activity`].
    List,
}

/// The words before the list of [`Content::Activity`].
pub const ACTIVITY_HEAD: u32 = 64;

/// What the invocations of a shader run over. Invocations beyond the end do nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dispatch {
    /// The cells: one invocation for each, along x, y and z, in workgroups of this size.
    Cells([u32; 3]),
    /// The items: one invocation for each, in workgroups of this many. Where one dimension does not hold all
    /// workgroups, they go on along y: workgroup `(x, y)` is number `x + y * (workgroups along x)`.
    Items(u32),
}

/// A buffer of a shader.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Binding {
    /// The number in group 0.
    pub number: u32,
    /// The name in the source.
    pub name: String,
    /// How the shader uses it.
    pub access: BindingAccess,
    /// What it holds.
    pub content: Content,
}

/// How a shader uses a buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BindingAccess {
    /// A uniform buffer.
    Uniform,
    /// A storage buffer that is read.
    Read,
    /// A storage buffer that is read and written.
    ReadWrite,
}

/// What a buffer holds. Cells are numbered with their halo, as the cell at `(x, y, z)` is number
/// `(x + halo.x) + (y + halo.y) * row + (z + halo.z) * layer`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// What is known of the space: `extents`, the number of cells of the neighbourhood, `halo`, `row`,
    /// `layer`, `seed` (low word, high word), the number of the `stream` of random numbers; where they are
    /// used, `side`, `covered`, the largest radius of a search, and `zero`, which is 0. A process over cells
    /// can be run for a part of them: the `first` cell, by its indices, the `count` of cells along each axis,
    /// and the number `base` of the stored cell with which the bound buffers begin. For all cells these are
    /// 0, the extents, and 0.
    Space(Layout),
    /// What changes with the step: `step` (low word, high word) and the number of items of the population.
    Moment(Layout),
    /// A struct of parameters: in a storage buffer where one of them is an array, else in a uniform buffer.
    Parameters {
        /// The number of the struct among those of parameters that the process takes.
        argument: usize,
        /// Where its fields lie.
        layout: Layout,
    },
    /// `i32` for each cell of the neighbourhood: the difference of its number from that of the central cell.
    /// Where rows or columns differ ([`Options::parity`]), first those of even, then those of odd ones.
    NeighbourOffsets,
    /// Four `i32` for each cell of the neighbourhood: the displacement along x, y, z and the index of the
    /// opposite neighbour. Where rows or columns differ, as with [`Self::NeighbourOffsets`].
    NeighbourDirections,
    /// A substate of all cells, or of all items: a value for each, element after element, lane beside lane,
    /// without padding; a `u8`, a `bool` and a state as a `u32`.
    Substate {
        /// The number of the struct among those of substates that the process takes.
        argument: usize,
        /// The number of the field in the struct of substates.
        field: usize,
        /// What it holds.
        value_type: ValueType,
        /// Which state.
        state: State,
    },
    /// `u32` for each cell: its first item.
    ItemStarts,
    /// `u32` for each cell: one past its last item.
    ItemEnds,
    /// `u32` for each item: its label.
    ItemLabels,
    /// `u32` for each item: the number of its cell.
    ItemCells,
    /// `u32` for each item: where a migration sends it, the linear index of a cell (without halo) or one of
    /// `xca_core::kernel::{STAY, OUTSIDE, NOWHERE}`.
    Destinations,
    /// Which tiles a process works on, and in which it changes something, as `u32`. A tile is the cells of a
    /// workgroup; `n` is the number of tiles. At 0 the number of this run, at 1 the length of the list, from
    /// [`ACTIVITY_HEAD`] on the list, as many words as tiles; then `n` words that are the engine's; then `n`
    /// words for each substate that the process writes, in the order of the bindings: the number of the last
    /// run that changed it in that tile.
    Activity,
    /// Faults: at 0 a `u32`, the linear index of the first cell (of a process over items: the first item)
    /// with a fault, which is `u32::MAX` before; at 4 a `u32` that makes the shader do nothing where it is
    /// not zero, so that the state at a fault stays; from 8 on a record for each workgroup, numbered with x
    /// running fastest, which holds the first fault in it: `cell`, `label`, and what [`crate::FaultKind`]
    /// tells of `kind`, `number`, `limit` and `value`. A record that no fault was written to is not touched.
    Faults(Layout),
}

/// Which state a buffer with a substate shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// That from before the process; only read.
    Before,
    /// That from after the process, where the other is still read: the buffers are exchanged afterwards.
    After,
    /// Both: written in place.
    Both,
}
