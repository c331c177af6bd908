//! Reading a grid.

use super::header::{Header, Place};
use super::{AsciiGrid, ReadGridError};
use crate::regular_file;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

pub(super) fn read(path: &Path) -> Result<AsciiGrid, ReadGridError> {
    let mut lines = Lines::open(path)?;
    let mut header = Header::default();
    while lines.advance()? {
        let mut words = lines.words();
        match words.next() {
            None => {}
            Some(key) if is_key(key) => header.take(lines.place, key, words.next())?,
            Some(_) => break,
        }
    }
    let mut grid = header.grid(path)?;
    let cells = grid.extents[0].saturating_mul(grid.extents[1]);
    let extents = grid.extents;
    let wrong_count = |line, found: &str| ReadGridError::Count {
        path: path.to_owned(),
        line,
        extents,
        cells,
        found: found.to_owned(),
    };
    let mut values = Vec::new();
    loop {
        for word in lines.words() {
            if values.len() == cells {
                return Err(wrong_count(Some(lines.place.line), "more"));
            }
            let number = lines.place.number(word)?;
            values.push(if Some(number) == header.nothing { f64::NAN } else { number });
        }
        if !lines.advance()? {
            break;
        }
    }
    if values.len() < cells {
        return Err(wrong_count(None, &values.len().to_string()));
    }
    // The northernmost row stands first.
    grid.values = values.chunks_exact(grid.extents[0]).rev().flatten().copied().collect();
    Ok(grid)
}

/// Keys begin with a letter; so do numbers that are infinite or none.
fn is_key(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_alphabetic()) && word.parse::<f64>().is_err()
}

/// The lines of a file, one at a time.
struct Lines<'a> {
    file: BufReader<File>,
    place: Place<'a>,
    text: String,
}

impl<'a> Lines<'a> {
    fn open(path: &'a Path) -> Result<Self, ReadGridError> {
        let file = regular_file::open(path)
            .map_err(|source| ReadGridError::Open { path: path.to_owned(), source })?;
        let file = BufReader::with_capacity(1 << 18, file);
        Ok(Self { file, place: Place { path, line: 0 }, text: String::new() })
    }

    /// Goes to the next line; there is none after the last.
    fn advance(&mut self) -> Result<bool, ReadGridError> {
        self.text.clear();
        self.place.line += 1;
        let Place { path, line } = self.place;
        let failed = |source| ReadGridError::Read { path: path.to_owned(), line, source };
        Ok(self.file.read_line(&mut self.text).map_err(failed)? > 0)
    }

    fn words(&self) -> impl Iterator<Item = &str> {
        // Some programs begin a text with a mark of its byte order.
        self.text.trim_start_matches('\u{feff}').split_ascii_whitespace()
    }
}
