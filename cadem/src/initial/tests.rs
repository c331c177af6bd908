use super::*;

/// What a slot of the literal version below holds.
#[derive(Clone, Copy, PartialEq)]
enum Slot {
    Void,
    Particle([f64; 3]),
    /// A piece of the domain's face: the axis, and whether it is the upper face.
    Boundary(usize, bool),
}

/// The recipe word by word: dense slots, boundary slots that fill cells from the top, toroidal
/// neighbourhoods, and square roots.
fn placed_literally(cells: [usize; 3], side: f64, radius: f64, seed: u32) -> Vec<[f64; 3]> {
    let index = |i: usize, j: usize, k: usize| (i * cells[1] + j) * cells[2] + k;
    let mut slots = vec![[Slot::Void; 12]; cells.iter().product()];
    let mut filled = Vec::new();
    let mut random = ReentrantRandom::new(seed);
    for i in 0..cells[0] {
        for j in 0..cells[1] {
            for k in 0..cells[2] {
                let own = &mut slots[index(i, j, k)];
                let mut last = 12;
                for (axis, at) in [i, j, k].into_iter().enumerate() {
                    for (upper, face) in [(false, 0), (true, cells[axis] - 1)] {
                        if at == face {
                            last -= 1;
                            own[last] = Slot::Boundary(axis, upper);
                        }
                    }
                }
                if k as f64 > 0.2 * cells[2] as f64 {
                    continue;
                }
                for (number, slot) in own.iter_mut().enumerate().filter(|(_, slot)| **slot == Slot::Void) {
                    if random.next_unit() < 0.75 {
                        let [x, y, z] = [i, j, k].map(|c| (c as f64 + random.next_unit()) * side);
                        *slot = Slot::Particle([x, y, z]);
                        filled.push(([i, j, k], number));
                    }
                }
            }
        }
    }
    for &([i, j, k], number) in &filled {
        let Slot::Particle(here) = slots[index(i, j, k)][number] else { unreachable!() };
        let mut touches = false;
        for step in 0..27 {
            let [a, b, c] = [step / 9, step / 3 % 3, step % 3];
            let wrap = |at: usize, by: usize, n: usize| (at + n + by - 1) % n;
            let other = &slots[index(wrap(i, a, cells[0]), wrap(j, b, cells[1]), wrap(k, c, cells[2]))];
            for (other_number, slot) in other.iter().enumerate() {
                touches |= match *slot {
                    Slot::Void => false,
                    Slot::Particle(there) => {
                        let square: f64 = (0..3).map(|axis| (here[axis] - there[axis]).powi(2)).sum();
                        (step != 13 || other_number > number) && square.sqrt() <= 2.0 * radius
                    }
                    Slot::Boundary(axis, upper) => {
                        let plane = if upper { cells[axis] as f64 * side - radius } else { radius };
                        (here[axis] - plane).abs() <= radius
                    }
                };
            }
        }
        if touches {
            slots[index(i, j, k)][number] = Slot::Void;
        }
    }
    let standing = filled.into_iter().filter_map(|([i, j, k], number)| match slots[index(i, j, k)][number] {
        Slot::Particle(position) => Some(position),
        _ => None,
    });
    standing.collect()
}

#[test]
fn the_small_system_has_2602_particles() {
    let particles = authors_placement([20; 3], 0.002, 0.0005, 1).expect("possible");
    assert_eq!(particles.len(), 2_602);
    let labels: Vec<u32> = particles.iter().map(|particle| particle.label).collect();
    assert_eq!(labels, (1..=2_602).collect::<Vec<_>>());
    // The first cells of the scan lie along the box's edge; the walls empty the lowest one.
    let rounded = |particle: &Placed| particle.position.map(|x| (x * 1e9).round() as i64);
    assert_eq!(rounded(&particles[0]), [1_697_723, 1_219_959, 3_509_522]);
    assert_eq!(rounded(&particles[1]), [1_337_205, 3_464_071, 4_325_785]);
    assert_eq!(rounded(&particles[2_601]), [38_663_664, 38_815_784, 6_996_982]);
}

#[test]
fn the_benchmark_has_315979_particles() {
    let particles = authors_placement([100; 3], 0.002, 0.0005, 1).expect("possible");
    assert_eq!(particles.len(), 315_979);
    assert_eq!(particles.last().expect("there are some").label, 315_979);
    // 21 layers of cells of 100: the one that starts at 20 % of the height is filled too.
    let highest = particles.iter().map(|particle| particle.position[2]).fold(0.0, f64::max);
    assert!((0.041..0.042).contains(&highest), "highest {highest}");
}

#[test]
fn agrees_with_the_recipe_word_by_word() {
    for (cells, radius, seed) in [
        ([20, 20, 20], 0.0005, 1),
        ([20, 20, 20], 0.0005, 2),
        ([3, 5, 17], 0.0003, 99),
        ([7, 2, 9], 0.00025, 5),
        ([9, 4, 30], 0.001, u32::MAX),
    ] {
        let particles = authors_placement(cells, 0.002, radius, seed).expect("possible");
        let positions: Vec<_> = particles.iter().map(|particle| particle.position).collect();
        assert!(!positions.is_empty());
        assert_eq!(positions, placed_literally(cells, 0.002, radius, seed), "{cells:?}, seed {seed}");
    }
}

#[test]
fn no_two_particles_touch_and_none_touches_a_wall() {
    let (side, radius) = (0.04, 0.0005);
    let particles = authors_placement([20; 3], 0.002, radius, 3).expect("possible");
    for (n, one) in particles.iter().enumerate() {
        assert!(one.position.iter().all(|x| (2.0 * radius..side - 2.0 * radius).contains(x)), "{one:?}");
        for other in &particles[..n] {
            let square: f64 = (0..3).map(|axis| (one.position[axis] - other.position[axis]).powi(2)).sum();
            assert!(square.sqrt() > 2.0 * radius, "{one:?} touches {other:?}");
        }
    }
}

#[test]
fn a_seed_is_a_placement() {
    let with_seed = |seed| authors_placement([20; 3], 0.002, 0.0005, seed).expect("possible");
    assert_eq!(with_seed(8), with_seed(8));
    assert_ne!(with_seed(8), with_seed(9));
}

#[test]
fn a_domain_one_cell_wide_is_no_special_case() {
    let particles = authors_placement([1, 1, 100], 0.002, 0.00025, 1).expect("possible");
    assert!(particles.len() > 21, "{}", particles.len());
}

#[test]
fn impossible_requests_are_refused() {
    let refused = |cells, side, radius| authors_placement(cells, side, radius, 1).expect_err("impossible");
    assert_eq!(refused([4, 0, 4], 0.002, 0.0005), PlacementError::NoCells { cells: [4, 0, 4] });
    for bad in [0.0, -0.002, f64::INFINITY, f64::NAN] {
        assert!(matches!(refused([4; 3], bad, 0.0005), PlacementError::BadLength { .. }), "side {bad}");
        assert!(matches!(refused([4; 3], 0.002, bad), PlacementError::BadLength { .. }), "radius {bad}");
    }
    let wide = PlacementError::WiderThanACell { radius: 0.0011, cell_side: 0.002 };
    assert_eq!(refused([4; 3], 0.002, 0.0011), wide);
    for cells in [[1 << 12; 3], [usize::MAX; 3]] {
        assert!(matches!(refused(cells, 0.002, 0.0005), PlacementError::TooManyCells { .. }));
    }
    assert_eq!(
        refused([4; 3], -1.0, 0.0005).to_string(),
        "the side of a cell must be positive and finite, not -1 m"
    );
}
