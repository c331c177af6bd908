//! A time series as CSV, row by row while the run goes on.
//!
//! The header is `step,time` and then the names of the observables; time is in seconds, or the unit of the model. Each
//! row goes to the file whole, in one write, as soon as it is known: whenever the run ends, by Ctrl-C or a crash of the
//! machine's power aside, the file holds complete rows. Numbers are the shortest decimals that give back the same `f64`.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A time series that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum SeriesError {
    /// The file cannot be made or written.
    #[error("cannot write the time series {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A row has more or fewer values than the header has names.
    #[error("cannot write row `step {step}` of {}: {found} values for {expected} names", path.display())]
    Width {
        /// The file.
        path: PathBuf,
        /// The step of the row.
        step: u64,
        /// The number of names.
        expected: usize,
        /// The number of values.
        found: usize,
    },
    /// Two columns have one name.
    #[error("cannot write the time series {}: the name `{name}` is used twice", path.display())]
    RepeatedName {
        /// The file.
        path: PathBuf,
        /// The name.
        name: String,
    },
}

/// The writer of a time series.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let temporary = tempfile::tempdir()?;
/// # let path = temporary.path().join("observables.csv");
/// use xca_run::output::table_csv::SeriesWriter;
///
/// let mut series = SeriesWriter::create(&path, &["particles", "kinetic energy"])?;
/// series.append(0, 0.0, &[2602.0, 0.0])?;
/// series.append(100, 1.118e-3, &[2602.0, 1.5631e-4])?;
/// assert_eq!(
///     std::fs::read_to_string(&path)?,
///     "step,time,particles,kinetic energy\n0,0,2602,0\n100,0.001118,2602,0.00015631\n"
/// );
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct SeriesWriter {
    path: PathBuf,
    file: File,
    names: usize,
}

impl SeriesWriter {
    /// Makes the file, in place of an earlier one, and writes its header.
    ///
    /// # Errors
    /// [`SeriesError::Write`] and [`SeriesError::RepeatedName`] (`step` and `time` are taken).
    pub fn create(path: &Path, names: &[&str]) -> Result<Self, SeriesError> {
        let header: Vec<&str> = ["step", "time"].iter().chain(names).copied().collect();
        if let Some(i) = (0..header.len()).find(|&i| header[..i].contains(&header[i])) {
            return Err(SeriesError::RepeatedName { path: path.to_owned(), name: header[i].to_owned() });
        }
        let file =
            File::create(path).map_err(|source| SeriesError::Write { path: path.to_owned(), source })?;
        let mut series = Self { path: path.to_owned(), file, names: names.len() };
        series.write_row(&header)?;
        Ok(series)
    }

    /// Appends a row and hands it to the system. The values stand in the order of the names; `NaN` and `inf` are
    /// written as such.
    ///
    /// # Errors
    /// [`SeriesError::Width`] and [`SeriesError::Write`].
    pub fn append(&mut self, step: u64, time: f64, values: &[f64]) -> Result<(), SeriesError> {
        if values.len() != self.names {
            let (path, expected, found) = (self.path.clone(), self.names, values.len());
            return Err(SeriesError::Width { path, step, expected, found });
        }
        let numbers = std::iter::once(&time).chain(values).map(|&value| shortest(value));
        let row: Vec<String> = std::iter::once(step.to_string()).chain(numbers).collect();
        self.write_row(&row)
    }

    fn write_row<T: AsRef<[u8]>>(&mut self, fields: &[T]) -> Result<(), SeriesError> {
        let mut csv = csv::Writer::from_writer(Vec::new());
        let row = csv
            .write_record(fields)
            .map_err(io::Error::from)
            .and_then(|()| csv.into_inner().map_err(|error| io::Error::other(error.to_string())));
        row.and_then(|row| self.file.write_all(&row))
            .map_err(|source| SeriesError::Write { path: self.path.clone(), source })
    }
}

/// The shortest decimal that reads back as `value`: whole numbers without a point, very small and very large ones with
/// an exponent.
fn shortest(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 { format!("{value}") } else { format!("{value:?}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn every_row_is_in_the_file_as_soon_as_it_is_appended() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("o.csv");
        let mut series = SeriesWriter::create(&path, &["energy", "a, b"]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "step,time,energy,\"a, b\"\n");
        series.append(0, 0.0, &[0.25, -3.0]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap().lines().count(), 2);
        series.append(1, 1.118_034e-5, &[1.0e22, f64::NAN]).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.ends_with("\n0,0,0.25,-3\n1,1.118034e-5,1e22,NaN\n"), "{text}");
    }

    #[test]
    fn numbers_read_back_exactly() {
        let mut bits = 1_u64;
        for _ in 0..2000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = f64::from_bits(bits);
            if value.is_finite() {
                assert_eq!(shortest(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
            }
        }
        for value in [-0.0, 315_979.0, 1e15, 0.1 + 0.2, 5e-324, f64::MAX] {
            assert_eq!(shortest(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
        assert_eq!(shortest(315_979.0), "315979");
    }

    #[test]
    fn a_row_of_the_wrong_width_is_refused_and_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("o.csv");
        let mut series = SeriesWriter::create(&path, &["energy"]).unwrap();
        let error = series.append(5, 0.1, &[1.0, 2.0]).unwrap_err();
        assert!(error.to_string().contains("2 values for 1 names"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "step,time,energy\n");
    }

    #[test]
    fn a_name_used_twice_and_a_missing_folder_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        let error = SeriesWriter::create(&folder.path().join("o.csv"), &["a", "time"]).unwrap_err();
        assert!(error.to_string().contains("the name `time` is used twice"), "{error}");
        let error = SeriesWriter::create(&folder.path().join("missing/o.csv"), &[]).unwrap_err();
        assert!(error.to_string().contains("missing/o.csv"), "{error}");
    }
}
