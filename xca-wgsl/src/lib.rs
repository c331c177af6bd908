//! Elementary processes of xca as WGSL.
//!
//! [`shader`] takes the body of a process as data ([`xca_core::ir::Function`]) and gives a complete module:
//! types, buffers, the helpers that the process calls, the process itself, and an entry point that runs it
//! for one cell or one item. No GPU is needed for it.
//!
//! # What the text looks like
//! Names are those of the model where WGSL allows them. The own substates are loaded into a variable that is
//! called like the first argument of the process, `cell.temperature`, and stored at the end; so the own cell
//! shows what the process has already written. Neighbours and other items are read from buffers that show the
//! state from before, `temperature_now[…]`; where they are also written, results go to a second buffer,
//! `temperature_next`. Of an array in memory single elements are read without the rest.
//!
//! # What is the same as in Rust, and what is not
//! Integers wrap as in a release build, also `u8`, which is a `u32` below 256 here. `usize` has 32 bits.
//! Casts from floats saturate. `min` and `max` of floats are comparisons and not the processor's own; NaN is
//! unequal to everything.
//!
//! Every operation stands in the text as in the source; but WGSL lets a driver contract and reorder float
//! operations, so that equal bits need more than the text: an engine has to forbid it, and to hide zeros from
//! drivers that fold them ([`Options::opaque_zero`]). Which NaN an operation gives is nowhere defined.
//!
//! # What stops a process
//! An index beyond an array, and a division of integers that has no result, stop a process in Rust. Here they
//! are a fault ([`FaultKind`]): it is recorded, and the process goes on with some value in range to its end,
//! where the engine looks for faults. What surely goes right is not checked: literals, variables of loops and
//! other variables that never change, remainders, states, neighbours of a known neighbourhood, and what is
//! computed of these. A process without anything to check, and without faults of its own, needs no record.
//!
//! # What is refused
//! NaN as a constant, empty arrays, comparisons of tuples and of arrays of them, order comparisons of `bool`.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod access;
mod buffer;
mod constant;
mod declarations;
mod entry;
mod error;
mod fault;
mod glossary;
mod inference;
mod layout;
mod literal;
mod module;
mod names;
mod numbers;
mod print;
mod program;
mod routine;
mod shader;
mod space;
mod types;
mod visit;

pub use error::{Error, Problem};
pub use fault::FaultKind;
pub use layout::{FieldLayout, Layout};
pub use module::shader;
pub use shader::{
    ACTIVITY_HEAD, Binding, BindingAccess, Content, Dispatch, Numbering, Options, Shader, State,
};
