//! The engines that every suite runs on, and how their runs are compared.

use std::error::Error;
use std::fmt::Debug;
use std::num::{NonZeroU64, NonZeroUsize};
use xca_core::{
    Engine, Fault, GroupSnapshot, Model, Precision, Reference, RunError, RunOptions, Simulation, Snapshot,
    State, StoredScalar,
};
use xca_cpu::Cpu;
use xca_gpu::{Arithmetic, Gpu, GpuError, GpuOptions};
use xca_parts::Parts;

/// The thread counts of the parallel engine that must make no difference.
pub const THREADS: [usize; 4] = [1, 2, 3, 8];

/// How much further than a search its lists reach, in radii, for each of the thread counts: what the engine
/// finds best, next to nothing, as is common, and more than there is room for. It must make no difference
/// either.
pub const SKINS: [Option<f64>; 4] = [None, Some(1e-3), Some(0.3), Some(1e9)];

/// The cells of a piece that is left out where nothing can change, for each of the thread counts: what the
/// engine finds best, a single cell, an odd number, and more than most rows have.
pub const TILES: [Option<NonZeroUsize>; 4] =
    [None, NonZeroUsize::new(1), NonZeroUsize::new(3), NonZeroUsize::new(1000)];

/// Steps that are done together where there is room, in columns of so many rows, and how many threads do so.
/// It must make no difference either.
pub const STRIDES: [(Option<NonZeroU64>, Option<NonZeroUsize>, usize); 2] =
    [(NonZeroU64::new(2), NonZeroUsize::new(1), 1), (NonZeroU64::new(7), NonZeroUsize::new(4), 3)];

/// Numbers of parts of the space that must make no difference; fewer where the space is too small.
pub const PARTS: [usize; 3] = [2, 3, 7];

/// Both precisions.
pub const PRECISIONS: [Precision; 2] = [Precision::F32, Precision::F64];

/// Of so many cases the GPU engine takes part in one: a driver compiles each model anew, which takes far
/// longer than to run it. Odd, so that both precisions take turns.
pub const GPU_SHARE: usize = 9;

/// The same where there are thousands of cases.
pub const SMALL_GPU_SHARE: usize = 101;

/// Of so many cases one runs in parts too: they start many threads. Odd, as above.
const PARTS_SHARE: usize = 7;

/// The engines for the case with this number: all, those on processors, or those that run the space as a
/// whole.
pub fn for_case(engines: &[Box<dyn Engine>], number: usize, share: usize) -> &[Box<dyn Engine>] {
    if number.is_multiple_of(share) {
        return engines;
    }
    let on_processors = on_processors(engines);
    let parts = if number.is_multiple_of(PARTS_SHARE) { 0 } else { PARTS.len() };
    &on_processors[..on_processors.len() - parts]
}

/// The engines without the GPU's.
pub fn on_processors(engines: &[Box<dyn Engine>]) -> &[Box<dyn Engine>] {
    &engines[..engines.len() - 1]
}

/// A snapshot in which each float that is no number has the same bits: which ones an operation gives is
/// nowhere defined, and processors and graphics drivers differ.
pub fn with_one_nan(model: &Model, precision: Precision, mut snapshot: Snapshot) -> Snapshot {
    for (group, state) in model.groups().iter().zip(&mut snapshot.groups) {
        let fields = match state {
            GroupSnapshot::Cells(fields) => fields,
            GroupSnapshot::Population(population, _) => &mut population.fields,
        };
        for (stored, bytes) in group.stored(precision).iter().zip(fields) {
            match stored.scalar {
                StoredScalar::F32 => {
                    let (values, _) = bytes.as_chunks_mut();
                    let nans = values.iter_mut().filter(|value| f32::from_ne_bytes(**value).is_nan());
                    nans.for_each(|value| *value = f32::NAN.to_ne_bytes());
                }
                StoredScalar::F64 => {
                    let (values, _) = bytes.as_chunks_mut();
                    let nans = values.iter_mut().filter(|value| f64::from_ne_bytes(**value).is_nan());
                    nans.for_each(|value| *value = f64::NAN.to_ne_bytes());
                }
                _ => {}
            }
        }
    }
    snapshot
}

