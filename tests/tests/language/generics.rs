//! Processes and helpers that are generic in constants.

use crate::{TestResult, on_all_engines};
use xca_core::ElementaryProcess;
use xca_core::prelude::*;
use xca_tests::suite::engines::PRECISIONS;

const SMALL: usize = 3;

/// Which cells the debris leaves for: the minimisation of differences of Di Gregorio and Serra.
#[helper]
fn minimise<const N: usize>(heights: [i32; N]) -> [bool; N] {
    let mut takes = [true; N];
    let mut changed = true;
    while changed {
        changed = false;
        let (mut sum, mut count) = (0, 0);
        for i in 0..N {
            if takes[i] {
                sum += heights[i];
                count += 1;
            }
        }
        for i in 0..heights.len() {
            if takes[i] && heights[i] * count > sum {
                takes[i] = false;
                changed = true;
            }
        }
    }
    takes
}

#[helper]
fn chosen<const N: usize, const WEIGHT: i32, const TWICE: bool>(heights: [i32; N]) -> i32 {
    let mut sum = N as i32;
    let takes = minimise::<N>(heights);
    for i in 0..N {
        sum = 3 * sum + if takes[i] { WEIGHT } else { heights[i] };
    }
    if TWICE { 2 * sum } else { sum }
}

#[helper]
fn all(n: i32) -> i32 {
    let few = chosen::<SMALL, 5, false>([n, 4, 9 - n]);
    let many = chosen::<5, -1, true>([n, n * n, 7, 11 - n, 2]);
    few + 100 * many + chosen::<5, 5, true>([1, n, 3, n, 5])
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Board {
    all: i32,
    value: Real,
}

/// One half of a step of a relaxation on a checkerboard.
#[elementary_process]
fn relax<const COLOUR: i32>(cell: &mut Cell<Board>) {
    cell.all = all(cell.index().x);
    if (cell.index().x + cell.index().y) % 2 == COLOUR {
        let mut sum = 0.0;
        for n in 1..cell.neighbour_count() {
            sum += cell.neighbour(n).value;
        }
        cell.value = 0.25 * sum + COLOUR as Real;
    }
}

#[test]
fn one_process_for_both_colours() -> TestResult {
    let model = Model::builder("checkerboard")
        .extents([8, 6, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Board>()
        .process(relax::<0>)
        .process(relax::<1>)
        .fill(|site| {
            let [x, y, _] = site.cell();
            Board { all: 0, value: ((5 * x + 3 * y) % 8) as f64 }
        })
        .build()?;
    assert_eq!(relax::<1>::process().name, "relax<1>");
    for precision in PRECISIONS {
        on_all_engines(&model, precision, |simulation| {
            let mut board: Vec<f64> = (0..48).map(|i| ((5 * (i % 8) + 3 * (i / 8)) % 8) as f64).collect();
            for colour in [0, 1] {
                let before = board.clone();
                for (x, y) in (0..8).flat_map(|x| (0..6).map(move |y| (x, y))) {
                    if (x + y) % 2 == colour {
                        let at = |x: usize, y: usize| before[(x % 8) + 8 * (y % 6)];
                        let sum = at(x, y + 5) + at(x + 7, y) + at(x + 1, y) + at(x, y + 1);
                        board[x + 8 * y] = 0.25 * sum + colour as f64;
                    }
                }
            }
            let state = simulation.state();
            assert_eq!(state.read(Board::VALUE)?, board);
            for x in 0..8 {
                assert_eq!(state.get(Board::ALL, [x, 0, 0])?, all(x as i32));
            }
            Ok(())
        })?;
    }
    Ok(())
}
