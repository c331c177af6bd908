//! Each construct that a process may use, run on the reference engine in both precisions.

mod cells;
mod common;
mod composition;
mod constants;
mod control;
mod faults;
mod floats;
mod helpers;
mod integers;
mod items;
mod iterators;
mod loops;
mod names;
mod ranges;
mod together;
mod values;
mod vectors;
