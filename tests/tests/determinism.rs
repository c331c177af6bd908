//! Determinism as a contract: a run is a function of the model, the precision and the seed, and of nothing
//! else: not of the engine, the threads, the build, the order in which items are given, or what was run
//! before.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::{Draw, GroupSnapshot, Snapshot, Stream};
use xca_tests::suite::engines::{self, PRECISIONS, THREADS, assert_same_runs, assert_same_state};
use xca_tests::suite::lattice::Terrain;
use xca_tests::suite::medium::{Medium, Tuning};
use xca_tests::suite::recipe::Recipe;
use xca_tests::suite::walker::Walker;

/// A model with every process that reports no fault, in a space of many rows.
fn everything() -> Recipe {
    Recipe {
        extents: [11, 12, 14],
        neighbourhood: Neighbourhood::moore(1),
        boundaries: [Boundary::Toroidal, Boundary::Flat, Boundary::Toroidal].into(),
        outsides: false,
        side: 0.3,
        processes: vec![
            0, 1, 3, 14, 4, 16, 10, 5, 2, 18, 11, 6, 21, 25, 9, 12, 15, 7, 13, 22, 17, 24, 19, 23, 20,
        ],
        cadence: false,
        slots: 40,
        crowding: 6,
        aligned: false,
        salt: 99,
        tuning: Tuning {
            rate: 0.3,
            radius: 0.25,
            pace: 0.2,
            drift: Vector3::new(0.1, -0.05, 0.2),
            salt: 7,
            rarity: 0,
            greed: 0,
            torus: Vector3::splat(0),
            weights: [0.5, -0.25, 0.3],
            rains: true,
            turns_to: Terrain::Water,
            counts: [true, false, true, true],
        },
        open: true,
        steered: false,
        calm: None,
    }
}

/// FNV-1a of all bytes of a state.
fn checksum(snapshot: &Snapshot) -> u64 {
    let mut sum = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |bytes: &[u8]| {
        for byte in bytes {
            sum = (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    };
    for group in &snapshot.groups {
        match group {
            GroupSnapshot::Cells(fields) => fields.iter().for_each(|field| add(field)),
            GroupSnapshot::Population(population, left) => {
                population.counts.iter().for_each(|count| add(&count.to_le_bytes()));
                population.labels.iter().for_each(|label| add(&label.to_le_bytes()));
                population.fields.iter().for_each(|field| add(field));
                add(&left.to_le_bytes());
            }
        }
    }
    sum
}

/// The same on every machine, in every build, with every number of threads. A change of these numbers is a
/// change of what models compute: it must be meant, and told to users.
#[test]
fn the_bits_of_a_run_are_fixed() -> Result<(), Box<dyn Error>> {
    let model = everything().build()?;
    for (precision, wanted) in
        [(Precision::F32, 0x1030_09dc_e4b9_913a), (Precision::F64, 0xb330_c365_b2b8_055c)]
    {
        for engine in engines::all()? {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed: 1 })?;
            simulation.run(6)?;
            assert!(simulation.state().count_left::<Walker>()? > 0);
            let found = checksum(&simulation.snapshot()?);
            assert_eq!(found, wanted, "{found:#x} in {precision} on {}", engines::describe(&*engine));
        }
    }
    Ok(())
}

#[test]
fn the_suite_has_the_thread_counts_of_the_contract() -> Result<(), Box<dyn Error>> {
    let counts: Vec<usize> = engines::all()?.iter().map(|engine| engine.threads()).collect();
    assert_eq!(counts[0], 1);
    assert!(THREADS.iter().all(|threads| counts[1..].contains(threads)), "{counts:?}");
    Ok(())
}

#[test]
fn the_seed_matters() -> Result<(), Box<dyn Error>> {
    let model = everything().build()?;
    for engine in engines::all()? {
        let run = |seed| -> Result<Snapshot, RunError> {
            let mut simulation =
                Simulation::new(&model, &*engine, RunOptions { seed, ..RunOptions::default() })?;
            simulation.run(1)?;
            simulation.snapshot()
        };
        assert!(run(5)? == run(5)?);
        assert!(run(5)? != run(6)?);
        assert!(run(5)? != run(5 << 40)?);
    }
    Ok(())
}

/// A state is a function of its items: however they came to where they are, and in whatever order they are
/// given.
#[test]
fn history_does_not_matter() -> Result<(), Box<dyn Error>> {
    let model = everything().build()?;
    let engines = engines::all()?;
    for precision in PRECISIONS {
        let options = RunOptions { precision, seed: 3 };
        let mut oracle = Simulation::new(&model, &*engines[0], options)?;
        oracle.run(4)?;
        let mut items = oracle.state().items::<Walker>()?;
        items.sort_by_key(|item| item.label.wrapping_mul(0x2545_F491));
        oracle.state().set_items(items.clone())?;
        let wanted = oracle.snapshot()?;
        oracle.run_process(3)?;
        for engine in &engines[1..] {
            let place = || engines::describe(&**engine);
            let mut simulation = Simulation::new(&model, &**engine, options)?;
            simulation.run(4)?;
            assert_same_state(&wanted, &simulation.snapshot()?, &place);
            items.reverse();
            simulation.state().set_items(items.clone())?;
            assert_same_state(&wanted, &simulation.snapshot()?, &place);
            simulation.run_process(3)?;
            assert_same_state(&oracle.snapshot()?, &simulation.snapshot()?, &place);
        }
    }
    Ok(())
}

