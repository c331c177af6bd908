//! The types that an elementary process uses.
//!
//! They exist for the compiler and the reader. The macros check a process against them, then replace them by
//! kernels. They have no values, so ordinary code cannot call their functions.

use crate::checks::HasPosition;
use std::convert::Infallible;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};
use xca_values::Real;
use xca_values::Vector3;

/// The central cell, in a process that runs once for each cell.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Heat {
///     temperature: Real,
/// }
///
/// #[elementary_process]
/// fn conduct(cell: &mut Cell<Heat>) {
///     let mut sum = 0.0;
///     for n in 1..cell.neighbour_count() {
///         sum += cell.neighbour(n).temperature - cell.temperature;
///     }
///     cell.temperature += 0.2 * sum;
/// }
/// ```
///
/// Its substates are its fields: `cell.temperature` reads, `cell.temperature = …` writes. A process reads
/// back what it has written. It can write the central cell only.
#[derive(Debug)]
pub struct Cell<S> {
    never: Infallible,
    substates: PhantomData<S>,
}

impl<S: 'static> Cell<S> {
    /// The number of cells in the neighbourhood, including the central one: neighbours are
    /// `1..cell.neighbour_count()`.
    pub fn neighbour_count(&self) -> usize {
        match self.never {}
    }

    /// A cell of the neighbourhood as it was before this process; index 0 is the central cell. An index
    /// beyond the neighbourhood is a fault that stops the run.
    pub fn neighbour(&self, _index: usize) -> &'static S {
        match self.never {}
    }

    /// The index of the opposite direction: neighbour `index` sees this cell as `cell.opposite(index)`. 0 for
    /// 0. A custom neighbourhood must hold the opposite of each displacement, or `build` returns an error. An
    /// index beyond the neighbourhood is a fault, as in [`Self::neighbour`].
    pub fn opposite(&self, _index: usize) -> usize {
        match self.never {}
    }

    /// The displacement from this cell to a neighbour, in cells along x, y, z. With hexagons it depends on
    /// the row or column of the cell. An index beyond the neighbourhood is a fault, as in
    /// [`Self::neighbour`].
    pub fn displacement(&self, _index: usize) -> Vector3<i32> {
        match self.never {}
    }

    /// Whether a neighbour is a cell of the space. `false` only beyond a flat face, where
    /// [`Self::neighbour`] shows the outside values. An index beyond the neighbourhood is a fault, as in
    /// [`Self::neighbour`].
    pub fn exists(&self, _index: usize) -> bool {
        match self.never {}
    }

    /// The indices of the cell along x, y, z.
    pub fn index(&self) -> Vector3<i32> {
        match self.never {}
    }

    /// A random number in [0, 1): a function of seed, step, process, cell and `draw`, the same on every
    /// engine.
    ///
    /// Use a different `draw` each time within a process: equal draws give equal numbers. Draws of different
    /// processes are independent, and so are those of two runs of a process in one step.
    pub fn random(&self, _draw: usize) -> Real {
        match self.never {}
    }

    /// 32 random bits: a function of seed, step, process, cell and `draw`, the same on every engine. Equal
    /// draws give equal bits. [`Self::random`] makes its number of the same bits.
    pub fn random_bits(&self, _draw: usize) -> u32 {
        match self.never {}
    }

    /// Stops the run after this process with an error that names the step, the process, the cell, the code
    /// and the value.
    pub fn fault(&self, _code: u32, _value: Real) {
        match self.never {}
    }
}

impl<S> Deref for Cell<S> {
    type Target = S;

    fn deref(&self) -> &S {
        match self.never {}
    }
}

impl<S> DerefMut for Cell<S> {
    fn deref_mut(&mut self) -> &mut S {
        match self.never {}
    }
}

