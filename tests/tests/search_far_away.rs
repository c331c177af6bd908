//! Searches across the seam of a torus that is so long that `f32` rounds positions there by a visible part of
//! a cell.

use std::error::Error;
use xca_core::prelude::*;
use xca_tests::suite::engines;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Speck {
    #[position]
    position: Vector3<Real>,
    near: u32,
    labels: u32,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Sight {
    radius: Real,
}

#[elementary_process]
fn look(me: &mut Slot<Speck>, p: &Sight) {
    me.near = 0;
    me.labels = 0;
    for other in me.others_within(p.radius) {
        me.near += 1;
        me.labels = (me.labels * 7 + other.label()) % 1_000_003;
    }
}

const CELLS: usize = 1 << 16;

/// In sides of a cell: on the grid of the numbers there, and just beyond it, so that rounding shortens a
/// distance to less.
const RADII: [f64; 2] = [0.5, 0.5002];

/// Items on both sides of the seam: in the first cell close together around the radius, in the last one as
/// dense as `f32` can tell.
fn items(side: f64) -> Vec<(usize, f32)> {
    let length = CELLS as f64 * side;
    let first = (0..80).map(|number| (0, (side * (0.48 + 0.0005 * f64::from(number))) as f32));
    let mut last = Vec::new();
    let mut place = length as f32;
    while last.len() < 20 {
        if f64::from(place) <= length {
            last.push((CELLS - 1, place));
        }
        place = place.next_down();
    }
    first.chain(last).collect()
}

/// For each item, in the order of cells and labels, what it finds: all pairs are compared by the definition
/// of a search.
fn all_pairs(side: f64, radius: f64) -> Vec<(u32, u32)> {
    let items = items(side);
    let period = CELLS as f32 * side as f32;
    let radius = (radius * side) as f32;
    let near = |place: f32, other: f32| {
        let separation = place - other;
        let shorter = if separation > 0.5 * period {
            separation - period
        } else if separation < -(0.5 * period) {
            separation + period
        } else {
            separation
        };
        shorter * shorter < radius * radius
    };
    let found = |own: usize, (cell, place): (usize, f32)| {
        let others = |of: usize| {
            let those = items.iter().enumerate().filter(move |(label, (at, _))| *at == of && *label != own);
            those.filter(|(_, (_, other))| near(place, *other)).map(|(label, _)| label as u32)
        };
        // The own cell comes first, then the neighbour across the seam.
        let labels: Vec<u32> = others(cell).chain(others(CELLS - 1 - cell)).collect();
        let digest = labels.iter().fold(0, |digest: u32, label| (digest * 7 + label) % 1_000_003);
        (labels.len() as u32, digest)
    };
    items.iter().enumerate().map(|(label, item)| found(label, *item)).collect()
}

#[test]
fn across_the_seam_of_a_long_torus() -> Result<(), Box<dyn Error>> {
    let sides = [1.0, 0.1, 0.7, 0.003];
    for (side, radius) in sides.into_iter().flat_map(|side| RADII.map(|radius| (side, radius))) {
        let wanted = all_pairs(side, radius);
        // Some of the first cell find items across the seam, others find only the 79 of their own cell.
        let first = || wanted.iter().take(80);
        assert!(first().any(|(near, _)| *near > 79) && first().any(|(near, _)| *near == 79));
        let model = Model::builder("long torus")
            .extents([CELLS, 1, 1])
            .cell_side(side)
            .boundaries([Boundary::Toroidal, Boundary::Flat, Boundary::Flat])
            .neighbourhood(Neighbourhood::moore(1))
            .population::<Speck>(80)
            .parameters(Sight { radius: radius * side })
            .process(look)
            .initialise(move |state| {
                let item = |(label, (cell, place)): (usize, (usize, f32))| Item {
                    label: label as u32,
                    cell: [cell, 0, 0],
                    state: Speck {
                        position: Vector3::new(f64::from(place), 0.5 * side, 0.5 * side),
                        near: 0,
                        labels: 0,
                    },
                };
                Ok(state.set_items(items(side).into_iter().enumerate().map(item).collect())?)
            })
            .build()?;
        for engine in engines::all()? {
            let options = RunOptions { precision: Precision::F32, seed: 0 };
            let mut simulation = Simulation::new(&model, &*engine, options)?;
            simulation.step()?;
            let found: Vec<(u32, u32)> = simulation
                .state()
                .items::<Speck>()?
                .iter()
                .map(|item| (item.state.near, item.state.labels))
                .collect();
            assert!(
                found == wanted,
                "side {side}, radius {radius} on {}: {found:?}, not {wanted:?}",
                engines::describe(&*engine)
            );
        }
    }
    Ok(())
}
