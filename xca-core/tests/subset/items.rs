//! Processes over items, and migrations.

use crate::common::PRECISIONS;
use xca_core::prelude::*;
use xca_core::{Draw, ElementaryProcess, ModelBuilder, Stream};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    #[position]
    centre: Vector3<Real>,
    speed: Real,
    found: u32,
    place: Vector3<i32>,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ground {
    height: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Reach {
    radius: Real,
}

/// Four cells in a row, with items labelled 1 to 6 at these coordinates.
fn row() -> ModelBuilder {
    let coordinates = [2.0, 0.25, 1.5, 0.75, 1.0, 3.5];
    Model::builder("row")
        .extents([4, 1, 1])
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [1, 0, 0], [-1, 0, 0]]).expect("a list"))
        .parameters(Reach { radius: 0.75 })
        .substates::<Ground>()
        .population::<Grain>(4)
        .items_may_leave::<Grain>()
        .initialise(move |state| {
            state.fill(|site| Ground { height: site.cell()[0] as f64 * 0.5 })?;
            let items = coordinates.iter().zip(1..).map(|(x, label)| Item {
                label,
                cell: [*x as usize, 0, 0],
                state: Grain {
                    centre: Vector3::new(*x, 0.5, 0.5),
                    speed: 0.25 * f64::from(label),
                    found: 0,
                    place: Vector3::splat(0),
                },
            });
            Ok(state.set_items(items.collect())?)
        })
}

fn after_step(model: ModelBuilder) -> Vec<Item<Grain>> {
    let model = model.build().expect("the model is right");
    let [single, double] = PRECISIONS.map(|precision| {
        let options = RunOptions { precision, seed: 7 };
        let mut simulation = Simulation::new(&model, &Reference, options).expect("starts");
        simulation.step().expect("a step");
        simulation.state().items::<Grain>().expect("items")
    });
    assert_eq!(single, double);
    double
}

fn found(model: ModelBuilder) -> Vec<(u32, u32)> {
    after_step(model).into_iter().map(|item| (item.label, item.state.found)).collect()
}

#[elementary_process]
fn all(me: &mut Slot<Grain>) {
    for other in me.others() {
        me.found = me.found * 10 + other.label();
    }
}

#[elementary_process]
fn in_cell(me: &mut Slot<Grain>) {
    for other in me.others_in_cell() {
        if other.label() == 3 {
            continue;
        }
        me.found = me.found * 10 + other.label();
    }
}

#[elementary_process]
fn in_neighbours(me: &mut Slot<Grain>) {
    for other in me.others_in_neighbours() {
        if other.label() == 5 {
            break;
        }
        me.found = me.found * 10 + other.label();
    }
}

#[elementary_process]
fn all_within(me: &mut Slot<Grain>, p: &Reach) {
    for other in me.others_within(p.radius) {
        me.found = me.found * 10 + other.label();
        if me.found > 20 {
            return;
        }
    }
    me.found += 100;
}

#[elementary_process]
fn both_within(me: &mut Slot<Grain>, p: &Reach) {
    for near in me.others_in_cell_within(p.radius) {
        for far in me.others_in_neighbours_within(p.radius + 0.25) {
            let shift = far.centre - near.centre;
            me.found = me.found * 100 + near.label() * 10 + far.label();
            me.speed += shift.x;
        }
    }
}

/// Cell 0 holds 2 and 4, cell 1 3 and 5, cell 2 1, cell 3 6.
#[test]
fn searches_come_in_the_order_of_neighbours_and_labels() {
    assert_eq!(found(row().process(all)), [(2, 435), (4, 235), (3, 5124), (5, 3124), (1, 635), (6, 1)]);
    assert_eq!(found(row().process(in_cell)), [(2, 4), (4, 2), (3, 5), (5, 0), (1, 0), (6, 0)]);
    assert_eq!(found(row().process(in_neighbours)), [(2, 3), (4, 3), (3, 124), (5, 124), (1, 63), (6, 1)]);
}

