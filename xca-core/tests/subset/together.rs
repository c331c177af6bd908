//! Constants of processes, labels, loops over arrays and tuples together with several structs, states and
//! compositions.

use crate::common::{PRECISIONS, cells};
use xca_core::ElementaryProcess;
use xca_core::prelude::*;

const SIDES: usize = 3;

#[derive(States, Clone, Copy, Debug, PartialEq, Default)]
enum Kind {
    #[default]
    Dry,
    Wet,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Ground {
    colour: i32,
    flow: Real,
    visits: i32,
    kind: Kind,
    first: u32,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Weather {
    rain: [Real; SIDES],
    kind: Kind,
}

#[derive(Parameters, Clone, Debug)]
struct Soil {
    rate: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Growth {
    rate: Real,
    weights: [Real; SIDES],
}

/// The sum, the product and what the ground becomes.
#[helper]
fn shares<const N: usize>(values: [Real; N], growth: &Growth) -> (Real, Real, Kind) {
    let (mut sum, mut product) = (0.0, 1.0);
    for value in values {
        sum += value;
        product *= value;
    }
    let kind = if sum > 3.0 { Kind::Wet } else { Kind::Dry };
    (sum * growth.rate, product, kind)
}

/// Works on cells of one colour; reads another struct, there and at neighbours, and two structs of
/// parameters.
#[elementary_process]
fn update<const COLOUR: i32>(cell: &mut Cell<Ground>, weather: &Cell<Weather>, soil: &Soil, growth: &Growth) {
    if cell.colour != COLOUR {
        return;
    }
    cell.visits = cell.visits * 10 + COLOUR + 1;
    let (sum, product, kind): (Real, Real, Kind) = shares::<SIDES>(weather.rain, growth);
    cell.flow = sum + product * soil.rate;
    cell.kind = kind;
    'search: for n in (1..cell.neighbour_count()).rev() {
        let sky = weather.neighbour(n);
        for rain in sky.rain {
            if sky.kind == Kind::Wet && rain > 1.5 {
                cell.first = n as u32;
                break 'search;
            }
            if cell.neighbour(n).colour == 7 {
                continue 'search;
            }
        }
        for k in (0..weather.neighbour(n).rain.len()).step_by(2) {
            cell.flow += weather.neighbour(n).rain[k] * growth.weights[k];
        }
    }
}

fn row() -> ModelBuilder {
    Model::builder("row")
        .extents([4, 1, 1])
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [-1, 0, 0], [1, 0, 0]]).expect("a list"))
        .substates::<Ground>()
        .substates::<Weather>()
        .parameters(Soil { rate: 2.0 })
        .parameters(Growth { rate: 4.0, weights: [1.0, 10.0, 100.0] })
        .fill(|site| Ground { colour: site.cell()[0] as i32 % 2, ..Ground::default() })
        .fill(|site| {
            let x = site.cell()[0] as f64;
            Weather { rain: [x, 1.0, 2.0], kind: if site.cell()[0] == 3 { Kind::Wet } else { Kind::Dry } }
        })
}

fn after_a_step(model: ModelBuilder, precision: Precision) -> Vec<Ground> {
    let model = model.build().expect("the model is right");
    let options = RunOptions { precision, ..RunOptions::default() };
    let mut simulation = Simulation::new(&model, &Reference, options).expect("a start");
    simulation.step().expect("the step succeeds");
    cells(&simulation, precision)
}

#[test]
fn a_process_with_a_constant_takes_several_structs() {
    for precision in PRECISIONS {
        let ground = after_a_step(row().process((update::<0>, update::<1>)), precision);
        let own = |x: f64| (x + 3.0) * 4.0 + x * 2.0 * 2.0;
        let around = |x: f64| x + 200.0;
        let wanted = |x: usize| match x {
            // Beyond the first cell there is no rain.
            0 => own(0.0) + around(1.0),
            1 => own(1.0) + around(2.0) + around(0.0),
            // The search ends at the wet neighbour to the right, which comes first.
            2 => own(2.0),
            _ => own(3.0) + around(2.0),
        };
        for (x, cell) in ground.iter().enumerate() {
            assert_eq!(cell.flow, wanted(x), "{x}");
            assert_eq!(cell.kind, if x > 0 { Kind::Wet } else { Kind::Dry });
            assert_eq!(cell.first, if x == 2 { 2 } else { 0 });
            assert_eq!(cell.visits, x as i32 % 2 + 1);
        }
    }
}

#[test]
fn constants_compose() {
    let model = row().repeat(2, (update::<0>, update::<1>)).process_every(2, (update::<0>, update::<7>));
    let built = model.build().expect("the model is right");
    let names: Vec<_> = built.processes().iter().map(|process| process.name).collect();
    assert_eq!(names, ["update<0>", "update<1>", "update<0>", "update<1>", "update<0>", "update<7>"]);
    let ground = after_a_step(row().repeat(2, (update::<0>, update::<1>)), Precision::F64);
    assert_eq!(ground.iter().map(|cell| cell.visits).collect::<Vec<_>>(), [11, 22, 11, 22]);
    assert_eq!(update::<1>::process().substates.len(), 2);
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Walker {
    #[position]
    position: Vector3<Real>,
    found: Real,
}

#[elementary_process]
fn explore<const FACTOR: u32>(me: &mut Slot<Walker>, ground: &Cell<Ground>, weather: &Cell<Weather>) {
    'all: for other in me.others() {
        for rain in weather.rain {
            if rain == other.position.x {
                continue 'all;
            }
        }
        me.found += other.position.x * FACTOR as Real;
    }
    for n in (0..3).rev() {
        me.found = me.found * 10.0 + ground.neighbour(n).colour as Real;
    }
}

/// How many items stand in the cell, up to the first beyond a limit.
#[elementary_process]
fn count<const LIMIT: usize>(cell: &mut Cell<Ground>, weather: &Cell<Weather>, walkers: &Slots<Walker>) {
    'items: for walker in walkers {
        for k in (0..=LIMIT).step_by(1) {
            if weather.rain[k] + walker.found > 1000.0 {
                break 'items;
            }
        }
        cell.visits += 1;
    }
}

#[test]
fn items_with_constants_and_labels() {
    let walker = |label: u32, x: usize, found: f64| Item {
        label,
        cell: [x, 0, 0],
        state: Walker { position: Vector3::new(x as f64 + 0.25 * f64::from(label), 0.5, 0.5), found },
    };
    let model = row()
        .population::<Walker>(4)
        .initialise(move |state| {
            Ok(state.set_items(vec![walker(0, 1, 0.0), walker(1, 1, 0.0), walker(2, 1, 5000.0)])?)
        })
        .process((count::<2>, explore::<3>))
        .build()
        .expect("the model is right");
    for precision in PRECISIONS {
        let options = RunOptions { precision, ..RunOptions::default() };
        let mut simulation = Simulation::new(&model, &Reference, options).expect("a start");
        simulation.step().expect("the step succeeds");
        assert_eq!(cells::<Ground>(&simulation, precision)[1].visits, 2);
        let items = simulation.state().items::<Walker>().expect("items");
        // The first stands at 1, which is how much it rains: it is passed over by the others.
        assert_eq!(items[0].state.found, 3.0 * (1.25 + 1.5) * 1000.0 + 100.0 * 0.0 + 10.0 * 0.0 + 1.0);
    }
}
