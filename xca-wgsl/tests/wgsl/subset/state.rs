//! The substates, parameters and constants of the processes.

use xca_core::prelude::*;

pub(super) const WEIGHTS: [Real; 3] = [0.25, 0.5, 0.25];
pub(super) const STEPS: [Vector2<i32>; 2] = [Vector2::new(1, 0), Vector2::new(0, -1)];
pub(super) const GRAVITY: Vector3<Real> = Vector3::new(0.0, 0.0, -9.81);
pub(super) const LIMIT: Real = Real::MAX;
pub(super) const INFINITE: Real = Real::INFINITY;
pub(super) const LIMITS: [Real; 3] = [0.0, Real::INFINITY, -0.0];
pub(super) const LOWEST: i32 = i32::MIN;
pub(super) const MASK: u32 = 0xdead_beef;
pub(super) const LIVING: u8 = 3;
pub(super) const PERIODIC: bool = true;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(super) struct State {
    pub(super) byte: u8,
    pub(super) signed: i32,
    pub(super) unsigned: u32,
    pub(super) single: f32,
    pub(super) double: f64,
    pub(super) real: Real,
    pub(super) velocity: Vector3<Real>,
    pub(super) grid: Vector2<i32>,
    pub(super) colour: Vector4<u8>,
}

#[derive(Parameters, Clone, Debug)]
pub(super) struct Settings {
    pub(super) scale: Real,
    pub(super) wind: Vector3<Real>,
    pub(super) rule: u32,
}
