//! The reader of extended XYZ.

use super::comment::pairs;
use super::{POSITIONS, ReadXyzError, Space};
use crate::lines::read_line;
use crate::regular_file;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;
use std::str::FromStr;

/// A frame of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadFrame {
    /// The simulated time, if the file gives it.
    pub time: Option<f64>,
    /// The space, if the file gives it.
    pub space: Option<Space>,
    /// The positions of the particles.
    pub positions: Vec<[f64; 3]>,
    /// The other columns.
    pub columns: Vec<ReadColumn>,
}

/// A column of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadColumn {
    /// Its name in `Properties`.
    pub name: String,
    /// The number of values per particle.
    pub components: usize,
    /// All values, one particle after the other.
    pub values: ReadValues,
}

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum ReadValues {
    Real(Vec<f64>),
    Whole(Vec<i64>),
    Bool(Vec<bool>),
    Text(Vec<String>),
}

/// Reads all frames of a file.
///
/// The lattice must be a box along the axes. Columns other than `pos` may have any names. Keys other than
/// `Lattice`, `Origin`, `Properties`, `pbc` and `Time` are ignored. Without `pbc`, a lattice is periodic
/// along all axes, as the format says.
///
/// # Errors
/// [`ReadXyzError`] with the path and the line.
pub fn read(path: &Path) -> Result<Vec<ReadFrame>, ReadXyzError> {
    let file =
        regular_file::open(path).map_err(|source| ReadXyzError::Open { path: path.to_owned(), source })?;
    let mut lines =
        Lines { path, file: BufReader::with_capacity(1 << 18, file), line: 0, text: String::new() };
    let mut frames = Vec::new();
    while lines.advance()? {
        if lines.text.trim().is_empty() {
            continue;
        }
        let count: usize = lines
            .text
            .trim()
            .parse()
            .map_err(|_| lines.wrong(lines.text.trim(), "is not a number of particles"))?;
        if !lines.advance()? {
            return Err(lines.problem("the file ends before its line of keys".to_owned()));
        }
        let mut frame = keys(&lines)?;
        for read in 0..count {
            if !lines.advance()? {
                return Err(lines.problem(format!("the file ends after {read} of {count} particles")));
            }
            particle(&lines, &mut frame)?;
        }
        frames.push(frame.frame);
    }
    Ok(frames)
}

/// A frame in progress, with the place of `pos` among its columns.
struct Partial {
    frame: ReadFrame,
    /// The number of other columns before `pos`.
    before: usize,
}

/// Reads the line of keys. Returns a frame without particles.
fn keys(lines: &Lines<'_>) -> Result<Partial, ReadXyzError> {
    let pairs = pairs(&lines.text).map_err(|problem| lines.problem(problem))?;
    let value = |wanted: &str| pairs.iter().find(|pair| pair.key == wanted).map(|pair| pair.value);
    let numbers = |text: &str| {
        text.split_whitespace()
            .map(|word| lines.parse(word, "is not a number"))
            .collect::<Result<Vec<f64>, _>>()
    };
    let time = value("Time").map(|text| lines.parse(text, "is not a time")).transpose()?;
    let mut space = None;
    if let Some(text) = value("Lattice") {
        let matrix = numbers(text)?;
        let [a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, c] = matrix[..] else {
            return Err(lines.wrong(text, "is not the lattice of a box along the axes"));
        };
        let origin = value("Origin").map(numbers).transpose()?.unwrap_or_else(|| vec![0.0; 3]);
        let [x, y, z] = origin[..] else {
            return Err(lines.wrong(value("Origin").unwrap_or_default(), "is not a point"));
        };
        let axes = value("pbc").unwrap_or("T T T");
        let axes: Vec<bool> =
            axes.split_whitespace().map(|word| lines.truth(word)).collect::<Result<_, _>>()?;
        let [p, q, r] = axes[..] else {
            return Err(lines.wrong(value("pbc").unwrap_or_default(), "does not have three axes"));
        };
        space = Some(Space { origin: [x, y, z], sides: [a, b, c], periodic: [p, q, r] });
    }
    let properties = value("Properties").unwrap_or("species:S:1:pos:R:3");
    let mut columns = Vec::new();
    let mut before = None;
    let words: Vec<&str> = properties.split(':').collect();
    for column in words.chunks(3) {
        let &[name, letter, width] = column else {
            return Err(lines.wrong(properties, "does not have a name, a type and a width for each column"));
        };
        let components = match width.parse() {
            Ok(components @ 1..=1000) => components,
            _ => return Err(lines.wrong(width, "is not the width of a column")),
        };
        if name == POSITIONS && letter == "R" && components == 3 && before.is_none() {
            before = Some(columns.len());
            continue;
        }
        let values = match letter {
            "R" => ReadValues::Real(Vec::new()),
            "I" => ReadValues::Whole(Vec::new()),
            "L" => ReadValues::Bool(Vec::new()),
            "S" => ReadValues::Text(Vec::new()),
            _ => return Err(lines.wrong(letter, "is no type of a column; there are R, I, L and S")),
        };
        columns.push(ReadColumn { name: name.to_owned(), components, values });
    }
    let before = before.ok_or_else(|| lines.wrong(properties, "has no column pos:R:3"))?;
    Ok(Partial { frame: ReadFrame { time, space, positions: Vec::new(), columns }, before })
}

