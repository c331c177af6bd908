//! Basic tests against the reference engine, and guarantees beyond equal bits. The workspace member `tests`
//! has the suites for all engines.

use std::error::Error;
use xca_core::prelude::*;
use xca_cpu::{Cpu, CpuError};

type TestResult = Result<(), Box<dyn Error>>;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Walker {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    seen: u32,
}

#[elementary_process]
fn avoid(me: &mut Slot<Walker>) {
    for other in me.others_within(0.75) {
        me.seen = me.seen.wrapping_mul(31).wrapping_add(other.label());
        me.velocity += 0.01 * (me.position - other.position);
    }
}

#[elementary_process]
fn walk(me: &mut Slot<Walker>) {
    me.velocity += Vector3::new(me.random(0) - 0.5, me.random(1) - 0.5, me.random(2) - 0.5) * 0.1;
    me.position += me.velocity * 0.2;
}

#[migration]
fn settle(me: &Slot<Walker>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// `count` walkers, spread over a box of 7 by 6 by 5 cells.
fn walkers(count: u32, slots: usize) -> Result<Model, ModelError> {
    Model::builder("walkers")
        .extents([7, 6, 5])
        .neighbourhood(Neighbourhood::moore(1))
        .population::<Walker>(slots)
        .items_may_leave::<Walker>()
        .process(avoid)
        .process(walk)
        .process(settle)
        .initialise(move |state| {
            let item = |label: u32| {
                let cell = [label % 7, label / 7 % 6, label / 42 % 5];
                let [x, y, z] = cell.map(|index| f64::from(index) + f64::from(label * 7919 % 97) / 97.0);
                let position = Vector3::new(x, y, z);
                let state = Walker { position, velocity: Vector3::splat(0.0), seen: 0 };
                Item { label, cell: cell.map(|index| index as usize), state }
            };
            Ok(state.set_items((0..count).map(item).collect())?)
        })
        .build()
}

#[test]
fn same_bits_as_the_reference() -> TestResult {
    let model = walkers(300, 20)?;
    for precision in [Precision::F32, Precision::F64] {
        let options = RunOptions { precision, seed: 3 };
        for threads in [1, 2, 3] {
            let mut reference = Simulation::new(&model, &Reference, options)?;
            let mut parallel = Simulation::new(&model, &Cpu::with_threads(threads)?, options)?;
            for step in 0..40 {
                assert!(
                    reference.snapshot()? == parallel.snapshot()?,
                    "step {step}, {threads} threads, {precision}"
                );
                reference.step()?;
                parallel.step()?;
            }
            assert!(parallel.state().count_left::<Walker>()? > 0);
        }
    }
    Ok(())
}

#[test]
fn as_many_threads_as_wanted() -> TestResult {
    assert_eq!(Cpu::with_threads(5)?.threads(), 5);
    assert!(Cpu::new()?.threads() >= 1);
    let none = Cpu::with_threads(0);
    assert!(matches!(none, Err(CpuError::NoThreads)), "{none:?}");
    Ok(())
}

/// Slots are a limit and take no memory. Only items do.
#[test]
fn memory_grows_with_the_items() -> TestResult {
    let engine = Cpu::with_threads(1)?;
    let memory = |count, slots| -> Result<usize, Box<dyn Error>> {
        Ok(Simulation::new(&walkers(count, slots)?, &engine, RunOptions::default())?.memory())
    };
    assert_eq!(memory(100, 10)?, memory(100, 100_000)?);
    let more = memory(2000, 100)? - memory(100, 100)?;
    // At least the substates and the label of each item, and at most twice that.
    let item = size_of::<Vector3<f64>>() * 2 + size_of::<u32>() * 2;
    assert!((1900 * item..=2 * 1900 * item).contains(&more), "{more} bytes for 1900 items of {item}");
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Site {
    level: Real,
    flow: Vector3<Real>,
}

#[elementary_process]
fn spread(cell: &mut Cell<Site>) {
    cell.level += cell.neighbour(1).level;
}

/// The announced memory is the actual one, except for a page for each of at most three buffers, and a few
/// bytes.
#[test]
fn memory_is_announced() -> TestResult {
    let cells = Model::builder("cells")
        .extents([40, 30, 20])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .substates::<Site>()
        .process(spread)
        .build()?;
    let engines: [Box<dyn Engine>; 2] = [Box::new(Reference), Box::new(Cpu::with_threads(1)?)];
    for engine in engines {
        for precision in [Precision::F32, Precision::F64] {
            for model in [&cells, &walkers(0, 3)?] {
                let announced = engine.least_memory(model, precision);
                let taken =
                    Simulation::new(model, &*engine, RunOptions { precision, seed: 0 })?.memory() as u128;
                let place = format!("{} on {engine:?} in {precision}", model.name());
                assert!(announced > 1000 && announced <= taken, "{place}: {announced}, not {taken}");
                assert!(taken < announced + 3 * 4096 + 200, "{place}: {announced}, not {taken}");
            }
        }
    }
    Ok(())
}
