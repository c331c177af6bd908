// Methods of Rust for which a process has another way.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    speed: Vector2<Real>,
    flows: [Real; 4],
    kind: i32,
}

#[elementary_process]
fn numbers(cell: &mut Cell<Heat>) {
    cell.kind = cell.kind.pow(3);
    cell.kind = i32::pow(cell.kind, 3);
    cell.kind = cell.kind.abs_diff(2);
    let up = cell.kind.is_positive();
    let down = cell.kind.is_negative();
    let right = cell.temperature.is_sign_positive();
    cell.temperature = cell.temperature.acosh();
    cell.temperature = cell.temperature.atanh();
    let (sine, cosine) = cell.temperature.sin_cos();
    let order = cell.temperature.total_cmp(1.0);
    let warm = cell.temperature.partial_cmp(1.0).unwrap();
    cell.temperature = cell.temperature.clone();
    cell.temperature = cell.kind.into();
    cell.kind = u32::try_from(cell.kind);
}

#[elementary_process]
fn vectors(cell: &mut Cell<Heat>) {
    cell.speed = cell.speed.normalized();
    cell.temperature = cell.speed.norm();
    cell.temperature = cell.speed.magnitude_squared();
}

#[elementary_process]
fn lists(cell: &mut Cell<Heat>) {
    cell.temperature = cell.flows.iter().sum();
    cell.temperature = cell.flows.sum();
    cell.flows = cell.flows.map(0.0);
    cell.flows.push(1.0);
    let last = cell.flows.pop();
    let none = cell.flows.is_empty();
}

#[elementary_process]
fn options(cell: &mut Cell<Heat>) {
    cell.temperature = cell.temperature.unwrap();
    cell.temperature = cell.temperature.expect(1.0);
    if cell.temperature.is_some() {
        cell.temperature = cell.temperature.unwrap_or(1.0);
    }
}

fn main() {}
