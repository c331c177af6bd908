//! The header of a grid: keys with their values, in any order.

use super::{AsciiGrid, ReadGridError};
use std::path::Path;

/// Where the corner that a header gives lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Origin {
    /// It is the corner of the first cell.
    Corner(f64),
    /// It is the centre of the first cell.
    Centre(f64),
}

impl Origin {
    /// The coordinate of the corner.
    pub(super) fn corner(self, side: f64) -> f64 {
        match self {
            Self::Corner(corner) => corner,
            Self::Centre(centre) => centre - side / 2.0,
        }
    }
}

/// What was found so far.
#[derive(Debug, Default)]
pub(super) struct Header {
    pub(super) columns: Option<usize>,
    pub(super) rows: Option<usize>,
    pub(super) x: Option<Origin>,
    pub(super) y: Option<Origin>,
    pub(super) side: Option<f64>,
    /// The number that stands for none.
    pub(super) nothing: Option<f64>,
}

/// A line of a file.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) path: &'a Path,
    pub(super) line: u64,
}

impl Place<'_> {
    /// A text as a number.
    pub(super) fn number(self, text: &str) -> Result<f64, ReadGridError> {
        text.parse().map_err(|source| ReadGridError::Number {
            path: self.path.to_owned(),
            line: self.line,
            text: text.to_owned(),
            source,
        })
    }

    fn key(self, key: &str, problem: &'static str) -> ReadGridError {
        ReadGridError::Key { path: self.path.to_owned(), line: self.line, key: key.to_owned(), problem }
    }
}

impl Header {
    /// Takes in a key with the word after it.
    pub(super) fn take(
        &mut self,
        place: Place<'_>,
        key: &str,
        value: Option<&str>,
    ) -> Result<(), ReadGridError> {
        let text = value.ok_or_else(|| place.key(key, "has no value"))?;
        let number = || place.number(text);
        let finite = || match number()? {
            number if number.is_finite() => Ok(number),
            _ => Err(place.key(key, "must be a finite number")),
        };
        let count = || match text.parse() {
            Ok(count) if count > 0 => Ok(count),
            _ => Err(place.key(key, "must be a whole number, at least 1")),
        };
        let lower = key.to_ascii_lowercase();
        let is_new = match lower.as_str() {
            "ncols" => self.columns.replace(count()?).is_none(),
            "nrows" => self.rows.replace(count()?).is_none(),
            "xllcorner" => self.x.replace(Origin::Corner(finite()?)).is_none(),
            "yllcorner" => self.y.replace(Origin::Corner(finite()?)).is_none(),
            "xllcenter" => self.x.replace(Origin::Centre(finite()?)).is_none(),
            "yllcenter" => self.y.replace(Origin::Centre(finite()?)).is_none(),
            "cellsize" => match finite()? {
                side if side > 0.0 => self.side.replace(side).is_none(),
                _ => return Err(place.key(key, "must be more than 0")),
            },
            "nodata_value" => self.nothing.replace(number()?).is_none(),
            "dx" | "dy" => return Err(place.key(key, "is for cells that are not square; give one cellsize")),
            _ => {
                return Err(place.key(
                    key,
                    "is no key of a grid; there are ncols, nrows, xllcorner, yllcorner, cellsize and NODATA_value",
                ));
            }
        };
        if is_new { Ok(()) } else { Err(place.key(key, "stands twice in the header")) }
    }

    /// A grid with this header, and no values yet.
    pub(super) fn grid(&self, path: &Path) -> Result<AsciiGrid, ReadGridError> {
        let missing = |key| ReadGridError::MissingKey { path: path.to_owned(), key };
        let columns = self.columns.ok_or_else(|| missing("ncols"))?;
        let rows = self.rows.ok_or_else(|| missing("nrows"))?;
        let side = self.side.ok_or_else(|| missing("cellsize"))?;
        let x = self.x.ok_or_else(|| missing("xllcorner"))?;
        let y = self.y.ok_or_else(|| missing("yllcorner"))?;
        let corner = [x.corner(side), y.corner(side)];
        Ok(AsciiGrid { extents: [columns, rows], corner, side, values: Vec::new() })
    }
}
