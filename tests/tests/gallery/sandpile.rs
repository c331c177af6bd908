//! The final pile does not depend on the order in which cells topple: it is that of one cell after the other.

use crate::common::{assert_same_bits, run};
use xca_examples::models::sandpile::{Pile, model};

/// Topples one cell at a time, from a list.
fn toppled(size: usize, grains: u32) -> (Vec<u32>, u32) {
    let mut pile = vec![0; size * size];
    let middle = size / 2 * size + size / 2;
    pile[middle] = grains;
    let mut lost = 0;
    let mut unstable = vec![middle];
    while let Some(cell) = unstable.pop() {
        let fall = pile[cell] / 4;
        if fall == 0 {
            continue;
        }
        pile[cell] -= 4 * fall;
        let (x, y) = ((cell % size) as i64, (cell / size) as i64);
        for (x, y) in [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)] {
            if (0..size as i64).contains(&x) && (0..size as i64).contains(&y) {
                let neighbour = y as usize * size + x as usize;
                pile[neighbour] += fall;
                unstable.push(neighbour);
            } else {
                lost += fall;
            }
        }
    }
    (pile, lost)
}

#[test]
fn the_final_pile_is_that_of_one_cell_after_the_other() {
    for (size, grains) in [(21, 400), (15, 3000)] {
        let mut simulation = run(&model(size, grains).unwrap(), 0, 100_000);
        assert_eq!(simulation.stop_reason(), Some("the pile is stable"));
        let state = simulation.state();
        let (pile, lost) = toppled(size, grains);
        assert_eq!(state.read(Pile::GRAINS).unwrap(), pile);
        assert_eq!(state.sum(Pile::LOST).unwrap(), i64::from(lost));
        assert_eq!(state.sum(Pile::GRAINS).unwrap() + i64::from(lost), i64::from(grains), "none is lost");
        assert_eq!(lost > 0, size == 15);
    }
}

#[test]
fn same_bits() {
    assert_same_bits(&model(9, 500).unwrap(), 15);
}
