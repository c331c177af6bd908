//! Names that generated code might use itself.

use crate::common::{PRECISIONS, run, single_cell, step};
use xca_core::prelude::*;

/// Substates named like what the macros need, and like Rust's own words.
#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
#[allow(non_snake_case)]
struct Names {
    x: i32,
    row: i32,
    item: i32,
    length: Real,
    parameters: i32,
    own_x: i32,
    read_x: i32,
    write_x: i32,
    r#type: i32,
    never: i32,
    substates: i32,
    index: i32,
    label: i32,
    Self_: i32,
}

#[derive(Parameters, Clone, Debug)]
struct Material {
    row: i32,
    x: i32,
    r#fn: i32,
    __real: Real,
}

// Items named like those that the macros make.
const ACCESS: i32 = 1;
const SIZE: i32 = 2;
const CHECKED: i32 = 3;
#[allow(non_upper_case_globals, dead_code)]
const x: i32 = 1_000_000;
#[allow(non_upper_case_globals, dead_code)]
const row: i32 = 1_000_000;

#[helper]
fn inner(own_x: i32, native_f32: i32) -> i32 {
    own_x * 10 + native_f32
}

#[helper]
fn row_f32(body: i32) -> i32 {
    body + 1
}

#[helper]
fn r#match(value: i32) -> i32 {
    -value
}

#[elementary_process]
fn names(me: &mut Cell<Names>, space: &Material, parameters: &Space) {
    let item = me.x + 1;
    let offsets = me.row + item;
    let found_0 = offsets * 2;
    let own_x = found_0 + me.own_x;
    let length = own_x + space.row + space.x;
    let answer = length + parameters.extents().x;
    let __xca = answer + space.r#fn;
    for first in 0..2 {
        me.write_x += first + ACCESS + SIZE + CHECKED;
    }
    me.item = item;
    me.parameters = __xca;
    me.read_x = inner(me.x, row_f32(me.row));
    me.r#type += 5;
    me.never += r#match(2);
    me.substates = me.index().x + me.index;
    me.length = space.__real;
    me.label += me.neighbour_count() as i32 + me.neighbour(0).x;
    me.Self_ += me.neighbour(0).r#type;
}

#[test]
fn no_name_meets_another() {
    let before = Names { x: 3, row: 4, own_x: 100, r#type: 1, index: 9, ..Names::default() };
    let material = Material { row: 5, x: 6, r#fn: 7, __real: 0.5 };
    let model = single_cell(before).parameters(material).process(names).build().expect("right");
    for precision in PRECISIONS {
        let after: Names = step(&model, precision).expect("succeeds").remove(0);
        let expected = Names {
            item: 4,
            parameters: (3 + 1 + 4) * 2 + 100 + 5 + 6 + 1 + 7,
            read_x: 35,
            write_x: 13,
            r#type: 6,
            never: -2,
            substates: 9,
            length: 0.5,
            label: 4,
            Self_: 1,
            ..before
        };
        assert_eq!(after, expected);
    }
    assert_eq!(Names::TYPE.name(), "type");
}

pub(crate) mod inside {
    use xca_core::prelude::*;

    #[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
    pub(crate) struct Private {
        hidden: i32,
        pub(crate) open: i32,
    }

    /// Processes see what is private in their module.
    #[elementary_process]
    pub(crate) fn reveal(cell: &mut Cell<Private>) {
        cell.hidden += 1;
        cell.open = cell.hidden;
    }

    /// In a module of its own, with types by their whole paths.
    pub(crate) mod qualified {
        #[xca_core::elementary_process]
        pub(crate) fn double(cell: &mut xca_core::Cell<super::Private>) {
            let factor: xca_core::Real = 2.0;
            let vector = xca_core::Vector2::new(factor, 1.0);
            cell.open *= (vector.x as xca_core::Real) as i32;
        }
    }
}

#[test]
fn processes_of_other_modules() {
    let once = run(inside::reveal, inside::Private::default());
    assert_eq!(once.open, 1);
    assert_eq!(run(inside::qualified::double, once).open, 2);
}

macro_rules! process_of {
    ($name:ident, $substate:ident, $amount:expr) => {
        #[elementary_process]
        fn $name(cell: &mut Cell<Names>) {
            let amount = $amount;
            cell.$substate += amount;
            cell.x += cell.$substate;
        }
    };
}

process_of!(add_two, row, 2);
process_of!(add_three, own_x, 1 + 2);

/// A process may come from a macro of the user.
#[test]
fn processes_made_by_macros() {
    assert_eq!(run(add_two, Names::default()), Names { row: 2, x: 2, ..Names::default() });
    assert_eq!(run(add_three, Names::default()), Names { own_x: 3, x: 3, ..Names::default() });
}

macro_rules! land_of {
    ($land:ident, $flow:ident, $raise:ident, $double:ident, $number:ty) => {
        #[derive(Substates, Clone, Copy, Debug, PartialEq)]
        struct $land {
            height: $number,
            slopes: [Vector2<$number>; 2],
        }

        #[derive(Parameters, Clone, Debug)]
        struct $flow {
            #[parameter(positive)]
            by: [$number; 2],
        }

        #[helper]
        fn $double(number: $number) -> $number {
            number + number
        }

        #[elementary_process]
        fn $raise(cell: &mut Cell<$land>, flow: &$flow) {
            let by: $number = flow.by[1];
            cell.height += $double(by);
            cell.slopes[1].x = cell.height;
        }
    };
}

land_of!(Coarse, CoarseFlow, raise_coarse, double_coarse, i32);
land_of!(Fine, FineFlow, raise_fine, double_fine, Real);

/// So may the type of a substate, a parameter, a variable and a helper.
#[test]
fn types_given_to_macros() {
    macro_rules! raised {
        ($land:ident, $flow:ident, $raise:ident, $from:expr, $by:expr) => {{
            let model = Model::builder("land")
                .extents([1, 1, 1])
                .substates::<$land>()
                .parameters($flow { by: [$from, $by] })
                .process($raise)
                .fill(|_| $land { height: $from, slopes: [Vector2::splat($from); 2] })
                .build()
                .expect("a model of one cell");
            let mut simulation =
                Simulation::new(&model, &Reference, RunOptions::default()).expect("it starts");
            simulation.run(3).expect("it runs");
            let state = simulation.state();
            let slopes = state.get($land::SLOPES, [0; 3]).expect("it has slopes");
            (state.get($land::HEIGHT, [0; 3]).expect("it has a height"), slopes[1])
        }};
    }
    assert_eq!(raised!(Coarse, CoarseFlow, raise_coarse, 7, 2), (19, Vector2::new(19, 7)));
    assert_eq!(raised!(Fine, FineFlow, raise_fine, 0.5, 0.25), (2.0, Vector2::new(2.0, 0.5)));
}
