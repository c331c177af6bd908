//! Programs under `mpirun`: the files of one machine, byte by byte, and an end whatever happens.
//!
//! There may be more processes than cores here, so nothing is said about times.

mod book;
mod ends;
mod launched;
mod misuse;
mod same_files;
