//! What only the GPU engine has: strict and relaxed arithmetic, large substates in parts, several steps in
//! one submission, refusals. That it agrees with the other engines is tested with them, in the other suites.

use cadem::{Case, Configuration};
use std::error::Error;
use xca_core::prelude::*;
use xca_core::{GroupSnapshot, Snapshot, StartError};
use xca_gpu::{AdapterChoice, Arithmetic, Gpu, GpuError, GpuOptions, Handicap};
use xca_tests::suite::engines::{PRECISIONS, assert_same_fault, assert_same_runs, gpu};
use xca_tests::suite::lattice::Shape;
use xca_tests::suite::site;

type TestResult = Result<(), Box<dyn Error>>;

fn relaxed() -> Result<Gpu, GpuError> {
    Gpu::new(&GpuOptions { arithmetic: Arithmetic::Relaxed, ..GpuOptions::default() })
}

/// The strict engine, with so few bytes in reach that spaces are cut.
fn short_sighted(reach: u64) -> Result<Gpu, GpuError> {
    let handicap = Handicap { reach: Some(reach), ..Handicap::default() };
    Gpu::new(&GpuOptions { arithmetic: Arithmetic::Strict, handicap, ..GpuOptions::default() })
}

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    visits: u32,
}

#[derive(Parameters, Clone, Debug)]
struct Conduction {
    alpha: Real,
    limit: Real,
}

