//! Real processes, written as WGSL and checked by naga.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should")]

mod common;
mod items;
mod language;
mod layouts;
mod mathematics;
mod random;
mod refusals;
mod subset;
mod texts;
mod values;
