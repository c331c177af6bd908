//! Results are the same with all instruction sets. The reference engine gives the expected results.
//!
//! The file has a single test, because the instruction set is that of the whole process.

use std::error::Error;
use xca_core::kernel::Instructions;
use xca_core::prelude::*;
use xca_cpu::Cpu;

/// Values of all sizes, in whole registers and in parts of them.
#[derive(Substates, Clone, Copy, PartialEq, Debug)]
struct Site {
    warmth: Real,
    kind: u8,
    count: u32,
    flows: [Real; 3],
}

#[elementary_process]
fn flow(cell: &mut Cell<Site>) {
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        let difference = cell.neighbour(n).warmth - cell.warmth;
        if difference > 0.25 {
            sum += difference / 3.0;
        }
        cell.count += (cell.neighbour(n).kind > cell.kind) as u32;
    }
    for k in 0..3 {
        cell.flows[k] = cell.flows[k] * 0.5 + sum.sqrt() * cell.warmth.exp();
    }
    cell.warmth += 0.1 * sum - 0.01 * cell.random(0) * cell.flows[1].sin();
    cell.kind = if cell.count % 5 == 0 { cell.kind / 2 + 3 } else { cell.kind ^ 1 };
}

#[derive(Substates, Clone, Copy)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    push: Vector3<Real>,
    crowd: Real,
}

/// Grains push each other apart.
#[elementary_process]
fn repel(grain: &mut Slot<Grain>) {
    let mut push = Vector3::splat(0.0);
    for other in grain.others_within(0.9) {
        let away = grain.position - other.position;
        push += away * (0.9 - away.length());
    }
    grain.push = push;
}

/// Grains count those around them, many pairs at a time.
#[elementary_process]
fn look_around(grain: &mut Slot<Grain>) {
    for other in grain.others_in_neighbours_within(0.9) {
        grain.crowd += 1.0 / (0.1 + (grain.position - other.position).length()).sqrt();
    }
}

#[elementary_process]
fn go(grain: &mut Slot<Grain>) {
    grain.position += 0.05 * grain.push;
}

#[migration]
fn settle(grain: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(grain.position)
}

fn model(extents: [usize; 3]) -> Result<Model, ModelError> {
    Model::builder("instructions")
        .extents(extents)
        .neighbourhood(Neighbourhood::moore(1))
        .substates::<Site>()
        .population::<Grain>(24)
        .items_may_leave::<Grain>()
        .process((flow, repel, look_around, go, settle))
        .fill(|site| {
            let kind = (site.cell().iter().sum::<usize>() % 7) as u8;
            Site { warmth: site.random(0), kind, count: 0, flows: [site.random(1); 3] }
        })
        .populate(|site| {
            let number = site.cell().iter().sum::<usize>() % 4;
            let grain = |number: usize| {
                let offset = |axis: usize| site.random(3 * number + axis) - 0.5;
                let position = site.centre() + Vector3::new(offset(0), offset(1), offset(2));
                Grain { position, push: Vector3::splat(0.0), crowd: 0.0 }
            };
            (0..number).map(grain).collect::<Vec<_>>()
        })
        .build()
}

#[test]
fn no_instructions_change_a_bit() -> Result<(), Box<dyn Error>> {
    let mut used = Vec::new();
    // Rows shorter and longer than registers, aligned and not.
    for extents in [[5, 4, 3], [37, 3, 2], [130, 4, 2]] {
        let model = model(extents)?;
        for precision in [Precision::F32, Precision::F64] {
            let options = RunOptions { precision, seed: 5 };
            let mut wanted = Simulation::new(&model, &Reference, options)?;
            wanted.run(12)?;
            for limit in [Instructions::Plain, Instructions::Avx2, Instructions::Avx512] {
                let set = limit.limit();
                used.push(set);
                let mut simulation = Simulation::new(&model, &Cpu::with_threads(2)?, options)?;
                simulation.run(12)?;
                assert!(simulation.snapshot()? == wanted.snapshot()?, "{extents:?} {precision} {set:?}");
            }
        }
    }
    assert!(used.contains(&Instructions::Plain));
    Ok(())
}
