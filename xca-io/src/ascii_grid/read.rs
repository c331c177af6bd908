//! The reader of grids.

use super::ReadGridError;
use super::header::{Header, Place, is_key};
use crate::lines::read_line;
use crate::placement::Placement;
use crate::raster::{Raster, from_the_south, stands_for_none};
use crate::regular_file;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

/// The default NODATA value.
pub(crate) const NOTHING: f64 = -9999.0;

pub(super) fn read(path: &Path, on: Option<Placement>) -> Result<Raster, ReadGridError> {
    let mut lines = Lines::open(path)?;
    let mut header = Header::default();
    while lines.advance()? {
        let first = lines.words().next();
        match first {
            None => {}
            Some(key) if is_key(key) => header.take_all(lines.place, lines.words())?,
            Some(_) if header.is_empty() => {
                let placement = on.ok_or_else(|| ReadGridError::NoHeader { path: path.to_owned() })?;
                return matrix(lines, placement);
            }
            Some(_) => break,
        }
    }
    let placement = header.placement(path)?;
    let nothing = header.nothing.unwrap_or(NOTHING);
    let extents = placement.extents;
    let cells = extents[0].saturating_mul(extents[1]);
    let wrong_count = |line, found: &str| ReadGridError::Count {
        path: path.to_owned(),
        line,
        extents,
        cells,
        found: found.to_owned(),
    };
    let mut values = Vec::with_capacity(cells.min(lines.most_values()));
    loop {
        for word in lines.words() {
            if values.len() == cells {
                return Err(wrong_count(Some(lines.place.line), "more"));
            }
            values.push(value(lines.place, word, nothing)?);
        }
        if !lines.advance()? {
            break;
        }
    }
    if values.len() < cells {
        return Err(wrong_count(None, &values.len().to_string()));
    }
    Ok(Raster { placement, values: from_the_south(values, extents[0]), coordinate_system: None })
}

/// Reads the rest of a file without a header: one line per row.
fn matrix(mut lines: Lines<'_>, placement: Placement) -> Result<Raster, ReadGridError> {
    let [columns, rows] = placement.extents;
    let other = |line, found: String, wanted| ReadGridError::Matrix {
        path: lines.place.path.to_owned(),
        line,
        found,
        wanted,
    };
    let wrong_row = |line, found: usize| other(Some(line), format!("{found} values in this row"), columns);
    let wrong_rows = |found: &str| other(None, format!("{found} rows"), rows);
    let cells = columns.saturating_mul(rows);
    let (mut values, mut found) = (Vec::with_capacity(cells.min(lines.most_values())), 0);
    loop {
        let before = values.len();
        for word in lines.words() {
            values.push(value(lines.place, word, NOTHING)?);
        }
        match values.len() - before {
            0 => {}
            count if count != columns => return Err(wrong_row(lines.place.line, count)),
            _ if found == rows => return Err(wrong_rows("more")),
            _ => found += 1,
        }
        if !lines.advance()? {
            break;
        }
    }
    if found < rows {
        return Err(wrong_rows(&found.to_string()));
    }
    Ok(Raster { placement, values: from_the_south(values, columns), coordinate_system: None })
}

fn value(place: Place<'_>, word: &str, nothing: f64) -> Result<f64, ReadGridError> {
    // NODATA may be infinite.
    let number = place.number(word)?;
    if stands_for_none(number, nothing) { Ok(f64::NAN) } else { place.value(word) }
}

/// The lines of a file, read one at a time.
struct Lines<'a> {
    file: BufReader<File>,
    /// The length of the file in bytes.
    length: u64,
    place: Place<'a>,
    text: String,
}

impl<'a> Lines<'a> {
    fn open(path: &'a Path) -> Result<Self, ReadGridError> {
        let failed = |source| ReadGridError::Open { path: path.to_owned(), source };
        let file = regular_file::open(path).map_err(failed)?;
        let length = file.metadata().map_err(failed)?.len();
        let file = BufReader::with_capacity(1 << 18, file);
        Ok(Self { file, length, place: Place { path, line: 0 }, text: String::new() })
    }

    /// An upper limit of the number of values: each takes a digit and a blank.
    fn most_values(&self) -> usize {
        usize::try_from(self.length / 2 + 1).unwrap_or(usize::MAX)
    }

    /// Goes to the next line. Returns `false` at the end of the file.
    fn advance(&mut self) -> Result<bool, ReadGridError> {
        self.place.line += 1;
        let Place { path, line } = self.place;
        let failed = |source| ReadGridError::Read { path: path.to_owned(), line, source };
        let mut bytes = std::mem::take(&mut self.text).into_bytes();
        read_line(&mut self.file, &mut bytes).map_err(failed)?;
        let no_text = |_| failed(io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"));
        self.text = String::from_utf8(bytes).map_err(no_text)?;
        Ok(!self.text.is_empty())
    }

    fn words(&self) -> impl Iterator<Item = &str> {
        // Some programs begin a text with a byte order mark.
        self.text.trim_start_matches('\u{feff}').split_ascii_whitespace()
    }
}
