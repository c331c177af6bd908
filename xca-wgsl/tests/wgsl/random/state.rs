//! The substates of the processes, and the names and types of their values.

use xca_core::ir::Type;
use xca_core::prelude::*;
use xca_core::{ScalarType, Schema};

#[derive(States, Clone, Copy, Debug, PartialEq)]
pub(super) enum Ground {
    Rock,
    Soil,
    Water,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(super) struct State {
    pub(super) truth: bool,
    pub(super) ground: Ground,
    pub(super) table: [i32; 3],
    pub(super) path: [Vector2<Real>; 2],
    pub(super) byte: u8,
    pub(super) signed: i32,
    pub(super) unsigned: u32,
    pub(super) single: f32,
    pub(super) double: f64,
    pub(super) real: Real,
    pub(super) place: Vector3<Real>,
}

pub(super) const SCHEMA: &Schema = State::SCHEMA;
pub(super) const NAMES: [&str; 6] = ["a", "b", "cell", "end", "value", "operand"];
pub(super) const SCALARS: [(ScalarType, &str); 6] = [
    (ScalarType::U8, "byte"),
    (ScalarType::I32, "signed"),
    (ScalarType::U32, "unsigned"),
    (ScalarType::F32, "single"),
    (ScalarType::F64, "double"),
    (ScalarType::Real, "real"),
];
pub(super) const PLACE: Type = Type::Vector(ScalarType::Real, 3);
pub(super) const PAIR: Type = Type::Vector(ScalarType::Real, 2);
pub(super) const GROUND: Type = Type::State(Ground::NAMES);

pub(super) fn table() -> Type {
    Type::Array(Box::new(Type::Scalar(ScalarType::I32)), 3)
}

pub(super) fn path() -> Type {
    Type::Array(Box::new(PAIR), 2)
}
