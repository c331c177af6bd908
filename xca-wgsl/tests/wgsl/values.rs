//! Arrays, bool and states as substates, items and parameters; and what is checked of them.

use crate::common::{accepted, function, written, written_with};
use xca_core::prelude::*;
use xca_wgsl::{BindingAccess, Content, Options, Shader};

#[derive(States, Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Ground {
    Rock,
    Soil,
    Water,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Land {
    ground: Ground,
    wet: bool,
    flows: [Real; 3],
    long: [i32; 20],
    paths: [Vector2<i32>; 2],
    many: [Vector3<f32>; 9],
    seen: [Ground; 4],
    marks: [bool; 2],
    number: u32,
    sum: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    shares: [Real; 3],
    phase: Ground,
    awake: bool,
}

#[derive(Parameters, Clone, Debug)]
struct Climate {
    rains: bool,
    turns_to: Ground,
    shares: [Real; 3],
    shifts: [Vector3<Real>; 2],
    level: u8,
    always: [bool; 2],
}

#[derive(Parameters, Clone, Debug)]
struct Weather {
    rains: bool,
    turns_to: Ground,
    level: u8,
}

const TABLE: [Ground; 4] = [Ground::Rock, Ground::Soil, Ground::Water, Ground::Soil];

/// Whether faults are recorded.
fn records_faults(shader: &Shader) -> bool {
    shader.bindings.iter().any(|binding| matches!(binding.content, Content::Faults(_)))
}

#[helper]
fn worse(ground: Ground, grounds: [Ground; 4]) -> Ground {
    if ground == Ground::Water { grounds[3] } else { Ground::Water }
}

#[elementary_process]
fn states(cell: &mut Cell<Land>, weather: &Weather) {
    let next: Ground = worse(cell.ground, TABLE);
    let number = match next {
        Ground::Rock => 3,
        Ground::Soil | Ground::Water => 4,
    };
    cell.wet = weather.rains && !cell.wet;
    if cell.ground == weather.turns_to || next > Ground::Soil {
        cell.ground = next;
    }
    cell.seen = [worse(next, cell.seen); 4];
    cell.number = number + cell.ground as u32 + cell.wet as u32 + weather.level as u32;
    cell.sum = cell.seen[cell.ground as usize] as u32 as Real;
}

#[test]
fn states_are_numbers_without_arithmetic() {
    accepted::<states>();
    let shader = written::<states>(Precision::F64);
    let text = function(&shader, "states");
    assert!(text.contains("let next: u32 = worse(cell.ground, TABLE);"), "{text}");
    assert!(text.contains("    if next == Rock {\n        number = 3u;\n    } else {\n"), "{text}");
    assert!(shader.source.contains("const Water: u32 = 2u;\n"), "{}", shader.source);
    assert!(text.contains("cell.wet = (weather.rains != 0u) && !cell.wet;"), "{text}");
    assert!(text.contains("cell.seen[cell.ground]"), "{text}");
    let entry = function(&shader, "process_cell");
    assert!(entry.contains("    cell.wet = (wet_now[here] != 0u);\n"), "{entry}");
    assert!(entry.contains("    wet_now[here] = u32(cell.wet);\n"), "{entry}");
    assert!(!records_faults(&shader));
}

#[elementary_process]
fn whole(cell: &mut Cell<Land>) {
    let left = cell.neighbour(1);
    cell.flows = left.flows;
    cell.long = cell.neighbour(2).long;
    cell.paths = left.paths;
    cell.many = left.many;
    cell.marks = [left.marks[1], cell.flows == left.flows];
    cell.wet = cell.many != left.many || cell.marks != left.marks;
}

#[test]
fn whole_arrays_are_read_and_stored() {
    accepted::<whole>();
    let shader = written_with::<whole>(&Options { neighbourhood_size: Some(7), ..Options::default() });
    let text = function(&shader, "flows_at");
    assert!(
        text.contains("array<Real, 3>(flows_now[3u * number + 0u], flows_now[3u * number + 1u], "),
        "{text}"
    );
    assert!(function(&shader, "many_at").contains("value[element] = many_element_at(number, element);"));
    let text = function(&shader, "many_element_at");
    assert!(text.contains("let first: u32 = 27u * number + 3u * element;"), "{text}");
    let entry = function(&shader, "process_cell");
    assert!(entry.contains("        long_next[20u * here + element] = cell.long[element];\n"), "{entry}");
    assert!(entry.contains("    paths_next[4u * here + 3u] = cell.paths[1u].y;\n"), "{entry}");
    assert!(entry.contains("    marks_next[2u * here + 1u] = u32(cell.marks[1u]);\n"), "{entry}");
    assert!(!records_faults(&shader));
}

#[elementary_process]
fn elements(cell: &mut Cell<Land>) {
    let mut sum = cell.flows[1];
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        for k in 0..3 {
            sum += other.flows[k];
        }
        if other.marks[1] && cell.neighbour(n).seen[n as usize % 4] == Ground::Water {
            sum += cell.neighbour(n).paths[0].x as Real;
        }
    }
    cell.sum = sum;
}

