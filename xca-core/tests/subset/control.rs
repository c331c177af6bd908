//! Statements.

use crate::common::run;
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct State {
    a: i32,
    b: i32,
    real: Real,
    byte: u8,
}

fn start(a: i32, b: i32) -> State {
    State { a, b, ..State::default() }
}

#[elementary_process]
fn variables(cell: &mut Cell<State>) {
    let x = cell.a;
    let x = x + 1;
    let y: Real = {
        let x = x as Real;
        x * 2.0
    };
    {
        let mut x = y;
        x += 1.0;
        cell.real = x;
    };
    let r#type = x;
    let _unused = 3;
    for x in 0..3 {
        let x = x * 2;
        cell.b += x;
    }
    cell.b += x + r#type;
}

#[test]
fn variables_hide_each_other() {
    let after = run(variables, start(4, 100));
    assert_eq!((after.b, after.real), (100 + 6 + 5 + 5, 11.0));
}

#[elementary_process]
fn branches(cell: &mut Cell<State>) {
    if cell.a > 10 {
        cell.b = 1;
    } else if cell.a > 5 {
        cell.b = 2;
    } else {
        cell.b = 3;
    }
    if cell.a == 7 {
        cell.byte = 1
    }
    let sign = if cell.a < 0 { -1 } else { 1 };
    let size = if cell.a > 100 {
        let tens = cell.a / 10;
        tens * tens
    } else if cell.a == 0 {
        return;
    } else {
        cell.a
    };
    cell.a = sign * size + if cell.b == 2 { 1000 } else { 0 };
}

#[test]
fn branches_with_and_without_values() {
    let after = [-3, 0, 7, 12, 200].map(|a| {
        let after = run(branches, start(a, 0));
        (after.a, after.b, after.byte)
    });
    assert_eq!(after, [(3, 3, 0), (0, 3, 0), (1007, 2, 1), (12, 1, 0), (400, 1, 0)]);
}

#[elementary_process]
fn ranges(cell: &mut Cell<State>) {
    let mut total = 0;
    for i in 0..cell.a {
        if i % 2 == 1 {
            continue;
        }
        for j in i + 1..=cell.a {
            if j > 5 {
                break;
            }
            total += i * 10 + j;
        }
    }
    for _ in 0..3 {
        total += 100;
    }
    for _ in 0..2 {
        for _ in 0..=1 {
            total += 1000;
        }
    }
    for i in 5..2 {
        total += i;
    }
    for byte in 250..=255 {
        cell.byte ^= byte;
    }
    cell.b = total;
}

#[test]
fn loops_over_ranges() {
    for a in [0, 1, 4, 9] {
        let mut total = 0;
        for i in (0..a).step_by(2) {
            total += (i + 1..=a).filter(|j| *j <= 5).map(|j| i * 10 + j).sum::<i32>();
        }
        let after = run(ranges, start(a, 0));
        assert_eq!(after.b, total + 300 + 4000, "{a}");
        assert_eq!(after.byte, (250..=255).fold(0, |all, byte| all ^ byte));
    }
}

#[elementary_process]
fn collatz(cell: &mut Cell<State>) {
    let mut n = cell.a;
    let mut steps = 0;
    while n != 1 && steps < 1000 {
        n = if n % 2 == 0 { n / 2 } else { 3 * n + 1 };
        steps += 1;
    }
    cell.b = steps;
    let mut root = 0;
    loop {
        root += 1;
        if root % 3 == 0 {
            continue;
        }
        if root * root >= cell.a {
            break;
        }
        if root > 50 {
            cell.byte = 9;
            return;
        }
    }
    cell.real = root as Real;
}

#[test]
fn loops_with_conditions() {
    assert_eq!(run(collatz, start(27, 0)), State { a: 27, b: 111, real: 7.0, byte: 0 });
    assert_eq!(run(collatz, start(100_000, 0)).byte, 9);
}

#[elementary_process]
fn matches(cell: &mut Cell<State>) {
    match cell.a {
        0 => cell.b = 10,
        1 | 2 => {
            let b = cell.b;
            cell.b = b + 20;
        }
        3..=9 if cell.b > 5 => cell.b = 30,
        -5 => cell.b = 40,
        -20..=-10 => {}
        _ if cell.byte == 1 => return,
        _ => cell.b = 50,
    }
    let value = match cell.byte {
        0..=1 => 0.5,
        2 => {
            cell.a += 1;
            1.5
        }
        _ => match cell.a > 0 {
            true => 2.5,
            false => 3.5,
        },
    };
    cell.real = value;
}

#[test]
fn matches_on_numbers() {
    let after = |a, b, byte| {
        let after = run(matches, State { byte, ..start(a, b) });
        (after.a, after.b, after.real)
    };
    assert_eq!(after(0, 1, 0), (0, 10, 0.5));
    assert_eq!(after(2, 1, 2), (3, 21, 1.5));
    assert_eq!(after(4, 6, 3), (4, 30, 2.5));
    assert_eq!(after(4, 5, 3), (4, 50, 2.5));
    assert_eq!(after(-5, 0, 3), (-5, 40, 3.5));
    assert_eq!(after(-15, 7, 0), (-15, 7, 0.5));
    assert_eq!(after(99, 7, 1), (99, 7, 0.0));
}

#[elementary_process]
fn blocks(cell: &mut Cell<State>) {
    let mut x = 1;
    let sum =
        x + {
            x = 5;
            x
        } + if cell.a > 0 {
            x += 1;
            x
        } else {
            2
        };
    x += {
        cell.b = 7;
        1
    };
    while {
        x += 1;
        x < 15
    } {
        cell.byte += 1;
    }
    cell.a = sum;
    cell.b = x;
}

/// What stands to the left is computed first; in `x += y` it is `y`.
#[test]
fn the_order_is_rusts() {
    let after = run(blocks, start(1, 0));
    assert_eq!((after.a, after.b, after.byte), (1 + 5 + 6, 15, 7));
}

#[elementary_process]
fn early(cell: &mut Cell<State>) {
    cell.b = 1;
    for i in 0..10 {
        cell.b += 1;
        if i == cell.a {
            return;
        }
    }
    cell.b = -1;
}

#[elementary_process]
fn idle(_cell: &mut Cell<State>) {}

#[test]
fn what_was_written_before_a_return_stays() {
    assert_eq!(run(early, start(3, 0)).b, 5);
    assert_eq!(run(early, start(30, 0)).b, -1);
    assert_eq!(run(idle, start(3, 4)), start(3, 4));
}
