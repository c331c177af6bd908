//! Skipping cells in which nothing can change does not change a bit. The reference engine, which computes all
//! cells, gives the expected results.

use std::error::Error;
use std::num::NonZeroUsize;
use xca_core::Snapshot;
use xca_core::prelude::*;
use xca_cpu::Cpu;

type TestResult = Result<(), Box<dyn Error>>;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Site {
    fuel: u32,
    lit: u32,
    trail: [u32; 2],
    haze: u32,
    ember: u32,
    age: u32,
    traffic: u32,
    worn: u32,
}

/// Another struct of the same cells.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Weather {
    wind: u32,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Walker {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Rule {
    /// The number of burning neighbours that set a cell on fire.
    catch: u32,
}

/// Writes to a second buffer.
#[elementary_process]
fn ignite(cell: &mut Cell<Site>, weather: &Cell<Weather>, rule: &Rule) {
    let mut burning = weather.wind;
    for n in 1..cell.neighbour_count() {
        burning += cell.neighbour(n).lit;
    }
    if cell.lit == 0 && burning >= rule.catch {
        cell.lit = cell.fuel;
    }
}

/// Writes the same substate to a second buffer, in some steps only.
#[elementary_process]
fn rekindle(cell: &mut Cell<Site>) {
    if cell.lit == 1 && cell.neighbour(1).lit > 2 {
        cell.lit = 2;
    }
}

/// Writes in place.
#[elementary_process]
fn burn(cell: &mut Cell<Site>) {
    if cell.lit > 0 {
        cell.lit -= 1;
        cell.fuel /= 2;
    }
}

/// In the same pass as [`burn`], and after it.
#[elementary_process]
fn cool(cell: &mut Cell<Site>) {
    if cell.lit == 0 {
        cell.ember = 0;
    }
}

/// Draws only beside a fire.
#[elementary_process]
fn glow(cell: &mut Cell<Site>) {
    if cell.lit > 0 && cell.random(0) < 0.5 {
        cell.ember += 1;
    }
}

#[helper]
fn now(space: &Space) -> u32 {
    space.step()
}

/// Requests the step in some cells, in a helper.
#[elementary_process]
fn stamp(cell: &mut Cell<Site>, space: &Space) {
    if cell.fuel == 1 {
        cell.age = now(space);
    }
}

#[elementary_process]
fn smoke(cell: &mut Cell<Site>) {
    cell.trail[1] = cell.trail[0];
    let mut sum = 0;
    for n in 0..cell.neighbour_count() {
        sum = 31 * (sum % 1000) + cell.neighbour(n).fuel;
    }
    cell.trail[0] = sum;
}

/// Sees the two elements of an array change at different times.
#[elementary_process]
fn drift(cell: &mut Cell<Site>) {
    let last = cell.neighbour_count() - 1;
    cell.haze = cell.neighbour(1).trail[0] % 1000 + cell.neighbour(last).trail[1];
}

/// Reads items, so it always runs.
#[elementary_process]
fn count(cell: &mut Cell<Site>, walkers: &Slots<Walker>) {
    cell.traffic = 0;
    for walker in walkers {
        cell.traffic += 1 + walker.label() % 3;
    }
}

#[elementary_process]
fn wear(cell: &mut Cell<Site>) {
    for n in 0..cell.neighbour_count() {
        cell.worn = cell.worn.max(cell.neighbour(n).traffic);
    }
}

#[elementary_process]
fn walk(me: &mut Slot<Walker>, space: &Space) {
    me.position = space.wrapped(me.position + me.velocity);
}

#[migration]
fn settle(me: &Slot<Walker>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// A number below `below`, from the cell and `which`.
fn number(cell: [usize; 3], which: u32, below: u32) -> u32 {
    let mut mixed =
        cell.iter().fold(which, |mixed, index| mixed.wrapping_mul(977).wrapping_add(*index as u32));
    for factor in [0x7feb_352d_u32, 0x846c_a68b, 0x9e37_79b1] {
        mixed = (mixed ^ (mixed >> 15)).wrapping_mul(factor);
    }
    (mixed >> 8) % below
}

/// A wood with some fires. Later steps add fires, and change the weather and the rule.
fn wood(
    extents: [usize; 3],
    neighbourhood: Neighbourhood,
    boundaries: [Boundary; 3],
    walkers: bool,
) -> Result<Model, ModelError> {
    let corner = extents.map(|extent| extent - 1);
    let builder = Model::builder("wood")
        .extents(extents)
        .neighbourhood(neighbourhood)
        .boundaries(boundaries)
        .substates::<Site>()
        .substates::<Weather>()
        .parameters(Rule { catch: 3 })
        .process((ignite, glow, burn, cool))
        .process_every(3, rekindle)
        .process((stamp, smoke, drift));
    let builder = if walkers {
        let builder = builder.population::<Walker>(9).items_may_leave::<Walker>();
        builder.process((walk, settle)).process((count, wear))
    } else {
        builder
    };
    builder
        .steer(Schedule::At(vec![14, 19]), move |state| {
            Ok(state.set_cells(Site::LIT, [(corner, 4), ([0; 3], 4)])?)
        })
        .steer(Schedule::At(vec![22]), |state| Ok(state.set_parameters(Rule { catch: 0 })?))
        .steer(Schedule::At(vec![25]), |state| Ok(state.set_parameters(Rule { catch: 9 })?))
        .steer(Schedule::At(vec![31]), |state| {
            let wind: Vec<u32> = (0_u32..)
                .map(|cell| u32::from(cell % 97 == 5) * 20)
                .take(state.read(Weather::WIND)?.len())
                .collect();
            Ok(state.write(Weather::WIND, &wind)?)
        })
        .initialise(move |state| {
            state.fill(|site| {
                let fuel = number(site.cell(), 1, 6);
                let lit = u32::from(number(site.cell(), 2, 60) == 0) * 4;
                Site { fuel, lit, trail: [0; 2], haze: 0, ember: 0, age: 0, traffic: 0, worn: 0 }
            })?;
            if walkers {
                let item = |label: u32| {
                    let place = [0, 1, 2].map(|axis| number([axis, 3, 3], label, extents[axis] as u32));
                    let way = [0, 1, 2].map(|axis| f64::from(number([axis, 5, 5], label, 9)) / 16.0 - 0.25);
                    let [x, y, z] = place.map(|index| f64::from(index) + 0.5);
                    let moves = |axis: usize| label.is_multiple_of(4) && extents[axis] > 1;
                    let [u, v, w] = [0, 1, 2].map(|axis| if moves(axis) { way[axis] } else { 0.0 });
                    let state = Walker { position: Vector3::new(x, y, z), velocity: Vector3::new(u, v, w) };
                    Item { label, cell: place.map(|index| index as usize), state }
                };
                let mut items: Vec<Item<Walker>> = (0..12).map(item).collect();
                items.dedup_by_key(|item| item.cell);
                state.set_items(items)?;
            }
            Ok(())
        })
        .build()
}

/// The results of a simulation after a step.
#[derive(Debug, PartialEq)]
struct Seen {
    snapshot: Snapshot,
    fuel: i64,
    trail: Option<[u32; 2]>,
}

/// The results after each of `steps` steps, some of which are repeated.
fn run(model: &Model, engine: &dyn Engine, steps: u64) -> Result<Vec<Seen>, Box<dyn Error>> {
    let options = RunOptions { precision: Precision::F32, seed: 7 };
    let mut simulation = Simulation::new(model, engine, options)?;
    let mut seen: Vec<Seen> = Vec::new();
    for step in 0..steps {
        if step == 17 {
            simulation.restore(&seen[8].snapshot)?;
        }
        simulation.step()?;
        let snapshot = simulation.snapshot()?;
        let state = simulation.state();
        seen.push(Seen { snapshot, fuel: state.sum(Site::FUEL)?, trail: state.maximum(Site::TRAIL)? });
    }
    Ok(seen)
}

const STEPS: u64 = 50;

/// The number of cells in a tile, and the number of threads.
const TILES: [(usize, usize); 5] = [(1, 1), (2, 3), (3, 2), (7, 1), (64, 3)];

fn forced((cells, threads): (usize, usize)) -> Result<Cpu, Box<dyn Error>> {
    Ok(Cpu::with_threads(threads)?.with_tiles(NonZeroUsize::new(cells).ok_or("no cells")?))
}

fn spaces() -> Result<Vec<([usize; 3], Neighbourhood)>, xca_core::NeighbourhoodError> {
    Ok(vec![
        ([70, 6, 1], Neighbourhood::von_neumann_2d(1)),
        ([23, 9, 1], Neighbourhood::moore_2d(2)),
        ([9, 4, 5], Neighbourhood::moore(1)),
        ([150, 1, 1], Neighbourhood::custom(vec![[0; 3], [1, 0, 0], [-2, 0, 0]])?),
        ([5, 6, 5], Neighbourhood::moore(2)),
        ([17, 8, 1], Neighbourhood::hexagonal(Hexagons::CornerUp)),
        ([16, 7, 1], Neighbourhood::hexagonal(Hexagons::SideUp)),
        ([40, 5, 3], Neighbourhood::custom(vec![[0, 0, 0], [3, 0, 0], [-1, 2, 0], [0, -1, 1]])?),
    ])
}

const RINGS: [Boundary; 3] = [Boundary::Toroidal; 3];

#[test]
fn what_is_left_out_changes_no_bit() -> TestResult {
    let mixed = [Boundary::Toroidal, Boundary::Reflecting, Boundary::Flat];
    let turned = [Boundary::Flat, Boundary::Toroidal, Boundary::Reflecting];
    let partly = [Boundary::Flat, Boundary::Toroidal, Boundary::Flat];
    for (extents, neighbourhood) in spaces()? {
        for boundaries in [[Boundary::Flat; 3], RINGS, [Boundary::Reflecting; 3], mixed, turned, partly] {
            let reflects = boundaries.contains(&Boundary::Reflecting);
            if reflects && neighbourhood.parity() != xca_core::Parity::None {
                continue;
            }
            // Walkers move to all adjacent cells.
            let can_walk = [Neighbourhood::moore_2d(2), Neighbourhood::moore(1), Neighbourhood::moore(2)];
            let walkers = can_walk.contains(&neighbourhood) && !reflects;
            for walkers in [false, walkers] {
                let model = wood(extents, neighbourhood.clone(), boundaries, walkers)?;
                let wanted = run(&model, &Reference, STEPS)?;
                for tiles in TILES {
                    for (step, (got, wanted)) in
                        run(&model, &forced(tiles)?, STEPS)?.iter().zip(&wanted).enumerate()
                    {
                        assert!(got == wanted, "{extents:?} {boundaries:?} {tiles:?} {walkers} step {step}");
                    }
                }
            }
        }
    }
    Ok(())
}

/// The share of cells that an engine updates in `steps` steps.
fn share(model: &Model, engine: &dyn Engine, steps: u64) -> Result<f64, Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions::default())?;
    simulation.run(steps)?;
    let figures = simulation.figures();
    let share = figures.iter().find(|figure| figure.name == "share_of_cells_worked_on");
    Ok(share.ok_or("the engine tells no share")?.value)
}

