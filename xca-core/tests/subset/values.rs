//! Arrays, bool and states as substates of cells and items, and as parameters.

use crate::common::{PRECISIONS, cells, failure, run, step};
use xca_core::prelude::*;

#[derive(States, Clone, Copy, Debug, PartialEq, Default)]
enum Ground {
    #[default]
    Rock,
    Soil,
    Water,
}

const LENGTH: usize = 3;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Land {
    ground: Ground,
    wet: bool,
    flows: [Real; LENGTH],
    paths: [Vector2<i32>; 2],
    seen: [Ground; 4],
    marks: [bool; 2],
    sum: Real,
}

#[derive(Parameters, Clone, Debug, PartialEq)]
struct Climate {
    rains: bool,
    turns_to: Ground,
    shares: [Real; LENGTH],
    shifts: [Vector2<Real>; 2],
    level: u8,
    always: [bool; 2],
}

fn climate() -> Climate {
    Climate {
        rains: true,
        turns_to: Ground::Water,
        shares: [0.5, 0.25, 0.125],
        shifts: [Vector2::new(1.0, 2.0), Vector2::new(3.0, 4.0)],
        level: 7,
        always: [false, true],
    }
}

#[elementary_process]
fn single(cell: &mut Cell<Land>, climate: &Climate) {
    cell.wet = climate.rains && !cell.wet;
    let mut k = 0;
    while k < LENGTH {
        cell.flows[k] = cell.flows[k] + climate.shares[k] * climate.shifts[1].y;
        cell.sum += cell.flows[k];
        k += 1;
    }
    cell.paths[1].x = cell.paths[0].y + climate.level as i32;
    cell.paths[0] = Vector2::new(5, 6);
    match cell.ground {
        Ground::Rock => cell.seen[0] = climate.turns_to,
        Ground::Soil | Ground::Water => cell.seen[1] = Ground::Soil,
    }
    if cell.ground == Ground::Rock && climate.always[1] {
        cell.ground = Ground::Soil;
    }
    cell.seen[2 + cell.wet as usize] = cell.ground;
    cell.marks = [cell.wet, cell.ground != Ground::Soil];
}

#[test]
fn own_values_are_read_and_written_element_by_element() {
    let before = Land {
        ground: Ground::Rock,
        flows: [1.0, 2.0, 3.0],
        paths: [Vector2::new(1, 2), Vector2::new(3, 4)],
        ..Land::default()
    };
    let model = || Model::builder("land").extents([1, 1, 1]).substates::<Land>().parameters(climate());
    let model = model().process(single).fill(move |_| before).build().unwrap();
    for precision in PRECISIONS {
        let after = step::<Land>(&model, precision).unwrap().remove(0);
        let expected = Land {
            ground: Ground::Soil,
            wet: true,
            flows: [3.0, 3.0, 3.5],
            paths: [Vector2::new(5, 6), Vector2::new(9, 4)],
            seen: [Ground::Water, Ground::Rock, Ground::Rock, Ground::Soil],
            marks: [true, false],
            sum: 9.5,
        };
        assert_eq!(after, expected);
    }
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Lane {
    flows: [Real; 2],
    states: [Ground; 2],
    total: Real,
    wet: u32,
    first: [Real; 2],
}

/// What flows in from the neighbours, read by element, by name and as a whole.
#[elementary_process]
fn exchange(cell: &mut Cell<Lane>) {
    let mut total = 0.0;
    let mut wet = 0;
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        for k in 0..2 {
            total += (k as Real + 1.0) * other.flows[k];
            if other.states[k] == Ground::Water {
                wet += 1;
            }
        }
        total -= cell.neighbour(n).flows[0];
    }
    let left = cell.neighbour(1);
    cell.first = left.flows;
    cell.total = total;
    cell.wet = wet;
    cell.flows[0] = cell.flows[0] + 100.0;
    cell.flows[1] = cell.neighbour(0).flows[0];
}

