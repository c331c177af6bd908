//! The reader of particles as CSV.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::BufReader;
use std::path::Path;

use super::LABEL;
use super::column_type::ColumnType;
use super::error::ReadError;
use super::lines::MeaningfulLines;
use crate::lines::LimitedRows;
use crate::regular_file;

/// The particles of a file, in the order of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleTable {
    /// The label of each particle.
    pub labels: Vec<u32>,
    /// The values: `columns[c][i]` for column `c` (in the requested order) and particle `i`. All are finite.
    pub columns: Vec<Vec<f64>>,
    /// The line of each particle in the file, from 1, for error messages of the model.
    pub lines: Vec<u64>,
}

/// Reads particles from `path`. The header must hold `label` and each of `columns` once, in any order.
///
/// Ignores blanks around fields, blank lines and lines that begin with `#`. Every value must have the type of
/// its column: a finite float, an integer in range, `true` or `false`, the name of a state. A state is
/// returned as its index. Every label must be unique. The model makes further checks itself, and takes line
/// numbers from [`ParticleTable::lines`]. Values that were written as `f32` are exact when cast to `f32`.
///
/// # Errors
/// [`ReadError`], with the path, the line and the column.
pub fn read(path: &Path, columns: &[(&str, ColumnType<'_>)]) -> Result<ParticleTable, ReadError> {
    let file =
        regular_file::open(path).map_err(|source| ReadError::Open { path: path.to_owned(), source })?;
    let broken = |error: csv::Error| ReadError::Read { path: path.to_owned(), source: error.into() };
    let mut csv = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(LimitedRows::new(MeaningfulLines::new(BufReader::with_capacity(1 << 18, file))));
    let line_of = |csv: &csv::Reader<LimitedRows<MeaningfulLines<_>>>, record: &csv::ByteRecord| {
        csv.get_ref().source().number(record.position().map_or(1, csv::Position::line))
    };
    let mut record = csv::ByteRecord::new();
    csv.read_byte_record(&mut record).map_err(broken)?;
    let places = header(path, line_of(&csv, &record), &record, columns)?;

    let mut table =
        ParticleTable { labels: Vec::new(), columns: vec![Vec::new(); columns.len()], lines: Vec::new() };
    let mut seen = HashMap::new();
    loop {
        csv.get_mut().begin_row();
        if !csv.read_byte_record(&mut record).map_err(broken)? {
            break;
        }
        let line = line_of(&csv, &record);
        let row = Row { path, line, record: &record, width: places.len() };
        let label = row.label(places[0])?;
        if let Some(first) = seen.insert(label, line) {
            return Err(ReadError::DuplicateLabel { path: path.to_owned(), line, first, label });
        }
        table.labels.push(label);
        table.lines.push(line);
        for ((values, &place), (name, column_type)) in table.columns.iter_mut().zip(&places[1..]).zip(columns)
        {
            values.push(row.value(place, name, *column_type)?);
        }
    }
    Ok(table)
}

/// The index of the field in a row, for `label` and then for each of `columns`.
fn header(
    path: &Path,
    line: u64,
    record: &csv::ByteRecord,
    columns: &[(&str, ColumnType<'_>)],
) -> Result<Vec<usize>, ReadError> {
    let wanted: Vec<&str> = std::iter::once(LABEL).chain(columns.iter().map(|(name, _)| *name)).collect();
    let names: Vec<Cow<'_, str>> = record.iter().map(String::from_utf8_lossy).collect();
    for (place, name) in names.iter().enumerate() {
        let (path, column) = (path.to_owned(), name.to_string());
        if !wanted.contains(&name.as_ref()) {
            return Err(ReadError::UnknownColumn { path, line, column, expected: wanted.join(",") });
        }
        if names[..place].contains(name) {
            return Err(ReadError::RepeatedColumn { path, line, column });
        }
    }
    let place_of = |name: &&str| {
        names.iter().position(|field| field == name).ok_or_else(|| ReadError::MissingColumn {
            path: path.to_owned(),
            line,
            column: (*name).to_owned(),
            expected: wanted.join(","),
        })
    };
    wanted.iter().map(place_of).collect()
}

struct Row<'a> {
    path: &'a Path,
    line: u64,
    record: &'a csv::ByteRecord,
    width: usize,
}

impl<'a> Row<'a> {
    fn field(&self, place: usize) -> Result<Cow<'a, str>, ReadError> {
        let (expected, found) = (self.width, self.record.len());
        let field = self.record.get(place).filter(|_| found == expected);
        field.map(String::from_utf8_lossy).ok_or_else(|| ReadError::FieldCount {
            path: self.path.to_owned(),
            line: self.line,
            expected,
            found,
        })
    }

    fn label(&self, place: usize) -> Result<u32, ReadError> {
        let text = self.field(place)?;
        text.parse().map_err(|source| ReadError::Label {
            path: self.path.to_owned(),
            line: self.line,
            text: text.into_owned(),
            source,
        })
    }

    fn value(&self, place: usize, column: &str, column_type: ColumnType<'_>) -> Result<f64, ReadError> {
        if column_type == ColumnType::Number {
            return self.number(place, column);
        }
        let text = self.field(place)?;
        column_type.parse(&text).ok_or_else(|| ReadError::Value {
            path: self.path.to_owned(),
            line: self.line,
            column: column.to_owned(),
            text: text.into_owned(),
            wanted: column_type.to_string(),
        })
    }

    fn number(&self, place: usize, column: &str) -> Result<f64, ReadError> {
        let text = self.field(place)?;
        let (path, line) = (self.path.to_owned(), self.line);
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => {
                Err(ReadError::NotFinite { path, line, column: column.to_owned(), text: text.into_owned() })
            }
            Err(source) => Err(ReadError::Number {
                path,
                line,
                column: column.to_owned(),
                text: text.into_owned(),
                source,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Column;
    use super::*;

    fn read_text(text: &[u8]) -> Result<ParticleTable, ReadError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        std::fs::write(&path, text).unwrap();
        read(&path, &[("x", ColumnType::Number), ("y", ColumnType::Number)])
    }

    const PHASE: ColumnType<'static> = ColumnType::State { name: "Phase", states: &["Solid", "Liquid"] };

    #[test]
    fn values_are_read_by_the_types_of_their_columns() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        let columns = [
            ("phase", PHASE),
            ("wet", ColumnType::Bool),
            ("age", ColumnType::Whole { least: 0, largest: 255 }),
            ("charge", ColumnType::Whole { least: i32::MIN as i64, largest: i32::MAX as i64 }),
            ("hits", ColumnType::Whole { least: 0, largest: u32::MAX as i64 }),
        ];
        let values: [&[f64]; 5] =
            [&[1.0, 0.0], &[0.0, 1.0], &[255.0, 0.0], &[-2_147_483_648.0, 7.0], &[4_294_967_295.0, 0.0]];
        let written: Vec<_> = columns
            .iter()
            .zip(values)
            .map(|((name, scalar), values)| (*name, Column::Typed(*scalar, values)))
            .collect();
        super::super::write(&path, &[3, 1], &written).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(
            text,
            "label,phase,wet,age,charge,hits\n\
             1,Solid,true,0,7,0\n\
             3,Liquid,false,255,-2147483648,4294967295\n"
        );
        let table = read(&path, &columns).unwrap();
        for (column, values) in table.columns.iter().zip(values) {
            assert_eq!(*column, [values[1], values[0]]);
        }
        for (wrong, message) in [
            ("Gas,true,0,0,0", "`Gas` in column `phase` must be a Phase: Solid, Liquid"),
            ("Solid,1,0,0,0", "`1` in column `wet` must be true or false"),
            ("Solid,true,256,0,0", "`256` in column `age` must be a whole number from 0 to 255"),
            (
                "Solid,true,0,1.5,0",
                "`1.5` in column `charge` must be a whole number from -2147483648 to 2147483647",
            ),
            ("Solid,true,0,0,-1", "`-1` in column `hits` must be a whole number from 0 to 4294967295"),
        ] {
            std::fs::write(&path, format!("label,phase,wet,age,charge,hits\n\n1,{wrong}\n")).unwrap();
            let error = read(&path, &columns).unwrap_err().to_string();
            assert!(error.ends_with(&format!("p.csv:3: {message}")), "{error}");
        }
    }

    /// The message without the folder, which differs from run to run.
    fn message(text: &str) -> String {
        let message = read_text(text.as_bytes()).unwrap_err().to_string();
        message[message.find("p.csv").unwrap()..].to_owned()
    }

    #[test]
    fn columns_may_stand_in_any_order() {
        let table = read_text(b"y,label,x\n2,7,1\n4.5e-3, 3 ,-3\n").unwrap();
        assert_eq!(table.labels, [7, 3]);
        assert_eq!(table.columns, [vec![1.0, -3.0], vec![2.0, 4.5e-3]]);
        assert_eq!(table.lines, [2, 3]);
    }

    #[test]
    fn lines_are_counted_through_blanks_comments_and_foreign_line_ends() {
        let table =
            read_text(b"\xEF\xBB\xBF# made by hand\n\nlabel,x,y\r\n1,0,0\r\n\r\n\n# more\n2,0,0").unwrap();
        assert_eq!(table.labels, [1, 2]);
        assert_eq!(table.lines, [4, 8]);
    }

    #[test]
    fn a_bad_header_is_named() {
        assert_eq!(
            message(""),
            "p.csv:1: the header has no column `label`; it must be `label,x,y`, in any order"
        );
        assert_eq!(
            message("label,x\n"),
            "p.csv:1: the header has no column `y`; it must be `label,x,y`, in any order"
        );
        assert_eq!(
            message("label,x,y,z\n"),
            "p.csv:1: unknown column `z` in the header; it must be `label,x,y`, in any order"
        );
        assert_eq!(message("label,x,x,y\n"), "p.csv:1: the column `x` appears twice in the header");
    }

    #[test]
    fn a_bad_row_is_named_by_its_line() {
        let line_4 = |row: &str| message(&format!("label,x,y\n1,0,0\n\n{row}\n9,0,0\n"));
        assert_eq!(line_4("2,0"), "p.csv:4: 2 fields in this row, 3 in the header");
        assert_eq!(line_4("2,0,0,0"), "p.csv:4: 4 fields in this row, 3 in the header");
        assert_eq!(line_4("2,0.1.2,0"), "p.csv:4: `0.1.2` in column `x` is not a number");
        assert_eq!(line_4("2,0,"), "p.csv:4: `` in column `y` is not a number");
        assert_eq!(line_4("2,0,nan"), "p.csv:4: `nan` in column `y` is not a finite number");
        assert_eq!(line_4("2,-inf,0"), "p.csv:4: `-inf` in column `x` is not a finite number");
        assert_eq!(line_4("2,1e999,0"), "p.csv:4: `1e999` in column `x` is not a finite number");
        assert_eq!(line_4("-2,0,0"), "p.csv:4: the label `-2` is not a whole number from 0 to 4294967295");
        assert_eq!(
            line_4("4294967296,0,0"),
            "p.csv:4: the label `4294967296` is not a whole number from 0 to 4294967295"
        );
        assert_eq!(line_4("1,5,5"), "p.csv:4: the label 1 stands on line 2 already");
    }

    #[test]
    fn bytes_that_are_no_text_and_a_missing_file_are_errors() {
        let error = read_text(b"label,x,y\n\n1,0,\xFF\n").unwrap_err().to_string();
        assert!(error.ends_with("p.csv:3: `\u{FFFD}` in column `y` is not a number"), "{error}");
        let error = read(Path::new("/nowhere/p.csv"), &[]).unwrap_err();
        assert!(error.to_string().contains("/nowhere/p.csv"), "{error}");
        assert!(std::error::Error::source(&error).is_some());
    }
}
