//! What the engine does at the limits of adapters, which handicaps bring within reach of small models.

mod activity;
mod buffers;
mod common;
mod corrections;
mod pieces;
mod silence;
mod turns;
mod workgroups;
