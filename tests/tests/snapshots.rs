//! A run goes on from a snapshot as if it had never been taken apart: on any engine, with all that a state is
//! made of. What does not fit is refused, and changes nothing.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::{Fault, GroupSnapshot, Snapshot, StateError};
use xca_tests::suite::engines::{self, PRECISIONS, assert_same_runs};

#[derive(Substates, Clone, Copy)]
struct Soil {
    water: Real,
}

#[derive(Substates, Clone, Copy)]
struct Beetle {
    #[position]
    position: Vector3<Real>,
    age: u32,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Weather {
    rain: Real,
    wind: Vector2<f32>,
    patience: u32,
}

const TOO_OLD: u32 = 4;

#[elementary_process]
fn seep(cell: &mut Cell<Soil>, p: &Weather) {
    let mut water = 0.0;
    for n in 1..cell.neighbour_count() {
        water += cell.neighbour(n).water - cell.water;
    }
    cell.water += 0.1 * water + p.rain * cell.random(0);
}

#[elementary_process]
fn crawl(me: &mut Slot<Beetle>, p: &Weather) {
    me.age += 1;
    me.position.x += 0.3 * me.random(1);
    if me.age > p.patience {
        me.fault(TOO_OLD, 0.0);
    }
}

#[migration]
fn settle(me: &Slot<Beetle>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

fn beetle(label: u32) -> Item<Beetle> {
    let x = label as usize % 6;
    let position = Vector3::new(x as f64 + 0.5, 0.5, 0.5);
    Item { label, cell: [x, 0, 0], state: Beetle { position, age: 0 } }
}

/// Steering that changes a parameter and adds items between the steps, and items that leave.
fn garden() -> Result<Model, ModelError> {
    Model::builder("garden")
        .extents([6, 4, 3])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .boundaries([Boundary::Flat, Boundary::Toroidal, Boundary::Flat])
        .parameters(Weather { rain: 0.1, wind: Vector2::new(0.1, -0.0), patience: 1000 })
        .substates_with_outside(Soil { water: 2.0 })
        .population::<Beetle>(20)
        .items_may_leave::<Beetle>()
        .process(seep)
        .process(crawl)
        .process(settle)
        .initialise(|state| Ok(state.set_items((0..20).map(beetle).collect())?))
        .steer(Schedule::Every(7), |state| {
            let mut weather: Weather = state.parameters()?;
            weather.rain *= 1.1;
            weather.wind.x += 0.1;
            Ok(state.set_parameters(weather)?)
        })
        .steer(Schedule::At(vec![30]), |state| {
            let mut items = state.items::<Beetle>()?;
            items.push(beetle(100));
            Ok(state.set_items(items)?)
        })
        .stop_when(Schedule::Every(1), |state| {
            Ok((state.count_left::<Beetle>()? >= 20).then(|| "all have left".to_owned()))
        })
        .build()
}

#[test]
fn a_run_goes_on_from_anywhere_on_any_engine() -> Result<(), Box<dyn Error>> {
    let model = garden()?;
    for precision in PRECISIONS {
        let options = RunOptions { precision, seed: 11 };
        assert_same_runs(&model, &engines::all()?, options, 35)?;
        let mut whole = Simulation::new(&model, &Reference, options)?;
        whole.run(1000)?;
        assert_eq!(whole.stop_reason(), Some("all have left"));
        // Each engine hands over to the next, every few steps.
        let engines = engines::all()?;
        let mut simulation = Simulation::new(&model, &*engines[0], options)?;
        for engine in engines.iter().cycle() {
            let snapshot = simulation.snapshot()?;
            simulation = Simulation::resume(&model, &**engine, options, &snapshot)?;
            if matches!(simulation.run(3)?, Outcome::Stopped { .. }) {
                break;
            }
        }
        assert!(simulation.snapshot()? == whole.snapshot()?);
        assert_eq!(simulation.state().count_left::<Beetle>()?, whole.state().count_left::<Beetle>()?);
        // Also that it has been stopped is kept.
        let snapshot = simulation.snapshot()?;
        let mut resumed = Simulation::resume(&model, &*engines[1], options, &snapshot)?;
        assert_eq!(resumed.run(5)?, Outcome::Stopped { reason: "all have left".to_owned() });
        assert!(resumed.snapshot()? == snapshot);
    }
    Ok(())
}

#[test]
fn a_simulation_goes_back_also_after_a_fault() -> Result<(), Box<dyn Error>> {
    let model = garden()?;
    let options = RunOptions::default();
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, options)?;
        simulation.run(20)?;
        let before = simulation.snapshot()?;
        simulation.run(10)?;
        let wanted = simulation.snapshot()?;
        simulation.state().set_parameter("patience", "30")?;
        assert!(matches!(simulation.run(10), Err(RunError::Fault { fault: Fault::Reported { .. }, .. })));
        let broken = simulation.snapshot()?;
        let refused = Simulation::resume(&model, &*engine, options, &broken).map(|_| ()).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "the snapshot was taken after a fault in step 31; its state is that of an unfinished step"
        );
        simulation.restore(&before)?;
        assert!(simulation.snapshot()? == before);
        simulation.run(10)?;
        assert!(simulation.snapshot()? == wanted);
    }
    Ok(())
}

