//! Values in kernels, their form in memory, and how a kernel writes them.
//!
//! An engine stores each substate of cells in planes at a fixed stride: one for a single value, one for each
//! element of an array. Values of items are stored whole, one after the other.

use crate::states::States;
use bytemuck::{Pod, Zeroable};
use std::ops::Range;
use xca_values::{Vector2, Vector3, Vector4};

/// The largest number of pairs in a batch. With more, the values would leave the nearest cache. With few, the
/// compiler would write out the loops that read values.
pub const BATCH: usize = 32;

/// A single value: a number, a bool, a state or a small vector.
pub trait KernelElement: Copy + 'static {
    /// The form in memory.
    type Memory: Pod;

    /// The values of a batch of pairs. Each number of a vector is beside that of the next lane.
    type Batch: Zeroable;

    /// The value of any memory content.
    fn from_memory(memory: Self::Memory) -> Self;

    /// The memory content of the value.
    fn to_memory(self) -> Self::Memory;

    /// The value of a pair.
    fn lane(batch: &Self::Batch, lane: usize) -> Self;

    /// Replaces the value of a pair.
    fn set_lane(batch: &mut Self::Batch, lane: usize, value: Self);
}

/// Values of which each number stands in memory as one.
macro_rules! in_lanes {
    ($memory:ty) => {
        type Batch = [$memory; BATCH];

        #[inline(always)]
        fn lane(batch: &[$memory; BATCH], lane: usize) -> Self {
            <Self as KernelElement>::from_memory(batch[lane])
        }

        #[inline(always)]
        fn set_lane(batch: &mut [$memory; BATCH], lane: usize, value: Self) {
            batch[lane] = KernelElement::to_memory(value);
        }
    };
}

macro_rules! plain_elements {
    ($($type:ident)*) => {$(
        impl KernelElement for $type {
            type Memory = $type;

            in_lanes!($type);

            #[inline(always)]
            fn from_memory(memory: $type) -> $type {
                memory
            }

            #[inline(always)]
            fn to_memory(self) -> $type {
                self
            }
        }
    )*};
}

plain_elements!(u8 i32 u32 f32 f64);

macro_rules! vector_elements {
    ($($type:ident($($number:ident)*))*) => {$(
        impl<T: Pod> KernelElement for $type<T> {
            type Memory = Self;
            type Batch = $type<[T; BATCH]>;

            #[inline(always)]
            fn from_memory(memory: Self) -> Self {
                memory
            }

            #[inline(always)]
            fn to_memory(self) -> Self {
                self
            }

            #[inline(always)]
            fn lane(batch: &$type<[T; BATCH]>, lane: usize) -> Self {
                Self { $($number: batch.$number[lane]),* }
            }

            #[inline(always)]
            fn set_lane(batch: &mut $type<[T; BATCH]>, lane: usize, value: Self) {
                $(batch.$number[lane] = value.$number;)*
            }
        }
    )*};
}

vector_elements!(Vector2(x y) Vector3(x y z) Vector4(x y z w));

impl KernelElement for bool {
    type Memory = u8;

    in_lanes!(u8);

    #[inline(always)]
    fn from_memory(memory: u8) -> bool {
        memory != 0
    }

    #[inline(always)]
    fn to_memory(self) -> u8 {
        self.into()
    }
}

impl<T: States> KernelElement for T {
    type Memory = u8;

    in_lanes!(u8);

    #[inline(always)]
    fn from_memory(memory: u8) -> T {
        T::from_number(memory)
    }

    #[inline(always)]
    fn to_memory(self) -> u8 {
        self.number()
    }
}

/// A value of a substate: a single one, or an array.
pub trait KernelValue: Copy + 'static {
    /// The type of its elements. For a single value, the type itself.
    type Element: KernelElement;

    /// The number of elements.
    const LENGTH: usize;

    /// The form in memory of a whole value, with its elements one after the other.
    type Memory: Pod;

    /// The values of a row's cells, for writing.
    type Written<'r>: Written<'r, Self>;

    /// The buffer in which a block is written before it is copied to the planes.
    type Stage;

    /// The values of a block of cells, for writing.
    type Lanes<'b>: Lanes<Self>;

    /// The largest number of cells in a block.
    const BLOCK: usize;

    /// The values of a batch of pairs.
    type Batch: Zeroable;

    /// The value with these elements.
    fn from_elements(element: impl FnMut(usize) -> Self::Element) -> Self;

    /// The value of any memory content.
    fn from_memory(memory: Self::Memory) -> Self;

    /// The memory content of the value.
    fn to_memory(self) -> Self::Memory;

    /// The value of a pair.
    fn lane(batch: &Self::Batch, lane: usize) -> Self;

    /// Replaces the value of a pair.
    fn set_lane(batch: &mut Self::Batch, lane: usize, value: Self);
}

/// The planes of a row's cells, as the engine describes them.
#[derive(Debug, Clone, Copy)]
pub struct Planes<M> {
    pub(super) first: *mut M,
    pub(super) stride: usize,
    pub(super) cells: usize,
}

/// The values of a row's cells, for writing.
pub trait Written<'r, T: KernelValue>: Sized {
    /// Takes the planes of a row.
    ///
    /// # Safety
    /// For `'r`, each plane is aligned and has `cells` cells from the first on. The planes are `stride`
    /// elements apart. No one else reads or writes them.
    #[allow(unsafe_code)]
    unsafe fn new(planes: Planes<<T::Element as KernelElement>::Memory>) -> Self;

    /// Creates a stage.
    fn stage() -> T::Stage;

    /// Fills the stage with the current values of a block.
    fn load(&self, stage: &mut T::Stage, block: &Range<usize>);

    /// The values of a block.
    fn lanes<'b>(&'b mut self, stage: &'b mut T::Stage, block: &Range<usize>) -> T::Lanes<'b>;

    /// Copies a block from the stage to the planes.
    fn store(&mut self, stage: &T::Stage, block: &Range<usize>);
}

/// The largest number of cells in a block that suits all values that a kernel writes.
pub const fn block(most: &[usize]) -> usize {
    let (mut least, mut number) = (usize::MAX, 0);
    while number < most.len() {
        if most[number] < least {
            least = most[number];
        }
        number += 1;
    }
    least
}

/// The values of a block of cells, for writing.
pub trait Lanes<T: KernelValue> {
    /// The first lanes only. If the compiler knows their number, it can remove checks.
    fn first(self, lanes: usize) -> Self;

    /// The value of a cell.
    fn get(&self, lane: usize) -> T;

    /// Replaces the value of a cell.
    fn set(&mut self, lane: usize, value: T);
}

/// The value of a memory content.
#[inline(always)]
pub fn load<T: KernelValue>(memory: T::Memory) -> T {
    T::from_memory(memory)
}

/// The memory content of a value.
#[inline(always)]
pub fn store<T: KernelValue>(value: T) -> T::Memory {
    value.to_memory()
}

/// Room for the numbers of a batch of pairs.
#[inline(always)]
pub fn empty_batch<T: KernelValue>() -> T::Batch {
    T::Batch::zeroed()
}

/// An element of an array in memory.
#[inline(always)]
pub fn load_element<T: ArrayValue>(memory: &T::Memory, element: usize) -> T::Element {
    T::element_of(memory, element)
}

/// An array.
pub trait ArrayValue: KernelValue {
    /// An element of an array in memory.
    fn element_of(memory: &Self::Memory, element: usize) -> Self::Element;
}