/// Reads the line of a particle.
fn particle(lines: &Lines<'_>, partial: &mut Partial) -> Result<(), ReadXyzError> {
    let Partial { frame, before } = partial;
    let mut words = lines.text.split_whitespace();
    let mut next = || words.next().ok_or_else(|| lines.problem("the particle has too few values".to_owned()));
    for number in 0..=frame.columns.len() {
        if number == *before {
            let mut point = [0.0; 3];
            for lane in &mut point {
                *lane = lines.parse(next()?, "is not a number")?;
            }
            frame.positions.push(point);
        }
        let Some(column) = frame.columns.get_mut(number) else { continue };
        for _ in 0..column.components {
            let word = next()?;
            match &mut column.values {
                ReadValues::Real(values) => values.push(lines.parse(word, "is not a number")?),
                ReadValues::Whole(values) => values.push(lines.parse(word, "is not a whole number")?),
                ReadValues::Bool(values) => values.push(lines.truth(word)?),
                ReadValues::Text(values) => values.push(word.to_owned()),
            }
        }
    }
    match words.next() {
        Some(word) => Err(lines.wrong(word, "is more than the columns of a particle")),
        None => Ok(()),
    }
}

/// The lines of a file, read one at a time.
struct Lines<'a> {
    path: &'a Path,
    file: BufReader<File>,
    line: u64,
    text: String,
}

impl Lines<'_> {
    /// Goes to the next line. Returns `false` at the end of the file.
    fn advance(&mut self) -> Result<bool, ReadXyzError> {
        self.line += 1;
        let failed = |source| ReadXyzError::Read { path: self.path.to_owned(), line: self.line, source };
        let mut bytes = std::mem::take(&mut self.text).into_bytes();
        read_line(&mut self.file, &mut bytes).map_err(failed)?;
        let is_no_text = |error| failed(io::Error::new(io::ErrorKind::InvalidData, error));
        self.text = String::from_utf8(bytes).map_err(is_no_text)?;
        Ok(!self.text.is_empty())
    }

    fn problem(&self, problem: String) -> ReadXyzError {
        ReadXyzError::Line { path: self.path.to_owned(), line: self.line, problem }
    }

    /// The error for a word with any content.
    fn wrong(&self, word: &str, problem: &str) -> ReadXyzError {
        let word: String = word.escape_debug().take(60).collect();
        self.problem(format!("`{word}` {problem}"))
    }

    fn parse<T: FromStr>(&self, word: &str, problem: &str) -> Result<T, ReadXyzError> {
        word.parse().map_err(|_| self.wrong(word, problem))
    }

    fn truth(&self, word: &str) -> Result<bool, ReadXyzError> {
        match word {
            "T" | "True" | "true" | "1" => Ok(true),
            "F" | "False" | "false" | "0" => Ok(false),
            _ => Err(self.wrong(word, "is neither T nor F")),
        }
    }
}