/// What is drawn.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Urn {
    bits: Vector2<u32>,
    number: Real,
}

/// An item that draws.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Gambler {
    bits: Vector2<u32>,
    number: Real,
}

#[elementary_process]
fn draw_lots(cell: &mut Cell<Urn>) {
    cell.bits = Vector2::new(cell.random_bits(0), cell.random_bits(4_000_000_000));
    cell.number = cell.random(17);
}

#[elementary_process]
fn gamble(me: &mut Slot<Gambler>) {
    me.bits = Vector2::new(me.random_bits(0), me.random_bits(4_000_000_000));
    me.number = me.random(17);
}

/// Random numbers are what the documentation says: Philox of seed, step, process, owner and draw.
#[test]
fn random_numbers_are_as_documented() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("draws")
        .extents([5, 3, 2])
        .substates::<Urn>()
        .population::<Gambler>(2)
        .process(draw_lots)
        .process(gamble)
        .initialise(|state| {
            let item = |label: u32| Item {
                label,
                cell: [label as usize % 5, 1, label as usize % 2],
                state: Gambler { bits: Vector2::splat(0), number: 0.0 },
            };
            Ok(state.set_items([9, 0, 4_294_967_295, 17, 3].map(item).to_vec())?)
        })
        .build()?;
    let seed = 0x0123_4567_89AB_CDEF;
    for engine in engines::all()? {
        for precision in PRECISIONS {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed })?;
            simulation.run(3)?;
            let check = |place: usize, owner: u32, bits: Vector2<u32>, number: f64| {
                let stream = Stream::process(place);
                let words = |number| Draw { stream, step: 2, owner, number }.words(seed);
                assert_eq!([bits.x, bits.y], [words(0)[0], words(4_000_000_000)[0]], "{owner}");
                let [high, low, ..] = words(17);
                let wanted = match precision {
                    Precision::F32 => f64::from(high >> 8) / 2_f64.powi(24),
                    Precision::F64 => {
                        (f64::from(high >> 5) * 2_f64.powi(26) + f64::from(low >> 6)) / 2_f64.powi(53)
                    }
                };
                assert_eq!(number, wanted, "{owner}");
                assert!((0.0..1.0).contains(&number));
            };
            let (bits, numbers) =
                (simulation.state().read(Urn::BITS)?, simulation.state().read(Urn::NUMBER)?);
            for (cell, (bits, number)) in bits.into_iter().zip(numbers).enumerate() {
                check(0, cell as u32, bits, number);
            }
            for item in simulation.state().items::<Gambler>()? {
                check(1, item.label, item.state.bits, item.state.number);
            }
        }
    }
    Ok(())
}

/// A substate that no process writes keeps its bits, whatever runs beside it: also those of a NaN and of a
/// negative zero.
#[test]
fn what_no_process_writes_keeps_its_bits() -> Result<(), Box<dyn Error>> {
    let recipe = Recipe { processes: vec![0, 2, 6, 20], ..everything() };
    let model = recipe.build()?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        simulation.state().set(Medium::LEVEL, [0, 0, 0], f64::from_bits(0x7FF8_0000_0000_1234))?;
        simulation.state().set(Medium::LEVEL, [1, 0, 0], -0.0)?;
        let bits = |simulation: &mut Simulation| -> Result<Vec<u64>, Box<dyn Error>> {
            Ok(simulation.state().read(Medium::LEVEL)?.into_iter().map(f64::to_bits).collect())
        };
        let before = bits(&mut simulation)?;
        simulation.run(3)?;
        assert_eq!(before, bits(&mut simulation)?, "{}", engines::describe(&*engine));
    }
    Ok(())
}

/// Items on a grid, many of them exactly as far apart as the radius: whether they are near is decided by the
/// last bit of a sum.
#[test]
fn near_by_a_rounding() -> Result<(), Box<dyn Error>> {
    let engines = engines::all()?;
    for side in [1.0, 0.3, 2.5e-3] {
        for boundary in [Boundary::Flat, Boundary::Toroidal] {
            let tuning = Tuning { radius: side, ..everything().tuning };
            let (boundaries, processes) = (Faces::all(boundary), vec![14, 17]);
            let recipe =
                Recipe { boundaries, side, processes, tuning, crowding: 20, aligned: true, ..everything() };
            let model = recipe.build()?;
            for precision in PRECISIONS {
                assert_same_runs(&model, &engines, RunOptions { precision, seed: 0 }, 1)?;
            }
        }
    }
    Ok(())
}
