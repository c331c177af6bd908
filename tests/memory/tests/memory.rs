//! Small models of every kind on the reference, the CPU engine and parts of it, for memory checkers.
//! `scripts/miri` runs them under Miri. No test opens a file. Each model runs a few steps on a few cells.

use std::error::Error;
use std::num::NonZeroU64;
use xca_core::prelude::*;
use xca_core::{Fault, ModelBuilder};
use xca_cpu::Cpu;
use xca_parts::{Grid, Parts};

type TestResult = Result<(), Box<dyn Error>>;

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Ground {
    Rock,
    Soil,
    Water,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Land {
    ground: Ground,
    wet: bool,
    age: u8,
    height: Real,
    slope: Vector2<Real>,
    outflow: [Real; 4],
    marks: [Vector2<f32>; 2],
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Air {
    warmth: f32,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    speed: Vector3<Real>,
    force: Vector3<Real>,
    near: u32,
    bounces: [u8; 3],
    stuck: bool,
}

#[derive(Parameters, Clone, Debug)]
struct Motion {
    time_step: Real,
    gust: Real,
}

/// Writes a substate that it reads at neighbours, to a second buffer.
#[elementary_process]
fn spread(land: &mut Cell<Land>) {
    let mut mean = 0.0;
    for n in 0..land.neighbour_count() {
        mean += land.neighbour(n).height;
    }
    land.height = mean / land.neighbour_count() as Real;
}

/// Reads one element of a neighbour's array, and writes its own elements in place.
#[elementary_process]
fn flow(land: &mut Cell<Land>, air: &Cell<Air>) {
    for k in 0..4 {
        land.outflow[k] += 0.125 * land.height + air.neighbour(1).warmth as Real;
    }
    land.marks[land.age as usize % 2].y = air.warmth;
    land.slope.x = land.outflow[(land.age % 4) as usize];
    land.age = land.age.wrapping_add(1);
}

/// Joins the pass of the previous process, and only writes in place.
#[elementary_process]
fn settle_down(land: &mut Cell<Land>) {
    land.wet = land.height > 0.5 || land.random(0) < 0.25;
    land.ground = match land.ground {
        Ground::Rock if land.wet => Ground::Soil,
        Ground::Soil => Ground::Water,
        _ => land.ground,
    };
}

#[elementary_process]
fn collect(land: &mut Cell<Land>) {
    let mut sum = 0.0;
    for n in 1..land.neighbour_count() {
        sum += land.neighbour(n).outflow[n % 4];
        if land.neighbour(n).wet {
            sum += land.neighbour(n).marks[n % 2].y as Real;
        }
    }
    land.height += 0.01 * sum;
}

#[elementary_process]
fn push(grain: &mut Slot<Grain>, p: &Motion) {
    let mut force = Vector3::splat(0.0);
    let mut near = 0;
    for other in grain.others_within(0.75) {
        force += (grain.position - other.position) * 0.5;
        near += other.label();
    }
    for other in grain.others_in_cell() {
        near += other.bounces[1] as u32;
    }
    grain.force = force + Vector3::new(p.gust, grain.random(0) - 0.5, grain.random(1) - 0.5);
    grain.near = near;
}

/// Shares a pass with the next process: one writes the speed, the other reads its own.
#[elementary_process]
fn accelerate(grain: &mut Slot<Grain>, p: &Motion) {
    grain.speed += grain.force * p.time_step;
    grain.bounces[grain.near as usize % 3] += 1;
}

#[elementary_process]
fn displace(grain: &mut Slot<Grain>, land: &Cell<Land>, p: &Motion) {
    grain.stuck = land.wet && grain.near > 3;
    if !grain.stuck {
        grain.position += grain.speed * p.time_step;
    }
}

#[migration]
fn rehome(grain: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(grain.position)
}

#[elementary_process]
fn count(land: &mut Cell<Land>, grains: &Slots<Grain>) {
    for grain in grains {
        land.age = land.age.wrapping_add(grain.bounces[0]);
        land.slope.y += grain.position.z;
    }
}

#[elementary_process]
fn overstep(land: &mut Cell<Land>) {
    land.outflow[land.age as usize] = 1.0;
}

#[elementary_process]
fn overstep_for_items(grain: &mut Slot<Grain>) {
    grain.near = grain.bounces[grain.label() as usize] as u32;
}

fn land(site: Site) -> Land {
    let [x, y, z] = site.cell();
    Land {
        ground: if x == 1 { Ground::Rock } else { Ground::Soil },
        wet: y == 0,
        age: (x + y + z) as u8,
        height: site.random(0),
        slope: Vector2::splat(0.0),
        outflow: [x as f64, 0.0, 0.5, 1.0],
        marks: [Vector2::splat(1.0); 2],
    }
}

fn grains(site: Site) -> Vec<Grain> {
    let number = (site.cell()[0] + site.cell()[1]) % 3;
    let grain = |draw: usize| Grain {
        position: site.centre() + Vector3::splat(site.random(draw) - 0.5),
        speed: Vector3::new(1.0, 0.5, -0.5),
        force: Vector3::splat(0.0),
        near: 0,
        bounces: [0; 3],
        stuck: false,
    };
    (0..number).map(grain).collect()
}

fn cells(extents: [usize; 3], neighbourhood: Neighbourhood) -> ModelBuilder {
    Model::builder("memory")
        .extents(extents)
        .neighbourhood(neighbourhood)
        .substates::<Land>()
        .substates_with_outside(Air { warmth: 0.5 })
        .fill(land)
        .process((spread, flow, settle_down, collect))
}

fn items(extents: [usize; 3], boundary: Boundary) -> ModelBuilder {
    Model::builder("memory")
        .extents(extents)
        .neighbourhood(Neighbourhood::moore(1))
        .boundary(boundary)
        .substates::<Land>()
        .population::<Grain>(8)
        .items_may_leave::<Grain>()
        .parameters(Motion { time_step: 0.25, gust: 0.5 })
        .fill(land)
        .populate(grains)
        .process((push, accelerate, displace, rehome, count))
}

/// The CPU engine with some threads. Two steps run together where they can.
fn cpu(threads: usize) -> Result<Cpu, Box<dyn Error>> {
    Ok(Cpu::with_threads(threads)?.with_stride(NonZeroU64::MIN.saturating_add(1)))
}

/// The number of steps of a run. Miri is some thousand times slower.
const STEPS: u64 = if cfg!(miri) { 2 } else { 3 };

/// The engines that are compared with each other. Miri would take longest for the reference engine, whose
/// memory no thread shares.
fn engines() -> Result<Vec<Box<dyn Engine>>, Box<dyn Error>> {
    let (mut engines, threads): (Vec<Box<dyn Engine>>, &[usize]) =
        if cfg!(miri) { (Vec::new(), &[2]) } else { (vec![Box::new(Reference)], &[1, 2, 3]) };
    for threads in threads {
        engines.push(Box::new(cpu(*threads)?));
    }
    engines.push(Box::new(Parts::with_grid(cpu(1)?, Grid { y: 2, z: 1 })));
    Ok(engines)
}

/// The state after some steps is the same on all engines, including all requests of a host.
fn agrees(builder: ModelBuilder, precision: Precision) -> TestResult {
    let model = builder.watch_finite(Schedule::EveryFromStart(2)).build()?;
    let mut wanted = None;
    for engine in engines()? {
        let name = engine.name();
        let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed: 4 })?;
        let start = simulation.snapshot()?;
        for _ in 0..STEPS {
            simulation.step()?;
            let state = simulation.state();
            assert!(state.sum(Land::HEIGHT)?.is_finite());
            assert_eq!(state.get_cells(Land::AGE, &[[0, 0, 0], [1, 1, 0]])?.len(), 2);
        }
        let end = simulation.snapshot()?;
        simulation.restore(&start)?;
        simulation.run(STEPS)?;
        assert!(simulation.snapshot()? == end, "{name}, restored");
        simulation.state().update(Land::HEIGHT, &[[1, 0, 0]], |_, height| height + 1.0)?;
        simulation.step()?;
        assert!(*wanted.get_or_insert_with(|| [start.clone(), end.clone()]) == [start, end], "{name}");
    }
    Ok(())
}

