//! Initial values from GeoTIFF and ESRI ASCII grids.

use crate::program::Assignment;
use std::path::PathBuf;
use std::str::FromStr;
use xca_core::InitialError;
use xca_io::map::{Map, OverlayError, Placement};
use xca_io::raster::{Raster, ReadRasterError};
use xca_record::{InputFile, SetUp};

/// A grid that a model cannot begin with.
#[derive(Debug, thiserror::Error)]
pub(super) enum GridError {
    #[error(transparent)]
    Read(#[from] ReadRasterError),
    #[error("{option} is for models of one layer, and `{model}` has {layers}")]
    Layers { option: &'static str, model: String, layers: usize },
    #[error(transparent)]
    Overlay(#[from] OverlayError),
    #[error(
        "{} has NODATA in column {}, row {} from the north, but `{substate}` needs a value; for 0 there, write \
         {substate}:0={}",
        path.display(), place[0], place[1], path.display()
    )]
    NoValue { path: PathBuf, place: [usize; 2], substate: String },
    #[error("{} does not fit the model", path.display())]
    Values { path: PathBuf, source: InitialError },
}

/// A grid that a substate begins with: `NAME=FILE`, or `NAME:VALUE=FILE` with a value for the cells where the
/// grid has none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Initial {
    substate: String,
    /// The value of cells with ground where the grid has none.
    otherwise: Option<f64>,
    path: PathBuf,
}

impl FromStr for Initial {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let form = |_| "write NAME=FILE, such as altitude=ground.asc";
        let Assignment { name, value } = text.parse().map_err(form)?;
        let (substate, otherwise) = match name.split_once(':') {
            None => (name, None),
            Some((name, number)) => {
                let number: f64 = number.trim().parse().unwrap_or(f64::NAN);
                if !number.is_finite() || name.trim().is_empty() {
                    return Err("write NAME or NAME:NUMBER before `=`, such as thickness:0=lava.asc");
                }
                (name.trim().to_owned(), Some(number))
            }
        };
        Ok(Self { substate, otherwise, path: value.into() })
    }
}

/// Refuses an option where the model has several layers.
pub(super) fn one_layer(set_up: &SetUp, option: &'static str) -> Result<(), GridError> {
    match set_up.model.geometry().extents() {
        [_, _, 1] => Ok(()),
        [_, _, layers] => Err(GridError::Layers { option, model: set_up.model.name().to_owned(), layers }),
    }
}

/// Has substates begin with the values of grids. A model without a map gets the place of the first one.
pub(super) fn apply(set_up: &mut SetUp, initial: &[Initial]) -> Result<(), GridError> {
    let mut on = "the model".to_owned();
    for Initial { substate, otherwise, path } in initial {
        one_layer(set_up, "--initial")?;
        let placement = set_up.placement();
        let grid = Raster::read_on(path, placement)?;
        // A model without a map says nothing of the corner.
        let place = |corner| Map::new(Placement { corner, ..placement });
        let map = set_up.map.clone().unwrap_or_else(|| place(grid.corner()));
        map.check(path, &grid, &on)?;
        if set_up.map.is_none() {
            on = path.display().to_string();
        }
        // The first file that names a coordinate system tells that of the map.
        let coordinate_system = map.coordinate_system().or(grid.coordinate_system()).cloned();
        let map = map.with_coordinate_system(coordinate_system);
        set_up.map = Some(map.clone());
        let mut values = Vec::new();
        for (cell, value) in grid.values().iter().enumerate() {
            let value = Some(*value).filter(|value| !value.is_nan()).or(*otherwise);
            if map.has_ground(cell) && value.is_none() {
                let (path, substate, place) = (path.clone(), substate.clone(), placement.place(cell));
                return Err(GridError::NoValue { path, place, substate });
            }
            // The model knows what stands where there is no ground.
            values.push(value.filter(|_| map.has_ground(cell)));
        }
        let unfit = |source| GridError::Values { path: path.clone(), source };
        set_up.model.set_initial(substate, values).map_err(unfit)?;
        set_up.inputs.push(InputFile::new(path));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_for_cells_without_one_stands_behind_the_name() {
        let initial = |text: &str| text.parse::<Initial>();
        let found = |substate: &str, otherwise, path: &str| {
            Ok(Initial { substate: substate.to_owned(), otherwise, path: path.into() })
        };
        assert_eq!(initial("depth=a.asc"), found("depth", None, "a.asc"));
        assert_eq!(initial("depth:0=a.asc"), found("depth", Some(0.0), "a.asc"));
        assert_eq!(initial("Pond.flow.x : -1.5 = a:0=b.asc"), found("Pond.flow.x", Some(-1.5), "a:0=b.asc"));
        for text in ["depth", "depth:=a.asc", "depth:x=a.asc", "depth:nan=a.asc", ":0=a.asc", "=a.asc"] {
            assert!(initial(text).is_err(), "{text}");
        }
    }
}
