//! What shaders look like.

use crate::common::{function, written, written_with};
use xca_core::prelude::*;
use xca_wgsl::{BindingAccess, Content, Dispatch, Options, State};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Heat {
    temperature: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Conduction {
    alpha: Real,
}

#[elementary_process]
fn diffuse(cell: &mut Cell<Heat>, p: &Conduction) {
    let mut flux = 0.0;
    for n in 1..cell.neighbour_count() {
        flux += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature = cell.temperature + p.alpha * flux;
}

const HEAT: &str = "\
// wgsl::texts::diffuse, Real = f64

alias Real = f64;

struct Space {
    extents: vec3<i32>,
    neighbours: u32,
    halo: vec3<u32>,
    row: u32,
    first: vec3<u32>,
    base: u32,
    count: vec3<u32>,
    layer: u32,
    seed: vec2<u32>,
    stream: u32,
}

struct Conduction {
    alpha: Real,
}

struct Heat {
    temperature: Real,
}

@group(0) @binding(0) var<uniform> space: Space;
@group(0) @binding(1) var<storage, read> neighbour_offsets: array<i32>;
@group(0) @binding(2) var<uniform> p: Conduction;
@group(0) @binding(3) var<storage, read> temperature_now: array<Real>;
@group(0) @binding(4) var<storage, read_write> temperature_next: array<Real>;

var<private> cell: Heat;
var<private> here: u32;

fn storage_index(index: vec3<u32>) -> u32 {
    let number: u32 = (index.x + space.halo.x) + (index.y + space.halo.y) * space.row + (index.z + space.halo.z) * space.layer;
    return number - space.base;
}

fn neighbour_at(index: u32) -> u32 {
    return u32(i32(here) + neighbour_offsets[index]);
}

fn diffuse() {
    var flux: Real = 0.0lf;
    for (var n: u32 = 1u; n < 7u; n += 1u) {
        flux += temperature_now[neighbour_at(n)] - cell.temperature;
    }
    cell.temperature = cell.temperature + p.alpha * flux;
}

fn process_cell(id: vec3<u32>) {
    here = storage_index(id);
    cell.temperature = temperature_now[here];
    diffuse();
    temperature_next[here] = cell.temperature;
}

@compute @workgroup_size(64, 1, 1)
fn main(
    @builtin(global_invocation_id) id: vec3<u32>,
) {
    if all(id < space.count) {
        process_cell(space.first + id);
    }
}
";

#[test]
fn a_whole_module() {
    let options = Options { neighbourhood_size: Some(7), ..Options::default() };
    let shader = written_with::<diffuse>(&options);
    assert_eq!(shader.source, HEAT);
    assert!(shader.needs_f64);
    assert_eq!(shader.dispatch, Dispatch::Cells([64, 1, 1]));
    let after = &shader.bindings[4];
    assert_eq!((after.name.as_str(), after.access), ("temperature_next", BindingAccess::ReadWrite));
    assert!(matches!(after.content, Content::Substate { field: 0, state: State::After, .. }));
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Life {
    alive: u8,
}

#[elementary_process]
fn live(cell: &mut Cell<Life>) {
    let mut sum = 0;
    for n in 1..cell.neighbour_count() {
        sum += cell.neighbour(n).alive;
    }
    cell.alive = match sum {
        3 => 1,
        2 => cell.alive,
        _ => 0,
    };
}

#[test]
fn bytes_are_kept_below_256() {
    let shader = written::<live>(Precision::F64);
    assert!(!shader.needs_f64);
    assert_eq!(
        function(&shader, "live"),
        "\
fn live() {
    var sum: u32 = 0u;
    for (var n: u32 = 1u; n < space.neighbours; n += 1u) {
        sum = (sum + alive_now[neighbour_at(n)]) & 0xffu;
    }
    if sum == 3u {
        cell.alive = 1u;
    } else if sum == 2u {
        cell.alive = cell.alive;
    } else {
        cell.alive = 0u;
    }
}
"
    );
}