#[test]
fn cells_with_each_boundary() -> TestResult {
    for boundary in [Boundary::Flat, Boundary::Toroidal, Boundary::Reflecting] {
        agrees(cells([4, 3, 3], Neighbourhood::von_neumann(1)).boundary(boundary), Precision::F64)?;
    }
    agrees(cells([4, 3, 3], Neighbourhood::moore(1)), Precision::F32)
}

#[test]
fn layers_and_hexagons() -> TestResult {
    agrees(cells([5, 4, 1], Neighbourhood::moore_2d(1)).boundaries(layer()), Precision::F32)?;
    for hexagons in [Hexagons::CornerUp, Hexagons::SideUp] {
        let builder = cells([4, 4, 1], Neighbourhood::hexagonal(hexagons));
        agrees(builder.boundaries(layer()), Precision::F64)?;
    }
    Ok(())
}

fn layer() -> [Boundary; 3] {
    [Boundary::Toroidal, Boundary::Toroidal, Boundary::Flat]
}

#[test]
fn items_that_move() -> TestResult {
    for (boundary, precision) in [(Boundary::Flat, Precision::F64), (Boundary::Toroidal, Precision::F32)] {
        agrees(items([4, 3, 3], boundary), precision)?;
    }
    Ok(())
}

/// Steering replaces all kinds of values.
#[test]
fn other_items() -> TestResult {
    let model = items([3, 3, 3], Boundary::Flat).build()?;
    for engine in engines()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        simulation.step()?;
        let mut kept = simulation.state().items::<Grain>()?;
        kept.truncate(3);
        simulation.state().set_items(kept)?;
        simulation.run(2)?;
        simulation.state().set_items::<Grain>(Vec::new())?;
        simulation.step()?;
        assert_eq!(simulation.state().count_items::<Grain>()?, 0);
    }
    Ok(())
}

/// A panic in the middle of a row leaves memory valid, also on threads of the engine.
#[test]
fn panics() -> TestResult {
    let of_cells = cells([4, 3, 3], Neighbourhood::von_neumann(1)).process(overstep).build()?;
    let of_items = items([4, 3, 3], Boundary::Flat).process(overstep_for_items).build()?;
    for model in [of_cells, of_items] {
        let mut faults = Vec::new();
        for engine in engines()?.into_iter().chain([Box::new(Reference) as Box<dyn Engine>]) {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
            let Err(RunError::Fault { fault, .. }) = simulation.run(3) else { return Err("no fault".into()) };
            assert!(matches!(fault, Fault::Panicked { .. }), "{fault:?}");
            faults.push(fault);
            simulation.snapshot()?;
        }
        assert!(faults.iter().all(|fault| *fault == faults[0]), "{faults:?}");
    }
    Ok(())
}
