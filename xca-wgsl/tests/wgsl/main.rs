//! Real processes, written as WGSL and checked by naga.

mod common;
mod items;
mod layouts;
mod refusals;
mod subset;
mod texts;
