//! Single values and arrays, and how a kernel writes those of a row's cells.
//!
//! A kernel works through a row in blocks. It writes single values directly to their plane. It writes arrays
//! lane by lane to a stage on the stack, and each block is then copied to the planes. The compiler would not
//! vectorize a loop that writes to many planes, which may overlap the input.

use super::values::{ArrayValue, KernelElement, KernelValue, Lanes, Planes, Written};
use bytemuck::{Pod, Zeroable};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

/// The largest number of cells in a block of staged arrays.
const STAGED: usize = 32;

/// The largest size of a block in each plane, in bytes: two cache lines. More would make the planes of an
/// array evict each other from the cache.
pub(super) const BLOCK_BYTES: usize = 128;

/// The size of the widest move in bytes.
const WIDEST: usize = 32;

/// The largest number of cells in a block of arrays with elements of type `M`.
pub(super) const fn staged<M>() -> usize {
    let size = if size_of::<M>() == 0 { 1 } else { size_of::<M>() };
    let fitting = BLOCK_BYTES / size;
    if fitting > STAGED { STAGED } else { fitting }
}

impl<'r, T: KernelElement> Written<'r, T> for &'r mut [T::Memory] {
    #[inline(always)]
    #[allow(unsafe_code)]
    unsafe fn new(planes: Planes<T::Memory>) -> Self {
        // SAFETY: as the function.
        unsafe { std::slice::from_raw_parts_mut(planes.first, planes.cells) }
    }

    #[inline(always)]
    fn stage() {}

    #[inline(always)]
    fn load(&self, (): &mut (), _: &Range<usize>) {}

    #[inline(always)]
    fn lanes<'b>(&'b mut self, (): &'b mut (), block: &Range<usize>) -> &'b mut [T::Memory] {
        &mut self[block.clone()]
    }

    #[inline(always)]
    fn store(&mut self, (): &(), _: &Range<usize>) {}
}

impl<T: KernelElement> Lanes<T> for &mut [T::Memory] {
    #[inline(always)]
    fn first(self, lanes: usize) -> Self {
        &mut self[..lanes]
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> T {
        <T as KernelElement>::from_memory(self[lane])
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, value: T) {
        self[lane] = KernelElement::to_memory(value);
    }
}

/// The values of a row's cells, for writing. Arrays of `N` elements have a plane for each element.
#[derive(Debug)]
pub struct WrittenArrays<'r, M, const N: usize> {
    planes: Planes<M>,
    row: PhantomData<&'r mut [M]>,
}

impl<M: Pod, const N: usize> WrittenArrays<'_, M, N> {
    /// The place of an element of a block's first cell.
    #[inline(always)]
    fn place(&self, block: &Range<usize>, element: usize) -> *mut M {
        let inside = block.start <= block.end && block.end <= self.planes.cells;
        assert!(inside && block.len() <= staged::<M>() && element < N, "no such block in the row");
        self.planes.first.wrapping_add(element * self.planes.stride + block.start)
    }
}

/// Arrays of a block of cells, by element and lane, contiguous.
pub struct Stage<M, const N: usize>([[M; STAGED]; N]);

impl<M, const N: usize> Stage<M, N> {
    #[inline(always)]
    fn elements(&self) -> impl Iterator<Item = &[M]> {
        self.0.as_flattened().chunks_exact(staged::<M>()).take(N)
    }

    #[inline(always)]
    fn elements_mut(&mut self) -> impl Iterator<Item = &mut [M]> {
        self.0.as_flattened_mut().chunks_exact_mut(staged::<M>()).take(N)
    }
}

impl<M, const N: usize> fmt::Debug for Stage<M, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stage").finish_non_exhaustive()
    }
}

