//! Readers and writers of scientific file formats.
//!
//! Each module reads or writes one format, from plain data: slices of numbers, texts. No simulation is
//! needed. A file appears complete or not at all ([`atomic`]). Only time series ([`table_csv`]) grow, by
//! whole rows.
//!
//! | module | file | purpose |
//! |---|---|---|
//! | [`particle_csv`] | `.csv` | particles, exact to the last bit; also as initial state |
//! | [`extended_xyz`] | `.xyz` | particles for OVITO and ASE |
//! | [`table_csv`] | `.csv` | time series |
//! | [`raster`] | `.asc`, `.tif` | a layer of cells, in either of the next two formats |
//! | [`ascii_grid`] | `.asc` | a layer of cells for geographic information systems |
//! | [`geotiff`] | `.tif` | the same in binary, with a coordinate system |
//! | [`map`] | | the place of a layer, and its cells without ground |
//! | [`lattice`] | | the geometry of squares and hexagons in a layer |
//! | [`vtk`] | `.vtp`, `.vti`, `.pvd` | particles and dense substates for ParaView |
//! | [`regular_file`] | | opens regular files only |
//! | [`deflate`] | | the largest content of a compressed stream |
//! | [`numbered`] | | files with numbers in their names |
//! | [`numbers`] | | numbers formatted for people |
//!
//! The crate `xca-picture` makes pictures.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

pub mod ascii_grid;
pub mod atomic;
pub mod deflate;
pub mod extended_xyz;
pub mod geotiff;
pub mod lattice;
pub mod lines;
pub mod map;
mod map_unit;
pub mod numbered;
pub mod numbers;
pub mod particle_csv;
mod placement;
mod quantity;
pub mod raster;
pub mod regular_file;
pub mod table_csv;
pub mod vtk;
