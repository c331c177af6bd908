//! Each construct of the accepted subset of Rust.

mod cells;
mod numbers;
mod parts;
mod state;
mod statements;
