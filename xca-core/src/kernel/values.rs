//! Values as kernels compute with them, and how they stand in memory.
//!
//! An engine keeps each substate of cells as planes: one for a single value, one for each element of an array, a fixed stride apart. Of items
//! it keeps whole values one after the other.

use crate::states::States;
use crate::vector::{Vector2, Vector3, Vector4};
use bytemuck::Pod;
use std::marker::PhantomData;

/// A single value: a number, a bool, a state or a small vector.
pub trait KernelElement: Copy + 'static {
    /// What stands in memory.
    type Memory: Pod;

    /// The value, whatever stands there.
    fn from_memory(memory: Self::Memory) -> Self;

    /// What to put there.
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
    /// Its elements: of a single value, itself.
    type Element: KernelElement;

    /// How many.
    const LENGTH: usize;

    /// What stands in memory where the elements stand one after the other.
    type Memory: Pod;

    /// The value of each cell of a row, to be written.
    type Cells<'r>: CellsOf<'r, Self>;

    /// The value with these elements.
    fn from_elements(element: impl FnMut(usize) -> Self::Element) -> Self;

    /// The value, whatever stands there.
    fn from_memory(memory: Self::Memory) -> Self;

    /// What to put there.
    fn to_memory(self) -> Self::Memory;
}

/// The planes of a row's cells, as their engine describes them.
#[derive(Debug, Clone, Copy)]
pub struct Planes<M> {
    pub(super) first: *mut M,
    pub(super) stride: usize,
    pub(super) cells: usize,
}

/// The values of a row's cells, to be written.
pub trait CellsOf<'r, T: KernelValue>: Sized {
    /// Takes the planes of a row.
    ///
    /// # Safety
    /// For `'r` each of the planes, `stride` elements apart, is aligned, has so many cells from the first on, and no one else reads
    /// or writes them.
    #[allow(unsafe_code)]
    unsafe fn new(planes: Planes<<T::Element as KernelElement>::Memory>) -> Self;

    /// The same of the first cells. That their number is known where they are used lets the compiler leave out checks.
    fn first(self, cells: usize) -> Self;

    /// The value of a cell.
    fn get(&self, cell: usize) -> T;

    /// Replaces the value of a cell.
    fn set(&mut self, cell: usize, value: T);
}

impl<T: KernelElement> KernelValue for T {
    type Element = T;
    const LENGTH: usize = 1;
    type Memory = T::Memory;
    type Cells<'r> = &'r mut [T::Memory];

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

impl<'r, T: KernelElement> CellsOf<'r, T> for &'r mut [T::Memory] {
    #[inline(always)]
    #[allow(unsafe_code)]
    unsafe fn new(planes: Planes<T::Memory>) -> Self {
        // SAFETY: as the function.
        unsafe { std::slice::from_raw_parts_mut(planes.first, planes.cells) }
    }

    #[inline(always)]
    fn first(self, cells: usize) -> Self {
        &mut self[..cells]
    }

    #[inline(always)]
    fn get(&self, cell: usize) -> T {
        <T as KernelElement>::from_memory(self[cell])
    }

    #[inline(always)]
    fn set(&mut self, cell: usize, value: T) {
        self[cell] = KernelElement::to_memory(value);
    }
}

impl<T: KernelElement, const N: usize> KernelValue for [T; N] {
    type Element = T;
    const LENGTH: usize = N;
    type Memory = [T::Memory; N];
    type Cells<'r> = ArrayCells<'r, T::Memory, N>;

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

/// The values of a row's cells, arrays of `N` elements in a plane each, to be written.
#[derive(Debug)]
pub struct ArrayCells<'r, M, const N: usize> {
    planes: Planes<M>,
    row: PhantomData<&'r mut [M]>,
}

impl<M: Pod, const N: usize> ArrayCells<'_, M, N> {
    #[inline(always)]
    fn place(&self, cell: usize, element: usize) -> *mut M {
        assert!(cell < self.planes.cells && element < N, "no such cell in the row");
        self.planes.first.wrapping_add(element * self.planes.stride + cell)
    }
}

impl<'r, T: KernelElement, const N: usize> CellsOf<'r, [T; N]> for ArrayCells<'r, T::Memory, N> {
    #[inline(always)]
    #[allow(unsafe_code)]
    unsafe fn new(planes: Planes<T::Memory>) -> Self {
        Self { planes, row: PhantomData }
    }

    #[inline(always)]
    fn first(mut self, cells: usize) -> Self {
        self.planes.cells = self.planes.cells.min(cells);
        self
    }

    #[inline(always)]
    fn get(&self, cell: usize) -> [T; N] {
        // SAFETY: `new`: `N` planes, aligned, each with the cells that `place` lets through.
        #[allow(unsafe_code)]
        std::array::from_fn(|element| T::from_memory(unsafe { self.place(cell, element).read() }))
    }

    #[inline(always)]
    fn set(&mut self, cell: usize, value: [T; N]) {
        for (element, value) in value.into_iter().enumerate() {
            // SAFETY: as above, and no one else reads or writes them.
            #[allow(unsafe_code)]
            unsafe {
                self.place(cell, element).write(KernelElement::to_memory(value));
            }
        }
    }
}

/// The value that stands in memory.
#[inline(always)]
pub fn load<T: KernelValue>(memory: T::Memory) -> T {
    T::from_memory(memory)
}

/// What to put in memory for a value.
#[inline(always)]
pub fn store<T: KernelValue>(value: T) -> T::Memory {
    value.to_memory()
}

/// An element of the array that stands in memory.
#[inline(always)]
pub fn load_element<T: ArrayValue>(memory: &T::Memory, element: usize) -> T::Element {
    T::element_of(memory, element)
}

/// An array as a value.
pub trait ArrayValue: KernelValue {
    /// An element of the array that stands in memory.
    fn element_of(memory: &Self::Memory, element: usize) -> Self::Element;
}

impl<T: KernelElement, const N: usize> ArrayValue for [T; N] {
    #[inline(always)]
    fn element_of(memory: &[T::Memory; N], element: usize) -> T {
        <T as KernelElement>::from_memory(memory[element])
    }
}