/// The Game of Life on a torus.
mod life {
    use super::*;

    #[derive(Substates, Clone, Copy, Debug, PartialEq)]
    pub(crate) struct Life {
        pub(crate) alive: u32,
    }

    #[elementary_process]
    pub(crate) fn evolve(cell: &mut Cell<Life>) {
        let mut sum = 0;
        for n in 1..cell.neighbour_count() {
            sum += cell.neighbour(n).alive;
        }
        cell.alive = (sum == 3 || (sum == 2 && cell.alive == 1)) as u32;
    }

    pub(crate) fn model(
        alive: impl Fn([usize; 3]) -> bool + Send + Sync + 'static,
    ) -> Result<Model, ModelError> {
        Model::builder("life")
            .extents([256, 256, 1])
            .neighbourhood(Neighbourhood::moore_2d(1))
            .boundary(Boundary::Toroidal)
            .substates::<Life>()
            .process(evolve)
            .fill(move |site| Life { alive: u32::from(alive(site.cell())) })
            .build()
    }
}

/// A glider covers few tiles. The first step updates all cells.
#[test]
fn a_glider_is_all_that_is_worked_on() -> TestResult {
    const GLIDER: [[usize; 3]; 5] = [[1, 0, 0], [2, 1, 0], [0, 2, 0], [1, 2, 0], [2, 2, 0]];
    let model = life::model(|cell| GLIDER.contains(&cell))?;
    let steps = 1200;
    let share = share(&model, &forced((32, 2))?, steps)?;
    // Five rows, each with at most two tiles of 32 cells, in 256 x 256 cells.
    let of_glider = 5.0 * 64.0 / (256.0 * 256.0);
    assert!(share < 1.0 / steps as f64 + of_glider, "{share}");
    assert!(share > 1.0 / steps as f64 + of_glider / 10.0, "{share}");
    Ok(())
}

