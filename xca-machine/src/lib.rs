//! The machine: the memory that is left, and the memory that this process has used; the processor and its
//! cores.
//!
//! ```
//! use xca_machine::check_memory;
//!
//! let refusal = check_memory(1 << 62, "a space of that size").err().map(|error| error.to_string());
//! if cfg!(target_os = "linux") {
//!     assert!(refusal.is_some_and(|text| text.starts_with("a space of that size would need 4.61e9 GB")));
//! }
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod allocation;
mod limits;
mod table;

pub use allocation::return_large_pieces;
use limits::Free;
use std::fs;
use std::path::Path;
use table::kilobytes;

/// Something that does not fit into the memory that there is.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{what} would need {} of memory, and {} {} left; use fewer cells",
    gigabytes(*needed),
    free.limit.words(),
    gigabytes(u128::from(free.bytes))
)]
pub struct NotEnoughMemory {
    what: String,
    needed: u128,
    free: Free,
}

fn gigabytes(bytes: u128) -> String {
    format!("{} GB", xca_io::numbers::significant(bytes as f64 / 1e9, 3))
}

/// Checks that something can fit into the memory that is left. Where the system does not say how much that
/// is, everything fits.
///
/// For a set-up that makes something large before the model exists: memory that is not there ends a program
/// without a word.
///
/// # Errors
/// Where it does not fit into what the machine has, or what the process or its group may use.
pub fn check_memory(needed: u128, what: &str) -> Result<(), NotEnoughMemory> {
    match limits::free_memory(Path::new("/")) {
        Some(free) if needed > u128::from(free.bytes) => {
            Err(NotEnoughMemory { what: what.to_owned(), needed, free })
        }
        _ => Ok(()),
    }
}

/// The bytes of memory that are left, where the system tells.
pub fn free_memory() -> Option<u64> {
    limits::free_memory(Path::new("/")).map(|free| free.bytes)
}

/// The most bytes that this process has had in memory.
pub fn peak_memory() -> Option<u64> {
    kilobytes(Path::new("/proc/self/status"), "VmHWM:")
}

/// The bytes of memory that the machine has.
pub fn memory() -> Option<u64> {
    kilobytes(Path::new("/proc/meminfo"), "MemTotal:")
}

/// What the processor calls itself.
pub fn processor() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("model name"))?;
    Some(line.trim_start().trim_start_matches(':').trim().to_owned())
}

/// The number of cores that this process may use.
pub fn cores() -> Option<usize> {
    std::thread::available_parallelism().ok().map(std::num::NonZero::get)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_large_is_refused() {
        assert_eq!(check_memory(1000, "a cell"), Ok(()));
        if cfg!(target_os = "linux") {
            let error = check_memory(1 << 60, "the model").unwrap_err().to_string();
            assert!(error.starts_with("the model would need 1.15e9 GB of memory"), "{error}");
            assert!(peak_memory().is_some_and(|bytes| bytes > 100_000));
        }
    }
}
