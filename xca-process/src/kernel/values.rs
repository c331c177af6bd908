//! Values in kernels, and their form in memory.
//!
//! An engine stores each substate of cells in planes at a fixed stride: one for a single value, one for each
//! element of an array. Values of items are stored whole, one after the other.

use super::written::{Lanes, Stage, Written, WrittenArrays, staged};
use crate::states::States;
use bytemuck::Pod;
use xca_values::{Vector2, Vector3, Vector4};

/// A single value: a number, a bool, a state or a small vector.
pub trait KernelElement: Copy + 'static {
    /// The form in memory.
    type Memory: Pod;

    /// The value of any memory content.
    fn from_memory(memory: Self::Memory) -> Self;

    /// The memory content of the value.
    fn to_memory(self) -> Self::Memory;
}

macro_rules! plain_elements {
    ($($type:ident)*) => {$(
        impl KernelElement for $type {
            type Memory = $type;

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
    ($($type:ident)*) => {$(
        impl<T: Pod> KernelElement for $type<T> {
            type Memory = Self;

            #[inline(always)]
            fn from_memory(memory: Self) -> Self {
                memory
            }

            #[inline(always)]
            fn to_memory(self) -> Self {
                self
            }
        }
    )*};
}

vector_elements!(Vector2 Vector3 Vector4);

impl KernelElement for bool {
    type Memory = u8;

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

    /// The value with these elements.
    fn from_elements(element: impl FnMut(usize) -> Self::Element) -> Self;

    /// The value of any memory content.
    fn from_memory(memory: Self::Memory) -> Self;

    /// The memory content of the value.
    fn to_memory(self) -> Self::Memory;
}

impl<T: KernelElement> KernelValue for T {
    type Element = T;
    const LENGTH: usize = 1;
    type Memory = T::Memory;
    type Written<'r> = &'r mut [T::Memory];
    type Stage = ();
    type Lanes<'b> = &'b mut [T::Memory];
    const BLOCK: usize = usize::MAX;

    #[inline(always)]
    fn from_elements(mut element: impl FnMut(usize) -> T) -> T {
        element(0)
    }

    #[inline(always)]
    fn from_memory(memory: T::Memory) -> T {
        T::from_memory(memory)
    }

    #[inline(always)]
    fn to_memory(self) -> T::Memory {
        KernelElement::to_memory(self)
    }
}

impl<T: KernelElement, const N: usize> KernelValue for [T; N] {
    type Element = T;
    const LENGTH: usize = N;
    type Memory = [T::Memory; N];
    type Written<'r> = WrittenArrays<'r, T::Memory, N>;
    type Stage = Stage<T::Memory, N>;
    type Lanes<'b> = &'b mut Stage<T::Memory, N>;
    const BLOCK: usize = staged::<T::Memory>();

    #[inline(always)]
    fn from_elements(element: impl FnMut(usize) -> T) -> Self {
        std::array::from_fn(element)
    }

    #[inline(always)]
    fn from_memory(memory: Self::Memory) -> Self {
        memory.map(<T as KernelElement>::from_memory)
    }

    #[inline(always)]
    fn to_memory(self) -> Self::Memory {
        self.map(KernelElement::to_memory)
    }
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

impl<T: KernelElement, const N: usize> ArrayValue for [T; N] {
    #[inline(always)]
    fn element_of(memory: &[T::Memory; N], element: usize) -> T {
        <T as KernelElement>::from_memory(memory[element])
    }
}
