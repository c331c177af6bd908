//! Values that depend on the step: random numbers, and the number of the step.

use crate::float::Float;
use std::cell::Cell;
use xca_values::{Draw, Stream};

/// The random numbers of a row. Also records whether the kernel requested one, or the number of the step.
///
/// Each kernel has its own copy of all inputs of the numbers. The copy stays in registers, and the loop can
/// be vectorized even if only some cells draw.
#[derive(Debug)]
pub struct Draws {
    stream: Stream,
    step: u64,
    seed: u64,
    /// The linear index of the row's first cell.
    first_cell: u32,
    /// A sum of bits. Compilers recognize it as a reduction, unlike a flag.
    asked: Cell<u32>,
    /// Not 0, which the compiler must not know.
    mark: u32,
}

impl Draws {
    /// Creates the source of numbers. The mark is any number except 0 that the compiler cannot know.
    #[inline(always)]
    pub(super) fn new((stream, step, seed): (Stream, u64, u64), first_cell: u32, mark: u32) -> Self {
        Self { stream, step, seed, first_cell, asked: Cell::new(0), mark }
    }

    /// Whether a number has been requested.
    #[inline(always)]
    pub(super) fn is_asked(&self) -> bool {
        self.asked.get() != 0
    }

    #[inline(always)]
    fn ask(&self) {
        self.asked.set(self.asked.get() | self.mark);
    }

    /// The number of the step.
    #[inline(always)]
    pub(super) fn step(&self) -> u64 {
        self.ask();
        self.step
    }

    #[inline(always)]
    fn words(&self, owner: u32, number: usize) -> [u32; 4] {
        self.ask();
        let Self { stream, step, seed, .. } = *self;
        Draw { stream, step, owner, number: number as u32 }.words(seed)
    }

    /// Random bits of a cell of the row.
    #[inline(always)]
    pub fn bits_of_cell(&self, x: usize, draw: usize) -> u32 {
        self.words(self.first_cell + x as u32, draw)[0]
    }

    /// A random number of a cell of the row.
    #[inline(always)]
    pub fn of_cell<R: Float>(&self, x: usize, draw: usize) -> R {
        let words = self.words(self.first_cell + x as u32, draw);
        R::uniform([words[0], words[1]])
    }

    /// Random bits of the item with this label.
    #[inline]
    pub fn bits_of_item(&self, label: u32, draw: usize) -> u32 {
        self.words(label, draw)[0]
    }

    /// A random number of the item with this label.
    #[inline]
    pub fn of_item<R: Float>(&self, label: u32, draw: usize) -> R {
        let words = self.words(label, draw);
        R::uniform([words[0], words[1]])
    }
}
