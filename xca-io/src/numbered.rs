//! Files with numbers in their names, such as those of steps.

use std::fs;
use std::path::{Path, PathBuf};

/// The entries of a folder whose names have only digits between `before` and `after`, sorted by number.
#[must_use]
pub fn entries(folder: &Path, before: &str, after: &str) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let is_meant = |file: &str| {
        let middle = file.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
        middle.is_some_and(|middle| !middle.is_empty() && middle.bytes().all(|byte| byte.is_ascii_digit()))
    };
    let mut found: Vec<PathBuf> = entries
        .filter_map(Result::ok)
        .filter(|entry| entry.file_name().to_str().is_some_and(is_meant))
        .map(|entry| entry.path())
        .collect();
    found.sort_by_key(|path| (path.as_os_str().len(), path.clone()));
    found
}

/// The files of a folder whose names have only digits between `before` and `after`, sorted by number.
#[must_use]
pub fn files(folder: &Path, before: &str, after: &str) -> Vec<PathBuf> {
    let mut files = entries(folder, before, after);
    files.retain(|path| path.is_file());
    files
}
