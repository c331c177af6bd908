//! Each construct of the accepted subset of Rust.

use crate::common::{accepted, function, written, written_with};
use xca_core::Parity;
use xca_core::prelude::*;
use xca_wgsl::Options;

const WEIGHTS: [Real; 3] = [0.25, 0.5, 0.25];
const STEPS: [Vector2<i32>; 2] = [Vector2::new(1, 0), Vector2::new(0, -1)];
const GRAVITY: Vector3<Real> = Vector3::new(0.0, 0.0, -9.81);
const LIMIT: Real = Real::MAX;
const INFINITE: Real = Real::INFINITY;
const LIMITS: [Real; 3] = [0.0, Real::INFINITY, -0.0];
const LOWEST: i32 = i32::MIN;
const MASK: u32 = 0xdead_beef;
const LIVING: u8 = 3;
const PERIODIC: bool = true;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct State {
    byte: u8,
    signed: i32,
    unsigned: u32,
    single: f32,
    double: f64,
    real: Real,
    velocity: Vector3<Real>,
    grid: Vector2<i32>,
    colour: Vector4<u8>,
}

#[derive(Parameters, Clone, Debug)]
struct Settings {
    scale: Real,
    wind: Vector3<Real>,
    rule: u32,
}

#[elementary_process]
fn bytes(cell: &mut Cell<State>) {
    let mut n = 0;
    n += cell.byte;
    n = n * 3 - 1;
    n <<= 2;
    n ^= !cell.byte;
    let shifted = cell.byte << (cell.unsigned & 3);
    let half = n >> 1;
    n = n.wrapping_add(shifted).wrapping_mul(half).wrapping_sub(1);
    n %= 7;
    n |= 8;
    n &= 0x7f;
    let count = n.count_ones();
    cell.byte = (n + count as u8).min(250).max(3);
    cell.colour = Vector4::new(n, 1, 2, cell.byte) + cell.colour;
}

#[test]
fn u8_wraps() {
    accepted::<bytes>();
    let text = function(&written::<bytes>(Precision::F64), "bytes");
    assert!(text.contains("    n = (n + cell.byte) & 0xffu;\n"), "{text}");
    assert!(
        text.contains("    n = ((n * 3u) - 1u) & 0xffu;\n") || text.contains("& 0xffu) - 1u) & 0xffu;\n"),
        "{text}"
    );
    assert!(
        text.contains("    n = n ^ (~cell.byte & 0xffu);\n") || text.contains("n ^ ((~cell.byte) & 0xffu)"),
        "{text}"
    );
    assert!(text.contains("(cell.byte << (cell.unsigned_ & 7u))") || text.contains("& 7u"), "{text}");
}

#[elementary_process]
fn integers(cell: &mut Cell<State>) {
    let mut a = cell.signed;
    a = -a + LOWEST;
    a = a.abs() % 5 - 2147483647;
    let b = -2147483648;
    if a == b {
        a = !a;
    }
    a >>= 3;
    a <<= cell.byte;
    let c = a as u32 ^ MASK;
    let d = (c as u8) as i32 + (a > 0) as i32;
    cell.unsigned = c.wrapping_mul(747796405).wrapping_add(2891336453) >> 22;
    cell.signed = (d.clamp(-5, 5) + a.max(b).count_ones() as i32) / 2;
    cell.grid = STEPS[cell.unsigned as usize % 2] - cell.grid;
    cell.grid.x += cell.index().x + 1;
}

#[test]
fn integers_are_rusts() {
    accepted::<integers>();
    let text = function(&written::<integers>(Precision::F32), "integers");
    assert!(text.contains("let b: i32 = i32(-2147483648);"), "{text}");
    assert!(text.contains("a = a << (cell.byte & 31u);"), "{text}");
    assert!(text.contains("STEPS[cell.unsigned % 2u]"), "{text}");
}

#[elementary_process]
fn floats(cell: &mut Cell<State>, p: &Settings) {
    let mut x = cell.real * p.scale - 0.5;
    x = x.min(LIMIT).max(-1e-5).clamp(-2.0, 2.0);
    let y = (x * x + 1.0).sqrt().floor() + x.ceil().abs() - x.trunc();
    let single = y as f32;
    let double = x as f64 + 0.1;
    cell.single = single + 1.5 - cell.signed as f32;
    cell.double = double / 3.0 + cell.unsigned as f64;
    let n = y as i32 + (y as u8) as i32 - (y as u32) as i32;
    let mut count = 0.0;
    for i in 0..3 {
        count += WEIGHTS[i] * (n as Real);
    }
    cell.real = if count > 1.0 / 3.0 && count != -0.0 { count } else { -y };
    cell.single = cell.single * 0.1 + cell.double as f32;
    cell.real += 2.5 as Real;
}

