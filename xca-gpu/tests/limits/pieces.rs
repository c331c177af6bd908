//! Items, and what is known of them, in buffers larger than a binding.

use crate::common::{TestResult, gpu};
use std::error::Error;
use xca_core::prelude::*;
use xca_core::{GroupSnapshot, Snapshot};
use xca_gpu::Handicap;

/// The most bytes of a binding.
const REACH: u64 = 4608;

#[derive(Substates, Clone, Copy, Debug)]
struct Air {
    wind: Real,
    crowd: u32,
}

#[derive(Substates, Clone, Copy, Debug)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    met: u32,
}

/// Reads other items, and the cell of its own.
#[elementary_process]
fn collide(me: &mut Slot<Grain>, air: &Cell<Air>, space: &Space) {
    for other in me.others_within(0.9) {
        me.velocity += 0.05 * space.nearest_image(me.position - other.position);
        me.met += 1;
    }
    me.velocity.x += 0.02 * (air.wind - me.velocity.x);
}

/// Draws numbers by label.
#[elementary_process]
fn fly(me: &mut Slot<Grain>, space: &Space) {
    let mut step = 0.4 * me.velocity;
    step.z += 1.6 * (me.random(0) - 0.5);
    step = Vector3::new(step.x.max(-0.9).min(0.9), step.y.max(-0.9).min(0.9), step.z);
    me.position = space.wrapped(me.position + step);
}

#[migration]
fn settle(me: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// Reads the items of a cell.
#[elementary_process]
fn stir(air: &mut Cell<Air>, grains: &Slots<Grain>) {
    for grain in grains {
        air.crowd += 1 + grain.met;
        air.wind += 0.01 * grain.velocity.z;
    }
}

#[elementary_process]
fn blow(air: &mut Cell<Air>) {
    let mut sum = 0.0;
    for n in 0..air.neighbour_count() {
        sum += air.neighbour(n).wind;
    }
    air.wind = sum / 27.0;
}

fn swarm(boundary: Boundary) -> Result<Model, ModelError> {
    Model::builder("swarm")
        .extents([5, 4, 22])
        .neighbourhood(Neighbourhood::moore(1))
        .boundary(boundary)
        .substates::<Air>()
        .population::<Grain>(64)
        .items_may_leave::<Grain>()
        .process(collide)
        .process(fly)
        .process(settle)
        .process(stir)
        .process(blow)
        .fill(|site| Air { wind: site.random(0) - 0.5, crowd: 0 })
        .populate(|site: Site| {
            let near = |draw: usize| site.random(draw) - 0.5;
            let grain = |number: usize| {
                let place = Vector3::new(near(6 * number), near(6 * number + 1), near(6 * number + 2));
                let velocity = Vector3::new(near(6 * number + 3), near(6 * number + 4), 0.0);
                Grain { position: site.centre() + place, velocity, met: 0 }
            };
            (0..1 + site.cell()[0] % 2).map(grain).collect::<Vec<_>>()
        })
        .build()
}

/// What an engine makes of the model: the states before and after there are more items, and reductions.
fn run(
    model: &Model,
    engine: &dyn Engine,
    precision: Precision,
) -> Result<([Snapshot; 2], Vec<u64>), Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions { precision, seed: 5 })?;
    simulation.run(6)?;
    let first = simulation.snapshot()?;
    let mut items = simulation.state().items::<Grain>()?;
    let more: Vec<_> = items.iter().map(|item| Item { label: item.label + 10_000, ..item.clone() }).collect();
    items.extend(more);
    simulation.state().set_items(items)?;
    simulation.run(4)?;
    let state = simulation.state();
    let figures = vec![
        state.sum(Grain::MET)? as u64,
        state.maximum(Grain::MET)?.ok_or("no items")?.into(),
        state.largest_occupancy::<Grain>()?.into(),
        state.count_items::<Grain>()? as u64,
        state.count_left::<Grain>()?,
    ];
    Ok(([first, simulation.snapshot()?], figures))
}

fn items(snapshot: &Snapshot) -> usize {
    let of_group = |group: &GroupSnapshot| match group {
        GroupSnapshot::Cells(_) => 0,
        GroupSnapshot::Population(items, _) => items.labels.len(),
    };
    snapshot.groups.iter().map(of_group).sum()
}

fn assert_same(handicap: Handicap, boundary: Boundary, precision: Precision) -> TestResult {
    let model = swarm(boundary)?;
    let (wanted, figures) = run(&model, &Reference, precision)?;
    let (found, found_figures) = run(&model, &gpu(handicap)?, precision)?;
    for (wanted, found) in wanted.iter().zip(&found) {
        assert!(wanted.groups == found.groups, "{boundary} {precision}");
    }
    assert_eq!(figures, found_figures, "{boundary} {precision}");
    // Where none leaves, even the labels need two bindings in the end.
    let bytes = if boundary == Boundary::Toroidal { 4 } else { 12 };
    assert!(items(&wanted[1]) as u64 * bytes > REACH, "{} items", items(&wanted[1]));
    Ok(())
}

/// The space is cut into parts, and items go from part to part and round the space.
#[test]
fn items_in_pieces_give_the_same_bits() -> TestResult {
    let handicap = Handicap { reach: Some(REACH), ..Handicap::default() };
    for boundary in [Boundary::Toroidal, Boundary::Flat] {
        for precision in [Precision::F32, Precision::F64] {
            assert_same(handicap, boundary, precision)?;
        }
    }
    Ok(())
}

/// More workgroups of items than a dispatch holds along an axis.
#[test]
fn items_in_folded_dispatches_give_the_same_bits() -> TestResult {
    let handicap = Handicap { workgroup: Some(8), workgroups: Some(20), ..Handicap::default() };
    assert_same(handicap, Boundary::Toroidal, Precision::F64)
}

/// The error names the process, and how many buffers the adapter allows, before the first step.
#[test]
fn too_many_pieces_are_refused_at_the_start() -> TestResult {
    let gpu = gpu(Handicap { reach: Some(REACH), buffers: Some(13), ..Handicap::default() })?;
    let error = Simulation::new(&swarm(Boundary::Toroidal)?, &gpu, RunOptions::default()).err();
    let error = error.ok_or("thirteen buffers are enough")?.to_string();
    for part in ["`collide`", "allows 13", &format!("beyond {REACH} bytes")] {
        assert!(error.contains(part), "{error}");
    }
    Ok(())
}