#[test]
fn elements_are_read_without_the_rest() {
    accepted::<elements>();
    let options = Options {
        neighbourhood_size: Some(3),
        neighbour_offsets: Some(vec![0, -1, 1]),
        ..Options::default()
    };
    let shader = written_with::<elements>(&options);
    let text = function(&shader, "elements");
    assert!(text.contains("flows_now[3u * here + 1u]"), "{text}");
    assert!(text.contains("(marks_now[2u * other + 1u] != 0u)"), "{text}");
    assert!(text.contains("seen_now[4u * (here - 1u) + n % 4u]"), "{text}");
    assert!(text.contains("paths_element_at((here + 1u), 0u).x"), "{text}");
    assert!(!shader.source.contains("fn flows_at("), "{}", shader.source);
    assert!(!shader.source.contains("cell.flows"), "{}", shader.source);
    assert!(!records_faults(&shader));
}

#[elementary_process]
fn parameters(cell: &mut Cell<Land>, climate: &Climate) {
    let always = climate.always;
    let shares = climate.shares;
    for k in 0..2 {
        if climate.always[k] == always[1 - k] {
            cell.sum += climate.shares[k] * climate.shifts[k].z + shares[k + 1];
        }
    }
    cell.ground = climate.turns_to;
    cell.wet = climate.rains;
}

#[test]
fn parameters_with_arrays_are_in_a_storage_buffer() {
    accepted::<parameters>();
    let access = |shader: &Shader| {
        let binding =
            shader.bindings.iter().find(|binding| matches!(binding.content, Content::Parameters { .. }));
        binding.map(|binding| binding.access)
    };
    let shader = written::<parameters>(Precision::F32);
    assert_eq!(access(&shader), Some(BindingAccess::Read));
    assert!(shader.source.contains("    always: array<u32, 2>,\n"), "{}", shader.source);
    let text = function(&shader, "parameters");
    assert!(text.contains("var always: array<bool, 2> = truths_2(climate.always);"), "{text}");
    assert!(text.contains("(climate.always[k] != 0u) == always[1u - k]"), "{text}");
    assert!(!records_faults(&shader));
    assert_eq!(access(&written::<states>(Precision::F32)), Some(BindingAccess::Uniform));
}

#[elementary_process]
fn items(me: &mut Slot<Grain>, cell: &Cell<Land>) {
    me.shares[2] = cell.flows[1] + me.shares[0];
    for other in me.others_within(0.5) {
        if other.awake && other.phase == Ground::Water {
            me.shares[1] += other.shares[2];
        }
    }
    me.phase = cell.seen[me.phase as usize];
    me.awake = !me.awake;
}

#[test]
fn items_have_them_too() {
    accepted::<items>();
    let text = function(&written::<items>(Precision::F64), "items");
    assert!(text.contains("flows_now[3u * here + 1u]"), "{text}");
    assert!(text.contains("shares_now[3u * other + 2u]"), "{text}");
}

#[elementary_process]
fn checked(cell: &mut Cell<Land>, climate: &Climate) {
    let k = cell.number as usize;
    cell.flows[k] = cell.neighbour(0).flows[k] + climate.shares[k];
    cell.paths[0] = cell.paths[k] / cell.long[2];
    cell.long[1] %= cell.long[0];
    cell.ground = TABLE[k];
    let mut n = 0;
    while cell.long[n] > 0 {
        n += 1;
    }
}

#[test]
fn what_may_stop_a_process_is_checked() {
    accepted::<checked>();
    let shader = written::<checked>(Precision::F64);
    assert!(records_faults(&shader));
    let text = function(&shader, "checked");
    assert!(text.contains("    let index: u32 = checked_index(k, 3u);\n"), "{text}");
    assert!(text.contains("climate.shares[checked_index(k, 3u)]"), "{text}");
    assert!(text.contains("cell.long[1u] = checked_remainder_i32(cell.long[1u], cell.long[0u]);"), "{text}");
    assert!(
        text.contains(
            "checked_quotient_vec2_i32(cell.paths[checked_index(k, 2u)], vec2<i32>(cell.long[2u]))"
        )
    );
    assert!(text.contains("TABLE[checked_index(k, 4u)]"), "{text}");
    assert!(
        text.contains("        if has_fault {\n            break;\n        }\n        n += 1u;"),
        "{text}"
    );
}

#[elementary_process]
fn certain(cell: &mut Cell<Land>, climate: &Climate) {
    let last = cell.number % 3;
    let mut sum = climate.shares[last as usize] + TABLE[(last + 1) as usize] as u32 as Real;
    for k in 1..=2 {
        sum += cell.flows[k] * climate.shares[k - 1];
    }
    for n in 1..cell.neighbour_count() {
        sum += cell.neighbour(n).flows[n as usize / 3];
        cell.long[2 * n as usize - 1] = n as i32 / 2;
    }
    let turn = if cell.wet { 1 } else { 0 };
    cell.long[turn + cell.marks[turn] as usize] = 12 / (last as i32 + 1) + 7 % -3;
    cell.flows[(cell.number & 1) as usize] = climate.shares[cell.ground as usize];
    cell.flows[cell.number.min(2) as usize] = sum;
    while cell.number > 0 {
        cell.number /= 2;
    }
}

#[test]
fn what_cannot_go_wrong_is_not_checked() {
    let options = Options { neighbourhood_size: Some(7), ..Options::default() };
    let shader = written_with::<certain>(&options);
    assert!(!shader.source.contains("checked_"), "{}", function(&shader, "certain"));
    assert!(!shader.source.contains("has_fault"), "{}", function(&shader, "certain"));
    assert!(!records_faults(&shader));
    // With more neighbours it is not certain.
    let shader = written_with::<certain>(&Options { neighbourhood_size: Some(27), ..options });
    assert!(records_faults(&shader));
}
