//! Parts that do several steps together.

use crate::borders::{Behind, Manner};
use crate::models::wood;
use crate::{TestResult, count, cpu, run};
use std::num::{NonZeroU64, NonZeroUsize};
use std::sync::Arc;
use xca_core::engine::Figure;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_parts::{Grid, Parts};

use Boundary::{Flat, Reflecting, Toroidal};

/// An engine that does so many steps together, in columns of so many rows.
fn engine(threads: usize, steps: u64, rows: usize) -> Result<Cpu, Box<dyn std::error::Error>> {
    let steps = NonZeroU64::new(steps).ok_or("no steps")?;
    let engine = cpu(threads, 0)?.with_stride(steps);
    Ok(NonZeroUsize::new(rows).map_or(engine.clone(), |rows| engine.with_columns(rows)))
}

#[test]
fn steps_together_give_the_same_bits_in_parts() -> TestResult {
    let far = Neighbourhood::custom(vec![[0, 0, 0], [3, 0, 0], [-1, 2, 0], [0, -1, 1]])?;
    let spaces = [
        ([11, 120, 1], Neighbourhood::moore_2d(1), [[2, 1], [4, 1]]),
        ([7, 161, 1], Neighbourhood::moore_2d(2), [[2, 1], [3, 1]]),
        ([6, 7, 80], Neighbourhood::moore(1), [[1, 2], [1, 3]]),
        ([5, 6, 120], Neighbourhood::von_neumann(2), [[1, 2], [1, 3]]),
        ([9, 6, 70], far, [[1, 2], [1, 3]]),
        ([13, 100, 1], Neighbourhood::hexagonal(Hexagons::CornerUp), [[2, 1], [3, 1]]),
    ];
    let boundaries = [
        Faces::all(Flat),
        Faces::all(Toroidal),
        Faces::from([Toroidal, Reflecting, Flat]),
        Faces { south: Reflecting, top: Reflecting, ..Faces::all(Flat) },
    ];
    let mut most = 0.0_f64;
    for (number, (extents, neighbourhood, cuts)) in spaces.into_iter().enumerate() {
        for (other, boundaries) in boundaries.into_iter().enumerate() {
            let reflects = Face::ALL.iter().any(|face| boundaries[*face] == Reflecting);
            if reflects && neighbourhood.parity() != xca_core::Parity::None {
                continue;
            }
            let model = wood(extents, neighbourhood.clone(), boundaries, other % 2 == 0)?;
            let wanted = run(&model, &Reference)?;
            for (turn, [y, z]) in cuts.into_iter().enumerate() {
                let steps = [2, 3, 5, 16][(number + other + turn) % 4];
                let rows = if extents[2] > 1 { [0, 2, 4][(number + turn) % 3] } else { 0 };
                let parts = Parts::with_grid(engine(1 + turn, steps, rows)?, Grid { y, z });
                let what = format!("{extents:?} {boundaries:?} {y}x{z}, {steps} steps, columns of {rows}");
                assert!(run(&model, &parts)? == wanted, "{what}");
                most = most.max(together(&model, &parts)?);
            }
        }
    }
    assert!(most > 2.0, "{most}");
    Ok(())
}

/// The mean number of steps that the first part does together.
fn together(model: &Model, engine: &dyn Engine) -> Result<f64, Box<dyn std::error::Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions::default())?;
    simulation.run(40)?;
    let figures: Vec<Figure> = simulation.figures();
    let figure = figures.iter().find(|figure| figure.name == "part_0_steps_together");
    Ok(figure.map_or(1.0, |figure| figure.value))
}

/// Each part chooses the number by its own times.
#[test]
fn parts_need_not_do_the_same_number_of_steps_together() -> TestResult {
    let model = wood([9, 180, 1], Neighbourhood::moore_2d(1), Faces::all(Toroidal), true)?;
    let wanted = run(&model, &Reference)?;
    for steps in [[1, 3, 4], [5, 2, 1], [16, 1, 2]] {
        let engines: Vec<Arc<dyn Engine>> = steps
            .into_iter()
            .map(|steps| Ok(Arc::new(engine(1, steps, 0)?) as Arc<dyn Engine>))
            .collect::<Result<_, Box<dyn std::error::Error>>>()?;
        assert!(run(&model, &Parts::with_engines(engines))? == wanted, "{steps:?}");
    }
    let late = Behind { engine: engine(2, 4, 0)?, manner: Manner::Late };
    assert!(run(&model, &Parts::new(late, count(3)?))? == wanted);
    Ok(())
}
