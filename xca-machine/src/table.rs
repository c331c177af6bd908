//! The tables of the system.

use std::fs;
use std::path::Path;

/// A number of bytes from one of Linux's tables; other systems have none.
pub(crate) fn kilobytes(table: &Path, name: &str) -> Option<u64> {
    let text = fs::read_to_string(table).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let number: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    number.checked_mul(1024)
}