/// Every engine, the oracle first and the GPU last.
///
/// # Errors
/// Where an engine cannot be made.
pub fn all() -> Result<Vec<Box<dyn Engine>>, Box<dyn Error>> {
    let mut engines: Vec<Box<dyn Engine>> = vec![Box::new(Reference)];
    for (threads, (skin, tile)) in THREADS.into_iter().zip(SKINS.into_iter().zip(TILES)) {
        let mut engine = Cpu::with_threads(threads)?;
        if let Some(radii) = skin {
            engine = engine.with_skin(radii);
        }
        if let Some(cells) = tile {
            engine = engine.with_tiles(cells);
        }
        engines.push(Box::new(engine));
    }
    for (steps, rows, threads) in STRIDES {
        let (steps, rows) = steps.zip(rows).ok_or("no steps or no rows")?;
        let engine = Cpu::with_threads(threads)?.without_tiles();
        engines.push(Box::new(engine.with_stride(steps).with_columns(rows)));
    }
    for (number, (parts, tile)) in PARTS.into_iter().zip(TILES).enumerate() {
        let mut engine = Cpu::with_threads(1 + number)?;
        if let Some(cells) = tile {
            engine = engine.with_tiles(cells);
        }
        engines.push(Box::new(Parts::at_most(engine, NonZeroUsize::new(parts).ok_or("no parts")?)));
    }
    engines.push(Box::new(gpu()?));
    Ok(engines)
}

/// The GPU engine, which must be strict.
///
/// # Errors
/// Where this machine has no adapter with strict arithmetic.
pub fn gpu() -> Result<Gpu, GpuError> {
    Gpu::new(&GpuOptions { arithmetic: Arithmetic::Strict, ..GpuOptions::default() })
}

/// The name of an engine with its number of threads, for messages.
pub fn describe(engine: &dyn Engine) -> String {
    let parts = engine.facts().into_iter().find(|(name, _)| *name == "parts");
    let parts = parts.map(|(_, parts)| format!(", parts: {parts}")).unwrap_or_default();
    format!("{} with {} threads{parts}", engine.name(), engine.threads())
}

/// Runs a model on each engine and demands that all agree with the first to the last bit, after every step,
/// in a run of all steps at once, and in a run that goes on from a snapshot of the first. Where the first
/// stops with an error, the others must stop in the same step with the same one; that error is the result.
///
/// # Errors
/// What the run ends with on all engines.
///
/// # Panics
/// Where two engines differ.
pub fn assert_same_runs(
    model: &Model,
    engines: &[Box<dyn Engine>],
    options: RunOptions,
    steps: u64,
) -> Result<(), RunError> {
    let Some((oracle, others)) = engines.split_first() else { return Ok(()) };
    let mut first = Simulation::new(model, &**oracle, options)?;
    let mut rest: Vec<Simulation> =
        others.iter().map(|engine| Simulation::new(model, &**engine, options)).collect::<Result<_, _>>()?;
    let mut halfway = None;
    for step in 0..=steps {
        let outcome = if step == 0 { Ok(()) } else { first.step() };
        let snapshot = first.snapshot()?;
        if step == steps / 2 {
            halfway = Some(snapshot.clone());
        }
        for (engine, simulation) in others.iter().zip(&mut rest) {
            let other = if step == 0 { Ok(()) } else { simulation.step() };
            let place = || format!("step {step} of `{}` on {}", model.name(), describe(&**engine));
            assert_eq!(outcome_text(&outcome), outcome_text(&other), "{}", place());
            if outcome.is_ok() {
                assert_same_state(&snapshot, &simulation.snapshot()?, &place);
            }
        }
        outcome?;
    }
    let snapshot = first.snapshot()?;
    for engine in others {
        let place = || format!("all steps of `{}` at once on {}", model.name(), describe(&**engine));
        let mut at_once = Simulation::new(model, &**engine, options)?;
        at_once.run(steps)?;
        assert_same_state(&snapshot, &at_once.snapshot()?, &place);
    }
    let Some(halfway) = &halfway else { return Ok(()) };
    for engine in engines {
        let place =
            || format!("`{}` resumed after step {} on {}", model.name(), halfway.step, describe(&**engine));
        let mut resumed = Simulation::resume(model, &**engine, options, halfway)?;
        assert_same_state(halfway, &resumed.snapshot()?, &place);
        resumed.run(steps - halfway.step)?;
        assert_same_state(&snapshot, &resumed.snapshot()?, &place);
    }
    Ok(())
}

