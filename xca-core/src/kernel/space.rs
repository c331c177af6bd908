//! The cellular space in a kernel.

use super::{Frame, NOWHERE, OUTSIDE};
use crate::value::Float;
use crate::vector::Vector3;
use std::marker::PhantomData;

/// The cellular space in a kernel.
#[derive(Debug, Clone, Copy)]
pub struct NativeSpace<'a, R> {
    frame: &'a Frame<'a>,
    real: PhantomData<R>,
}

impl<'a, R: Float> NativeSpace<'a, R> {
    pub(super) fn new(frame: &'a Frame<'a>) -> Self {
        Self { frame, real: PhantomData }
    }

    /// The side of a cell in metres.
    #[inline(always)]
    pub fn side(&self) -> R {
        R::from_f64(self.frame.side)
    }

    /// The number of cells along x, y, z.
    #[inline(always)]
    pub fn extents(&self) -> Vector3<i32> {
        let [x, y, z] = self.frame.extents;
        Vector3::new(x as i32, y as i32, z as i32)
    }

    /// The low 32 bits of the number of the step.
    #[inline(always)]
    pub fn step(&self) -> u32 {
        self.frame.step as u32
    }

    /// The answer of a migration that sends an item to where its position is.
    #[inline(always)]
    pub fn cell_containing(&self, position: Vector3<R>) -> u32 {
        let side = self.side();
        let [width, height, depth] = self.frame.extents;
        let (Some(x), Some(y), Some(z)) = (
            R::cell_number(position.x, side),
            R::cell_number(position.y, side),
            R::cell_number(position.z, side),
        ) else {
            let nowhere = [position.x, position.y, position.z].iter().any(|along| along.to_f64().is_nan());
            return if nowhere { NOWHERE } else { OUTSIDE };
        };
        let inside = |number: i64, extent: u32| number >= 0 && number < i64::from(extent);
        if inside(x, width) && inside(y, height) && inside(z, depth) {
            (z as u32 * height + y as u32) * width + x as u32
        } else {
            OUTSIDE
        }
    }
}
