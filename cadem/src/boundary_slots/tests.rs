use crate::boundary_slots::*;
use crate::walls::Walls;
use crate::{Case, contact};

fn box_of(cells: [usize; 3]) -> Configuration {
    Configuration { cells, ..Case::Table1.configuration() }
}

fn faces_of(configuration: &Configuration, cell: [usize; 3]) -> Vec<u8> {
    let in_cell = configuration.boundary_slots().filter(|item| item.cell == cell);
    in_cell.map(|item| item.state.face).collect()
}

#[test]
fn each_outermost_cell_has_a_slot_for_each_face_that_it_touches() {
    let configuration = box_of([3, 4, 5]);
    assert_eq!(configuration.boundary_slots().count(), 2 * (12 + 15 + 20));
    assert_eq!(faces_of(&configuration, [0, 3, 0]), [0, 3, 4]);
    assert_eq!(faces_of(&configuration, [2, 0, 4]), [1, 2, 5]);
    assert_eq!(faces_of(&configuration, [1, 1, 4]), [5]);
    assert_eq!(faces_of(&configuration, [1, 1, 1]), [0; 0]);
    assert_eq!(faces_of(&box_of([1, 1, 2]), [0, 0, 0]), [0, 1, 2, 3, 4]);
    assert_eq!(box_of([1, 1, 2]).most_faces_of_a_cell(), 5);
}

#[test]
fn labels_are_unique_and_above_those_of_particles() {
    let configuration = box_of([3, 4, 5]);
    for (item, label) in configuration.boundary_slots().zip(0x8000_0000..) {
        assert_eq!((item.label, item.state.id), (label, BOUNDARY));
    }
}

#[test]
fn the_point_is_on_the_wall_and_its_normal_points_inside() {
    for walls in Walls::ALL {
        let configuration = Configuration { walls, ..box_of([3, 4, 5]) };
        let sides = configuration.sides();
        for item in configuration.boundary_slots() {
            let face = Face::ALL[usize::from(item.state.face)];
            let point = crate::particles::array(item.state.position);
            let inset = match walls {
                Walls::Single => 0.0,
                Walls::PerSlot => 0.0005,
            };
            let expected = if face.is_high() { sides[face.axis()] - inset } else { inset };
            assert_eq!(point[face.axis()], expected);
            assert_eq!(point[face.axis()], configuration.wall(face));
            let normal = crate::particles::array(contact::inward_normal(face.number()));
            assert_eq!(normal[face.axis()], if face.is_high() { -1.0 } else { 1.0 });
            for axis in face.along() {
                assert_eq!(normal[axis], 0.0);
                assert_eq!((point[axis] / 0.002).floor() as usize, item.cell[axis]);
            }
        }
    }
}

#[test]
fn openings_are_faces_or_rectangles() {
    let rectangle = |first, last| Some(Rectangle { first, last });
    let open = |face, cells| Configuration { openings: vec![Opening { face, cells }], ..box_of([3, 4, 5]) };
    let all = box_of([3, 4, 5]).boundary_slots().count();
    assert_eq!(open(Face::XHigh, None).boundary_slots().count(), all - 20);
    // On a face across y the two axes are x and z.
    let hole = open(Face::YLow, rectangle([1, 2], [2, 4]));
    assert_eq!(hole.boundary_slots().count(), all - 6);
    assert_eq!(faces_of(&hole, [2, 0, 4]), [1, 5]);
    assert_eq!(faces_of(&hole, [0, 0, 4]), [0, 2, 5]);
    assert_eq!(hole.check(), Ok(()));
    let none = Configuration { openings: Opening::all_faces(), ..box_of([3, 4, 5]) };
    assert_eq!(none.boundary_slots().count(), 0);
    for (first, last) in [([0, 0], [3, 0]), ([0, 0], [0, 5]), ([2, 0], [1, 0])] {
        let error = open(Face::YLow, rectangle(first, last)).check().expect_err("no such cells");
        assert_eq!(error, CademError::Opening { face: Face::YLow, first, last, extents: [3, 5] });
    }
}

#[test]
fn names_are_those_of_files() {
    for face in Face::ALL {
        assert_eq!(
            usize::from(face.number()),
            Face::ALL.iter().position(|same| *same == face).expect("there")
        );
        let text = format!("face = '{face}'");
        assert_eq!(toml::from_str::<Opening>(&text), Ok(Opening::whole(face)));
    }
}