/// Motion continues across the torus: after 4 x 256 steps a glider is back at its start.
#[test]
fn a_glider_comes_back() -> TestResult {
    const GLIDER: [[usize; 3]; 5] = [[1, 0, 0], [2, 1, 0], [0, 2, 0], [1, 2, 0], [2, 2, 0]];
    let model = life::model(|cell| GLIDER.contains(&cell))?;
    let mut simulation = Simulation::new(&model, &forced((16, 2))?, RunOptions::default())?;
    let first = simulation.state().read(life::Life::ALIVE)?;
    simulation.run(1024)?;
    assert!(simulation.state().read(life::Life::ALIVE)? == first);
    Ok(())
}

/// The sums of rows are kept until a row changes.
#[test]
fn sums_follow_a_pattern_that_grows() -> TestResult {
    const PENTOMINO: [[usize; 3]; 5] =
        [[101, 100, 0], [102, 100, 0], [100, 101, 0], [101, 101, 0], [101, 102, 0]];
    let model = life::model(|cell| PENTOMINO.contains(&cell))?;
    let mut simulation = Simulation::new(&model, &forced((16, 2))?, RunOptions::default())?;
    let mut most = 0;
    for _ in 0..200 {
        simulation.step()?;
        let alive: i64 = simulation.state().read(life::Life::ALIVE)?.into_iter().map(i64::from).sum();
        assert_eq!(simulation.state().sum(life::Life::ALIVE)?, alive);
        most = most.max(alive);
    }
    assert!(most > 50, "{most}");
    Ok(())
}

/// If nearly all cells change, changes are not tracked.
#[test]
fn a_soup_is_worked_on_whole() -> TestResult {
    let model = life::model(|cell| number(cell, 9, 3) == 0)?;
    let share = share(&model, &Cpu::with_threads(2)?, 64)?;
    assert!((share - 1.0).abs() < 1e-12, "{share}");
    Ok(())
}

/// The share does not depend on the threads.
#[test]
fn the_share_is_the_same_on_any_number_of_threads() -> TestResult {
    let model = wood([70, 20, 1], Neighbourhood::moore_2d(1), RINGS, false)?;
    let of = |threads: usize| share(&model, &forced((4, threads))?, STEPS);
    let one = of(1)?;
    assert!(one < 0.7, "{one}");
    assert_eq!([of(2)?, of(3)?], [one; 2]);
    Ok(())
}
