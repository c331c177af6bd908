//! What the whole-system suites share: the engines that they run on, how runs are compared, and the models
//! that they run.
//!
//! No suite names an engine. A new engine joins all of them by standing in [`engines::all`].

pub mod around;
pub mod cover;
pub mod engines;
pub mod lattice;
pub mod medium;
pub mod path;
pub mod recipe;
pub mod reduced;
pub mod site;
pub mod sky;
pub mod traveller;
pub mod walker;
