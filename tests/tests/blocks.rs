//! Arrays in rows that kernels go through in blocks: rows of every length around that of a block, against
//! loops on the host.

use std::error::Error;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, PRECISIONS, assert_same_runs};

type TestResult = Result<(), Box<dyn Error>>;

const LANES: usize = 3;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ring {
    values: [i32; LANES],
    marks: [bool; 2],
    parts: [Real; 2],
    sum: i32,
}

/// Neighbours that there are not.
const BEYOND: usize = 7;

/// Old values are read at the cell only, where they are replaced.
#[elementary_process]
fn turn(cell: &mut Cell<Ring>) {
    let first = cell.values[0];
    for n in 1..LANES {
        cell.values[n - 1] = cell.values[n];
    }
    cell.values[LANES - 1] = first + cell.sum;
    cell.marks[(cell.sum & 1) as usize] = first > cell.sum;
}

/// Old values are read at neighbours too; some cells keep theirs.
#[elementary_process]
fn pull(cell: &mut Cell<Ring>) {
    if cell.marks[0] {
        return;
    }
    for n in 1..cell.neighbour_count() {
        let from = cell.neighbour(n);
        cell.values[n % LANES] = cell.values[n % LANES].wrapping_add(3 * from.values[(n + 1) % LANES]);
        cell.sum += from.marks[n & 1] as i32;
    }
}

/// What is read is known before the cell is: it is asked for a block ahead, but not what no cell comes to.
#[elementary_process]
fn stream(cell: &mut Cell<Ring>) {
    for n in 0..LANES {
        let from = cell.neighbour(cell.opposite(n + 1));
        cell.values[n] = from.values[n].wrapping_sub(cell.neighbour(n).values[LANES - 1 - n]);
    }
    cell.parts = [cell.neighbour(4).parts[1], cell.neighbour(1).parts[0] + 1.0];
    if cell.sum > -1_000_000 {
        return;
    }
    for n in 0..=BEYOND {
        cell.values[0] = cell.neighbour(n - 1).values[n + BEYOND];
    }
}

fn begin(x: usize, y: usize) -> Ring {
    let number = (x * 7 + y * 13) as i32;
    Ring {
        values: [number, number % 5, -number],
        marks: [x.is_multiple_of(3), y.is_multiple_of(2)],
        parts: [f64::from(number), 0.5],
        sum: number % 4,
    }
}

/// The rows of the torus.
const ROWS: usize = 3;

/// All processes, as loops over the torus.
fn by_hand(width: usize, steps: usize) -> Vec<Ring> {
    let mut cells: Vec<Ring> = (0..ROWS * width).map(|cell| begin(cell % width, cell / width)).collect();
    for _ in 0..steps {
        for cell in &mut cells {
            let first = cell.values[0];
            cell.values.rotate_left(1);
            cell.values[LANES - 1] = first + cell.sum;
            cell.marks[(cell.sum % 2) as usize] = first > cell.sum;
        }
        let old = cells.clone();
        for (number, cell) in cells.iter_mut().enumerate().filter(|(_, cell)| !cell.marks[0]) {
            for (n, from) in around(&old, width, number).into_iter().enumerate().skip(1) {
                let value = &mut cell.values[n % LANES];
                *value = value.wrapping_add(3 * from.values[(n + 1) % LANES]);
                cell.sum += i32::from(from.marks[n % 2]);
            }
        }
        let old = cells.clone();
        for (number, cell) in cells.iter_mut().enumerate() {
            let near = around(&old, width, number);
            // The numbers of opposites add up to 5.
            cell.values =
                std::array::from_fn(|n| near[4 - n].values[n].wrapping_sub(near[n].values[LANES - 1 - n]));
            cell.parts = [near[4].parts[1], near[1].parts[0] + 1.0];
        }
    }
    cells
}

/// A cell and its neighbours: to the south, west, east and north.
fn around(cells: &[Ring], width: usize, number: usize) -> [Ring; 5] {
    let (x, y) = (number % width, number / width);
    [
        cells[number],
        cells[(y + ROWS - 1) % ROWS * width + x],
        cells[y * width + (x + width - 1) % width],
        cells[y * width + (x + 1) % width],
        cells[(y + 1) % ROWS * width + x],
    ]
}

#[test]
fn rows_of_every_length() -> TestResult {
    for width in [3, 15, 16, 17, 31, 32, 33, 63, 64, 65, 97] {
        let model = Model::builder("rings")
            .extents([width, ROWS, 1])
            .neighbourhood(Neighbourhood::von_neumann_2d(1))
            .boundary(Boundary::Toroidal)
            .substates::<Ring>()
            .process((turn, pull, stream))
            .fill(|site| begin(site.cell()[0], site.cell()[1]))
            .build()?;
        for precision in PRECISIONS {
            assert_same_runs(&model, &engines::all()?, RunOptions { precision, seed: 0 }, 3)?;
        }
        let mut simulation = Simulation::new(&model, &xca_cpu::Cpu::with_threads(2)?, RunOptions::default())?;
        simulation.run(3)?;
        let state = simulation.state();
        let (values, marks) = (state.read(Ring::VALUES)?, state.read(Ring::MARKS)?);
        let parts = state.read(Ring::PARTS)?;
        for (cell, wanted) in by_hand(width, 3).into_iter().enumerate() {
            let sum = state.get(Ring::SUM, [cell % width, cell / width, 0])?;
            assert_eq!(
                Ring { values: values[cell], marks: marks[cell], parts: parts[cell], sum },
                wanted,
                "cell {cell} of {width}"
            );
        }
    }
    Ok(())
}
