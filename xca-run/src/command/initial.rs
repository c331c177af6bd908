//! Initial values from ESRI ASCII grids.

use crate::program::Assignment;
use std::path::PathBuf;
use xca_core::InitialError;
use xca_io::ascii_grid::{AsciiGrid, ReadGridError};
use xca_record::SetUp;

/// A grid that a model cannot begin with.
#[derive(Debug, thiserror::Error)]
pub(super) enum GridError {
    #[error(transparent)]
    Read(#[from] ReadGridError),
    #[error("{option} is for models of one layer, and `{model}` has {layers}")]
    Layers { option: &'static str, model: String, layers: usize },
    #[error("{} has {} x {} cells, and the model {} x {}", path.display(), grid[0], grid[1], model[0], model[1])]
    Extents { path: PathBuf, grid: [usize; 2], model: [usize; 2] },
    #[error("the cells of {} have a side of {grid}, and those of the model {model}", path.display())]
    Side { path: PathBuf, grid: f64, model: f64 },
    #[error("{} has no value in column {}, row {} from the north; `{substate}` needs one in every cell", path.display(), place[0], place[1])]
    Nothing { path: PathBuf, place: [usize; 2], substate: String },
    #[error("{} does not fit the model", path.display())]
    Values { path: PathBuf, source: InitialError },
}

/// Refuses an option where the model has several layers.
pub(super) fn one_layer(set_up: &SetUp, option: &'static str) -> Result<(), GridError> {
    match set_up.model.geometry().extents() {
        [_, _, 1] => Ok(()),
        [_, _, layers] => Err(GridError::Layers { option, model: set_up.model.name().to_owned(), layers }),
    }
}

/// Has substates begin with the values of grids, as `NAME=FILE` says.
pub(super) fn apply(set_up: &mut SetUp, initial: &[Assignment]) -> Result<(), GridError> {
    for Assignment { name, value: file } in initial {
        one_layer(set_up, "--initial")?;
        let path = PathBuf::from(file);
        let grid = AsciiGrid::read(&path)?;
        let [columns, rows, _] = set_up.model.geometry().extents();
        if grid.extents() != [columns, rows] {
            return Err(GridError::Extents { path, grid: grid.extents(), model: [columns, rows] });
        }
        let side = set_up.model.geometry().side();
        if grid.side() != side {
            return Err(GridError::Side { path, grid: grid.side(), model: side });
        }
        if let Some(cell) = grid.values().iter().position(|value| value.is_nan()) {
            let place = [cell % columns + 1, rows - cell / columns];
            return Err(GridError::Nothing { path, place, substate: name.clone() });
        }
        let values = grid.values().to_vec();
        set_up
            .model
            .set_initial(name, values)
            .map_err(|source| GridError::Values { path: path.clone(), source })?;
        set_up.corner.get_or_insert(grid.corner());
        set_up.inputs.push(path);
    }
    Ok(())
}
