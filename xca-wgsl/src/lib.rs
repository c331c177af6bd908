//! Elementary processes of xca as WGSL.
//!
//! [`shader`] takes the body of a process as data ([`xca_core::ir::Function`]) and gives a complete module: types, buffers,
//! the helpers that the process calls, the process itself, and an entry point that runs it for one cell or one item. No GPU is
//! needed for it.
//!
//! # What the text looks like
//! Names are those of the model where WGSL allows them. The own substates are loaded into a variable that is called like the
//! first argument of the process, `cell.temperature`, and stored at the end; so the own cell shows what the process has already
//! written. Neighbours and other items are read from buffers that show the state from before, `temperature_now[…]`; where they
//! are also written, results go to a second buffer, `temperature_next`.
//!
//! # What is the same as in Rust, and what is not
//! Integers wrap as in a release build, also `u8`, which is a `u32` below 256 here. `usize` has 32 bits. Casts from floats
//! saturate. `min` and `max` of floats are comparisons and not the processor's own; NaN is unequal to everything.
//!
//! Every operation stands in the text as in the source; but WGSL lets a driver contract and reorder float operations, so that equal
//! bits need more than the text: an engine has to forbid it, and to hide zeros from drivers that fold them
//! ([`Options::opaque_zero`]). Which NaN an operation gives is nowhere defined.
//!
//! An index beyond an array ends the run in Rust; here it reads or writes some element of the array.
//!
//! # What is refused
//! NaN as a constant, empty arrays, comparisons of whole arrays and tuples, order comparisons of `bool`, recursion.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod access;
mod declarations;
mod entry;
mod error;
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
pub use layout::{FieldLayout, Layout};
pub use shader::{Binding, BindingAccess, Content, Dispatch, Options, Shader, State, shader};
