//! Items read back from the table that a run has left.

use crate::record::column_type;
use crate::view::TableColumn;
use std::path::Path;
use xca_core::{HostScalar, Precision, StoredScalar, Substates};
use xca_io::particle_csv::{self, ReadError};

/// An item of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadItem<S> {
    /// Its label.
    pub label: u32,
    /// Its state, with every type as the model has it.
    pub state: S,
    /// The line of the file that it stands on, from 1, for messages.
    pub line: u64,
}

/// Reads the items of a table with a column for each component of each substate of `S`, such as the
/// `final.csv` of a run whose view names no columns: `label,x,y,z,velocity_x,…,state,ages_0,…`. States are
/// given by name, `bool` as `true` or `false`.
///
/// # Errors
/// [`ReadError`] with the path, the line and the column.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let temporary = tempfile::tempdir()?;
/// # let path = temporary.path().join("final.csv");
/// use xca_core::prelude::*;
///
/// #[derive(States, Clone, Copy, Debug, PartialEq)]
/// enum Phase {
///     Solid,
///     Liquid,
/// }
///
/// #[derive(Substates, Clone, Debug, PartialEq)]
/// struct Drop {
///     phase: Phase,
///     ages: [u32; 2],
/// }
///
/// std::fs::write(&path, "label,phase,ages_0,ages_1\n7,Liquid,3,40\n")?;
/// let items = xca_record::read_items::<Drop>(&path)?;
/// assert_eq!(items[0].state, Drop { phase: Phase::Liquid, ages: [3, 40] });
///
/// std::fs::write(&path, "label,phase,ages_0,ages_1\n7,Liquid,3,40\n8,Gas,0,0\n")?;
/// let error = xca_record::read_items::<Drop>(&path).unwrap_err().to_string();
/// assert!(error.ends_with("final.csv:3: `Gas` in column `phase` must be a Phase: Solid, Liquid"),
/// "{error}");
/// # Ok(())
/// # }
/// ```
pub fn read_items<S: Substates>(path: &Path) -> Result<Vec<ReadItem<S>>, ReadError> {
    let fields = S::SCHEMA.fields;
    let columns = TableColumn::all(S::SCHEMA);
    let wanted: Vec<_> = columns
        .iter()
        .map(|column| (column.header.as_str(), column_type(fields[column.field].value_type.scalar)))
        .collect();
    let table = particle_csv::read(path, &wanted)?;
    let item = |row: usize| {
        let mut bytes: Vec<Vec<u8>> = vec![Vec::new(); fields.len()];
        for (column, values) in columns.iter().zip(&table.columns) {
            let stored = fields[column.field].value_type.stored(Precision::F64).scalar;
            bytes[column.field].extend(encoded(values[row], stored));
        }
        let state = S::decode(Precision::F64, |field| &bytes[field]);
        ReadItem { label: table.labels[row], state, line: table.lines[row] }
    };
    Ok((0..table.labels.len()).map(item).collect())
}

/// A number that fits the type, as it is stored.
fn encoded(number: f64, stored: StoredScalar) -> Vec<u8> {
    let mut bytes = vec![0; stored.size()];
    match stored {
        StoredScalar::U8 => (number as u8).encode(stored, &mut bytes),
        StoredScalar::I32 => (number as i32).encode(stored, &mut bytes),
        StoredScalar::U32 => (number as u32).encode(stored, &mut bytes),
        StoredScalar::F32 => (number as f32).encode(stored, &mut bytes),
        StoredScalar::F64 => number.encode(stored, &mut bytes),
    }
    bytes
}