/// An item of a population, in a process that runs once for each item. Its substates are its fields.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Grain {
///     #[position]
///     position: Vector3<Real>,
///     force: Vector3<Real>,
/// }
///
/// /// Overlapping spheres repel each other.
/// #[elementary_process]
/// fn repel(me: &mut Slot<Grain>, space: &Space) {
///     let mut force = Vector3::splat(0.0);
///     for other in me.others_within(0.01) {
///         force += space.nearest_image(me.position - other.position);
///     }
///     me.force = 100.0 * force;
/// }
/// ```
#[derive(Debug)]
pub struct Slot<S> {
    never: Infallible,
    substates: PhantomData<S>,
}

impl<S: 'static> Slot<S> {
    /// The item's label, which never changes.
    pub fn label(&self) -> u32 {
        match self.never {}
    }

    /// The indices along x, y, z of the item's cell.
    pub fn index(&self) -> Vector3<i32> {
        match self.never {}
    }

    /// A random number in [0, 1): a function of seed, step, process, label and `draw`, the same on every
    /// engine.
    ///
    /// Use a different `draw` each time within a process: equal draws give equal numbers. Draws of different
    /// processes are independent, and so are those of two runs of a process in one step.
    pub fn random(&self, _draw: usize) -> Real {
        match self.never {}
    }

    /// 32 random bits: a function of seed, step, process, label and `draw`, the same on every engine. Equal
    /// draws give equal bits. [`Self::random`] makes its number of the same bits.
    pub fn random_bits(&self, _draw: usize) -> u32 {
        match self.never {}
    }

    /// Stops the run after this process with an error that names the step, the process, the cell, the item,
    /// the code and the value.
    pub fn fault(&self, _code: u32, _value: Real) {
        match self.never {}
    }

    /// The other items of the own cell, by label.
    pub fn others_in_cell(&self) -> Others<S> {
        match self.never {}
    }

    /// The items of the neighbours, by neighbour index, then label.
    pub fn others_in_neighbours(&self) -> Others<S> {
        match self.never {}
    }

    /// The other items of the own cell, then those of the neighbours.
    pub fn others(&self) -> Others<S> {
        match self.never {}
    }

    /// The items of [`Self::others_in_cell`] within a radius. Toroidal axes use the nearest image. A NaN or
    /// negative radius is a fault.
    pub fn others_in_cell_within(&self, _radius: Real) -> Others<S>
    where
        S: HasPosition,
    {
        match self.never {}
    }

    /// The items of [`Self::others_in_neighbours`] within a radius. Radii are limited as in
    /// [`Self::others_within`].
    pub fn others_in_neighbours_within(&self, _radius: Real) -> Others<S>
    where
        S: HasPosition,
    {
        match self.never {}
    }

    /// The items of [`Self::others`] whose distance is less than the radius.
    ///
    /// The neighbourhood must cover the radius; a larger radius is a fault that stops the run.
    /// [`Geometry::covered_radius`](crate::Geometry::covered_radius) is the limit: for a Moore neighbourhood,
    /// its radius times the cell side. A NaN or negative radius is a fault too.
    pub fn others_within(&self, _radius: Real) -> Others<S>
    where
        S: HasPosition,
    {
        match self.never {}
    }
}

impl<S> Deref for Slot<S> {
    type Target = S;

    fn deref(&self) -> &S {
        match self.never {}
    }
}

impl<S> DerefMut for Slot<S> {
    fn deref_mut(&mut self) -> &mut S {
        match self.never {}
    }
}

/// All items of the central cell, by label, in a process over cells.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Meadow {
///     grass: Real,
/// }
///
/// #[derive(Substates, Clone, Copy)]
/// struct Sheep {
///     appetite: Real,
/// }
///
/// #[elementary_process]
/// fn graze(cell: &mut Cell<Meadow>, herd: &Slots<Sheep>) {
///     for sheep in herd {
///         cell.grass -= sheep.appetite;
///     }
/// }
/// ```
#[derive(Debug)]
pub struct Slots<S> {
    never: Infallible,
    substates: PhantomData<S>,
}