#[test]
fn neighbours_show_arrays_from_before_the_process() {
    let lane = |x: usize| Lane {
        flows: [x as f64 + 1.0, 10.0 * (x as f64 + 1.0)],
        states: [Ground::Soil, if x.is_multiple_of(2) { Ground::Water } else { Ground::Rock }],
        ..Lane::default()
    };
    let outside = Lane { flows: [0.5, 0.25], states: [Ground::Water; 2], ..Lane::default() };
    let model = Model::builder("lane")
        .extents([5, 1, 1])
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [-1, 0, 0], [1, 0, 0]]).unwrap())
        .substates_with_outside(outside)
        .process(exchange)
        .fill(move |site| lane(site.cell()[0]))
        .build()
        .unwrap();
    for precision in PRECISIONS {
        let after = step::<Lane>(&model, precision).unwrap();
        for (x, cell) in after.iter().enumerate() {
            let left = if x == 0 { outside } else { lane(x - 1) };
            let right = if x == 4 { outside } else { lane(x + 1) };
            let sums = [left, right].map(|one| 2.0 * one.flows[1]);
            assert_eq!(cell.total, sums[0] + sums[1], "{x}");
            let wet =
                [left, right].map(|one| one.states.iter().filter(|state| **state == Ground::Water).count());
            assert_eq!(cell.wet as usize, wet[0] + wet[1], "{x}");
            assert_eq!(cell.first, left.flows, "{x}");
            assert_eq!(cell.flows, [lane(x).flows[0] + 100.0, lane(x).flows[0]], "{x}");
        }
    }
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    history: [Real; 4],
    phase: Ground,
    awake: bool,
    meetings: [u32; 2],
}

#[elementary_process]
fn meet(me: &mut Slot<Grain>) {
    let mut k = 3;
    while k > 0 {
        me.history[k] = me.history[k - 1];
        k -= 1;
    }
    me.history[0] = me.position.x;
    for other in me.others_within(0.6) {
        me.meetings[0] += other.meetings[1] + 1;
        if other.awake && other.phase == Ground::Water {
            me.meetings[1] += 10;
        }
    }
    me.awake = !me.awake;
}

#[elementary_process]
fn gather(cell: &mut Cell<Lane>, grains: &Slots<Grain>) {
    for grain in grains {
        cell.total += grain.history[1];
        if grain.phase == Ground::Water {
            cell.states[1] = grain.phase;
        }
    }
}

#[elementary_process]
fn look_down(me: &mut Slot<Grain>, cell: &Cell<Lane>) {
    me.history[3] = cell.flows[me.meetings[0] as usize] + cell.flows[1];
    me.phase = cell.states[0];
}

