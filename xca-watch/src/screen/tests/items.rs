//! Items.

use super::*;
use xca_record::ItemView;

#[derive(Substates, Clone, Copy)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
}

#[elementary_process]
fn fall(me: &mut Slot<Grain>) {
    me.position.z -= me.velocity.z;
}

#[migration]
fn reassign(me: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// Three grains in a box of 8 cells each way; the first two stand behind each other, seen from the front.
fn grains() -> SetUp {
    let grain = |(label, at): (u32, [f64; 3])| Item {
        label,
        cell: at.map(|x| x as usize),
        state: Grain {
            position: Vector3::new(at[0], at[1], at[2]),
            velocity: Vector3::new(0.0, 0.0, f64::from(label)),
        },
    };
    let places = [(0, [2.5, 1.5, 6.5]), (1, [2.5, 6.5, 6.5]), (2, [5.5, 4.5, 3.5])];
    let model = Model::builder("grains")
        .extents([8; 3])
        .neighbourhood(Neighbourhood::moore(3))
        .population::<Grain>(4)
        .process(fall)
        .process(reassign)
        .initialise(move |state| Ok(state.set_items(places.map(grain).to_vec())?))
        .build();
    SetUp::new(model.unwrap(), 3)
        .items(ItemView::named("grains").radius(0.4).colour(Grain::VELOCITY, "speed"))
}

/// The items that are seen, as column and row of the pixel and their place on the scale: the places that are
/// not those of the background.
fn seen(watched: &mut Watched) -> Vec<(usize, usize)> {
    let rows = halves(&watched.drawn(8, 5), Rect::new(0, 1, 8, 4));
    let behind = rows[0][0];
    let row = |(y, row): (usize, &Vec<Option<Color>>)| -> Vec<(usize, usize)> {
        let items = row.iter().enumerate().filter(|(_, colour)| **colour != behind);
        items.map(|(x, _)| (x, y)).collect()
    };
    rows.iter().enumerate().flat_map(row).collect()
}

#[test]
fn items_are_seen_from_the_front_the_nearest_first() {
    let mut watched = Watched::new(grains(), None);
    assert!(watched.text().contains("3 items, seen along y"), "{}", watched.text());
    assert!(watched.text().contains(&format!("speed  0 {} 2", "█".repeat(24))), "{}", watched.text());
    assert_eq!(seen(&mut watched), [(2, 1), (5, 4)]);
    // The first, which stands still, hides the second: its colour is that of 0 (Oklab 0.37, 0.145, 300°), a
    // little darker by its distance.
    let rows = halves(&watched.drawn(8, 5), Rect::new(0, 1, 8, 4));
    let linear = |byte: f64| ((byte / 255.0 + 0.055) / 1.055).powf(2.4);
    let encoded = |x: f64| (1.055 * x.powf(1.0 / 2.4) - 0.055) * 255.0;
    let dusk = 1.0 - 0.5 * 1.5 / 8.0;
    let [r, g, b] = [77.0, 36.0, 127.0].map(|byte| encoded(linear(byte) * dusk));
    let Some(Color::Rgb(red, green, blue)) = rows[1][2] else { panic!("{:?}", rows[1]) };
    for (found, wanted) in [(red, r), (green, g), (blue, b)] {
        assert!((f64::from(found) - wanted).abs() < 1.6, "{found} {wanted}");
    }
    // From above: y up, the highest nearest; from the side: y across.
    watched.keys("a");
    assert!(watched.text().contains("seen along z"));
    assert_eq!(seen(&mut watched), [(2, 1), (5, 3), (2, 6)]);
    watched.keys("a");
    assert_eq!(seen(&mut watched), [(1, 1), (6, 1), (4, 4)]);
    // The third falls by two in a step, the second by one.
    watched.keys("n");
    assert_eq!(seen(&mut watched), [(1, 1), (6, 2), (4, 6)]);
}

#[test]
fn items_without_colours_are_characters() {
    let mut watched = Watched::new(grains(), None);
    watched.screen.colours = Colours::None;
    let drawn = text(&watched.drawn(8, 5));
    let rows: Vec<&str> = drawn.lines().skip(1).collect();
    assert_eq!(rows, ["  ░     ", "        ", "     ▀  ", "        "]);
}

#[test]
fn large_items_look_round() {
    let mut watched = Watched::new(grains(), None);
    // 80 half blocks each way, of which a cell has ten: the third grain is at (55, 45), its radius is four.
    let rows = halves(&watched.drawn(80, 44), Rect::new(0, 1, 80, 40));
    let brightness = |x: usize| match rows[45][x] {
        Some(Color::Rgb(r, g, b)) => u32::from(r) + u32::from(g) + u32::from(b),
        other => panic!("{other:?}"),
    };
    let across: Vec<u32> = (55..59).map(brightness).collect();
    assert!(across.windows(2).all(|pair| pair[0] > pair[1]), "{across:?}");
    // Behind it, it is darker still, and even.
    assert!(brightness(59) < across[3] && brightness(59) == brightness(60));
}
