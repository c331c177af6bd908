//! Elementary cellular automata (Wolfram, Reviews of Modern Physics 55, 1983): a row of cells that are on or
//! off.

use xca_core::prelude::*;

/// A cell of the row.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Row {
    /// Whether it is on.
    pub on: bool,
}

/// Which of the 256 automata it is.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Rule {
    /// Bit k says what three cells become that read k as a binary number.
    pub number: u8,
}

/// The cell itself, its neighbour at the left and that at the right.
const NEIGHBOURS: [[i32; 3]; 3] = [[0, 0, 0], [-1, 0, 0], [1, 0, 0]];

/// Three cells say what the middle one becomes.
#[elementary_process]
pub fn apply(cell: &mut Cell<Row>, rule: &Rule) {
    let (left, right) = (cell.neighbour(1).on, cell.neighbour(2).on);
    let pattern = 4 * (left as u32) + 2 * (cell.on as u32) + right as u32;
    cell.on = (rule.number as u32 >> pattern & 1) == 1;
}

/// So many cells on a ring, which the function fills.
///
/// # Errors
/// Where there are fewer than 3 cells.
pub fn model(
    width: usize,
    rule: u8,
    begin: impl Fn(usize) -> bool + Send + Sync + 'static,
) -> Result<Model, Box<dyn std::error::Error + Send + Sync>> {
    let model = Model::builder("elementary automaton")
        .extents([width, 1, 1])
        .neighbourhood(Neighbourhood::custom(NEIGHBOURS.to_vec())?)
        .boundaries([Boundary::Toroidal, Boundary::Flat, Boundary::Flat])
        .substates::<Row>()
        .parameters(Rule { number: rule })
        .process(apply)
        .fill(move |site| Row { on: begin(site.cell()[0]) })
        .build()?;
    Ok(model)
}
