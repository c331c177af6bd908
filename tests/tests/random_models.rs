//! Random models: whatever chance puts together runs on every engine with the same bits, or stops with the
//! same fault.
//!
//! The cases are the same in every run, so that a failure can be found again. `PROPTEST_RNG_SEED` chooses
//! others, `PROPTEST_CASES` more of them.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use std::cell::Cell;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, PRECISIONS, assert_same_runs, assert_same_state, outcome_text};
use xca_tests::suite::lattice::{Shape, terrain_of};
use xca_tests::suite::medium::Tuning;
use xca_tests::suite::recipe::{CALM, PROCESSES, Recipe};

/// So many cases, always the same ones, where the environment does not say something else.
fn config(cases: u32) -> Config {
    let wanted = Config::default();
    let cases = if std::env::var_os("PROPTEST_CASES").is_some() { wanted.cases } else { cases };
    let rng_seed = if wanted.rng_seed == RngSeed::Random { RngSeed::Fixed(2020) } else { wanted.rng_seed };
    Config { cases, rng_seed, failure_persistence: None, ..wanted }
}

/// Ready-made neighbourhoods and custom ones, with neighbours in any order.
fn neighbourhoods() -> impl Strategy<Value = Neighbourhood> {
    let ready_made = proptest::sample::select(Shape::ALL.to_vec()).prop_map(Shape::neighbourhood);
    let all: Vec<[i32; 3]> =
        (0..100).map(|n| [n % 5 - 2, n / 5 % 4 - 1, n / 20 - 3]).filter(|at| *at != [0; 3]).collect();
    let custom = proptest::sample::subsequence(all, 0..7).prop_shuffle().prop_map(|mut displacements| {
        displacements.insert(0, [0; 3]);
        Neighbourhood::custom(displacements).unwrap_or_else(|_| Neighbourhood::von_neumann(0))
    });
    prop_oneof![3 => ready_made, 2 => custom]
}

fn tunings() -> impl Strategy<Value = Tuning> {
    let numbers = (0.0..0.9, 0.05..1.6, 0.05..0.7, [-0.5..0.5, -0.5..0.5, -0.5..0.5]);
    let rarity = prop_oneof![6 => Just(0_u32), 1 => 100_u32..2000];
    let greed = prop_oneof![9 => Just(0_u32), 1 => Just(1_u32)];
    (numbers, any::<u16>(), rarity, greed).prop_map(
        |((rate, radius, pace, [x, y, z]), salt, rarity, greed)| {
            let drift = Vector3::new(x, y, z);
            let salt = u32::from(salt);
            Tuning {
                rate,
                radius,
                pace,
                drift,
                salt,
                rarity,
                greed,
                torus: Vector3::splat(0),
                weights: [rate, -x, 0.25 + y],
                rains: salt % 2 == 1,
                turns_to: terrain_of(salt / 2),
                counts: [8, 9, 10, 11].map(|bit| salt >> bit & 1 == 1),
            }
        },
    )
}

fn spaces() -> impl Strategy<Value = ([usize; 3], Faces<Boundary>, f64)> {
    // With one thread it takes more than 32 rows for two to be worked on together.
    let extents = prop_oneof![5 => [1_usize..7, 1..6, 1..5], 1 => [1_usize..5, 5..9, 6..12]];
    let boundary =
        || proptest::sample::select(vec![Boundary::Flat, Boundary::Toroidal, Boundary::Reflecting]);
    let axes = [boundary(), boundary(), boundary()].prop_map(Faces::from);
    let bounded = || proptest::sample::select(vec![Boundary::Flat, Boundary::Reflecting]);
    let faces = [bounded(), bounded(), bounded(), bounded(), bounded(), bounded()];
    let faces = faces.prop_map(|[west, east, south, north, bottom, top]| Faces {
        west,
        east,
        south,
        north,
        bottom,
        top,
    });
    // An engine may take short cuts where no axis leads back.
    let boundaries = prop_oneof![1 => Just(Faces::all(Boundary::Flat)), 2 => axes, 1 => faces];
    (extents, boundaries, proptest::sample::select(vec![1.0, 0.3, 2.5e-3]))
}

/// Slots, items in the fullest cells, whether they stand on a grid, whether they may leave.
fn populations() -> impl Strategy<Value = (usize, usize, bool, bool)> {
    let slots = prop_oneof![1 => Just(0_usize), 3 => 1_usize..20];
    (slots, 1_usize..9, proptest::bool::weighted(0.25), proptest::bool::weighted(0.8))
}

