//! Models of cells in parts on GPUs.

use super::{NoBorder, Site, TestResult, count, cpu, loads, run_in, wood};
use std::error::Error;
use std::sync::Arc;
use xca_core::Fault;
use xca_core::engine::{EngineFailure, InputError, Part, StartError, SubstateId};
use xca_core::prelude::*;
use xca_gpu::{Arithmetic, Gpu, GpuOptions, Handicap};
use xca_parts::{Grid, Parts};
use xca_tests::suite::engines::gpu;

use Boundary::{Flat, Reflecting, Toroidal};

/// A space, and its parts along y and z.
type Case = ([usize; 3], Neighbourhood, Faces<Boundary>, Vec<[usize; 2]>);

fn cases() -> Result<Vec<Case>, Box<dyn Error>> {
    let far = Neighbourhood::custom(vec![[0, 0, 0], [3, 0, 0], [-1, 2, 0], [0, -1, 1]])?;
    let one_sided = Faces { south: Reflecting, top: Reflecting, ..Faces::all(Flat) };
    let mixed = Faces::from([Toroidal, Reflecting, Flat]);
    Ok(vec![
        ([40, 9, 1], Neighbourhood::von_neumann_2d(1), Faces::all(Toroidal), vec![[2, 1], [3, 1]]),
        ([9, 4, 6], Neighbourhood::moore(1), Faces::all(Toroidal), vec![[1, 2], [2, 3]]),
        ([9, 4, 6], Neighbourhood::moore(1), mixed, vec![[2, 1], [2, 3]]),
        ([5, 6, 7], Neighbourhood::moore(2), one_sided, vec![[1, 3], [2, 2]]),
        ([17, 8, 1], Neighbourhood::hexagonal(Hexagons::CornerUp), Faces::all(Toroidal), vec![[3, 1]]),
        ([12, 5, 4], far, Faces::from([Flat, Toroidal, Reflecting]), vec![[2, 2]]),
    ])
}

/// Neighbours beyond cuts and corners, random numbers, positions, outside values, steering and reductions.
#[test]
fn same_bits_in_parts_on_gpus() -> TestResult {
    let gpu = gpu()?;
    for (number, (extents, neighbourhood, boundaries, cuts)) in cases()?.into_iter().enumerate() {
        let model = wood(extents, neighbourhood, boundaries, true)?;
        for (turn, [y, z]) in cuts.into_iter().enumerate() {
            let precision = if (number + turn) % 2 == 0 { Precision::F32 } else { Precision::F64 };
            let wanted = run_in(&model, &Reference, precision)?;
            let parts = Parts::with_grid(gpu.clone(), Grid { y, z });
            for (step, (got, wanted)) in run_in(&model, &parts, precision)?.iter().zip(&wanted).enumerate() {
                assert!(got == wanted, "{extents:?} {boundaries:?} {y}x{z} {precision}, step {step}");
            }
        }
    }
    Ok(())
}

/// Parts whose substates cannot be bound at once are worked on section by section.
#[test]
fn same_bits_in_parts_that_are_reached_in_sections() -> TestResult {
    // Three layers of 128 stored cells with 12 bytes each, and some more.
    let handicap = Handicap { reach: Some(3 * 128 * 12 + 100), ..Handicap::default() };
    let gpu = Gpu::new(&GpuOptions { arithmetic: Arithmetic::Strict, handicap, ..GpuOptions::default() })?;
    let model = wood([9, 8, 6], Neighbourhood::moore(1), Faces::all(Toroidal), true)?;
    for (grid, precision) in [(Grid { y: 1, z: 2 }, Precision::F32), (Grid { y: 2, z: 1 }, Precision::F32)] {
        let parts = Parts::with_grid(gpu.clone(), grid);
        assert!(run_in(&model, &parts, precision)? == run_in(&model, &Reference, precision)?, "{grid}");
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug)]
struct Grain {
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn rest(me: &mut Slot<Grain>) {
    me.position.x += 0.0;
}

#[test]
fn populations_are_refused_before_the_first_step() -> TestResult {
    let model = Model::builder("grains")
        .extents([4, 6, 1])
        .substates::<Site>()
        .population::<Grain>(2)
        .process(rest)
        .build()?;
    let parts = Parts::new(gpu()?, count(2)?);
    let error = Simulation::new(&model, &parts, RunOptions::default()).err().ok_or("it is not refused")?;
    let error = error.to_string();
    assert!(
        error.contains("the gpu engine cannot run a part of the space: the model has the population `Grain`")
            && error.contains("take parts on the cpu engine, or one GPU (--engine gpu)"),
        "{error}"
    );
    // One part is the whole space.
    let mut simulation = Simulation::new(&model, &Parts::new(gpu()?, count(1)?), RunOptions::default())?;
    Ok(simulation.run(2).map(drop)?)
}

/// Their messages differ.
#[test]
fn parts_on_different_engines_are_refused() -> TestResult {
    let model = loads(&[])?;
    let parts = Parts::with_engines(vec![Arc::new(cpu(1, 0)?), Arc::new(gpu()?)]);
    let error = parts.start(&model, Precision::F64).err().ok_or("they are not refused")?.to_string();
    assert!(error.contains("part 1 differs in its engine: gpu in place of cpu of part 0"), "{error}");
    Ok(())
}

/// A part has its own cells, by their numbers in the whole space, and takes no others.
#[test]
fn a_part_on_a_gpu_knows_its_cells() -> TestResult {
    let (model, gpu) = (loads(&[])?, gpu()?);
    let start = |y| gpu.start_part(&model, Precision::F64, &Part { y, z: 0..1 }, Box::new(NoBorder));
    let weight = SubstateId { group: 0, field: 0 };
    let mut part = start(2..4)?;
    let values: Vec<u8> = (0..10_u32).flat_map(u32::to_ne_bytes).collect();
    part.write(weight, &values)?;
    assert_eq!(part.read(weight)?, values);
    assert_eq!(part.read_cells(weight, &[19, 10])?, [9_u32, 0].map(u32::to_ne_bytes).concat());
    part.write_cells(weight, &[11], &7_u32.to_ne_bytes())?;
    assert_eq!(part.read(weight)?[4..8], 7_u32.to_ne_bytes());
    for cell in [9, 20, 0, 29] {
        let wanted = EngineFailure::Input(InputError::NotInPart { cell, y: 2..4, z: 0..1 });
        assert_eq!(part.read_cells(weight, &[12, cell]), Err(wanted.clone()));
        assert_eq!(part.write_cells(weight, &[cell], &[0; 4]), Err(wanted));
    }
    assert!(matches!(
        part.write(weight, &[0; 120]),
        Err(EngineFailure::Input(InputError::WrongLength { .. }))
    ));
    part.write(weight, &[0; 40])?;
    // A neighbour of another build sends something else.
    let mut values = model.parameters().clone();
    values.set_bits(&[]);
    let context = xca_core::engine::StepContext { step: 0, seed: 1, parameters: &[], values: &values };
    let fault = part.run(0..3, &context).expect_err("the edge is too short");
    assert!(matches!(&fault, Fault::Engine(EngineFailure::Broken { .. })), "{fault}");
    assert!(matches!(start(2..7), Err(StartError::Part(_))));
    Ok(())
}
