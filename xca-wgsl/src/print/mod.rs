//! Writes a function's body as WGSL.

mod bounds;
mod cast;
mod control;
mod element;
mod expression;
mod frame;
mod function;
mod loops;
mod method;
mod operator;
mod range;
mod search;
mod statement;
mod text;
mod writer;

pub(crate) use function::function;
pub(crate) use writer::Shared;
