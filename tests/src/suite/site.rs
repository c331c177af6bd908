//! The self-checking automaton of cells.
//!
//! What every substate of every cell holds after every process is a function of the cell's place, the step
//! and the process alone. So each cell can verify, in each process, its own indices and the whole state of
//! each of its neighbours, and reports a fault where something is not as it must be: a wrong neighbour, a
//! stale halo, a substate that changed though no one wrote it, or one that another process wrote too early.
//! No physics is needed to test an engine.

mod state;

pub use state::{
    Site, WRONG_DISPLACEMENT, WRONG_EXISTENCE, WRONG_INDEX, WRONG_NEIGHBOUR, WRONG_OPPOSITE, WRONG_PLACE,
    WRONG_SELF, WRONG_SIZE, WRONG_STEP, double_of, entry_of, mark, real_of, same_place, single_of, turn_of,
};

use super::around;
use super::lattice::{Lattice, Shape, Terrain, neighbour_place, outside_place, terrain_of};
use xca_core::prelude::*;

/// The number of [`fourth`], for [`mark`].
const FOURTH: u32 = 4;

/// Reads neighbours and itself, and writes what it reads at neighbours (so to a second buffer), and one
/// substate more in place.
#[elementary_process]
pub fn first(cell: &mut Cell<Site>, p: &Lattice, space: &Space) {
    let here = cell.index();
    let step = space.step();
    if !same_place(here, cell.place) {
        cell.fault(WRONG_INDEX, here.x as Real);
    }
    if cell.neighbour_count() != p.neighbours as usize {
        cell.fault(WRONG_SIZE, cell.neighbour_count() as Real);
    }
    if cell.stamp != mark(here, step, 0) || cell.single != single_of(mark(here, step.wrapping_sub(1), 1)) {
        cell.fault(WRONG_SELF, cell.single as Real);
    }
    // Written first: neighbours must show the old state all the same, and the cell itself the new one.
    cell.stamp = mark(here, step, 1);
    let before = mark(here, step.wrapping_sub(1), 1);
    for k in 0..4 {
        if cell.table[k] != entry_of(before, k as u32) {
            cell.fault(WRONG_SELF, k as Real);
        }
        cell.table[k] = entry_of(cell.stamp, k as u32);
    }
    for n in 0..cell.neighbour_count() {
        let there = neighbour_place(p, here, space.extents(), n);
        let other = cell.neighbour(n);
        if !same_place(other.place, there) {
            cell.fault(WRONG_PLACE, n as Real);
        }
        let stale = mark(there, step.wrapping_sub(1), 3);
        if other.stamp != mark(there, step, 0)
            || other.count != stale as i32
            || other.tag != (stale & 255) as u8
        {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
        let earlier = mark(there, step.wrapping_sub(1), 1);
        let chosen = (n as u32 + step) % 4;
        let all = other.table;
        if other.table[chosen as usize] != entry_of(earlier, chosen) || all[3] != entry_of(earlier, 3) {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
    }
    if cell.stamp != mark(here, step, 1) {
        cell.fault(WRONG_SELF, 1.0);
    }
    cell.single = single_of(cell.stamp);
    cell.double = double_of(cell.stamp);
}

/// Looks at its own cell alone, and writes in place: one substate from its old value, two others without
/// looking.
#[elementary_process]
pub fn second(cell: &mut Cell<Site>, space: &Space) {
    let here = cell.index();
    let step = space.step();
    if cell.stamp != mark(here, step, 1)
        || cell.single != single_of(cell.stamp)
        || cell.double != double_of(cell.stamp)
    {
        cell.fault(WRONG_SELF, 2.0);
    }
    cell.stamp = mark(here, step, 2);
    cell.level = real_of(cell.stamp);
    cell.flow = Vector3::new(cell.level, -cell.level, here.x as Real);
    let mut last = 1;
    while last > 0 {
        cell.paths[last].x = real_of(cell.stamp) + last as Real;
        last -= 1;
    }
    cell.paths[0] = Vector2::new(cell.level, 2.0);
    cell.dry = cell.stamp & 1 == 0;
}

/// Reads neighbours; writes one substate that it reads there, and one that it does not.
#[elementary_process]
pub fn third(cell: &mut Cell<Site>, p: &Lattice, space: &Space) {
    let here = cell.index();
    let step = space.step();
    for n in 0..cell.neighbour_count() {
        let there = neighbour_place(p, here, space.extents(), n);
        let other = cell.neighbour(n);
        let now = mark(there, step, 2);
        let before = mark(there, step, 1);
        if other.stamp != now || other.level != real_of(now) || other.flow.y != -real_of(now) {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
        if other.single != single_of(before)
            || other.double != double_of(before)
            || other.flow.z != there.x as Real
        {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
        if other.count != mark(there, step.wrapping_sub(1), 3) as i32 {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
        let stale = mark(there, step.wrapping_sub(1), 3);
        let terrain: Terrain = terrain_of(stale);
        if other.terrain != terrain || other.wet[n % 2] != ((stale >> (n % 2)) & 1 == 1) {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
        let paths = other.paths;
        if paths[0].x != real_of(now) || paths[0].y != 2.0 || other.paths[1].x != real_of(now) + 1.0 {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
        if other.dry != (now & 1 == 0) {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
    }
    let now = mark(here, step, 3);
    let terrain: Terrain = terrain_of(now);
    cell.terrain = terrain;
    cell.wet = [now & 1 == 1, now & 2 == 2];
    cell.count = now as i32;
    cell.tag = (now & 255) as u8;
}

/// Reads neighbours, and writes only what it does not read at all: in place.
#[elementary_process]
pub fn fourth(cell: &mut Cell<Site>, p: &Lattice, space: &Space) {
    let here = cell.index();
    let step = space.step();
    for n in 0..cell.neighbour_count() {
        let there = neighbour_place(p, here, space.extents(), n);
        let now = mark(there, step, 3);
        if cell.neighbour(n).tag != (now & 255) as u8 || cell.neighbour(n).count != now as i32 {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
        let terrain: Terrain = terrain_of(now);
        if cell.neighbour(n).terrain != terrain || cell.neighbour(n).wet != [now & 1 == 1, now & 2 == 2] {
            cell.fault(WRONG_NEIGHBOUR, n as Real);
        }
    }
    // A new state for each turn of nine steps.
    let terrain: Terrain = terrain_of(step / 9 + 1);
    cell.terrains[turn_of(step) as usize] = terrain;
    cell.pair = Vector2::new(single_of(mark(here, step, FOURTH)), 1.5);
    cell.stamp = mark(here, step.wrapping_add(1), 0);
}

/// Looks at its own cell alone; may run together with [`fourth`].
#[elementary_process]
pub fn fifth(cell: &mut Cell<Site>, space: &Space) {
    let here = cell.index();
    let step = space.step();
    if cell.pair.x != single_of(mark(here, step, FOURTH)) || cell.stamp != mark(here, step.wrapping_add(1), 0)
    {
        cell.fault(WRONG_SELF, 5.0);
    }
    if cell.steps.w != step || cell.steps.x != step + 3 {
        cell.fault(WRONG_STEP, cell.steps.w as Real);
    }
    cell.steps.w += 1;
    cell.steps.x += 1;
    for k in 0..9 {
        let turns = if k <= turn_of(step) { step / 9 + 1 } else { step / 9 };
        let terrain: Terrain = terrain_of(turns);
        if cell.terrains[k as usize] != terrain {
            cell.fault(WRONG_SELF, k as Real);
        }
    }
}

/// The state of a cell before the first step, or beyond a flat face (its [`outside_place`]).
fn at_start(place: Vector3<i32>) -> Site {
    let before = |process: u32| mark(place, u32::MAX, process);
    // What the processes of the step before would have left. The outside is the same after every process.
    let level = real_of(before(2));
    Site {
        place,
        stamp: mark(place, 0, 0),
        tag: (before(3) & 255) as u8,
        count: before(3) as i32,
        single: single_of(before(1)),
        double: double_of(before(1)),
        level,
        flow: Vector3::new(level, -level, f64::from(place.x)),
        pair: Vector2::new(0.0, 0.0),
        steps: Vector4::new(3, 0, 0, 0),
        table: std::array::from_fn(|element| entry_of(before(1), element as u32)),
        paths: [Vector2::new(level, 2.0), Vector2::new(level + 1.0, 0.0)],
        terrain: terrain_of(before(3)),
        wet: [before(3) & 1 == 1, before(3) & 2 == 2],
        dry: before(2) & 1 == 0,
        terrains: [Terrain::Rock; 9],
    }
}

/// The automaton in a space.
///
/// # Errors
/// Where the neighbourhood and the boundaries do not fit the extents.
pub fn model(
    shape: Shape,
    extents: [usize; 3],
    boundaries: impl Into<Faces<Boundary>>,
) -> Result<Model, ModelError> {
    let boundaries = boundaries.into();
    let mut builder = Model::builder(format!("sites, {shape:?}, {extents:?}, {boundaries}"))
        .extents(extents)
        .neighbourhood(shape.neighbourhood())
        .boundaries(boundaries)
        .parameters(Lattice::new(shape, boundaries))
        .substates_with_outside(at_start(outside_place(0)))
        .process(first)
        .process(second)
        .process(third)
        .process(fourth)
        .process(fifth)
        .process(around::look_around)
        .fill(|site| {
            let [x, y, z] = site.cell().map(|index| index as i32);
            at_start(Vector3::new(x, y, z))
        });
    // There is no opposite in a list without symmetry.
    if shape != Shape::Skewed {
        builder = builder.process(around::turn_round);
    }
    // The value of all flat faces is that of the first, and each other one is given its own.
    for (face, number) in Face::ALL.into_iter().zip(0..).skip(1) {
        if boundaries[face] == Boundary::Flat {
            builder = builder.outside(face, at_start(outside_place(number)));
        }
    }
    builder.build()
}
