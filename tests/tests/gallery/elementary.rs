//! Elementary automata against Pascal's triangle, published rows, and a loop over all rules.

use crate::common::{assert_same_bits, run};
use xca_examples::models::elementary::{Row, model};

/// The rows from the first one on, of a ring that begins as the function says.
fn rows(rule: u8, width: usize, steps: usize, begin: fn(usize) -> bool) -> Vec<Vec<bool>> {
    let mut simulation = run(&model(width, rule, begin).unwrap(), 0, 0);
    let mut row = |_| {
        let on = simulation.state().read(Row::ON).unwrap();
        simulation.step().unwrap();
        on
    };
    (0..=steps).map(&mut row).collect()
}

/// Whether the binomial coefficient is odd, by Lucas: the bits of k are among those of n.
fn is_odd_binomial(n: usize, k: usize) -> bool {
    n & k == k
}

/// From one cell, rule 90 draws Pascal's triangle modulo 2.
#[test]
fn rule_90_is_pascals_triangle() {
    let steps = 40;
    for (step, row) in rows(90, 101, steps, |x| x == 50).iter().enumerate() {
        for (x, on) in row.iter().enumerate() {
            let from_left = x + step;
            let is_reached =
                from_left >= 50 && from_left - 50 <= 2 * step && (from_left - 50).is_multiple_of(2);
            let wanted = is_reached && is_odd_binomial(step, (from_left - 50) / 2);
            assert_eq!(*on, wanted, "step {step}, cell {x}");
        }
    }
}

/// The centre column of rule 30 from one cell: A051023 of the On-Line Encyclopedia of Integer Sequences.
#[test]
fn rule_30_has_the_published_centre_column() {
    const PUBLISHED: &str = "11011100110001011001001110101110";
    let rows = rows(30, 101, PUBLISHED.len() - 1, |x| x == 50);
    let found: String = rows.iter().map(|row| if row[50] { '1' } else { '0' }).collect();
    assert_eq!(found, PUBLISHED);
}

/// The rows of rule 110 from one cell, read as binary numbers: A006978 of the same encyclopedia.
#[test]
fn rule_110_has_the_published_rows() {
    const PUBLISHED: [u64; 16] =
        [1, 3, 7, 13, 31, 49, 115, 215, 509, 775, 1805, 3359, 7985, 12659, 29655, 54909];
    let rows = rows(110, 41, PUBLISHED.len() - 1, |x| x == 30);
    // It grows to the left only, a cell a step.
    let number = |row: &Vec<bool>| row[..=30].iter().fold(0, |number, on| 2 * number + u64::from(*on));
    let found: Vec<u64> = rows.iter().map(number).collect();
    assert_eq!(found, PUBLISHED);
    assert!(rows.iter().all(|row| row[31..].iter().all(|on| !on)));
}

/// Each of the 256 automata against a table of its eight cases, on a ring narrow enough to go round.
#[test]
fn all_rules_follow_their_tables() {
    let (width, steps) = (23, 30);
    let begin = |x: usize| [true, false, true, true, false, false, true][x % 7] != (x > 15);
    for rule in 0..=255_u8 {
        // The digits of the rule stand for 111, 110, … 000.
        let table: Vec<(String, bool)> = format!("{rule:08b}")
            .chars()
            .enumerate()
            .map(|(number, digit)| (format!("{:03b}", 7 - number), digit == '1'))
            .collect();
        let found = rows(rule, width, steps, begin);
        let mut row: Vec<bool> = (0..width).map(begin).collect();
        for (step, found) in found.iter().enumerate() {
            assert_eq!(*found, row, "rule {rule}, step {step}");
            let digit = |x: usize| if row[x % width] { '1' } else { '0' };
            let next = (0..width).map(|x| {
                let three: String = [digit(x + width - 1), digit(x), digit(x + 1)].iter().collect();
                table.iter().any(|(pattern, on)| *pattern == three && *on)
            });
            row = next.collect();
        }
    }
}

#[test]
fn same_bits() {
    assert_same_bits(&model(19, 110, |x| x % 3 == 0).unwrap(), 11);
}