impl<'r, T: KernelElement, const N: usize> Written<'r, [T; N]> for WrittenArrays<'r, T::Memory, N> {
    #[inline(always)]
    #[allow(unsafe_code)]
    unsafe fn new(planes: Planes<T::Memory>) -> Self {
        Self { planes, row: PhantomData }
    }

    #[inline(always)]
    fn stage() -> Stage<T::Memory, N> {
        Stage([[T::Memory::zeroed(); STAGED]; N])
    }

    #[inline(always)]
    fn load(&self, stage: &mut Stage<T::Memory, N>, block: &Range<usize>) {
        for (element, lanes) in stage.elements_mut().enumerate() {
            let from = self.place(block, element).cast_const();
            // SAFETY: `new`: `N` planes, aligned, each with the cells that `place` lets through; a stage has
            // as many lanes.
            #[allow(unsafe_code)]
            unsafe {
                copy(from, lanes.as_mut_ptr(), block.len());
            }
        }
    }

    #[inline(always)]
    fn lanes<'b>(
        &'b mut self,
        stage: &'b mut Stage<T::Memory, N>,
        _: &Range<usize>,
    ) -> &'b mut Stage<T::Memory, N> {
        stage
    }

    #[inline(always)]
    fn store(&mut self, stage: &Stage<T::Memory, N>, block: &Range<usize>) {
        for (element, lanes) in stage.elements().enumerate() {
            let to = self.place(block, element);
            // SAFETY: as above, and no one else reads or writes them.
            #[allow(unsafe_code)]
            unsafe {
                copy(lanes.as_ptr(), to, block.len());
            }
        }
    }
}

/// Copies values of a block.
///
/// # Safety
/// As of [`std::ptr::copy_nonoverlapping`].
#[inline(always)]
#[allow(unsafe_code)]
unsafe fn copy<M: Copy>(from: *const M, to: *mut M, count: usize) {
    let bytes = staged::<M>() * size_of::<M>();
    if count != staged::<M>() || !bytes.is_multiple_of(WIDEST) {
        // SAFETY: as the function.
        unsafe { std::ptr::copy_nonoverlapping(from, to, count) }
        return;
    }
    // Most blocks are complete. The compiler copies such small parts inline, without a call.
    let (from, to) = (from.cast::<[u8; WIDEST]>(), to.cast::<[u8; WIDEST]>());
    for part in 0..bytes / WIDEST {
        // SAFETY: as the function; the parts make up a block, and bytes have no alignment.
        unsafe { to.add(part).write(from.add(part).read()) }
    }
}

impl<T: KernelElement, const N: usize> Lanes<[T; N]> for &mut Stage<T::Memory, N> {
    #[inline(always)]
    fn first(self, lanes: usize) -> Self {
        assert!(lanes <= staged::<T::Memory>(), "no such block");
        self
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> [T; N] {
        let lanes = self.0.as_flattened();
        std::array::from_fn(|element| T::from_memory(lanes[element * staged::<T::Memory>() + lane]))
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, value: [T; N]) {
        for (lanes, value) in self.elements_mut().zip(&value) {
            lanes[lane] = KernelElement::to_memory(*value);
        }
    }
}

impl<T: KernelElement> KernelValue for T {
    type Element = T;
    const LENGTH: usize = 1;
    type Memory = T::Memory;
    type Written<'r> = &'r mut [T::Memory];
    type Stage = ();
    type Lanes<'b> = &'b mut [T::Memory];
    const BLOCK: usize = usize::MAX;
    type Batch = T::Batch;

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

    #[inline(always)]
    fn lane(batch: &T::Batch, lane: usize) -> T {
        T::lane(batch, lane)
    }

    #[inline(always)]
    fn set_lane(batch: &mut T::Batch, lane: usize, value: T) {
        T::set_lane(batch, lane, value);
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
    type Batch = [T::Batch; N];

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

    #[inline(always)]
    fn lane(batch: &[T::Batch; N], lane: usize) -> Self {
        std::array::from_fn(|element| <T as KernelElement>::lane(&batch[element], lane))
    }

    #[inline(always)]
    fn set_lane(batch: &mut [T::Batch; N], lane: usize, value: Self) {
        for (batch, value) in batch.iter_mut().zip(value) {
            <T as KernelElement>::set_lane(batch, lane, value);
        }
    }
}

impl<T: KernelElement, const N: usize> ArrayValue for [T; N] {
    #[inline(always)]
    fn element_of(memory: &[T::Memory; N], element: usize) -> T {
        <T as KernelElement>::from_memory(memory[element])
    }
}
