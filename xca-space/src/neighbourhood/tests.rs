//! Tests of neighbourhoods against their geometry.

use super::{Hexagons, Neighbourhood, NeighbourhoodError, shapes};

#[test]
fn sizes_of_the_ready_made_ones() {
    assert_eq!(Neighbourhood::von_neumann(1).size(), 7);
    assert_eq!(Neighbourhood::moore(1).size(), 27);
    assert_eq!(Neighbourhood::von_neumann_2d(1).size(), 5);
    assert_eq!(Neighbourhood::moore_2d(1).size(), 9);
    // The octahedral number of radius 2, and a cube of five.
    assert_eq!(Neighbourhood::von_neumann(2).size(), 25);
    assert_eq!(Neighbourhood::moore(2).size(), 125);
    assert_eq!(Neighbourhood::moore(2).reach(), [2, 2, 2]);
    assert_eq!(Neighbourhood::moore_2d(2).reach(), [2, 2, 0]);
}

#[test]
fn order_is_centre_then_x_fastest() {
    let seven = Neighbourhood::von_neumann(1);
    let expected = [[0, 0, 0], [0, 0, -1], [0, -1, 0], [-1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
    assert_eq!(seven.displacements([4, 4, 4]), expected);
}

/// The centres of touching hexagons have distance 1, for cells of every parity.
#[test]
fn hexagons_touch() {
    let height = 3_f64.sqrt() / 2.0;
    for hexagons in [Hexagons::CornerUp, Hexagons::SideUp] {
        let neighbourhood = Neighbourhood::hexagonal(hexagons);
        let place = |[x, y]: [i32; 2]| match hexagons {
            Hexagons::CornerUp => [f64::from(x) + 0.5 * f64::from(y.rem_euclid(2)), height * f64::from(y)],
            Hexagons::SideUp => [height * f64::from(x), f64::from(y) + 0.5 * f64::from(x.rem_euclid(2))],
        };
        for cell in [[4, 4, 0], [5, 4, 0], [4, 5, 0], [5, 5, 0]] {
            let here = [cell[0] as i32, cell[1] as i32];
            let mut seen = Vec::new();
            for [x, y, _] in &neighbourhood.displacements(cell)[1..] {
                let other = [here[0] + x, here[1] + y];
                let (a, b) = (place(here), place(other));
                let distance = (a[0] - b[0]).hypot(a[1] - b[1]);
                assert!((distance - 1.0).abs() < 1e-12, "{hexagons:?} {cell:?} {other:?}: {distance}");
                assert!(!seen.contains(&other));
                seen.push(other);
            }
            assert_eq!(seen.len(), 6);
        }
    }
}

/// Names, displacements and opposites agree: north is +y, east +x, up +z.
#[test]
fn directions_are_what_they_are_called() {
    use crate::directions::{hexagonal, moore, moore_2d, von_neumann, von_neumann_2d};
    let check = |neighbourhood: Neighbourhood, cell: [usize; 3], named: &[(usize, [i32; 3])]| {
        assert_eq!(neighbourhood.size(), named.len());
        for (index, displacement) in named {
            assert_eq!(neighbourhood.displacements(cell)[*index], *displacement);
            assert_eq!(neighbourhood.index_of(cell, *displacement), Some(*index));
        }
    };
    let (south, north, west, east) = ([0, -1, 0], [0, 1, 0], [-1, 0, 0], [1, 0, 0]);
    let along = |a: [i32; 3], b: [i32; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let (south_west, south_east) = (along(south, west), along(south, east));
    let (north_west, north_east) = (along(north, west), along(north, east));
    let (down, up) = ([0, 0, -1], [0, 0, 1]);
    {
        use von_neumann_2d::{CENTRE, EAST, NORTH, SOUTH, WEST};
        let named = [(CENTRE, [0; 3]), (SOUTH, south), (NORTH, north), (WEST, west), (EAST, east)];
        check(Neighbourhood::von_neumann_2d(1), [3, 3, 0], &named);
    }
    {
        use von_neumann::{CENTRE, DOWN, EAST, NORTH, SOUTH, UP, WEST};
        let named = [
            (CENTRE, [0; 3]),
            (SOUTH, south),
            (NORTH, north),
            (WEST, west),
            (EAST, east),
            (DOWN, down),
            (UP, up),
        ];
        check(Neighbourhood::von_neumann(1), [3, 3, 3], &named);
    }
    {
        use moore_2d::{CENTRE, EAST, NORTH, NORTH_EAST, NORTH_WEST, SOUTH, SOUTH_EAST, SOUTH_WEST, WEST};
        let named = [
            (CENTRE, [0; 3]),
            (SOUTH, south),
            (NORTH, north),
            (WEST, west),
            (EAST, east),
            (SOUTH_WEST, south_west),
            (SOUTH_EAST, south_east),
            (NORTH_WEST, north_west),
            (NORTH_EAST, north_east),
        ];
        check(Neighbourhood::moore_2d(1), [3, 3, 0], &named);
    }
    let named = [
        (moore::CENTRE, [0; 3]),
        (moore::SOUTH, south),
        (moore::NORTH, north),
        (moore::WEST, west),
        (moore::EAST, east),
        (moore::SOUTH_WEST, south_west),
        (moore::SOUTH_EAST, south_east),
        (moore::NORTH_WEST, north_west),
        (moore::NORTH_EAST, north_east),
        (moore::DOWN, down),
        (moore::DOWN_SOUTH, along(down, south)),
        (moore::DOWN_NORTH, along(down, north)),
        (moore::DOWN_WEST, along(down, west)),
        (moore::DOWN_EAST, along(down, east)),
        (moore::DOWN_SOUTH_WEST, along(down, south_west)),
        (moore::DOWN_SOUTH_EAST, along(down, south_east)),
        (moore::DOWN_NORTH_WEST, along(down, north_west)),
        (moore::DOWN_NORTH_EAST, along(down, north_east)),
        (moore::UP, up),
        (moore::UP_SOUTH, along(up, south)),
        (moore::UP_NORTH, along(up, north)),
        (moore::UP_WEST, along(up, west)),
        (moore::UP_EAST, along(up, east)),
        (moore::UP_SOUTH_WEST, along(up, south_west)),
        (moore::UP_SOUTH_EAST, along(up, south_east)),
        (moore::UP_NORTH_WEST, along(up, north_west)),
        (moore::UP_NORTH_EAST, along(up, north_east)),
    ];
    check(Neighbourhood::moore(1), [3, 3, 3], &named);
    // Odd rows are half a cell farther east, odd columns half a cell farther north.
    for odd in [0, 1] {
        use hexagonal::corner_up::{CENTRE, EAST, NORTH_EAST, NORTH_WEST, SOUTH_EAST, SOUTH_WEST, WEST};
        let step = odd as i32;
        let named = [
            (CENTRE, [0; 3]),
            (WEST, west),
            (EAST, east),
            (SOUTH_WEST, [step - 1, -1, 0]),
            (SOUTH_EAST, [step, -1, 0]),
            (NORTH_WEST, [step - 1, 1, 0]),
            (NORTH_EAST, [step, 1, 0]),
        ];
        check(Neighbourhood::hexagonal(Hexagons::CornerUp), [4, odd, 0], &named);
    }
    for odd in [0, 1] {
        use hexagonal::side_up::{CENTRE, NORTH, NORTH_EAST, NORTH_WEST, SOUTH, SOUTH_EAST, SOUTH_WEST};
        let step = odd as i32;
        let named = [
            (CENTRE, [0; 3]),
            (SOUTH, south),
            (NORTH, north),
            (SOUTH_WEST, [-1, step - 1, 0]),
            (NORTH_WEST, [-1, step, 0]),
            (SOUTH_EAST, [1, step - 1, 0]),
            (NORTH_EAST, [1, step, 0]),
        ];
        check(Neighbourhood::hexagonal(Hexagons::SideUp), [odd, 4, 0], &named);
    }
}

/// The opposite index leads back to the cell, for cells of every parity.
#[test]
fn opposites_lead_back() {
    let all = [
        Neighbourhood::von_neumann(2),
        Neighbourhood::moore(2),
        Neighbourhood::von_neumann_2d(3),
        Neighbourhood::moore_2d(1),
        Neighbourhood::hexagonal(Hexagons::CornerUp),
        Neighbourhood::hexagonal(Hexagons::SideUp),
    ];
    for neighbourhood in all {
        assert_eq!(neighbourhood.opposite(0), Some(0));
        assert_eq!(neighbourhood.opposite(neighbourhood.size()), None);
        assert_eq!(neighbourhood.without_opposite(), None);
        for cell in [[6, 6, 6], [7, 6, 6], [6, 7, 6], [7, 7, 6]] {
            for (index, step) in neighbourhood.displacements(cell).iter().enumerate() {
                let there = [0, 1, 2].map(|axis| (cell[axis] as i32 + step[axis]) as usize);
                let back = neighbourhood.opposite(index).unwrap();
                assert_eq!(neighbourhood.displacements(there)[back], step.map(|along| -along));
                assert_eq!(neighbourhood.opposite(back), Some(index));
            }
        }
    }
    let list = vec![[0, 0, 0], [1, 0, 0], [2, 1, 0], [-1, 0, 0], [i32::MIN, 0, 0]];
    let custom = Neighbourhood::custom(list).unwrap();
    assert_eq!([1, 2, 3, 4].map(|n| custom.opposite(n)), [Some(3), None, Some(1), None]);
    assert_eq!(custom.without_opposite(), Some([2, 1, 0]));
}

/// The shapes that kernels know agree with the neighbourhoods.
#[test]
fn shapes_are_those_of_their_neighbourhoods() {
    let near = |[x, y, z]: &[i32; 3]| x * x + y * y + z * z <= 2;
    let cube = Neighbourhood::moore(1);
    let nineteen = cube.displacements([0; 3]).iter().copied().filter(near).collect();
    let known = [
        Neighbourhood::von_neumann_2d(1),
        Neighbourhood::von_neumann(1),
        Neighbourhood::moore_2d(1),
        Neighbourhood::custom(nineteen).unwrap(),
        cube,
        Neighbourhood::hexagonal(Hexagons::CornerUp),
        Neighbourhood::hexagonal(Hexagons::SideUp),
    ];
    for (neighbourhood, number) in known.iter().zip([1, 2, 3, 4, 5, 6, 6]) {
        assert_eq!(neighbourhood.shape(), number, "{neighbourhood}");
        let shape = shapes::shape(number);
        assert_eq!(shape.size, neighbourhood.size());
        if number != shapes::HEXAGONAL {
            assert_eq!(shape.displacements[..shape.size], *neighbourhood.displacements([0; 3]));
        }
        for index in 0..shape.size {
            assert_eq!(neighbourhood.opposite(index), Some(shape.opposite(index)));
        }
    }
    let turned = Neighbourhood::custom(vec![[0; 3], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]);
    let others = [Neighbourhood::moore(2), Neighbourhood::moore_2d(0), turned.unwrap()];
    assert!(others.iter().all(|other| other.shape() == shapes::ANY));
}

#[test]
fn custom_lists_are_checked() {
    assert_eq!(Neighbourhood::custom(vec![[1, 0, 0]]), Err(NeighbourhoodError::NoCentre));
    let twice = vec![[0, 0, 0], [1, 0, 0], [1, 0, 0]];
    assert_eq!(Neighbourhood::custom(twice), Err(NeighbourhoodError::Twice([1, 0, 0])));
}
