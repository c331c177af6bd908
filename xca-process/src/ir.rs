//! The body of an elementary process as data.
//!
//! `#[elementary_process]`, `#[migration]` and `#[helper]` keep the parsed body of the function beside the
//! native kernel. An engine that cannot call Rust (a GPU) generates its program from the body. Types are
//! those in the source. The reader repeats the type inference of Rust from the schemas of the substates and
//! parameters.
//!
//! This module is for engines and for code that the macros write. Models do not need it.

mod constant;
mod expression;
mod function;
mod operators;
mod statement;
mod types;

pub use constant::{Constant, ConstantValue};
pub use expression::{Arm, Expression, Literal, Pattern};
pub use function::{Argument, Function, FunctionKind, Role};
pub use operators::{BinaryOperator, Builtin, UnaryOperator};
pub use statement::{
    Block, Loop, LoopKind, Place, PlaceRoot, Projection, Range, Reach, Statement, TuplePart,
};
pub use types::Type;
pub use xca_methods::Operation;
