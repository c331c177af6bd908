//! Every reader is given damaged files: it may refuse them, but never panic, take more memory than a file is
//! worth, or take long.
//!
//! `XCA_FUZZ_INPUTS` says how many files each reader is given.

mod large_files;
mod measured;
mod model;
mod run_files;
mod saved_states;
mod set_up_files;

#[global_allocator]
static ALLOCATED: peak_alloc::PeakAlloc = peak_alloc::PeakAlloc;
