//! What the engine does at the limits of adapters, which handicaps bring within reach of small models.

mod common;
mod workgroups;
