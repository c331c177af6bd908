//! Models of several sciences, each of which leans on another part of the language.
//!
//! Each file names its source. The suites run them on every engine and compare them with what is known of
//! them.

pub mod boltzmann;
pub mod cavity;
pub mod debris;
pub mod elementary;
pub mod excitable;
pub mod flows;
pub mod ising;
pub mod landslide;
pub mod lava;
pub mod predators;
pub mod reaction;
pub mod sandpile;
pub mod wildfire;
