//! Small vectors and arrays.

use crate::common::{PRECISIONS, run, run_in};
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Motion {
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    plane: Vector2<Real>,
    grid: Vector2<i32>,
    colour: Vector4<u8>,
    energy: Real,
}

const VELOCITY: Vector3<Real> = Vector3::new(3.0, 4.0, -12.0);

const START: Motion = Motion {
    position: Vector3::new(1.0, -2.0, 0.5),
    velocity: VELOCITY,
    plane: Vector2::new(3.0, -4.0),
    grid: Vector2::new(7, -9),
    colour: Vector4::new(1, 2, 3, 4),
    energy: 0.0,
};

#[elementary_process]
fn operators(cell: &mut Cell<Motion>) {
    let v = cell.velocity;
    let x = cell.position;
    let mut sum = v + x * 2.0 - 0.5 * v / 4.0;
    sum += -x;
    sum -= Vector3::splat(0.25);
    sum *= 2.0;
    sum /= 4.0;
    sum.y = sum.y + 1.0;
    sum.z += v.dot(x);
    cell.energy = v.length() + v.length_squared() + cell.plane.length();
    cell.position = sum;
    cell.velocity = v.cross(x);
    cell.grid = cell.grid * 2 - Vector2::new(1, cell.grid.x);
    cell.colour.w = cell.colour.x + cell.colour.y;
    if v == VELOCITY || v != v {
        cell.plane = Vector2::splat(cell.energy);
    }
}

#[test]
fn operators_of_vectors() {
    let after = run(operators, START);
    let (v, x) = (START.velocity, START.position);
    let mut sum = (v + x * 2.0 - v * 0.125 - x - Vector3::splat(0.25)) * 0.5;
    sum.y += 1.0;
    sum.z += 3.0 - 8.0 - 6.0;
    assert_eq!(after.position, sum);
    assert_eq!(after.energy, 13.0 + 169.0 + 5.0);
    assert_eq!(after.velocity, Vector3::new(-22.0, -13.5, -10.0));
    assert_eq!(after.grid, Vector2::new(13, -25));
    assert_eq!(after.colour, Vector4::new(1, 2, 3, 3));
    assert_eq!(after.plane, Vector2::splat(187.0));
}

#[elementary_process]
fn rounding(cell: &mut Cell<Motion>) {
    cell.energy = (cell.position * 0.1).dot(cell.velocity / 3.0);
    cell.velocity = cell.position / cell.position.length();
}

/// The order of the operations is fixed, so that the last bit is too.
#[test]
fn rounding_of_vectors_is_fixed() {
    for precision in PRECISIONS {
        let after = run_in(rounding, START, precision);
        let (x, v) = (START.position, START.velocity);
        match precision {
            Precision::F32 => {
                let [x, v] = [x, v].map(|v| [v.x as f32, v.y as f32, v.z as f32]);
                let products = [0, 1, 2].map(|lane| (x[lane] * 0.1) * (v[lane] / 3.0));
                assert_eq!(after.energy, f64::from(products[0] + products[1] + products[2]));
                let length = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
                assert_eq!(after.velocity.y, f64::from(x[1] / length));
            }
            Precision::F64 => {
                let [x, v] = [x, v].map(|v| [v.x, v.y, v.z]);
                let products = [0, 1, 2].map(|lane| (x[lane] * 0.1) * (v[lane] / 3.0));
                assert_eq!(after.energy, products[0] + products[1] + products[2]);
                let length = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
                assert_eq!(after.velocity.y, x[1] / length);
            }
        }
    }
}

#[elementary_process]
fn arrays(cell: &mut Cell<Motion>) {
    let mut sums = [0.0; 4];
    let weights: [Real; 3] = [0.25, 0.5, 0.25];
    let mut table = [[0; 3]; 2];
    let mut points = [cell.position, cell.velocity];
    for i in 0..3 {
        sums[i + 1] = sums[i] + weights[i] * points[0].x;
        table[i % 2][i] = i as i32 + 1;
        table[1][0] += 2;
    }
    points[1].z = sums[3];
    points[0] = points[1];
    let copy = points;
    points[0].x = 99.0;
    table[1][0] += points[0].x as i32 - 99;
    table[0] = [5, 6, table[0][2]];
    cell.position = copy[0];
    cell.grid = Vector2::new(table[0][0] + table[0][2], table[1][0] + table[1][1]);
    cell.energy = sums[1] + [1.0, 2.0][1];
}

#[test]
fn arrays_are_values() {
    let after = run(arrays, START);
    assert_eq!(after.position, Vector3::new(3.0, 4.0, 1.0));
    assert_eq!(after.grid, Vector2::new(5 + 3, 6 + 2));
    assert_eq!(after.energy, 2.25);
}

#[elementary_process]
fn accumulate(cell: &mut Cell<Motion>) {
    cell.velocity += cell.velocity.cross(cell.position) + cell.velocity;
    cell.velocity.x *= cell.velocity.x + cell.position.y;
    cell.grid += cell.grid;
}

/// A compound assignment may read what it writes.
#[test]
fn compound_assignments_read_first() {
    let after = run(accumulate, START);
    assert_eq!(after.velocity, Vector3::new(-16.0 * (-16.0 - 2.0), -5.5, -34.0));
    assert_eq!(after.grid, Vector2::new(14, -18));
}