#[derive(Substates, Clone, Copy)]
struct Bits {
    number: f32,
}

#[test]
fn every_bit_is_kept() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("bits").extents([2, 1, 1]).substates::<Bits>().build()?;
    let numbers = [f32::from_bits(0x7fc1_2345), -0.0];
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        simulation.state().write(Bits::NUMBER, &numbers)?;
        let snapshot = simulation.snapshot()?;
        let mut resumed = Simulation::resume(&model, &Reference, RunOptions::default(), &snapshot)?;
        let read = resumed.state().read(Bits::NUMBER)?;
        assert_eq!(read.iter().map(|number| number.to_bits()).collect::<Vec<_>>(), numbers.map(f32::to_bits));
    }
    Ok(())
}

#[test]
fn what_does_not_fit_is_refused_and_changes_nothing() -> Result<(), Box<dyn Error>> {
    let model = garden()?;
    let options = RunOptions { precision: Precision::F64, seed: 3 };
    let population = |snapshot: &mut Snapshot, change: &dyn Fn(&mut xca_core::engine::Population)| {
        if let GroupSnapshot::Population(population, _) = &mut snapshot.groups[1] {
            change(population);
        }
    };
    type Change<'a> = &'a dyn Fn(&mut Snapshot);
    let cases: [(Change<'_>, &str); 10] = [
        (&|s| s.groups.truncate(1), "it has 1 structs of substates, not 2"),
        (&|s| s.groups.swap(0, 1), "`Soil`: the one belong to cells, the other are a population"),
        (&|s| s.parameters.truncate(2), "its parameters are not those of Weather"),
        (&|s| s.parameters[1].push(0), "its parameters are not those of Weather"),
        (
            &|s| s.groups[0] = GroupSnapshot::Cells(vec![vec![0; 4 * 72]]),
            "`Soil`: `water` takes 288 bytes, not the 576 of a run in f64",
        ),
        (&|s| s.groups[0] = GroupSnapshot::Cells(Vec::new()), "`Soil`: it has 0 substates, not 1"),
        (&|s| population(s, &|p| p.counts.truncate(71)), "`Beetle`: it has 71 cells, not 72"),
        (&|s| population(s, &|p| p.counts[3] += 1), "`Beetle`: it has 20 items, but 21 in its cells"),
        (
            &|s| population(s, &|p| p.labels.swap(0, 1)),
            "`Beetle`: the items of cell [0, 0, 0] are not in the order of their labels",
        ),
        (&|s| population(s, &|p| p.labels[3] = 19), "`Beetle`: the label 19 stands on two items"),
    ];
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, options)?;
        let snapshot = simulation.snapshot()?;
        for (change, reason) in &cases {
            let mut other = snapshot.clone();
            change(&mut other);
            let error = simulation.restore(&other).unwrap_err().to_string();
            assert_eq!(error, format!("the snapshot does not fit the model `garden`: {reason}"));
            assert!(simulation.snapshot()? == snapshot, "{reason}");
        }
        let mut full = snapshot.clone();
        population(&mut full, &|p| {
            p.counts.fill(0);
            p.counts[5] = 21;
            p.labels = (0..21).collect();
            p.fields = vec![vec![0; 21 * 24], vec![0; 21 * 4]];
        });
        let error = simulation.restore(&full).unwrap_err().to_string();
        assert!(error.ends_with("`Beetle`: cell [5, 0, 0] has 21 items in 20 slots"), "{error}");
        let single = RunOptions { precision: Precision::F32, ..options };
        assert!(Simulation::resume(&model, &*engine, single, &snapshot).is_err());
    }
    Ok(())
}

/// A type that is not there does not become another.
#[test]
fn a_restored_state_answers_as_before() -> Result<(), Box<dyn Error>> {
    let model = garden()?;
    let snapshot = Simulation::new(&model, &Reference, RunOptions::default())?.snapshot()?;
    let mut resumed = Simulation::resume(&model, &Reference, RunOptions::default(), &snapshot)?;
    let weather: Weather = resumed.state().parameters()?;
    assert_eq!(weather, Weather { rain: 0.1, wind: Vector2::new(0.1, -0.0), patience: 1000 });
    assert!(weather.wind.y.is_sign_negative());
    assert_eq!(resumed.state().count_items::<Bits>(), Err(StateError::UnknownSubstates("Bits")));
    Ok(())
}
