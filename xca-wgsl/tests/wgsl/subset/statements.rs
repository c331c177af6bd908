//! Variables, loops, branches and assignments.

use super::state::{LIVING, MASK, PERIODIC, Settings, State};
use crate::common::{accepted, function, written};
use xca_core::prelude::*;

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
