//! Several structs of cells and of parameters in one process; processes that run in some steps, or several
//! times in one.

use crate::common::{PRECISIONS, cells};
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Ground {
    height: Real,
    water: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Weather {
    rain: Real,
    wind: [i32; 2],
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Plants {
    cover: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Soil {
    loss: Real,
    rate: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Growth {
    rate: Real,
}

/// Writes one struct, reads two others, at neighbours too.
#[elementary_process]
fn soak(
    cell: &mut Cell<Ground>,
    weather: &Cell<Weather>,
    plants: &Cell<Plants>,
    soil: &Soil,
    growth: &Growth,
) {
    let mut around = 0.0;
    for n in 1..cell.neighbour_count() {
        let sky = weather.neighbour(n);
        around += sky.rain * sky.wind[1] as Real + plants.neighbour(n).cover + cell.neighbour(n).height;
    }
    cell.water += weather.rain * soil.rate - plants.cover * growth.rate - soil.loss;
    cell.height = around + weather.wind[0] as Real;
}

fn row() -> ModelBuilder {
    Model::builder("row")
        .extents([4, 1, 1])
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [-1, 0, 0], [1, 0, 0]]).expect("a list"))
        .substates::<Ground>()
        .substates_with_outside(Weather { rain: 100.0, wind: [0, 1] })
        .substates::<Plants>()
        .parameters(Soil { loss: 0.5, rate: 2.0 })
        .parameters(Growth { rate: 4.0 })
        .fill(|site| Ground { height: site.cell()[0] as f64, water: 10.0 })
        .fill(|site| Weather { rain: 1.0 + site.cell()[0] as f64, wind: [site.cell()[0] as i32, 3] })
        .fill(|site| Plants { cover: 0.25 * site.cell()[0] as f64 })
}

fn simulation(model: &Model, precision: Precision) -> Simulation {
    Simulation::new(model, &Reference, RunOptions { precision, ..RunOptions::default() }).expect("a start")
}

#[test]
fn a_process_reads_other_structs_of_its_cell_and_of_neighbours() {
    let model = row().process(soak).build().unwrap();
    for precision in PRECISIONS {
        let mut simulation = simulation(&model, precision);
        simulation.step().unwrap();
        for (x, ground) in cells::<Ground>(&simulation, precision).iter().enumerate() {
            let x = x as i32;
            let weight = |x: i32| match x {
                0..=3 => (1.0 + f64::from(x)) * 3.0 + 0.25 * f64::from(x) + f64::from(x),
                _ => 100.0,
            };
            assert_eq!(ground.height, weight(x - 1) + weight(x + 1) + f64::from(x));
            assert_eq!(ground.water, 10.0 + 2.0 * (1.0 + f64::from(x)) - f64::from(x) - 0.5);
        }
        assert_eq!(cells::<Weather>(&simulation, precision)[2], Weather { rain: 3.0, wind: [2, 3] });
    }
}

#[test]
fn parameters_of_one_name_are_told_apart_by_their_struct() {
    let mut model = row().process(soak).build().unwrap();
    assert_eq!(model.parameters().names(), ["loss", "Soil.rate", "Growth.rate"]);
    model.set_parameter("loss", "0.75").unwrap();
    model.set_parameter("Growth.rate", "5").unwrap();
    let error = model.set_parameter("rate", "5").unwrap_err();
    assert_eq!(error.to_string(), "several parameters are called `rate`; say which: Soil.rate, Growth.rate");
    let error = model.set_parameter("lost", "5").unwrap_err();
    assert_eq!(
        error.to_string(),
        "no parameter is called `lost`; known parameters: loss, Soil.rate, Growth.rate"
    );
    let mut simulation = simulation(&model, Precision::F64);
    let mut state = simulation.state();
    assert_eq!(state.parameters::<Growth>().unwrap().rate, 5.0);
    assert_eq!(state.parameter("Soil.rate").unwrap().to_string(), "2");
    state.set_parameters(Soil { loss: 1.0, rate: 3.0 }).unwrap();
    assert_eq!(state.parameter("Soil.rate").unwrap().to_string(), "3");
    let snapshot = simulation.snapshot().unwrap();
    assert_eq!(snapshot.parameters.len(), 3);
    let mut resumed = Simulation::resume(&model, &Reference, RunOptions::default(), &snapshot).unwrap();
    assert_eq!(resumed.state().parameters::<Soil>().unwrap().rate, 3.0);
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Walker {
    #[position]
    position: Vector3<Real>,
    found: Real,
}

/// An item looks at two structs of its cell, and at the neighbours of the cell.
#[elementary_process]
fn explore(me: &mut Slot<Walker>, ground: &Cell<Ground>, weather: &Cell<Weather>) {
    me.found = ground.height + weather.rain * 10.0 + ground.neighbour(1).height * 100.0;
    let right = weather.neighbour(2);
    me.found += right.rain * 1000.0;
}

#[test]
fn an_item_reads_several_structs_of_its_cell_and_of_neighbours() {
    let walker = |label: u32, x: usize| Item {
        label,
        cell: [x, 0, 0],
        state: Walker { position: Vector3::new(x as f64 + 0.5, 0.5, 0.5), found: 0.0 },
    };
    let model = row()
        .population::<Walker>(2)
        .initialise(move |state| Ok(state.set_items(vec![walker(0, 1), walker(1, 3)])?))
        .process(explore)
        .build()
        .unwrap();
    for precision in PRECISIONS {
        let mut simulation = simulation(&model, precision);
        simulation.step().unwrap();
        let items = simulation.state().items::<Walker>().unwrap();
        assert_eq!(items[0].state.found, 1.0 + 20.0 + 0.0 + 3000.0);
        assert_eq!(items[1].state.found, 3.0 + 40.0 + 200.0 + 100_000.0);
    }
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Counter {
    calls: u32,
    tens: u32,
    log: u32,
}

#[elementary_process]
fn count(cell: &mut Cell<Counter>) {
    cell.calls += 1;
    cell.log = cell.log * 10 + 1;
}

#[elementary_process]
fn note(cell: &mut Cell<Counter>, space: &Space) {
    cell.tens = cell.tens * 10 + space.step();
    cell.log = cell.log * 10 + 2;
}

fn counter(model: ModelBuilder, steps: u64) -> Counter {
    let model = model.build().expect("the model is right");
    let mut simulation = simulation(&model, Precision::F64);
    simulation.run(steps).expect("the steps succeed");
    cells::<Counter>(&simulation, Precision::F64)[0]
}

fn one_cell() -> ModelBuilder {
    Model::builder("one").extents([1, 1, 1]).substates::<Counter>()
}

#[test]
fn processes_run_every_so_many_steps_and_several_times_in_one() {
    // In the third step and in the sixth, which have the numbers 2 and 5.
    let every = counter(one_cell().process(count).process_every(3, note), 7);
    assert_eq!((every.calls, every.tens), (7, 25));
    let repeated = counter(one_cell().repeat(2, (count, note)), 1);
    assert_eq!(repeated.log, 1212);
    assert_eq!(counter(one_cell().process((count, note, count)), 1).log, 121);
    assert_eq!(counter(one_cell().process_every(2, (count, note)).repeat(1, count), 2).log, 1121);
}

#[test]
fn what_cannot_be_composed_is_refused() {
    let message = |model: ModelBuilder| model.build().unwrap_err().to_string();
    assert_eq!(message(one_cell().process_every(0, count)), "the interval must be at least 1 step");
    assert_eq!(
        message(one_cell().repeat(0, count)),
        "a process must run at least once in a step; leave it out instead of repeating it 0 times"
    );
    let model = || Model::builder("row").extents([4, 1, 1]).substates::<Ground>().substates::<Plants>();
    assert_eq!(
        message(model().process(soak)),
        "the process `soak` works on `Weather`, which the model does not have; add `.substates::<Weather>()` or \
         `.population::<Weather>(slots)`"
    );
    assert_eq!(
        message(model().substates::<Weather>().parameters(Soil { loss: 0.5, rate: 2.0 }).process(soak)),
        "the process `soak` takes the parameters `Growth`, which the model does not have (it has: Soil); call \
         `.parameters(Growth { … })`"
    );
}