#[test]
fn searches_within_a_radius_are_strict() {
    // From 4 at 0.75 to 2 it is 0.5, to 5 0.25, to 3 exactly 0.75; from 3 to 5 and to 1 it is 0.5.
    assert_eq!(found(row().process(all_within)), [(2, 104), (4, 25), (3, 51), (5, 34), (1, 103), (6, 100)]);
    let after = after_step(row().process(both_within));
    // 4 finds 2 in its cell, and with it 3 and 5; 3 finds 5, and with it 1 and 4, but not 2 at a distance of
    // 1.25.
    let four = after.iter().find(|item| item.label == 4).expect("it is there");
    assert_eq!(four.state.found, 2325);
    assert_eq!(four.state.speed, 1.0 + 1.25 + 0.75);
    let three = after.iter().find(|item| item.label == 3).expect("it is there");
    assert_eq!(three.state.found, 51_54);
}

#[elementary_process]
fn look_around(me: &mut Slot<Grain>, ground: &Cell<Ground>, space: &Space) {
    me.place = me.index() + Vector3::splat(me.label() as i32 * 10);
    me.speed = ground.height + space.side();
    me.found = me.random_bits(3);
    me.centre.y = (me.random(4) * 8.0).floor();
}

#[test]
fn an_item_sees_its_cell_label_place_and_random_numbers() {
    for item in after_step(row().process(look_around)) {
        let Item { label, cell, state } = item;
        let ten = label as i32 * 10;
        assert_eq!(state.place, Vector3::new(cell[0] as i32 + ten, ten, ten));
        assert_eq!(state.speed, cell[0] as f64 * 0.5 + 1.0);
        let stream = Stream::process(0);
        let word = |number| Draw { stream, step: 0, owner: label, number }.words(7)[0];
        assert_eq!(state.found, word(3));
        assert_eq!(state.centre.y, (f64::from(word(4)) / 2.0_f64.powi(32) * 8.0).floor());
    }
}

#[elementary_process]
fn step_right(me: &mut Slot<Grain>) {
    me.centre.x += me.speed;
}

/// Other items show the state before, the own item what was written.
#[elementary_process]
fn write_first(me: &mut Slot<Grain>) {
    me.speed += 100.0;
    let mut fastest = me.speed;
    for other in me.others() {
        fastest = fastest.max(other.speed);
    }
    me.found = fastest as u32;
}

#[test]
fn other_items_show_the_state_before() {
    assert!(found(row().process(write_first)).iter().all(|(_, found)| (100..102).contains(found)));
}

#[migration]
fn settle(me: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(me.centre)
}

#[migration]
fn choose(me: &Slot<Grain>, ground: &Cell<Ground>, p: &Reach, space: &Space) -> Destination {
    if me.label() == 6 {
        return Destination::Outside;
    }
    for n in 0..3 {
        if me.label() == n + 1 && ground.height > p.radius - 1.0 {
            return Destination::Stay;
        }
    }
    let answer = match me.label() {
        4 => Destination::Stay,
        _ => space.cell_containing(me.centre + Vector3::new(1.0, 0.0, 0.0)),
    };
    answer
}

fn places(model: ModelBuilder) -> Vec<(usize, u32)> {
    after_step(model).into_iter().map(|item| (item.cell[0], item.label)).collect()
}

#[test]
fn migrations_move_items() {
    // 1 is at 2.25, 2 at 0.75, 3 at 2.25, 4 at 1.75, 5 at 2.25; 6 leaves.
    assert_eq!(places(row().process(step_right).process(settle)), [(0, 2), (1, 4), (2, 1), (2, 3), (2, 5)]);
    assert_eq!(places(row().process(choose)), [(0, 2), (0, 4), (1, 3), (2, 1), (2, 5)]);
}

#[test]
fn what_a_process_uses_is_known() {
    let uses = |process: xca_core::Process| {
        let fields = process.access.iter().map(|access| {
            let group = process.substates[access.argument].schema;
            (group.fields[access.field].name, access.centre, access.others, access.write)
        });
        fields.collect::<Vec<_>>()
    };
    assert_eq!(uses(all::process()), [("found", true, false, true)]);
    assert_eq!(uses(settle::process()), [("centre", true, false, false)]);
    assert_eq!(
        uses(both_within::process()),
        [
            ("centre", true, true, false),
            ("centre", false, true, false),
            ("found", true, false, true),
            ("speed", true, false, true)
        ]
    );
    assert!(all::process().local_interaction && !in_cell::process().local_interaction);
}
