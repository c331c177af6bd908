//! One model on many machines: each process of an MPI job has a part of the space.
//!
//! All processes of a job run the same program. The process of rank 0 is the host: it has the first part,
//! and steering, files and the clock. It starts models on the [`Mpi`] engine. The others call
//! [`Job::serve`], make the same models, and do what the host says.
//!
//! `Library` connects a job to MPI. It is there with the feature `mpi`, which needs an MPI library and
//! libclang to build. A [`Wire`] of another kind works in the same way.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod attendant;
mod engine;
mod job;
#[cfg(feature = "mpi")]
mod library;
mod mailbox;
mod opened;
mod order;
mod place;
mod ranks;
#[cfg(feature = "mpi")]
mod sending;
#[cfg(feature = "mpi")]
mod spare;
mod tag;
mod wire;

pub use engine::Mpi;
pub use job::{Job, PartEngine, ServeError};
#[cfg(feature = "mpi")]
pub use library::{Library, LibraryError};
pub use place::Place;
pub use wire::{Piece, Wire};
