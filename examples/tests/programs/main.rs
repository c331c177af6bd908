//! The programs as their users see them: each test runs the real thing, and looks at what it says and writes.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should")]

mod begun;
mod book;
mod checkpoints;
mod compared;
mod continued;
mod doors;
mod files;
mod gallery;
mod grounds;
mod in_parts;
mod interrupted;
mod killed;
mod limits;
mod looked_at;
mod maps;
mod misuse;
#[cfg(all(unix, feature = "mpi"))]
mod mpi;
mod physics;
mod printed;
mod rendered;
mod resumed;
mod running;
mod same_bits;
mod scripted;
mod shaders;
mod swept;
mod values;
mod vtk_library;
mod watched;
