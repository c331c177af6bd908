//! Mistakes in the definition of a model.

use xca_process::ParameterError;
use xca_process::{Boundary, Face};

/// A mistake in the definition of a model. The message says what to change.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum ModelError {
    #[error(
        "the model `{model}` has no extents; call `.extents([x, y, z])` with the number of cells along each axis"
    )]
    NoExtents { model: String },
    #[error("the space has no cells along {axis}; each of the extents {extents:?} must be at least 1")]
    ZeroExtent { axis: char, extents: [usize; 3] },
    #[error(
        "a space of {extents:?} cells is too large: cells are numbered by 32 bits, at most {limit} can be"
    )]
    TooManyCells { extents: [usize; 3], limit: u64 },
    #[error("the cell side is {side} m; it must be a positive number")]
    CellSide { side: f64 },
    #[error(
        "{extents:?} cells of side {side} m are too long: the length overflows; give a smaller cell side"
    )]
    Length { side: f64, extents: [usize; 3] },
    #[error(
        "the {toroidal} face is toroidal and the {other} face is {boundary}: a toroidal boundary joins both faces of an axis; make both toroidal, or neither"
    )]
    HalfTorus { toroidal: Face, other: Face, boundary: Boundary },
    #[error(
        "`{substates}` has outside values for the {face} face, which is {boundary}: no cell would see them; make the face flat, or leave the values out"
    )]
    OutsideUnseen { substates: &'static str, face: Face, boundary: Boundary },
    #[error(
        "the neighbourhood ({neighbourhood}) reaches {reach} cells along {axis}, which is too far for {extent} cells with a {boundary} boundary; \
         use more cells, or a neighbourhood within one layer for a 2D model"
    )]
    NeighbourhoodTooWide {
        neighbourhood: String,
        axis: char,
        reach: usize,
        extent: usize,
        boundary: Boundary,
    },
    #[error(
        "a hexagonal neighbourhood on a torus needs an even number of cells along {axis}, not {extent}: rows alternate"
    )]
    OddHexagonalTorus { axis: char, extent: usize },
    #[error(
        "a hexagonal neighbourhood with a reflecting boundary along {axis} has no meaning: the mirror image of an even row is not an odd row"
    )]
    ReflectedHexagons { axis: char },
    #[error("the model `{model}` has no substates; call `.substates::<S>()` or `.population::<S>(slots)`")]
    NoSubstates { model: String },
    #[error(
        "the model has {processes} processes in a step, but random numbers tell {limit} apart; use fewer"
    )]
    TooManyProcesses { processes: usize, limit: usize },
    #[error("the model has {groups} structs of substates, but random numbers tell {limit} apart; use fewer")]
    TooManyGroups { groups: usize, limit: usize },
    #[error("the substates `{substates}` are given twice")]
    SubstatesTwice { substates: &'static str },
    #[error(
        "the process `{process}` works on `{substates}`, which the model does not have; add `.substates::<{substates}>()` or `.population::<{substates}>(slots)`"
    )]
    UnknownSubstates { process: &'static str, substates: &'static str },
    #[error(
        "the process `{process}` runs for cells, but `{substates}` is a population; take `me: &mut Slot<{substates}>`"
    )]
    CellsOfPopulation { process: &'static str, substates: &'static str },
    #[error(
        "the process `{process}` runs for items, but `{substates}` are the substates of cells; take `cell: &mut Cell<{substates}>`, or add them as `.population::<{substates}>(slots)`"
    )]
    ItemsOfCells { process: &'static str, substates: &'static str },
    #[error(
        "the process `{process}` takes the parameters `{wanted}`, which the model does not have (it has: {given}); call \
         `.parameters({wanted} {{ … }})`"
    )]
    Parameters { process: &'static str, wanted: &'static str, given: String },
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    #[error(
        "the process `{process}` takes `{substates}` twice; one argument is enough to read and to write it"
    )]
    ArgumentTwice { process: &'static str, substates: &'static str },
    #[error(
        "the process `{process}` writes `{substate}` and searches by it: what is near would depend on the order of items; search in one process, move in the next"
    )]
    SearchOfWritten { process: &'static str, substate: &'static str },
    #[error(
        "the process `{process}` uses `opposite`, but the neighbourhood ({neighbourhood}) lacks the displacement {missing:?}, the opposite of {displacement:?}; add it to the list"
    )]
    NoOpposite { process: &'static str, neighbourhood: String, displacement: [i32; 3], missing: [i32; 3] },
    #[error("the model `{model}` has no population `{population}`")]
    NoPopulation { model: String, population: String },
    #[error("a population has no slots; `{substates}` needs at least 1 in a cell")]
    NoSlots { substates: &'static str },
    #[error(
        "a reflecting boundary has no meaning for the items of `{substates}` at the {face} face; use a flat or toroidal one"
    )]
    ReflectedPopulation { substates: &'static str, face: Face },
    #[error(
        "`{substates}` is a population, and items have no outside values; leave out `.outside(…, {substates} {{ … }})`"
    )]
    OutsideOfItems { substates: &'static str },
    #[error("`{substates}` is not in the model; add it first")]
    NotAdded { substates: &'static str },
    #[error("`{substates}` is a population; make its items by `.populate(|site| …)`, not by `.fill`")]
    FillOfPopulation { substates: &'static str },
    #[error("`{substates}` are the substates of cells; make them by `.fill(|site| …)`, not by `.populate`")]
    PopulatedCells { substates: &'static str },
    #[error(
        "the initial state of `{substates}` takes the parameters `{wanted}`, which the model does not have (it has: {given}); call \
         `.parameters({wanted} {{ … }})`"
    )]
    InitialParameters { substates: &'static str, wanted: &'static str, given: String },
    #[error("two structs of substates are called `{name}`: `{first}` and `{second}`; rename one of them")]
    SameStructName { name: &'static str, first: &'static str, second: &'static str },
    #[error(
        "the fields `{first}` and `{second}` of `{substates}` would both be the column `{column}` in tables; rename one of them"
    )]
    SameColumn { substates: &'static str, first: &'static str, second: &'static str, column: String },
    #[error(
        "the field `label` of the population `{substates}` has the name of the label that every item has; rename it"
    )]
    FieldNamedLabel { substates: &'static str },
    #[error("the interval must be at least 1 step")]
    ZeroInterval,
    #[error("a process must run at least once in a step; leave it out instead of repeating it 0 times")]
    ZeroRepeats,
}