fn recipes() -> impl Strategy<Value = Recipe> {
    let processes = proptest::collection::vec(0..PROCESSES, 1..=6);
    let rest = (any::<u32>(), tunings(), any::<bool>(), any::<bool>());
    (spaces(), neighbourhoods(), populations(), processes, rest).prop_map(
        |(space, neighbourhood, population, processes, (salt, mut tuning, steered, cadence))| {
            let (extents, boundaries, side) = space;
            let (slots, crowding, aligned, open) = population;
            tuning.radius = if aligned { side } else { tuning.radius * side };
            Recipe {
                extents,
                neighbourhood,
                boundaries,
                outsides: true,
                side,
                processes,
                cadence,
                slots,
                crowding,
                aligned,
                salt,
                calm: None,
                tuning,
                open,
                steered,
            }
        },
    )
}

/// Models in which nearly all cells are at rest at first, in rows of many pieces.
fn calm_recipes() -> impl Strategy<Value = Recipe> {
    let extents = prop_oneof![[30_usize..80, 1..5, 1..4], [1_usize..6, 20..40, 1..3]];
    let processes = proptest::collection::vec(proptest::sample::select(CALM.to_vec()), 1..=4);
    (recipes(), extents, processes, 20_u32..200).prop_map(|(mut recipe, extents, processes, rarity)| {
        recipe.tuning.rains = false;
        recipe.crowding = 1;
        Recipe { extents, processes, calm: Some(rarity), ..recipe }
    })
}

fn options() -> impl Strategy<Value = RunOptions> {
    (proptest::sample::select(PRECISIONS.to_vec()), any::<u64>())
        .prop_map(|(precision, seed)| RunOptions { precision, seed })
}

#[test]
fn same_bits_on_every_engine() {
    let all = engines::all().expect("engines");
    let cases = Cell::new(0);
    proptest!(config(1200), |(recipe in recipes(), options in options(), steps in 1_u64..7)| {
        cases.set(cases.get() + 1);
        let engines = engines::for_case(&all, cases.get(), engines::GPU_SHARE);
        match assert_same_runs(&recipe.build()?, engines, options, steps) {
            Ok(()) | Err(RunError::Fault { .. }) => {}
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        }
    });
}

/// What is at rest is woken by its neighbours, beyond faces too, by steering, by parameters and by items.
#[test]
fn what_is_at_rest_wakes_up_on_every_engine() {
    let all = engines::all().expect("engines");
    let cases = Cell::new(0);
    proptest!(config(400), |(recipe in calm_recipes(), options in options(), steps in 6_u64..16)| {
        cases.set(cases.get() + 1);
        let engines = engines::for_case(&all, cases.get(), engines::SMALL_GPU_SHARE);
        match assert_same_runs(&recipe.build()?, engines, options, steps) {
            Ok(()) | Err(RunError::Fault { .. }) => {}
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        }
    });
}

/// Processes one by one, in any order and number: engines may run processes together or apart.
#[test]
fn same_bits_process_by_process() {
    let all = engines::all().expect("engines");
    let cases = Cell::new(0);
    let orders = proptest::collection::vec(any::<prop::sample::Index>(), 1..9);
    proptest!(config(500), |(recipe in recipes(), options in options(), order in orders)| {
        let model = recipe.build()?;
        let processes = model.processes().len();
        if processes == 0 {
            return Ok(());
        }
        cases.set(cases.get() + 1);
        let engines = engines::for_case(&all, cases.get(), engines::GPU_SHARE);
        let mut oracle = Simulation::new(&model, &*engines[0], options)?;
        let mut others = Vec::new();
        for engine in &engines[1..] {
            others.push((engines::describe(&**engine), Simulation::new(&model, &**engine, options)?));
        }
        for index in order {
            let process = index.index(processes);
            let outcome = oracle.run_process(process);
            for (name, simulation) in &mut others {
                prop_assert_eq!(outcome_text(&outcome), outcome_text(&simulation.run_process(process)));
                if outcome.is_ok() {
                    let called = model.processes()[process].name;
                    let place = || format!("`{called}` alone on {name}");
                    assert_same_state(&oracle.snapshot()?, &simulation.snapshot()?, &place);
                }
            }
            if outcome.is_err() {
                break;
            }
        }
    });
}

/// A step is its processes one after the other, on each engine by itself.
#[test]
fn a_step_is_its_processes_in_order() {
    let all = engines::all().expect("engines");
    let cases = Cell::new(0);
    proptest!(config(300), |(recipe in recipes(), options in options())| {
        let recipe = Recipe { steered: false, ..recipe };
        let model = recipe.build()?;
        cases.set(cases.get() + 1);
        for engine in engines::for_case(&all, cases.get(), engines::GPU_SHARE) {
            let mut whole = Simulation::new(&model, &**engine, options)?;
            let mut apart = Simulation::new(&model, &**engine, options)?;
            let outcome = whole.step();
            let pieces = (0..model.processes().len()).try_for_each(|process| apart.run_process(process));
            prop_assert_eq!(outcome_text(&outcome), outcome_text(&pieces));
            if outcome.is_ok() {
                prop_assert_eq!(whole.snapshot()?.groups, apart.snapshot()?.groups);
            }
        }
    });
}
