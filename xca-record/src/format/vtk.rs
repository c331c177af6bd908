//! VTK files of each state, and the list of them that ParaView opens.

use super::{Moment, OutputFile, RecordedState, ResumedRun, SavedState, Subject, View, Writer};
use crate::failure::Failure;
use crate::record::{CellState, CellSubstate, ItemState, Unwritten, lattice};
use serde_json::Value;
use std::io::{self, Write};
use std::path::Path;
use xca_io::lattice::Lattice;
use xca_io::vtk::{
    Collection, DataArray, GHOST_TYPE, Grid, HexagonGrid, PolyDataFile, ValueSource, Values, ghost_types,
    read_dense, read_poly_data, write_dense, write_hexagons, write_particles,
};
use xca_machine::free_memory;

/// `.vti` of cells, `.vtp` of items and hexagons, and a `.pvd` for each view.
#[derive(Debug, Default)]
pub(super) struct Vtk {
    /// For each view, the list of its frames.
    collections: Vec<Collection>,
}

/// The frames of a view, and the list of them.
fn files(subject: Subject<'_>, view: View<'_>) -> [OutputFile; 2] {
    let is_image = !view.shows_items() && lattice(subject.model().geometry()) == Lattice::Squares;
    let extension = if is_image { "vti" } else { "vtp" };
    [OutputFile::of_view(Moment::Each, view, extension), OutputFile::of_view(Moment::Run, view, "pvd")]
}

impl Writer for Vtk {
    fn name(&self) -> &'static str {
        "vtk"
    }

    fn about(&self) -> &'static str {
        "all states for ParaView: NAME.pvd, frames (.vti, .vtp)"
    }

    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
        subject.views().flat_map(|view| files(subject, view)).collect()
    }

    fn record(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        for view in state.subject().views() {
            let [frame, list] = files(state.subject(), view).map(|file| state.path(&file));
            if let Some(items) = state.items(view) {
                write_items(&frame, state.time(), &items)?;
            } else if let Some(cells) = state.cells(view) {
                write_cells(&frame, state.time(), &cells)?;
            }
            if self.collections.len() <= view.number() {
                self.collections.push(Collection::create(&list)?);
            }
            self.collections[view.number()].add(state.time(), &frame)?;
        }
        Ok(())
    }

    fn resume(&mut self, run: ResumedRun<'_>, _memory: &Value) -> Result<(), Failure> {
        self.collections.clear();
        for view in run.subject().views() {
            let [frame, list] = files(run.subject(), view);
            let entry = |step: &u64| (run.subject().time(*step), run.path(&frame, *step));
            let entries: Vec<_> = run.steps().iter().map(entry).collect();
            self.collections.push(Collection::of(&run.path(&list, 0), &entries)?);
        }
        Ok(())
    }

    fn read(&self, path: &Path) -> Option<Result<SavedState, Failure>> {
        match path.extension()?.to_str()? {
            "vti" => Some(saved_cells(path)),
            "vtp" => Some(saved_poly_data(path)),
            _ => None,
        }
    }
}

fn write_cells(path: &Path, time: f64, cells: &CellState<'_>) -> Result<(), Failure> {
    let substates = cells.substates();
    let ghosts = cells.missing().map(ghost_types);
    let ghosts = ghosts.as_deref().map(|ghosts| DataArray::new(GHOST_TYPE, ghosts));
    let arrays: Vec<DataArray<'_>> = substates.iter().map(CellSubstate::array).chain(ghosts).collect();
    let (extents, side, corner) = (cells.extents(), cells.side(), cells.corner());
    let [x, y] = corner;
    match cells.lattice() {
        Lattice::Squares => {
            let grid = Grid { origin: [x, y, 0.0], ..Grid::cubic(extents, side) };
            write_dense(path, time, &grid, &arrays)?;
        }
        lattice => {
            let grid = HexagonGrid { cells: extents, lattice, corner, side };
            write_hexagons(path, time, &grid, &arrays)?;
        }
    }
    Ok(())
}

/// The substates that have columns, at their place on the map.
fn write_items(path: &Path, time: f64, items: &ItemState<'_>) -> Result<(), Failure> {
    let count = items.count()?;
    let fields = items.fields();
    let [labels, positions] = [What::Labels, What::Positions].map(|what| ItemArray { items, what });
    let sources: Vec<ItemArray<'_>> =
        fields.iter().map(|field| ItemArray { items, what: What::Values(*field) }).collect();
    items.with_none(|none| {
        let all =
            |like: Values<'_>, source| Values::of_source(like.numbers(), like.components(), count, source);
        let substates = none.substates();
        let mut arrays = vec![DataArray::new("label", all(none.labels().into(), &labels))];
        for (substate, source) in substates.iter().zip(&sources) {
            let array = substate.array();
            arrays.push(DataArray { values: all(array.values, source), ..array });
        }
        let place = none.positions_on_map();
        Ok(write_particles(path, time, all(place.as_values(), &positions), &arrays)?)
    })
}

/// An array of all items, which is made block by block.
#[derive(Debug)]
struct ItemArray<'a> {
    items: &'a ItemState<'a>,
    what: What,
}

#[derive(Debug, Clone, Copy)]
enum What {
    Labels,
    Positions,
    /// Of a substate.
    Values(usize),
}

impl ValueSource for ItemArray<'_> {
    fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        let written = self.items.blocks(|block| {
            match self.what {
                What::Labels => Values::from(block.labels()).write_to(out)?,
                What::Positions => block.positions_on_map().as_values().write_to(out)?,
                What::Values(field) => block.plane(field).as_values().write_to(out)?,
            }
            Ok::<(), Unwritten>(())
        });
        written.map_err(|Unwritten(error)| error)
    }
}

/// The most bytes of memory that the values of a file may take.
fn most() -> u64 {
    free_memory().unwrap_or(u64::MAX)
}

fn saved_cells(path: &Path) -> Result<SavedState, Failure> {
    let file = read_dense(path, most())?;
    Ok(SavedState { hidden: file.hidden, ..SavedState::of_cells(file.time, file.grid.cells, file.arrays) })
}

fn saved_poly_data(path: &Path) -> Result<SavedState, Failure> {
    Ok(match read_poly_data(path, most())? {
        PolyDataFile::Particles(file) => SavedState::of_items(file.time, file.positions, file.arrays),
        PolyDataFile::Hexagons(file) => {
            let state = SavedState::of_cells(file.time, file.grid.cells, file.arrays);
            SavedState { hidden: file.hidden, ..state }
        }
    })
}
