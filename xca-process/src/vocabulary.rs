//! The words that an elementary process speaks.
//!
//! These types exist for the compiler and the reader: the macros check a process against them and then
//! replace them by kernels. No value of them can be made, so nothing here can be called from ordinary code.

use crate::checks::HasPosition;
use std::convert::Infallible;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};
use xca_values::Real;
use xca_values::Vector3;

/// The central cell, in a process that runs once for each cell.
///
/// Its substates are its fields: `cell.temperature` reads, `cell.temperature = …` writes. Reading shows what
/// the process has already written. Only the central cell can be written.
#[derive(Debug)]
pub struct Cell<S> {
    never: Infallible,
    substates: PhantomData<S>,
}

impl<S: 'static> Cell<S> {
    /// The number of cells in the neighbourhood, with the central one: neighbours are
    /// `1..cell.neighbour_count()`.
    pub fn neighbour_count(&self) -> usize {
        match self.never {}
    }

    /// A cell of the neighbourhood as it was before this process; index 0 is the central cell. An index
    /// beyond the neighbourhood is a fault that stops the run.
    pub fn neighbour(&self, _index: usize) -> &'static S {
        match self.never {}
    }

    /// The index of the neighbour in the opposite direction, 0 for 0: seen from neighbour `index`, this cell
    /// has the index `cell.opposite(index)`. A custom neighbourhood must hold the opposite of each
    /// displacement, or `build` refuses the process. An index beyond the neighbourhood is a fault, as in
    /// [`Self::neighbour`].
    pub fn opposite(&self, _index: usize) -> usize {
        match self.never {}
    }

    /// The displacement from this cell to a neighbour, in cells along x, y, z. With hexagons it depends on
    /// the row or column of the cell. An index beyond the neighbourhood is a fault, as in
    /// [`Self::neighbour`].
    pub fn displacement(&self, _index: usize) -> Vector3<i32> {
        match self.never {}
    }

    /// Whether a neighbour is a cell of the space: `false` beyond a flat face, where [`Self::neighbour`]
    /// shows the outside values. Beyond toroidal and reflecting faces there is always a cell. An index beyond
    /// the neighbourhood is a fault, as in [`Self::neighbour`].
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
    /// Give each use in a process a `draw` of its own: one that asks twice for the same draw gets the same
    /// number. Equal draws of two processes are independent, and so are those of two runs of a process in one
    /// step.
    pub fn random(&self, _draw: usize) -> Real {
        match self.never {}
    }

    /// 32 random bits: a function of seed, step, process, cell and `draw`, the same on every engine. Equal
    /// draws give equal bits, as with [`Self::random`], whose number is made of the same ones.
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

/// An item of a population, in a process that runs once for each occupied slot. Its substates are its fields.
#[derive(Debug)]
pub struct Slot<S> {
    never: Infallible,
    substates: PhantomData<S>,
}

impl<S: 'static> Slot<S> {
    /// The item's label, which it keeps for its life.
    pub fn label(&self) -> u32 {
        match self.never {}
    }

    /// The indices along x, y, z of the cell that the item stands in.
    pub fn index(&self) -> Vector3<i32> {
        match self.never {}
    }

    /// A random number in [0, 1): a function of seed, step, process, label and `draw`, the same on every
    /// engine.
    ///
    /// Give each use in a process a `draw` of its own: one that asks twice for the same draw gets the same
    /// number. Equal draws of two processes are independent, and so are those of two runs of a process in one
    /// step.
    pub fn random(&self, _draw: usize) -> Real {
        match self.never {}
    }

    /// 32 random bits: a function of seed, step, process, label and `draw`, the same on every engine. Equal
    /// draws give equal bits, as with [`Self::random`], whose number is made of the same ones.
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

    /// Of [`Self::others_in_cell`] those whose position is nearer than the radius; on a toroidal axis by the
    /// shorter way. A NaN or negative radius is a fault.
    pub fn others_in_cell_within(&self, _radius: Real) -> Others<S>
    where
        S: HasPosition,
    {
        match self.never {}
    }

    /// Of [`Self::others_in_neighbours`] those whose position is nearer than the radius. Radii are limited as
    /// in [`Self::others_within`].
    pub fn others_in_neighbours_within(&self, _radius: Real) -> Others<S>
    where
        S: HasPosition,
    {
        match self.never {}
    }

    /// Of [`Self::others`] those whose position is nearer than the radius.
    ///
    /// A radius beyond what the neighbourhood covers is a fault that stops the run:
    /// [`Geometry::covered_radius`](crate::Geometry::covered_radius) says how far that is, for a Moore
    /// neighbourhood its radius times the side of a cell. A NaN or negative radius is a fault too.
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

/// All items of the central cell, by label: `for item in slots { … }` in a process over cells.
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

/// Another item; its substates are its fields, and it cannot be written.
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

/// Other items, to be used in a `for`.
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

    /// A separation of two positions, by the shorter way round each toroidal axis (the nearest image); along
    /// the others it is what it was. A search measures distances in the same way.
    pub fn nearest_image(&self, _separation: Vector3<Real>) -> Vector3<Real> {
        match self.never {}
    }

    /// A position inside the space: one that lies beyond a face of a toroidal axis, by less than the length
    /// of the space, comes in again at the opposite face. Along the other axes it is what it was.
    pub fn wrapped(&self, _position: Vector3<Real>) -> Vector3<Real> {
        match self.never {}
    }

    /// The cell that contains the position: cell `i` holds `i * side <= x < (i + 1) * side`. Outside the
    /// space it is [`Destination::Outside`]; a position that is no number is a fault.
    pub fn cell_containing(&self, _position: Vector3<Real>) -> Destination {
        match self.never {}
    }
}

/// Where a migration sends an item.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Destination {
    /// It stays where it is.
    Stay,
    /// It leaves the space, which the model must allow.
    Outside,
    /// The cell with this linear index, made by [`Space::cell_containing`].
    Cell(u32),
}
