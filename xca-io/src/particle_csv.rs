//! Particles as CSV: one row per particle, exact to the last bit.
//!
//! The header is `label`, then the names of the columns (CADEM: `label,x,y,z,vx,vy,vz`). Rows are sorted by
//! label. Floats have 17 significant digits (`f64`) or 9 (`f32`) in scientific notation, so every value reads
//! back with the same bits. Integers are written as such, `bool` as `true` and `false`, states by name. Units
//! are those of the model.
//!
//! [`write()`] writes such a file. [`read()`] reads one, from a run or typed by hand, and reports errors by
//! line.

mod column_type;
mod error;
mod lines;
mod read;

use std::fmt::{self, Write as _};
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use super::atomic::write_atomically;

pub use column_type::ColumnType;
pub use error::{ReadError, WriteParticlesError};
pub use read::{ParticleTable, read};

/// The name of the first column.
pub const LABEL: &str = "label";

/// The values of one column, one for each particle.
#[derive(Debug, Clone, Copy)]
pub enum Column<'a> {
    /// Written with 17 significant digits.
    F64(&'a [f64]),
    /// Written with 9 significant digits.
    F32(&'a [f32]),
    /// Values of this type, given as numbers.
    Typed(ColumnType<'a>, &'a [f64]),
}

impl Column<'_> {
    fn len(&self) -> usize {
        match self {
            Self::F64(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::Typed(_, values) => values.len(),
        }
    }

    /// Formats the value of row `index` with one digit before the point and 16 or 8 after it.
    fn format(&self, index: usize, text: &mut String) -> fmt::Result {
        match self {
            Self::F64(values) => write!(text, "{:.16e}", values[index]),
            Self::F32(values) => write!(text, "{:.8e}", values[index]),
            Self::Typed(column_type, values) => text.write_str(&column_type.text(values[index])),
        }
    }
}

/// Writes particles to `path`, sorted by label. The file appears complete or not at all.
///
/// `labels` has one entry for each particle, in any order. Every column has the same length and order. Values
/// that are not finite are written as `NaN`, `inf` or `-inf`, so that a broken state can be inspected.
/// [`read()`] rejects them.
///
/// # Errors
/// [`WriteParticlesError`], each with the path.
pub fn write(path: &Path, labels: &[u32], columns: &[(&str, Column<'_>)]) -> Result<(), WriteParticlesError> {
    for (name, column) in columns {
        if column.len() != labels.len() {
            return Err(WriteParticlesError::ColumnLength {
                path: path.to_owned(),
                column: (*name).to_owned(),
                found: column.len(),
                labels: labels.len(),
            });
        }
    }
    let mut order: Vec<usize> = (0..labels.len()).collect();
    order.sort_unstable_by_key(|&i| labels[i]);
    if let Some(pair) = order.windows(2).find(|pair| labels[pair[0]] == labels[pair[1]]) {
        return Err(WriteParticlesError::DuplicateLabel { path: path.to_owned(), label: labels[pair[0]] });
    }
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    write_rows(path, &names, |rows| {
        let columns: Vec<Column<'_>> = columns.iter().map(|(_, column)| *column).collect();
        order.iter().try_for_each(|place| rows.add(labels, &columns, *place))
    })
}

/// Writes particles that need not be in memory as a whole: `give` adds them one by one, by label.
///
/// # Errors
/// [`WriteParticlesError::Write`], also with an error of `give`.
pub fn write_rows(
    path: &Path,
    columns: &[&str],
    give: impl FnOnce(&mut Rows<'_>) -> io::Result<()>,
) -> Result<(), WriteParticlesError> {
    write_atomically(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_field(LABEL)?;
        for name in columns {
            csv.write_field(name)?;
        }
        csv.write_record(None::<&[u8]>)?;
        let mut rows = Rows { csv, text: String::new() };
        give(&mut rows)?;
        rows.csv.flush()
    })?;
    Ok(())
}

/// The rows of a table that is written.
#[derive(Debug)]
pub struct Rows<'a> {
    csv: csv::Writer<&'a mut BufWriter<File>>,
    text: String,
}

impl Rows<'_> {
    /// Adds the particle at this place of the labels and columns. There are as many columns as names.
    ///
    /// # Errors
    /// If the system returns an error.
    pub fn add(&mut self, labels: &[u32], columns: &[Column<'_>], place: usize) -> io::Result<()> {
        self.text.clear();
        write!(self.text, "{}", labels[place]).map_err(io::Error::other)?;
        self.csv.write_field(&self.text)?;
        for column in columns {
            self.text.clear();
            column.format(place, &mut self.text).map_err(io::Error::other)?;
            self.csv.write_field(&self.text)?;
        }
        Ok(self.csv.write_record(None::<&[u8]>)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const AWKWARD: [f64; 8] = [
        0.1,
        -0.0,
        1.0 / 3.0,
        f64::MIN_POSITIVE,
        5e-324,
        f64::MAX,
        1.118_034e-5,
        0.30000000000000004, // 0.1 + 0.2; 16 digits would read back as 0.3
    ];

    #[test]
    fn the_text_is_sorted_and_has_17_and_9_digits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        let columns = [("x", Column::F64(&[0.1, -2.5])), ("vx", Column::F32(&[0.1, 0.0]))];
        write(&path, &[7, 3], &columns).unwrap();
        let text = "label,x,vx\n\
                    3,-2.5000000000000000e0,0.00000000e0\n\
                    7,1.0000000000000001e-1,1.00000001e-1\n";
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }

    #[test]
    fn every_f64_comes_back_with_its_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        let mut values = AWKWARD.to_vec();
        // Random bits: all exponents, all mantissas.
        let mut bits = 1_u64;
        while values.len() < 2000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            values.extend(Some(f64::from_bits(bits)).filter(|v| v.is_finite()));
        }
        let labels: Vec<u32> = (1..=2000).collect();
        write(&path, &labels, &[("x", Column::F64(&values))]).unwrap();
        let table = read(&path, &[("x", ColumnType::Number)]).unwrap();
        assert_eq!(table.labels, labels);
        for (written, back) in values.iter().zip(&table.columns[0]) {
            assert_eq!(written.to_bits(), back.to_bits(), "{written:e}");
        }
    }

    #[test]
    fn every_f32_comes_back_with_its_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        let mut values = vec![0.1_f32, -0.0, f32::MIN_POSITIVE, 1e-45, f32::MAX, 1.0 + f32::EPSILON];
        let mut bits = 1_u32;
        while values.len() < 2000 {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            values.extend(Some(f32::from_bits(bits)).filter(|v| v.is_finite()));
        }
        let labels: Vec<u32> = (1..=2000).collect();
        write(&path, &labels, &[("x", Column::F32(&values))]).unwrap();
        let table = read(&path, &[("x", ColumnType::Number)]).unwrap();
        for (written, &back) in values.iter().zip(&table.columns[0]) {
            assert_eq!(written.to_bits(), (back as f32).to_bits(), "{written:e}");
        }
    }

    #[test]
    fn no_particles_is_a_file_with_a_header() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        write(&path, &[], &[("x", Column::F64(&[]))]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "label,x\n");
        assert!(read(&path, &[("x", ColumnType::Number)]).unwrap().labels.is_empty());
    }

    #[test]
    fn two_of_one_label_and_uneven_columns_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        let error = write(&path, &[4, 9, 4], &[]).unwrap_err();
        assert!(error.to_string().contains("p.csv: two particles have the label 4"), "{error}");
        let error = write(&path, &[4], &[("x", Column::F32(&[1.0, 2.0]))]).unwrap_err();
        assert!(error.to_string().contains("column `x` has 2 values for 1 labels"), "{error}");
        assert!(!path.exists());
    }
}
