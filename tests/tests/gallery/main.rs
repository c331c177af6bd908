//! The gallery: each model against something that is known of it, and with the same bits on every engine.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should")]

mod boltzmann;
mod common;
mod debris;
mod elementary;
mod excitable;
mod ising;
mod landslide;
mod lava;
mod predators;
mod reaction;
mod sandpile;
mod wildfire;