#[test]
fn items_hold_arrays_bool_and_states() {
    let grain = |label: u32, x: f64, phase: Ground| Item {
        label,
        cell: [x as usize, 0, 0],
        state: Grain {
            position: Vector3::new(x, 0.5, 0.5),
            history: [1.0, 2.0, 3.0, 4.0],
            phase,
            awake: true,
            meetings: [0, label],
        },
    };
    let items = move || {
        vec![grain(0, 0.75, Ground::Water), grain(1, 1.25, Ground::Soil), grain(2, 2.75, Ground::Rock)]
    };
    let model = Model::builder("grains")
        .extents([3, 1, 1])
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [-1, 0, 0], [1, 0, 0]]).unwrap())
        .substates::<Lane>()
        .population::<Grain>(4)
        .process(meet)
        .process(gather)
        .process(look_down)
        .initialise(move |state| Ok(state.set_items(items())?))
        .fill(|site| Lane {
            flows: [site.cell()[0] as f64, 10.0],
            states: [Ground::Water; 2],
            ..Lane::default()
        })
        .build()
        .unwrap();
    for precision in PRECISIONS {
        let options = RunOptions { precision, ..RunOptions::default() };
        let mut simulation = Simulation::new(&model, &Reference, options).unwrap();
        simulation.run_process(0).unwrap();
        let state = simulation.state();
        let grains = state.items::<Grain>().unwrap();
        assert_eq!(grains[0].state.history, [0.75, 1.0, 2.0, 3.0]);
        assert_eq!(grains[0].state.meetings, [2, 0]);
        // The first one is water, and awake as it was before.
        assert_eq!(grains[1].state.meetings, [1, 11]);
        assert_eq!(grains[2].state.meetings, [0, 2]);
        assert!(grains.iter().all(|grain| !grain.state.awake));
        simulation.run_process(1).unwrap();
        let lanes = cells::<Lane>(&simulation, precision);
        assert_eq!(lanes.map_totals(), [1.0, 1.0, 1.0]);
        // In the third cell, meetings[0] is 0; in the first it is 2, beyond the array.
        let error = simulation.run_process(2).unwrap_err().to_string();
        assert!(error.contains("`look_down` panicked for item 0 in cell [0, 0, 0]"), "{error}");
        assert!(error.contains("the len is 2 but the index is 2"), "{error}");
    }
}

trait Totals {
    fn map_totals(&self) -> Vec<f64>;
}

impl Totals for Vec<Lane> {
    fn map_totals(&self) -> Vec<f64> {
        self.iter().map(|lane| lane.total).collect()
    }
}

#[elementary_process]
fn too_far(cell: &mut Cell<Lane>) {
    let k = cell.wet as usize;
    cell.total = cell.flows[k];
}

#[elementary_process]
fn too_far_at_a_neighbour(cell: &mut Cell<Lane>) {
    let k = cell.wet as usize;
    cell.total = cell.neighbour(0).flows[k];
}

#[elementary_process]
fn too_far_to_write(cell: &mut Cell<Lane>) {
    let k = cell.wet as usize;
    cell.flows[k] = 1.0;
}

#[test]
fn an_element_beyond_an_array_is_a_fault() {
    let before = Lane { wet: 2, ..Lane::default() };
    for message in
        [failure(too_far, before), failure(too_far_at_a_neighbour, before), failure(too_far_to_write, before)]
    {
        assert!(
            message.ends_with(
                "panicked in cell [0, 0, 0]: index out of bounds: the len is 2 but the index is 2"
            ),
            "{message}"
        );
    }
    let fits = Lane { wet: 1, flows: [3.0, 4.0], ..Lane::default() };
    assert_eq!(run(too_far, fits).total, 4.0);
    assert_eq!(run(too_far_at_a_neighbour, fits).total, 4.0);
    assert_eq!(run(too_far_to_write, fits).flows, [3.0, 1.0]);
}

#[test]
fn parameters_are_set_by_the_names_of_values() {
    let mut values = climate();
    values.set("rains", "false").unwrap();
    values.set("turns_to", "Soil").unwrap();
    values.set("shares", "1, 2, 3").unwrap();
    values.set("shifts", "1,2,3,4.5").unwrap();
    values.set("always", "true, false").unwrap();
    assert_eq!(
        values,
        Climate {
            rains: false,
            turns_to: Ground::Soil,
            shares: [1.0, 2.0, 3.0],
            shifts: [Vector2::new(1.0, 2.0), Vector2::new(3.0, 4.5)],
            level: 7,
            always: [true, false],
        }
    );
    assert_eq!(values.get("turns_to").unwrap().to_string(), "Soil");
    assert_eq!(values.get("always").unwrap().to_string(), "true, false");
    let message = |name: &str, text: &str| values.clone().set(name, text).unwrap_err().to_string();
    assert_eq!(
        message("turns_to", "Lava"),
        "`Lava` is no value for the parameter `turns_to`, which is a Ground: Rock, Soil, Water"
    );
    assert_eq!(
        message("rains", "1"),
        "`1` is no value for the parameter `rains`, which is a bool: true or false"
    );
    assert_eq!(
        message("shares", "1,2"),
        "`1,2` is no value for the parameter `shares`, which is a [Real; 3]"
    );
    assert_eq!(message("level", "256"), "`256` is no value for the parameter `level`, which is a u8");
}