#[elementary_process]
fn diffuse(cell: &mut Cell<Heat>, p: &Conduction) {
    let mut flux = 0.0;
    for n in 1..cell.neighbour_count() {
        flux += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature += p.alpha * flux;
    cell.visits += 1;
    if cell.temperature > p.limit {
        cell.fault(7, cell.temperature);
    }
}

fn heat(extents: [usize; 3], boundary: Boundary, limit: f64) -> Result<Model, ModelError> {
    let neighbourhood =
        if extents[2] == 1 { Neighbourhood::moore_2d(1) } else { Neighbourhood::von_neumann(1) };
    Model::builder("heat")
        .extents(extents)
        .neighbourhood(neighbourhood)
        .boundaries(if extents[2] == 1 { [boundary, boundary, Boundary::Flat] } else { [boundary; 3] })
        .substates::<Heat>()
        .parameters(Conduction { alpha: 0.1, limit })
        .process(diffuse)
        .fill(|site| {
            let [x, y, z] = site.cell();
            Heat { temperature: ((x * 31 + y * 17 + z * 7) % 101) as f64, visits: 0 }
        })
        .build()
}

/// Cut along z, and along y where there is one layer; all boundaries; reductions go over the parts.
#[test]
fn a_space_in_parts_gives_the_same_bits() -> TestResult {
    for (extents, reach) in [([9, 7, 20], 8 * 4000), ([9, 7, 20], 8 * 700), ([100, 40, 1], 8 * 1500)] {
        for boundary in [Boundary::Flat, Boundary::Toroidal, Boundary::Reflecting] {
            let model = heat(extents, boundary, 1e9)?;
            let gpu = short_sighted(reach)?;
            for precision in PRECISIONS {
                let options = RunOptions { precision, seed: 0 };
                let engines: [Box<dyn Engine>; 2] = [Box::new(Reference), Box::new(gpu.clone())];
                assert_same_runs(&model, &engines, options, 7)?;
                let sums = engines.iter().map(|engine| -> Result<f64, Box<dyn Error>> {
                    let mut simulation = Simulation::new(&model, &**engine, options)?;
                    simulation.run(3)?;
                    simulation.state().set(Heat::TEMPERATURE, [8, 6, extents[2] - 1], -3.5)?;
                    simulation.run(1)?;
                    Ok(simulation.state().sum(Heat::TEMPERATURE)?)
                });
                let sums: Vec<f64> = sums.collect::<Result<_, _>>()?;
                assert_eq!(sums[0].to_bits(), sums[1].to_bits(), "{extents:?} {boundary} {precision}");
            }
        }
    }
    Ok(())
}

/// Each cell of the automaton checks what it sees, also where the space is cut right beside it.
#[test]
fn an_automaton_in_parts_finds_what_it_must() -> TestResult {
    for (shape, extents, reach) in
        [(Shape::Moore, [5, 4, 9], 24 * 64 * 5), (Shape::WideVonNeumann, [5, 5, 11], 24 * 128 * 8)]
    {
        let engines: [Box<dyn Engine>; 2] = [Box::new(Reference), Box::new(short_sighted(reach)?)];
        for boundaries in [
            Faces::from([Boundary::Toroidal, Boundary::Flat, Boundary::Toroidal]),
            Faces::from([Boundary::Flat, Boundary::Reflecting, Boundary::Reflecting]),
            Faces { north: Boundary::Reflecting, bottom: Boundary::Reflecting, ..Faces::default() },
        ] {
            let model = site::model(shape, extents, boundaries)?;
            assert_same_runs(&model, &engines, RunOptions::default(), 3)?;
        }
    }
    Ok(())
}

/// The first fault in the order of cells, in its own step, though many steps are submitted together and the
/// space is cut.
#[test]
fn a_fault_names_its_step_and_cell() -> TestResult {
    // Heat comes one cell further in each step, and the first that does not bear it is cell 31.
    let model = Model::builder("source")
        .extents([40, 5, 5])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .substates::<Heat>()
        .parameters(Conduction { alpha: 0.1, limit: 0.0 })
        .process(diffuse_downstream)
        .fill(|site| Heat { temperature: if site.cell()[0] == 0 { 1.0 } else { 0.0 }, visits: 0 })
        .build()?;
    let engines: [Box<dyn Engine>; 3] =
        [Box::new(Reference), Box::new(gpu()?), Box::new(short_sighted(8 * 42 * 7 * 4)?)];
    let error = assert_same_fault(&model, &engines, RunOptions::default(), 60);
    assert!(error.to_string().starts_with("step 31: "), "{error}");
    assert!(error.to_string().contains("in cell [31, 0, 0]"), "{error}");
    Ok(())
}

/// Carries heat one cell on in each step, and does not bear it beyond the 30th.
#[elementary_process]
fn diffuse_downstream(cell: &mut Cell<Heat>, p: &Conduction) {
    let index = cell.index();
    if index.x > 0 && cell.neighbour(3).temperature > p.limit {
        cell.temperature = 1.0;
        if index.x > 30 {
            cell.fault(8, cell.temperature);
        }
    }
}

#[derive(Substates, Clone, Copy)]
struct Pilgrim {
    #[position]
    position: Vector3<Real>,
}

#[elementary_process]
fn walk(me: &mut Slot<Pilgrim>, space: &Space) {
    if me.index().x + 1 < space.extents().x {
        me.position.x += space.side();
    }
}

#[migration]
fn arrive(me: &Slot<Pilgrim>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// All walk to the last cell, which is full one day: the fault tells how many it would hold, though later
/// steps were submitted with it.
#[test]
fn a_full_cell_is_told_as_it_was() -> TestResult {
    let pilgrims = (0..12_u32).map(|label| {
        let cell = [label as usize, 0, 0];
        Item { label, cell, state: Pilgrim { position: Vector3::new(f64::from(label) + 0.5, 0.5, 0.5) } }
    });
    let pilgrims: Vec<_> = pilgrims.collect();
    let model = Model::builder("pilgrims")
        .extents([12, 2, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .population::<Pilgrim>(5)
        .process(walk)
        .process(arrive)
        .initialise(move |state| Ok(state.set_items(pilgrims.clone())?))
        .build()?;
    let engines: [Box<dyn Engine>; 2] = [Box::new(Reference), Box::new(gpu()?)];
    let error = assert_same_fault(&model, &engines, RunOptions::default(), 11);
    assert!(error.to_string().starts_with("step 5: "), "{error}");
    assert!(error.to_string().contains("cell [11, 0, 0] would hold 6 items"), "{error}");
    Ok(())
}

fn cells(snapshot: &Snapshot, precision: Precision) -> Vec<f64> {
    let GroupSnapshot::Cells(fields) = &snapshot.groups[0] else { return Vec::new() };
    match precision {
        Precision::F32 => {
            fields[0].as_chunks().0.iter().map(|value| f32::from_ne_bytes(*value).into()).collect()
        }
        Precision::F64 => fields[0].as_chunks().0.iter().map(|value| f64::from_ne_bytes(*value)).collect(),
    }
}

/// Relaxed arithmetic may contract and reorder. Of the stencil's seven terms each step then rounds a few
/// times otherwise, and diffusion does not amplify that: after 50 steps temperatures near 50 agree to some
/// hundred units in the last place.
#[test]
fn relaxed_heat_agrees_to_rounding() -> TestResult {
    let (gpu, model) = (relaxed()?, heat([20, 15, 12], Boundary::Toroidal, 1e9)?);
    assert!(!gpu.is_strict());
    for (precision, tolerance) in [(Precision::F32, 2e-3), (Precision::F64, 5e-12)] {
        let options = RunOptions { precision, seed: 0 };
        let mut reference = Simulation::new(&model, &Reference, options)?;
        let mut simulation = Simulation::new(&model, &gpu, options)?;
        reference.run(50)?;
        simulation.run(50)?;
        let (wanted, found) =
            (cells(&reference.snapshot()?, precision), cells(&simulation.snapshot()?, precision));
        assert_eq!(wanted.len(), 20 * 15 * 12);
        for (wanted, found) in wanted.iter().zip(&found) {
            assert!((wanted - found).abs() <= tolerance, "{precision}: {found} instead of {wanted}");
        }
    }
    Ok(())
}

/// In free fall nothing amplifies rounding: before the first contact particles agree to some units in the
/// last place.
#[test]
fn relaxed_particles_agree_to_rounding() -> TestResult {
    let configuration = Case::Illustration.configuration();
    let particles = configuration.authors_particles()?;
    let model = cadem::model(&configuration, particles)?;
    let positions = |engine: &dyn Engine| -> Result<Vec<_>, Box<dyn Error>> {
        let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
        simulation.run(100)?;
        let mut items = simulation.state().items::<cadem::Dem>()?;
        items.sort_unstable_by_key(|item| item.label);
        Ok(items)
    };
    let (wanted, found) = (positions(&Reference)?, positions(&relaxed()?)?);
    assert_eq!(wanted.len(), found.len());
    for (wanted, found) in wanted.iter().zip(&found) {
        assert_eq!(wanted.label, found.label);
        let apart = wanted.state.position - found.state.position;
        assert!(apart.x.abs() + apart.y.abs() + apart.z.abs() < 1e-14, "{} {apart:?}", wanted.label);
    }
    Ok(())
}

/// Both laws of walls, contacts, migration: the bits of the reference engine.
#[test]
fn particles_in_contact_have_the_same_bits() -> TestResult {
    for walls in [cadem::Walls::Single, cadem::Walls::PerSlot] {
        let configuration = Configuration { walls, cells: [12; 3], ..Case::Illustration.configuration() };
        let model = cadem::model(&configuration, configuration.authors_particles()?)?;
        for precision in PRECISIONS {
            let options = RunOptions { precision, seed: 0 };
            let mut cpu = Simulation::new(&model, &xca_cpu::Cpu::new()?, options)?;
            let mut gpu = Simulation::new(&model, &gpu()?, options)?;
            for _ in 0..3 {
                cpu.run(500)?;
                gpu.run(500)?;
                assert!(cpu.snapshot()? == gpu.snapshot()?, "{walls:?} {precision}");
            }
        }
    }
    Ok(())
}

#[test]
fn what_is_not_there_is_refused_with_the_choices() -> TestResult {
    let options = GpuOptions { adapter: AdapterChoice::from("no such adapter"), ..GpuOptions::default() };
    let error = Gpu::new(&options).err().ok_or("an adapter of that name")?;
    let known = &xca_gpu::adapters()[0].name;
    assert!(error.to_string().contains(known.as_str()), "{error}");
    // One layer with its neighbours does not fit into a kilobyte.
    let model = heat([30, 30, 30], Boundary::Flat, 1e9)?;
    let error = Simulation::new(&model, &short_sighted(1024)?, RunOptions::default()).err();
    let Some(RunError::Start(StartError::TooLarge { wanted, limit, .. })) = error else {
        return Err("a model that cannot be cut was started".into());
    };
    assert!(wanted > 1024 && limit == 1024, "{wanted} {limit}");
    // More cells than 32 bits can number.
    let model = heat([60_000, 40_000, 1], Boundary::Flat, 1e9)?;
    let error = Simulation::new(&model, &gpu()?, RunOptions::default()).err().ok_or("a huge model")?;
    assert!(error.to_string().contains("bytes"), "{error}");
    Ok(())
}