#[test]
fn floats_keep_their_types() {
    accepted::<floats>();
    let text = function(&written::<floats>(Precision::F32), "floats");
    assert!(text.contains("let single: f32 = y;"), "{text}");
    assert!(text.contains("let double: f64 = f64(x) + 0.1lf;"), "{text}");
    assert!(text.contains("var count: Real = 0.0f;"), "{text}");
    assert!(text.contains("saturate_u8_from_real(y)"), "{text}");
    // naga's `!=` of floats is false for NaN.
    assert!(text.contains("!(count == (-0.0f))"), "{text}");
    assert!(text.contains("cell.real = select(-y, count, "), "{text}");
}

#[elementary_process]
fn edges(cell: &mut Cell<State>) {
    let x = cell.real;
    let y = cell.velocity.x;
    let least = x.min(y);
    let most = x.max(y);
    cell.signed = x as i32 ^ (least as i32).abs() ^ y as u32 as i32 ^ (x as u8) as i32;
    cell.unsigned = (x as u32) ^ (cell.unsigned << cell.byte) ^ (cell.signed >> (cell.byte + 25)) as u32;
    cell.byte = y as u8 ^ (cell.byte << (cell.byte & 15));
    cell.single = most as f32;
    cell.double = x.clamp(-1.5, 1e30) as f64 + cell.signed as f64;
    if x < INFINITE && !(y > -INFINITE) {
        cell.real = -0.0;
    } else if least != most {
        cell.real = x / y + LIMITS[(cell.unsigned % 3) as usize];
    }
}

#[test]
fn edges_of_types() {
    accepted::<edges>();
}

#[elementary_process]
fn vectors(cell: &mut Cell<State>, p: &Settings) {
    let mut v = cell.velocity + GRAVITY * 0.1 - 2.0 * p.wind;
    v *= 0.5;
    v += Vector3::splat(1.0);
    v -= p.wind / 3.0;
    v /= p.scale;
    v.z = -v.z;
    let w = Vector3::new(v.y, 0.0, 1.0).cross(-v);
    let d = v.dot(w) + (v - w).length_squared() + v.length();
    if v == w || v != -w {
        v.x = d;
    }
    cell.velocity = v;
    cell.velocity.y += 1.0;
}

#[test]
fn vectors_are_added_in_order() {
    accepted::<vectors>();
    let shader = written::<vectors>(Precision::F64);
    let dot = function(&shader, "dot_vec3_real");
    assert!(dot.contains("return a.x * b.x + a.y * b.y + a.z * b.z;"), "{dot}");
}

#[elementary_process]
fn shadowing(cell: &mut Cell<State>) {
    let x = cell.signed;
    let x = x + 1;
    let y = {
        let x = x as Real;
        x * 2.0
    };
    {
        let mut x = y;
        x += 1.0;
        cell.real = x;
    }
    let r#type = x;
    let _unused = 3;
    let here = r#type;
    let f32 = here % 1000 + 1;
    for x in 0..f32 {
        let x = x * 2;
        cell.signed += x;
    }
    cell.signed += x;
}

#[test]
fn shadowed_names_stay_apart() {
    accepted::<shadowing>();
    let text = function(&written::<shadowing>(Precision::F64), "shadowing");
    assert_eq!(
        text,
        "\
fn shadowing() {
    let x: i32 = cell.signed;
    let x_2: i32 = x + 1i;
    var y: Real;
    {
        let x_3: Real = Real(x_2);
        y = x_3 * 2.0lf;
    }
    {
        var x_3: Real = y;
        x_3 += 1.0lf;
        cell.real = x_3;
    }
    let type_2: i32 = x_2;
    let _unused: i32 = 3i;
    let here_2: i32 = type_2;
    let f32_2: i32 = here_2 % 1000i + 1i;
    for (var x_3: i32 = 0i; x_3 < f32_2; x_3 += 1i) {
        let x_4: i32 = x_3 * 2i;
        cell.signed += x_4;
    }
    cell.signed += x_2;
}
"
    );
}

