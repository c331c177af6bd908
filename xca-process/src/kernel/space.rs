//! The cellular space in a kernel.

use super::{Draws, Frame, NOWHERE, OUTSIDE};
use crate::float::Float;
use std::marker::PhantomData;
use xca_values::Vector3;

/// The cellular space in a kernel.
#[derive(Debug, Clone, Copy)]
pub struct NativeSpace<'a, R> {
    frame: &'a Frame<'a>,
    draws: &'a Draws,
    real: PhantomData<R>,
}

impl<'a, R: Float> NativeSpace<'a, R> {
    pub(super) fn new(frame: &'a Frame<'a>, draws: &'a Draws) -> Self {
        Self { frame, draws, real: PhantomData }
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
        self.draws.step() as u32
    }

    /// The length of the space along an axis.
    #[inline(always)]
    fn period(&self, axis: usize) -> R {
        R::from_f64(f64::from(self.frame.extents[axis])) * self.side()
    }

    /// Applies `along` to the lanes of toroidal axes.
    #[inline(always)]
    fn along_toroidal(&self, vector: Vector3<R>, along: impl Fn(R, usize) -> R) -> Vector3<R> {
        let lane = |value, axis| if self.frame.toroidal[axis] { along(value, axis) } else { value };
        Vector3::new(lane(vector.x, 0), lane(vector.y, 1), lane(vector.z, 2))
    }

    /// The separation to the nearest image, on each toroidal axis.
    #[inline(always)]
    pub fn nearest_image(&self, separation: Vector3<R>) -> Vector3<R> {
        self.along_toroidal(separation, |value, axis| {
            let period = self.period(axis);
            let half = R::from_f64(0.5) * period;
            if value > half {
                value - period
            } else if value < R::default() - half {
                value + period
            } else {
                value
            }
        })
    }

    /// Wraps a position into the space on each toroidal axis.
    ///
    /// The cell index decides. A position may be so close to a face that wrapping rounds it to the opposite
    /// face, which is in no cell. It becomes 0.
    #[inline(always)]
    pub fn wrapped(&self, position: Vector3<R>) -> Vector3<R> {
        self.along_toroidal(position, |value, axis| {
            let (side, zero) = (self.side(), R::default());
            let extent = i64::from(self.frame.extents[axis]);
            match R::cell_number(value, side) {
                Some(number) if number < 0 => {
                    let inside = value + self.period(axis);
                    let is_beyond = R::cell_number(inside, side).is_some_and(|number| number >= extent);
                    if is_beyond { zero } else { inside }
                }
                Some(number) if number >= extent => {
                    let inside = value - self.period(axis);
                    if inside < zero { zero } else { inside }
                }
                _ => value,
            }
        })
    }

    /// The result of a migration that sends an item to the cell of its position.
    #[inline(always)]
    pub fn cell_containing(&self, position: Vector3<R>) -> u32 {
        let Vector3 { x, y, z } = position;
        let (side, [width, height, depth]) = (self.side(), self.frame.extents);
        let index = |coordinate, extent| R::cell_index(coordinate, side, extent);
        match (index(x, width), index(y, height), index(z, depth)) {
            (Some(x), Some(y), Some(z)) => (z * height + y) * width + x,
            _ => self.beyond(position),
        }
    }

    /// The result of a migration to a position outside of the space.
    #[cold]
    fn beyond(&self, position: Vector3<R>) -> u32 {
        let coordinates = [position.x, position.y, position.z];
        let is_nowhere = coordinates.iter().any(|coordinate| coordinate.to_f64().is_nan());
        if is_nowhere { NOWHERE } else { OUTSIDE }
    }
}
