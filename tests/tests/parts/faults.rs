//! Faults of parts that have run ahead of each other.

use crate::borders::{Behind, Manner};
use crate::{TestResult, count, cpu};
use std::error::Error;
use std::num::NonZeroU64;
use xca_core::prelude::*;
use xca_parts::Parts;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Charge {
    /// The number of steps to the fault. 0 for none.
    fuse: u32,
    heat: u32,
}

/// Also reads neighbours, so parts exchange edges in each step.
#[elementary_process]
fn spread(charge: &mut Cell<Charge>) {
    let mut heat = charge.heat;
    for n in 1..charge.neighbour_count() {
        heat = heat.wrapping_mul(31).wrapping_add(charge.neighbour(n).heat);
    }
    charge.heat = heat;
}

#[elementary_process]
fn burn(charge: &mut Cell<Charge>) {
    if charge.fuse == 1 {
        charge.fault(3, charge.heat as Real);
    }
    if charge.fuse > 1 {
        charge.fuse -= 1;
    }
}

const EXTENTS: [usize; 3] = [4, 12 * APART, 1];

/// Room for steps together.
const APART: usize = 4;

/// A row out of every fourth, and the number of steps to its fault.
type Fuse = (usize, u32);

fn model(boundary: Boundary, fuses: &'static [Fuse]) -> Result<Model, ModelError> {
    Model::builder("charges")
        .extents(EXTENTS)
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(boundary)
        .substates::<Charge>()
        .process((spread, burn))
        .fault_text(3, "it burns")
        .fill(|site| {
            let [x, y, _] = site.cell();
            let here = fuses.iter().find(|(row, _)| x == 1 && *row * APART == y);
            Charge { fuse: here.map_or(0, |(_, steps)| *steps), heat: (7 * x + 13 * y) as u32 }
        })
        .build()
}

const CASES: [&[Fuse]; 7] = [
    &[(0, 3)],
    &[(11, 16)],
    &[(5, 17), (0, 17)],
    // The later fault is seen first by the parts beside it.
    &[(0, 14), (11, 11)],
    &[(0, 20), (6, 19), (11, 21)],
    &[(2, 33), (3, 32), (9, 32)],
    &[(11, 5), (0, 6), (4, 7)],
];

/// A run with a fault, a second one from its beginning without faults, and a third one with them.
fn outcome(model: &Model, engine: &dyn Engine) -> Result<[String; 3], Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions::default())?;
    let first = simulation.snapshot()?;
    let fault = simulation.run(60).expect_err("a charge burns");
    simulation.restore(&first)?;
    simulation.state().write(Charge::FUSE, &[0; EXTENTS[0] * EXTENTS[1]])?;
    simulation.run(40)?;
    let heat = simulation.state().read(Charge::HEAT)?;
    simulation.restore(&first)?;
    simulation.run(2)?;
    let again = simulation.run(60).expect_err("a charge burns");
    Ok([format!("{fault:?}"), format!("{heat:?}"), format!("{again:?}")])
}

/// Parts compare their faults every 16 steps. Until then, parts far from a fault run on, and others wait for
/// messages that never come. The message and the step are those of the first fault, and nothing of the time
/// after it is left over for later steps.
#[test]
fn the_first_fault_of_parts_far_from_each_other() -> TestResult {
    for (number, fuses) in CASES.into_iter().enumerate() {
        for boundary in [Boundary::Flat, Boundary::Toroidal] {
            let model = model(boundary, fuses)?;
            let wanted = outcome(&model, &Reference)?;
            for parts in [2, 3, 6, 12] {
                let engine = cpu(1, number % 3)?;
                let late = Behind { engine: engine.clone(), manner: Manner::Late };
                let together = cpu(1, 0)?.with_stride(NonZeroU64::MIN.saturating_add(1 + number as u64));
                for parts in [
                    Parts::new(engine, count(parts)?),
                    Parts::new(late, count(parts)?),
                    Parts::new(together, count(parts)?),
                ] {
                    assert_eq!(outcome(&model, &parts)?, wanted, "{fuses:?} {boundary} {parts:?}");
                }
            }
        }
    }
    Ok(())
}

/// The same on GPUs.
#[test]
fn the_first_fault_of_parts_on_gpus() -> TestResult {
    let gpu = xca_tests::suite::engines::gpu()?;
    for fuses in CASES {
        let model = model(Boundary::Toroidal, fuses)?;
        let wanted = outcome(&model, &Reference)?;
        for parts in [2, 3] {
            let parts = Parts::new(gpu.clone(), count(parts)?);
            assert_eq!(outcome(&model, &parts)?, wanted, "{fuses:?} {parts:?}");
        }
    }
    Ok(())
}