/// Runs a model that must stop with a fault: in the same way on every engine, after which none goes on.
///
/// # Panics
/// Where it does not stop, or not in the same way, or where an engine goes on.
pub fn assert_same_fault(
    model: &Model,
    engines: &[Box<dyn Engine>],
    options: RunOptions,
    steps: u64,
) -> RunError {
    let Err(error) = assert_same_runs(model, engines, options, steps) else {
        panic!("`{}` does not stop with a fault", model.name());
    };
    let RunError::Fault { step: broken, .. } = &error else { return error };
    for engine in engines {
        let name = describe(&**engine);
        let Ok(mut simulation) = Simulation::new(model, &**engine, options) else { continue };
        assert_eq!(outcome_text(&simulation.run(steps).map(|_| ())), error_text(&error), "{name}");
        for outcome in [simulation.step(), simulation.run(1).map(|_| ()), simulation.run_process(0)] {
            assert!(matches!(outcome, Err(RunError::Broken { step }) if step == *broken), "{name} goes on");
        }
    }
    error
}

/// Demands that two states are the same to the last bit.
///
/// # Panics
/// Where they are not, with the place and what differs.
pub fn assert_same_state(wanted: &Snapshot, found: &Snapshot, place: &dyn Fn() -> String) {
    assert_eq!(wanted.step, found.step, "{}: the number of steps", place());
    assert_eq!(wanted.parameters, found.parameters, "{}: the parameters", place());
    assert_eq!(wanted.stop, found.stop, "{}: the reason to stop", place());
    for (group, (wanted, found)) in wanted.groups.iter().zip(&found.groups).enumerate() {
        match (wanted, found) {
            (GroupSnapshot::Cells(wanted), GroupSnapshot::Cells(found)) => {
                for (field, (wanted, found)) in wanted.iter().zip(found).enumerate() {
                    assert_same_bytes(wanted, found, &|| {
                        format!("{}: group {group}, field {field}", place())
                    });
                }
            }
            (GroupSnapshot::Population(wanted, left), GroupSnapshot::Population(found, found_left)) => {
                assert_eq!(wanted.counts, found.counts, "{}: items in each cell", place());
                assert_eq!(wanted.labels, found.labels, "{}: labels", place());
                for (field, (wanted, found)) in wanted.fields.iter().zip(&found.fields).enumerate() {
                    assert_same_bytes(wanted, found, &|| {
                        format!("{}: group {group}, field {field}", place())
                    });
                }
                assert_eq!(left, found_left, "{}: items that left", place());
            }
            _ => panic!("{}: group {group} is another kind", place()),
        }
    }
}

/// Demands that two lists of bytes are the same, and shows the first that are not.
fn assert_same_bytes(wanted: &[u8], found: &[u8], place: &dyn Fn() -> String) {
    assert_eq!(wanted.len(), found.len(), "{}: the number of bytes", place());
    let Some(byte) = wanted.iter().zip(found).position(|(wanted, found)| wanted != found) else { return };
    let differing = wanted.iter().zip(found).filter(|(wanted, found)| wanted != found).count();
    let start = byte / 8 * 8;
    let window = start..wanted.len().min(start + 16);
    panic!(
        "{}: {differing} of {} bytes differ, from byte {byte} on; from byte {start} on wanted {:02x?}, found {:02x?}",
        place(),
        wanted.len(),
        &wanted[window.clone()],
        &found[window]
    );
}

/// An outcome as text, in which a value that is no number equals itself.
pub fn outcome_text(outcome: &Result<(), RunError>) -> String {
    match outcome {
        Ok(()) => "no fault".to_owned(),
        Err(error) => error_text(error),
    }
}

fn error_text(error: &RunError) -> String {
    format!("{error}; {error:?}")
}

/// Changes the state after the first so many processes of the second step, and demands that the rest of the
/// step ends with a fault that a process reports: the same on every engine. `what` is changed, for messages.
///
/// # Errors
/// Where the change cannot be made.
///
/// # Panics
/// Where no fault comes, or not the same.
pub fn assert_found(
    model: &Model,
    before: usize,
    what: &dyn Debug,
    change: impl Fn(&mut State<'_>) -> Result<(), Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let mut reports = Vec::new();
    for engine in all()? {
        let mut simulation = Simulation::new(model, &*engine, RunOptions::default())?;
        simulation.step()?;
        (0..before).try_for_each(|process| simulation.run_process(process))?;
        change(&mut simulation.state())?;
        let outcome =
            (before..model.processes().len()).try_for_each(|process| simulation.run_process(process));
        assert!(
            matches!(&outcome, Err(RunError::Fault { step: 2, fault: Fault::Reported { .. }, .. })),
            "{what:?} on {}: {outcome:?}",
            describe(&*engine)
        );
        reports.push(outcome_text(&outcome));
    }
    reports.dedup();
    assert_eq!(reports.len(), 1, "{reports:?}");
    Ok(())
}
