//! What the program of CADEM reads: particles from a file, openings from the command line.

use cadem::{Configuration, Face, Opening, Particle, ParticleError, Rectangle};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use xca_run::Failure;
use xca_run::io::particle_csv::{self, ColumnType};

/// The columns of a file of particles, beside the label.
pub const COLUMNS: [&str; 6] = ["x", "y", "z", "vx", "vy", "vz"];

/// A particle of a file that no run can start from.
#[derive(Debug)]
pub struct LineError {
    path: PathBuf,
    line: u64,
    other: Option<u64>,
    particle: ParticleError,
}

impl std::fmt::Display for LineError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}", self.path.display(), self.line)?;
        if let Some(other) = self.other {
            write!(f, " and line {other}")?;
        }
        write!(f, ": {}", self.particle)
    }
}

impl std::error::Error for LineError {}

/// Reads particles from a CSV file and checks that a run can start from them.
///
/// # Errors
/// With the file and the line, where the file cannot be read, is malformed, or holds a particle that does not
/// fit the system.
pub fn particles(path: &Path, configuration: &Configuration) -> Result<Vec<Particle>, Failure> {
    let table = particle_csv::read(path, &COLUMNS.map(|name| (name, ColumnType::Number)))?;
    let [x, y, z, vx, vy, vz] = [0, 1, 2, 3, 4, 5].map(|column| &table.columns[column]);
    let particles: Vec<Particle> = (0..table.labels.len())
        .map(|i| Particle {
            label: table.labels[i],
            position: [x[i], y[i], z[i]],
            velocity: [vx[i], vy[i], vz[i]],
        })
        .collect();
    configuration.check_particles(&particles).map_err(|particle| {
        let lines: HashMap<u32, u64> =
            table.labels.iter().copied().zip(table.lines.iter().copied()).collect();
        let line = |label: u32| lines.get(&label).copied().unwrap_or_default();
        let (label, other) = particle.labels();
        LineError { path: path.to_owned(), line: line(label), other: other.map(line), particle }
    })?;
    Ok(particles)
}

/// An opening from text: a face, `x-low` to `z-high`, or a rectangle of its cells from a first to a last one,
/// `z-low:8,8:11,11`.
///
/// # Errors
/// Where the text is neither.
pub fn opening(text: &str) -> Result<Opening, String> {
    let (name, cells) = text.split_once(':').map_or((text, None), |(name, cells)| (name, Some(cells)));
    let face = Face::ALL.into_iter().find(|face| face.name() == name).ok_or_else(|| {
        format!("unknown face `{name}`; the faces are {}", Face::ALL.map(Face::name).join(", "))
    })?;
    let pair = |text: &str| -> Option<[usize; 2]> {
        let (along, across) = text.split_once(',')?;
        Some([along.trim().parse().ok()?, across.trim().parse().ok()?])
    };
    let rectangle = |cells: &str| {
        let (first, last) = cells.split_once(':')?;
        Some(Rectangle { first: pair(first)?, last: pair(last)? })
    };
    let cells = cells.map(|cells| {
        let error =
            || format!("`{cells}` are no cells; give the first and the last one, such as {name}:8,8:11,11");
        rectangle(cells).ok_or_else(error)
    });
    Ok(Opening { face, cells: cells.transpose()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn openings_are_faces_or_rectangles() {
        assert_eq!(opening("x-high").unwrap(), Opening::whole(Face::XHigh));
        let cells = Rectangle { first: [8, 9], last: [11, 12] };
        assert_eq!(opening("z-low:8,9:11,12").unwrap(), Opening { face: Face::ZLow, cells: Some(cells) });
        assert!(opening("floor").unwrap_err().contains("the faces are x-low, x-high"));
        for text in ["z-low:8,9", "z-low:8:9", "z-low:", "z-low:8,9:11,-1"] {
            assert!(opening(text).unwrap_err().contains("are no cells"), "{text}");
        }
    }
}
