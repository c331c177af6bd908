//! Elementary cellular automata (Wolfram, Reviews of Modern Physics 55, 1983) as a picture of space
//! and time: row t from the top is step t.

use xca_core::prelude::*;

/// All rows.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Row {
    /// Whether the cell is on.
    pub on: bool,
}

/// Which of the 256 automata it is.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Rule {
    /// Bit k says what three cells become that read k as a binary number.
    pub number: u8,
}

/// The neighbours above: at the left, in the middle, at the right.
const ABOVE: [[i32; 3]; 4] = [[0, 0, 0], [-1, 1, 0], [0, 1, 0], [1, 1, 0]];

/// Each step makes the next row from the one above it.
#[elementary_process]
pub fn next_row(cell: &mut Cell<Row>, rule: &Rule, space: &Space) {
    if cell.index().y == space.extents().y - 2 - space.step() as i32 {
        let mut pattern = 0;
        for n in 1..cell.neighbour_count() {
            pattern = 2 * pattern + cell.neighbour(n).on as u32;
        }
        cell.on = (rule.number as u32 >> pattern & 1) == 1;
    }
}

/// So many cells on a ring, for as many steps as there are rows below the first, which the function fills.
///
/// # Errors
/// Where there are fewer than 3 cells or 2 rows.
pub fn model(
    width: usize,
    rows: usize,
    rule: u8,
    begin: impl Fn(usize) -> bool + Send + Sync + 'static,
) -> Result<Model, Box<dyn std::error::Error + Send + Sync>> {
    let model = Model::builder("elementary automaton")
        .extents([width, rows, 1])
        .neighbourhood(Neighbourhood::custom(ABOVE.to_vec())?)
        .boundaries([Boundary::Toroidal, Boundary::Flat, Boundary::Flat])
        .substates::<Row>()
        .parameters(Rule { number: rule })
        .process(next_row)
        .fill(move |site| Row { on: site.cell()[1] == rows - 1 && begin(site.cell()[0]) })
        .build()?;
    Ok(model)
}