#[elementary_process]
fn loops(cell: &mut Cell<State>) {
    let mut total = 0;
    for i in 0..=cell.unsigned % 50 {
        if i % 2 == 0 {
            continue;
        }
        for k in i..=i + 2 {
            total += k;
        }
        for k in i..=i + 2 {
            total += k;
        }
        for j in (i + 1)..10 {
            if j > 5 {
                break;
            }
            total += j;
        }
        for k in 0..=9 {
            total += k;
        }
    }
    let mut n = 0_u8;
    while n < 100 && total > 3 {
        n += 1;
        if n == 50 && cell.signed > 0 {
            break;
        }
    }
    loop {
        total -= 1;
        match total {
            0 => break,
            1 | 2 => continue,
            3..=9 => {}
            _ if total % 3 == 0 => total /= 3,
            _ => {
                cell.unsigned = total;
                if total % 2 == 0 {
                    return;
                }
                break;
            }
        }
    }
    for byte in 250..=255 {
        n ^= byte;
    }
    while {
        total += 1;
        total < 5
    } {
        n += 1;
    }
    for _ in 0..2 {
        n += 1;
    }
    cell.byte = n;
    cell.unsigned = total;
}

#[test]
fn loops_of_all_kinds() {
    accepted::<loops>();
    let text = function(&written::<loops>(Precision::F64), "loops");
    assert!(!text.contains("switch"), "{text}");
    assert!(text.contains("byte <= 255u"), "{text}");
}

#[elementary_process]
fn branches(cell: &mut Cell<State>, p: &Settings) {
    let a = if cell.byte == LIVING {
        let b = cell.signed + 1;
        b * 2
    } else if cell.byte > 9 {
        -1
    } else {
        match cell.unsigned {
            0 => 5,
            1..=3 if cell.signed > 0 => 6,
            MASK => 7,
            _ => {
                if PERIODIC {
                    return;
                }
                8
            }
        }
    };
    let mut x = 1;
    let sum =
        x + {
            x = 5;
            x
        } + if cell.real > 0.0 {
            x += 1;
            x
        } else {
            2
        };
    let both = cell.signed > 0 && {
        x += 1;
        x > 3
    } || PERIODIC ^ (cell.byte < 3);
    cell.signed = a + sum + both as i32;
    cell.real = if both { p.scale } else { 0.0 };
    cell.byte = if x > 2 {
        1
    } else if {
        x -= 1;
        x == 0
    } {
        2
    } else {
        3
    };
    match both {
        true => cell.byte += 1,
        false => {}
    }
    let unit = match x {
        1 => {
            cell.byte = 7;
            1.5
        }
        _ => 2.5,
    };
    cell.real += unit;
}

#[test]
fn branches_with_values() {
    accepted::<branches>();
    let text = function(&written::<branches>(Precision::F64), "branches");
    assert!(text.contains("let operand: i32 = x;"), "{text}");
    assert!(text.contains("cell.real = select(0.0lf, p.scale, both);"), "{text}");
}

#[elementary_process]
fn arrays(cell: &mut Cell<State>) {
    let mut table = [0; 4];
    let mut fields = [[0.5; 2]; 3];
    let mut pair = [Vector3::splat(0.0), cell.velocity];
    for i in 0..4 {
        table[i] = cell.signed + i as i32;
        table[(i + 1) % 4] += 2;
    }
    fields[1][0] = cell.real;
    fields[2] = [1.0, 2.0];
    pair[0].y += fields[1][0];
    pair[1] = pair[0];
    let copy = fields;
    cell.signed = table[3] + [1, 2, 3][cell.byte as usize % 3];
    cell.real = copy[1][(cell.unsigned % 2) as usize];
    cell.velocity = pair[1];
}

#[test]
fn arrays_and_places() {
    accepted::<arrays>();
    let text = function(&written::<arrays>(Precision::F64), "arrays");
    assert!(text.contains("for (var i: u32 = 0u; i < 4u; i += 1u) {"), "{text}");
    assert!(text.contains("fields[1u][0u] = cell.real;"), "{text}");
}

#[helper]
fn square(x: Real) -> Real {
    x * x
}

#[helper]
fn hypotenuse(a: Real, b: Real, p: &Settings) -> Real {
    if a < 0.0 {
        return p.scale;
    }
    (square(a) + square(b)).sqrt()
}

#[helper]
fn search(limit: u32, space: &Space) -> u32 {
    let mut n = space.step();
    loop {
        n += 1;
        if n > limit {
            return n;
        }
    }
}

#[helper]
fn sign(x: i32) -> i32 {
    match x {
        0 => 0,
        1..=2147483647 => 1,
        _ => -1,
    }
}

