//! The header of a grid: keys with their values, in any order.

use super::ReadGridError;
use crate::placement::Placement;
use std::path::Path;

/// A coordinate of the first cell, as the header gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Origin {
    /// The corner of the first cell.
    Corner(f64),
    /// The centre of the first cell.
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

/// The keys found so far.
#[derive(Debug, Default)]
pub(super) struct Header {
    pub(super) columns: Option<usize>,
    pub(super) rows: Option<usize>,
    pub(super) x: Option<Origin>,
    pub(super) y: Option<Origin>,
    pub(super) side: Option<f64>,
    /// The sides along x and y. They replace `side` if they are equal.
    pub(super) sides: [Option<f64>; 2],
    /// The NODATA value.
    pub(super) nothing: Option<f64>,
}

/// A line of a file, for error messages.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) path: &'a Path,
    pub(super) line: u64,
}

impl Place<'_> {
    /// Parses a number.
    pub(super) fn number(self, text: &str) -> Result<f64, ReadGridError> {
        text.parse().map_err(|source| ReadGridError::Number {
            path: self.path.to_owned(),
            line: self.line,
            text: text.to_owned(),
            source,
        })
    }

    /// Parses the number of a cell. Rejects infinities.
    pub(super) fn value(self, text: &str) -> Result<f64, ReadGridError> {
        let number = self.number(text)?;
        if number.is_infinite() {
            let (path, line, text) = (self.path.to_owned(), self.line, text.to_owned());
            return Err(ReadGridError::Infinite { path, line, text });
        }
        Ok(number)
    }

    fn key(self, key: &str, problem: impl Into<String>) -> ReadGridError {
        let problem = problem.into();
        ReadGridError::Key { path: self.path.to_owned(), line: self.line, key: key.to_owned(), problem }
    }
}

impl Header {
    /// Parses a line of keys, each with the word after it.
    pub(super) fn take_all<'a>(
        &mut self,
        place: Place<'_>,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), ReadGridError> {
        let mut words = words.peekable();
        while let Some(key) = words.next() {
            self.take(place, key, words.next())?;
            if let Some(over) = words.peek().filter(|word| !is_key(word)) {
                return Err(place.key(key, format!("has more than one value: `{over}` is left over")));
            }
        }
        Ok(())
    }

    /// Parses a key with the word after it.
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
        let positive = || match finite()? {
            side if side > 0.0 => Ok(side),
            _ => Err(place.key(key, "must be more than 0")),
        };
        let lower = key.to_ascii_lowercase();
        let is_new = match lower.as_str() {
            "ncols" => self.columns.replace(count()?).is_none(),
            "nrows" => self.rows.replace(count()?).is_none(),
            "xllcorner" => self.x.replace(Origin::Corner(finite()?)).is_none(),
            "yllcorner" => self.y.replace(Origin::Corner(finite()?)).is_none(),
            "xllcenter" => self.x.replace(Origin::Centre(finite()?)).is_none(),
            "yllcenter" => self.y.replace(Origin::Centre(finite()?)).is_none(),
            "cellsize" => self.side.replace(positive()?).is_none(),
            "dx" => self.sides[0].replace(positive()?).is_none(),
            "dy" => self.sides[1].replace(positive()?).is_none(),
            "nodata_value" => self.nothing.replace(number()?).is_none(),
            _ => {
                return Err(place.key(
                    key,
                    "is no key of a grid; there are ncols, nrows, xllcorner, yllcorner, cellsize and NODATA_value",
                ));
            }
        };
        if is_new { Ok(()) } else { Err(place.key(key, "appears twice in the header")) }
    }

    /// The place of the grid on the map.
    pub(super) fn placement(&self, path: &Path) -> Result<Placement, ReadGridError> {
        let missing = |key| ReadGridError::MissingKey { path: path.to_owned(), key };
        let columns = self.columns.ok_or_else(|| missing("ncols"))?;
        let rows = self.rows.ok_or_else(|| missing("nrows"))?;
        let side = self.side(path)?;
        let x = self.x.ok_or_else(|| missing("xllcorner"))?;
        let y = self.y.ok_or_else(|| missing("yllcorner"))?;
        let corner = [x.corner(side), y.corner(side)];
        let placement = Placement { extents: [columns, rows], corner, side }.checked();
        placement.map_err(|problem| ReadGridError::Place { path: path.to_owned(), problem })
    }

    /// Whether no key has been found.
    pub(super) fn is_empty(&self) -> bool {
        let numbers = [self.side, self.sides[0], self.sides[1], self.nothing];
        let counts = [self.columns, self.rows];
        counts.iter().all(Option::is_none)
            && [self.x, self.y].iter().all(Option::is_none)
            && numbers.iter().all(Option::is_none)
    }

    /// The side of a cell, from `cellsize` or from `dx` and `dy`.
    fn side(&self, path: &Path) -> Result<f64, ReadGridError> {
        let path = || path.to_owned();
        match (self.side, self.sides) {
            (Some(side), [None, None]) => Ok(side),
            (None, [Some(dx), Some(dy)]) if (dx - dy).abs() <= 1e-6 * dx => Ok(dx),
            (None, [Some(dx), Some(dy)]) => Err(ReadGridError::NotSquare { path: path(), dx, dy }),
            (None, [None, None]) => Err(ReadGridError::MissingKey { path: path(), key: "cellsize" }),
            (None, [None, _]) => Err(ReadGridError::MissingKey { path: path(), key: "dx" }),
            (None, [_, None]) => Err(ReadGridError::MissingKey { path: path(), key: "dy" }),
            (Some(_), _) => Err(ReadGridError::TwoSides { path: path() }),
        }
    }
}

/// Whether a word is a key. Keys begin with a letter, but so do infinity and NaN.
pub(super) fn is_key(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_alphabetic()) && word.parse::<f64>().is_err()
}
