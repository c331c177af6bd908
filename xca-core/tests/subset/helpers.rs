//! Functions called by processes and by ordinary code.

use crate::common::{PRECISIONS, run_in, single_cell, step};
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct State {
    a: Real,
    b: Real,
    n: u32,
    byte: u8,
    vector: Vector3<Real>,
}

#[derive(Parameters, Clone, Debug)]
struct Settings {
    scale: Real,
}

/// The square.
#[helper]
fn square(x: Real) -> Real {
    x * x
}

#[helper]
#[must_use]
fn hypotenuse(a: Real, b: Real) -> Real {
    (square(a) + square(b)).sqrt()
}

mod elsewhere {
    use super::{Settings, hypotenuse};
    use xca_core::prelude::*;

    const LIMIT: Real = 100.0;

    #[helper]
    pub(super) fn scaled(p: &Settings, x: Real, y: Real) -> Real {
        let long = hypotenuse(x, y);
        if long > LIMIT {
            return LIMIT;
        }
        p.scale * long
    }

    pub(super) mod deeper {
        use xca_core::prelude::*;

        #[helper]
        pub(crate) const fn count(limit: u32, byte: u8) -> u32 {
            let mut n = 1;
            loop {
                n *= 2;
                if n > limit {
                    return n + byte as u32;
                }
            }
        }

        #[helper]
        pub(in crate::helpers) fn sign(x: i32) -> i32 {
            match x {
                0 => 0,
                1..=2_147_483_647 => 1,
                _ => -1,
            }
        }
    }
}

#[helper]
fn later(space: &Space, step: u32) -> bool {
    space.step() >= step
}

#[helper]
fn turned(v: Vector3<Real>, quarter: bool) -> Vector3<Real> {
    if quarter { Vector3::new(-v.y, v.x, v.z) } else { v }
}

#[helper]
fn table(i: usize) -> [u32; 3] {
    let mut all = [1, 2, 3];
    all[i] *= 10;
    all
}

use elsewhere::scaled as rescaled;

#[elementary_process]
fn call(cell: &mut Cell<State>, p: &Settings, space: &Space) {
    cell.a = rescaled(p, cell.a, square(cell.b));
    cell.b = elsewhere::scaled(p, 300.0, 400.0);
    cell.n = elsewhere::deeper::count(cell.n, 1) + elsewhere::deeper::count(3, cell.byte);
    cell.byte = (elsewhere::deeper::sign(-3) + 2) as u8;
    cell.vector = turned(cell.vector, later(space, 0)) + turned(cell.vector, later(space, 1));
    cell.n += table(1)[1] + table(2)[1];
}

#[test]
fn helpers_call_helpers() {
    let before = State { a: 3.0, b: 2.0, n: 9, byte: 2, vector: Vector3::new(1.0, 2.0, 3.0) };
    let builder = single_cell(before).parameters(Settings { scale: 2.0 });
    let model = builder.process(call).build().expect("right");
    for precision in PRECISIONS {
        let after: State = step(&model, precision).expect("succeeds").remove(0);
        assert_eq!((after.a, after.b), (10.0, 100.0));
        assert_eq!((after.n, after.byte), (17 + 6 + 20 + 2, 1));
        assert_eq!(after.vector, Vector3::new(-1.0, 3.0, 6.0));
    }
}

#[test]
fn helpers_stay_ordinary_functions() {
    assert_eq!([1.0, 2.0].map(square), [1.0, 4.0]);
    assert_eq!(elsewhere::scaled(&Settings { scale: 0.5 }, 3.0, 4.0), 2.5);
    const COUNT: u32 = elsewhere::deeper::count(5, 1);
    assert_eq!(COUNT, 9);
}

#[elementary_process]
fn rounded(cell: &mut Cell<State>) {
    cell.a = hypotenuse(cell.a, cell.b);
}

#[test]
fn helpers_compute_in_the_precision_of_the_run() {
    let before = State { a: 0.1, b: 0.7, ..State::default() };
    let single = run_in(rounded, before, Precision::F32).a;
    assert_eq!(single, f64::from((0.1_f32 * 0.1 + 0.7_f32 * 0.7).sqrt()));
    assert_eq!(run_in(rounded, before, Precision::F64).a, hypotenuse(0.1, 0.7));
}

/// A process and its helpers may stand in a function, as in documentation tests.
#[test]
fn processes_within_a_function() {
    const STEP: Real = 0.25;

    #[helper]
    fn stepped(x: Real) -> Real {
        square(x) + STEP
    }

    #[elementary_process]
    fn local(cell: &mut Cell<State>) {
        cell.a = stepped(cell.a);
    }

    let after = run_in(local, State { a: 2.0, ..State::default() }, Precision::F32);
    assert_eq!(after.a, 4.25);
}