mod elsewhere {
    use xca_core::prelude::*;

    #[helper]
    pub(super) fn square(x: i32) -> i32 {
        x * x
    }
}

#[elementary_process]
fn helpers(cell: &mut Cell<State>, p: &Settings, space: &Space) {
    cell.real = hypotenuse(cell.real, space.side(), p);
    cell.unsigned = search(10, space) + cell.index().y as u32;
    cell.signed = sign(cell.signed) + elsewhere::square(space.extents().x);
    square(1.0);
}

#[test]
fn helpers_come_along() {
    accepted::<helpers>();
    let shader = written::<helpers>(Precision::F64);
    assert!(function(&shader, "search").ends_with("    return u32();\n}\n"));
    assert_eq!(shader.source.matches("fn square").count(), 2);
    assert!(shader.source.contains("fn square_2("));
}

#[elementary_process]
fn neighbours(cell: &mut Cell<State>) {
    let left = cell.neighbour(1);
    let any = cell.neighbour(cell.unsigned as usize);
    cell.real = left.real + any.velocity.x + cell.neighbour(cell.byte as usize).real;
    if cell.neighbour_count() > 3 {
        cell.signed += cell.neighbour(3).signed;
    }
    if cell.real > 100.0 {
        cell.fault(17, cell.real);
        return;
    }
    cell.velocity = cell.neighbour(0).velocity;
}

#[test]
fn neighbours_beyond_the_neighbourhood_are_faults() {
    accepted::<neighbours>();
    let shader = written::<neighbours>(Precision::F64);
    assert!(shader.source.contains("record_fault(1u, index, space.neighbours, Real());"));
    assert!(shader.source.contains("velocity_next[3u * here + 2u] = cell.velocity.z;"));
}

/// In a hexagonal grid odd rows or columns have neighbours of their own.
#[test]
fn neighbours_by_parity() {
    for (parity, axis) in [(Parity::Row, "y"), (Parity::Column, "x")] {
        let shader = written_with::<neighbours>(&Options {
            parity,
            neighbourhood_size: Some(7),
            ..Options::default()
        });
        let text = function(&shader, "neighbour_at");
        assert!(
            text.contains(&format!("neighbour_offsets[index + (u32(here_index.{axis}) & 1u) * 7u]")),
            "{text}"
        );
    }
}

#[elementary_process]
fn compound(cell: &mut Cell<State>) {
    cell.signed -= {
        cell.signed *= 2;
        7
    };
}

#[test]
fn the_right_hand_side_comes_first() {
    let text = function(&written::<compound>(Precision::F64), "compound");
    let (first, second) = (text.find("cell.signed *= 2i;"), text.find("cell.signed -= value;"));
    assert!(first.is_some() && first < second, "{text}");
}

#[elementary_process]
fn chance(cell: &mut Cell<State>) {
    if cell.random(0) < 0.25 {
        cell.unsigned = cell.random_bits(cell.unsigned as usize + 1);
    }
}

#[test]
fn random_numbers() {
    accepted::<chance>();
}

#[elementary_process]
fn directions_of_neighbours(cell: &mut Cell<State>) {
    for n in 1..cell.neighbour_count() {
        if cell.exists(n) {
            cell.unsigned += cell.opposite(n) as u32;
        }
    }
    cell.signed = cell.displacement(directions::von_neumann::UP).z;
    cell.signed += cell.displacement(cell.unsigned as usize).x;
}

/// A number that may lie beyond the neighbourhood is checked; one from a loop over the neighbours is not.
#[test]
fn directions_are_read_from_a_table() {
    accepted::<directions_of_neighbours>();
    for parity in [Parity::None, Parity::Row, Parity::Column] {
        let options = Options { parity, neighbourhood_size: Some(7), ..Options::default() };
        let text = written_with::<directions_of_neighbours>(&options).source;
        for words in [
            "if neighbour_exists(n) {",
            "u32(neighbour_direction(n).w)",
            "neighbour_direction(valid_neighbour(cell.unsigned)).x",
            "there.y >= 0 && there.y < space.extents.y",
        ] {
            assert!(text.contains(words), "{words}: {text}");
        }
        assert!(!text.contains("neighbour_offsets"), "{text}");
    }
    let boundaries = [Boundary::Toroidal, Boundary::Reflecting, Boundary::Toroidal].into();
    let text = written_with::<directions_of_neighbours>(&Options { boundaries, ..Options::default() }).source;
    assert!(text.contains("return true;"), "{text}");
}
