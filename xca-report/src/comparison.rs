//! A comparison as people and programs read it.

mod csv_files;
mod error;
mod markdown;
mod page;
mod plots;
mod sheets;
#[cfg(test)]
mod tests;

pub use error::ReportError;

use crate::table::table_within;
use sheets::Sheet;
use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::Path;
use xca_compare::ComparisonReport;
use xca_io::atomic::{WriteError, write_atomically};
use xca_record::InputFile;
use xca_record::record::{COMPARISON as JSON, Claim, FolderError, Kind, LockedFolder};

/// The folder of a comparison.
#[derive(Debug)]
pub struct Files {
    folder: LockedFolder,
}

/// What is in it.
const PAGE: &str = "compare.html";
const MARKDOWN: &str = "compare.md";

/// The most columns of a table on the terminal.
const WIDTH: usize = 100;

/// The files of a comparison.
fn files() -> impl Iterator<Item = &'static str> {
    [JSON, PAGE, MARKDOWN].into_iter().chain(csv_files::NAMES)
}

impl Files {
    /// Makes the folder; `inputs` is what the comparison has read.
    pub fn prepare(folder: &Path, inputs: &[InputFile]) -> Result<Self, FolderError> {
        let files: Vec<String> = files().map(str::to_owned).collect();
        let claim = Claim { kind: Kind::Comparison, files: &files, inputs, program: None, overwrite: false };
        Ok(Self { folder: LockedFolder::prepare(folder, &claim)? })
    }

    /// Writes all files; the report lists them.
    pub fn write(&self, comparison: &mut ComparisonReport) -> Result<(), ReportError> {
        comparison.files = files().collect();
        // The first, as it tells whose the others are.
        self.file(JSON, format!("{}\n", serde_json::to_string_pretty(comparison)?).as_bytes())?;
        self.file(PAGE, page::page(comparison)?.as_bytes())?;
        self.file(MARKDOWN, markdown::markdown(comparison).as_bytes())?;
        for (name, content) in csv_files::all(comparison)? {
            self.file(name, &content)?;
        }
        Ok(())
    }

    fn file(&self, name: &str, content: &[u8]) -> Result<(), WriteError> {
        write_atomically(&self.folder.top.file(name), |file| -> io::Result<()> { file.write_all(content) })
    }

    /// Where they are.
    pub fn told(&self) -> String {
        let names = csv_files::NAMES.join(", ");
        format!("{} ({MARKDOWN}, {JSON}, {names} beside it)", self.folder.top.file(PAGE).display())
    }
}

/// For the terminal.
pub fn text(comparison: &ComparisonReport) -> String {
    let mut out = sheets::headline(comparison);
    for Sheet { header, right, rows, .. } in sheets::narrow(comparison) {
        // Writing to a string cannot fail.
        let _ = write!(out, "\n\n{}", table_within(WIDTH, &header, &rows, &right));
    }
    out.push('\n');
    for note in sheets::notes(comparison) {
        let _ = write!(out, "\nnote: {note}");
    }
    for finding in sheets::findings(comparison) {
        let _ = write!(out, "\n{finding}");
    }
    if comparison.differs() {
        let _ = write!(out, "\n{}", sheets::CHAOS);
    }
    out
}
