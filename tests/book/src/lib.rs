//! The pages of `docs/` as a book.

use mdbook_driver::MDBook;
use std::error::Error;
use std::path::{Path, PathBuf};

/// The workspace.
fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// The directory in which `mdbook build` leaves the book, as book.toml names it.
pub fn folder() -> PathBuf {
    root().join("target/book")
}

/// Builds the book in a directory, and replaces what was there.
///
/// # Errors
/// If book.toml, a page or the directory cannot be read or written.
pub fn build(folder: &Path) -> Result<(), Box<dyn Error + Send + Sync>> {
    let mut book = MDBook::load(root())?;
    folder.clone_into(&mut book.config.build.build_dir);
    Ok(book.build()?)
}