#[test]
fn the_host_reads_writes_and_reduces_them() {
    let model = Model::builder("land")
        .extents([3, 2, 1])
        .substates::<Land>()
        .fill(|site| {
            let [x, y, _] = site.cell();
            Land {
                ground: if x == 1 { Ground::Water } else { Ground::Rock },
                wet: y == 1,
                flows: [x as f64, y as f64, 1.0],
                ..Land::default()
            }
        })
        .build()
        .unwrap();
    for precision in PRECISIONS {
        let options = RunOptions { precision, ..RunOptions::default() };
        let mut simulation = Simulation::new(&model, &Reference, options).unwrap();
        let mut state = simulation.state();
        assert_eq!(state.count(Land::GROUND, Ground::Water).unwrap(), 2);
        assert_eq!(state.count(Land::WET, true).unwrap(), 3);
        assert_eq!(state.sum(Land::WET).unwrap(), 3);
        assert_eq!(state.maximum(Land::WET).unwrap(), Some(true));
        assert_eq!(state.sum(Land::FLOWS).unwrap(), [6.0, 3.0, 6.0]);
        assert_eq!(state.maximum(Land::FLOWS).unwrap(), Some([2.0, 1.0, 1.0]));
        state.set(Land::GROUND, [0, 0, 0], Ground::Soil).unwrap();
        state.set(Land::FLOWS, [2, 1, 0], [7.0, 8.0, 9.0]).unwrap();
        assert_eq!(state.get(Land::GROUND, [0, 0, 0]).unwrap(), Ground::Soil);
        assert_eq!(state.read(Land::FLOWS).unwrap()[5], [7.0, 8.0, 9.0]);
        let mut all = state.read(Land::SEEN).unwrap();
        all[3][2] = Ground::Water;
        state.write(Land::SEEN, &all).unwrap();
        assert_eq!(state.get(Land::SEEN, [0, 1, 0]).unwrap()[2], Ground::Water);
    }
}

/// A helper takes states and arrays of them, and gives them back.
#[helper]
fn worse(ground: Ground, grounds: [Ground; 4]) -> Ground {
    if ground == Ground::Water { grounds[3] } else { Ground::Water }
}

const TABLE: [Ground; 4] = [Ground::Rock, Ground::Soil, Ground::Water, Ground::Soil];

#[elementary_process]
fn ask(cell: &mut Cell<Land>) {
    let next: Ground = worse(cell.ground, TABLE);
    cell.ground = next;
    cell.seen = [worse(next, cell.seen); 4];
    cell.sum = cell.ground as u32 as Real;
}

#[test]
fn helpers_and_constants_have_states() {
    let before = Land { ground: Ground::Water, ..Land::default() };
    let after = run(ask, before);
    assert_eq!(after.ground, Ground::Soil);
    assert_eq!(after.seen, [Ground::Water; 4]);
    assert_eq!(after.sum, 1.0);
}

#[test]
fn a_snapshot_with_a_number_that_is_no_state_is_refused() {
    let model = Model::builder("land").extents([2, 1, 1]).substates::<Land>().build().unwrap();
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default()).unwrap();
    let mut snapshot = simulation.snapshot().unwrap();
    let xca_core::GroupSnapshot::Cells(fields) = &mut snapshot.groups[0] else { panic!("cells") };
    fields[0][1] = 3;
    let error = simulation.restore(&snapshot).unwrap_err().to_string();
    assert!(error.ends_with("`Land`: `ground` is a Ground: Rock, Soil, Water, which 3 is not"), "{error}");
}