impl<S: 'static> IntoIterator for &Slots<S> {
    type Item = &'static Other<S>;
    type IntoIter = Others<S>;

    fn into_iter(self) -> Others<S> {
        match self.never {}
    }
}

/// Another item. Its substates are its fields, for reading only.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Ant {
///     #[position]
///     position: Vector3<Real>,
///     load: Real,
///     rank: u32,
/// }
///
/// /// The number of heavier ants within 2 cm. Among equals the label decides.
/// #[elementary_process]
/// fn compare(me: &mut Slot<Ant>) {
///     me.rank = 0;
///     for other in me.others_within(0.02) {
///         if other.load > me.load || (other.load == me.load && other.label() < me.label()) {
///             me.rank += 1;
///         }
///     }
/// }
/// ```
#[derive(Debug)]
pub struct Other<S> {
    never: Infallible,
    substates: PhantomData<S>,
}

impl<S> Other<S> {
    /// The item's label.
    pub fn label(&self) -> u32 {
        match self.never {}
    }
}

impl<S> Deref for Other<S> {
    type Target = S;

    fn deref(&self) -> &S {
        match self.never {}
    }
}

/// Other items, for a `for` loop.
#[derive(Debug)]
pub struct Others<S> {
    never: Infallible,
    items: PhantomData<S>,
}

impl<S: 'static> Iterator for Others<S> {
    type Item = &'static Other<S>;

    fn next(&mut self) -> Option<&'static Other<S>> {
        match self.never {}
    }
}

/// The cellular space.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Grain {
///     #[position]
///     position: Vector3<Real>,
///     velocity: Vector3<Real>,
/// }
///
/// /// Moves a grain by at most half a cell, round toroidal axes.
/// #[elementary_process]
/// fn fly(me: &mut Slot<Grain>, space: &Space) {
///     let limit = 0.5 * space.side();
///     let step = me.velocity.length();
///     let share = if step > limit { limit / step } else { 1.0 };
///     me.position = space.wrapped(me.position + share * me.velocity);
/// }
/// ```
#[derive(Debug)]
pub struct Space {
    never: Infallible,
}

impl Space {
    /// The side of a cell in metres.
    pub fn side(&self) -> Real {
        match self.never {}
    }

    /// The number of cells along x, y, z.
    pub fn extents(&self) -> Vector3<i32> {
        match self.never {}
    }

    /// The number of the step, from 0 (its low 32 bits).
    pub fn step(&self) -> u32 {
        match self.never {}
    }

    /// The separation of two positions by the nearest image, on each toroidal axis. Other axes do not change.
    /// Searches measure distances in the same way.
    pub fn nearest_image(&self, _separation: Vector3<Real>) -> Vector3<Real> {
        match self.never {}
    }

    /// Wraps a position into the space on each toroidal axis. It may lie beyond a face by less than the
    /// length of the space. Other axes do not change.
    pub fn wrapped(&self, _position: Vector3<Real>) -> Vector3<Real> {
        match self.never {}
    }

    /// The cell that contains a position: cell `i` holds `i * side <= x < (i + 1) * side`. Outside the space:
    /// [`Destination::Outside`]. A NaN position is a fault.
    pub fn cell_containing(&self, _position: Vector3<Real>) -> Destination {
        match self.never {}
    }
}

/// The place to which a migration sends an item.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Leaf {
///     #[position]
///     position: Vector3<Real>,
///     is_rotten: bool,
///     lies: bool,
/// }
///
/// #[migration]
/// fn drift(me: &Slot<Leaf>, space: &Space) -> Destination {
///     if me.is_rotten {
///         Destination::Outside
///     } else if me.lies {
///         Destination::Stay
///     } else {
///         space.cell_containing(me.position)
///     }
/// }
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Destination {
    /// The item's own cell.
    Stay,
    /// Outside the space. The model must allow it.
    Outside,
    /// The cell with this linear index, made by [`Space::cell_containing`].
    Cell(u32),
}
