//! What Rust stops a process for: an index beyond an array, a division without a result, a range in steps
//! of 0. Every engine stops there with the same fault, in the same words, whether its machine can panic or
//! not.

mod divisions;
mod first;
mod indices;
mod items;
mod model;
mod steps;
