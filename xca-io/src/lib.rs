//! Readers and writers of scientific files.
//!
//! Every module takes plain data (slices of numbers, texts) and writes one kind of file. A file either
//! appears complete under its name or not at all ([`atomic`]); the one exception is the time series
//! ([`table_csv`]), which grows by whole rows. No simulation is needed.
//!
//! | module | file | for |
//! |---|---|---|
//! | [`particle_csv`] | `.csv` | particles, exact to the last bit; can be read back as an initial state |
//! | [`extended_xyz`] | `.xyz` | particles for OVITO and ASE |
//! | [`table_csv`] | `.csv` | time series |
//! | [`raster`] | | a layer of cells, of whichever of the next two formats |
//! | [`ascii_grid`] | `.asc` | a layer of cells for geographic information systems, also to begin from |
//! | [`geotiff`] | `.tif` | the same in binary, with a coordinate system |
//! | [`map`] | | where a layer of cells lies, and which of its cells have no ground |
//! | [`lattice`] | | how squares and hexagons lie in a layer |
//! | [`vtk`] | `.vtp`, `.vti`, `.pvd` | particles and dense substates in ParaView |
//! | [`regular_file`] | | how files are opened to be read: regular ones alone |
//! | [`deflate`] | | how much a compressed stream can hold |
//! | [`numbered`] | | files that are numbered by their names |
//! | [`numbers`] | | numbers as people read them |
//!
//! Pictures are made by the crate `xca-picture`.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

pub mod ascii_grid;
pub mod atomic;
pub mod deflate;
pub mod extended_xyz;
pub mod geotiff;
pub mod lattice;
pub mod lines;
pub mod map;
pub mod numbered;
pub mod numbers;
pub mod particle_csv;
mod placement;
pub mod raster;
pub mod regular_file;
pub mod table_csv;
pub mod vtk;
