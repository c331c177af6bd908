//! The plain comparison of distances.
#![allow(unsafe_code)]

use crate::float::Float;
use std::ops::Range;
use xca_values::Vector3;

#[inline(always)]
pub(super) fn length_squared<R: Float>(vector: Vector3<R>) -> R {
    vector.x * vector.x + vector.y * vector.y + vector.z * vector.z
}

/// Adds the items of a range whose positions are near, without the item itself.
///
/// The processor cannot predict whether an item is near, so the loop has no branch on it. Each number is
/// written, and the list grows only if it is kept.
#[inline(always)]
pub(super) fn keep<R: Float>(
    range: Range<usize>,
    item: usize,
    positions: &[Vector3<R>],
    found: &mut Vec<u32>,
    near: impl Fn(Vector3<R>) -> bool,
) {
    // An empty range may lie anywhere.
    if range.is_empty() {
        return;
    }
    found.reserve(range.len());
    let first = range.start;
    let mut length = found.len();
    let places = found.as_mut_ptr();
    for (index, other) in positions[range].iter().enumerate() {
        let number = first + index;
        // SAFETY: `length` grows at most by one a turn, from the length before, and there is room for as many
        // as turns.
        unsafe { places.add(length).write(number as u32) };
        length += usize::from(near(*other) & (number != item));
    }
    // SAFETY: as above; all places below `length` have been written.
    unsafe { found.set_len(length) };
}
