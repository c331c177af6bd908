//! What is on the screen, cell by cell, of states that are worked out by hand.

use super::*;
use crate::command::watch::worker::{Shared, Worker};
use crate::output::picture::ColourMap;
use crate::record::{Recorder, Sight};
use crate::set_up::SetUp;
use crate::view::{CellView, ItemView};
use proptest::prelude::*;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::style::Color;
use std::sync::atomic::Ordering;
use std::sync::mpsc;
use xca_core::prelude::*;
use xca_core::{Reference, RunOptions, Simulation};

/// The colours of a dead and a living cell: Oklab (0.97, 0.005, 250°) and (0.38, 0.09, 265°) in sRGB.
const DEAD: Color = Color::Rgb(243, 245, 248);
const ALIVE: Color = Color::Rgb(42, 64, 114);

#[derive(Substates, Clone, Copy)]
struct Life {
    alive: u8,
    age: Real,
}

#[elementary_process]
fn evolve(cell: &mut Cell<Life>) {
    let mut count = 0;
    for n in 1..cell.neighbours() {
        count += cell.neighbour(n).alive;
    }
    cell.alive = if count == 3 || (count == 2 && cell.alive == 1) { 1 } else { 0 };
    cell.age += 1.0;
}

/// Life on a torus, where these cells are alive.
fn life(size: [usize; 3], alive: &'static [[usize; 2]]) -> SetUp {
    let model = Model::builder("life")
        .extents(size)
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Life>()
        .process(evolve)
        .fill(move |[x, y, _]| Life { alive: u8::from(alive.contains(&[x, y])), age: 0.0 })
        .build();
    SetUp::new(model.unwrap(), 10)
}

const BLINKER: &[[usize; 2]] = &[[3, 4], [4, 4], [5, 4]];
const GLIDER: &[[usize; 2]] = &[[1, 6], [2, 5], [0, 4], [1, 4], [2, 4]];

/// A run that is watched without a clock: orders are carried out as they are made.
struct Watched {
    recorder: Recorder,
    screen: Screen,
    wanted: Option<u64>,
    orders: Vec<Order>,
}

impl Watched {
    fn new(set_up: SetUp, wanted: Option<u64>) -> Self {
        let recorder = Recorder::new(set_up).unwrap();
        let facts = Facts {
            title: recorder.set_up().title.clone(),
            engine: ["some engine with much to say".to_owned(), "some engine".to_owned()],
            note: None,
            time_step: Some(0.5),
            wanted,
            substates: recorder.substates(),
        };
        let screen = Screen::new(facts, Colours::True, Pace::new(1, 20), Look::default());
        let mut watched = Self { recorder, screen, wanted, orders: Vec::new() };
        watched.obey(false);
        watched
    }

    /// Has all orders so far carried out again on a new worker, of which the last answer is shown: so no state is kept but the screen's.
    fn obey(&mut self, is_picture_due: bool) {
        let before = self.orders.len();
        while let Some(order) = self.screen.take_order(is_picture_due && self.orders.len() == before) {
            self.orders.push(order);
        }
        let (orders, received) = mpsc::channel();
        let (answers, news) = mpsc::channel();
        self.orders.iter().for_each(|order| orders.send(order.clone()).unwrap());
        drop(orders);
        let shared = Shared::default();
        let options = RunOptions::default();
        let simulation = Simulation::new(self.recorder.model(), &Reference, options).unwrap();
        let worker = Worker {
            recorder: &self.recorder,
            engine: &Reference,
            options,
            wanted: self.wanted,
            shared: &shared,
        };
        worker.work(simulation, &received, &answers);
        let last = news.try_iter().last().unwrap().unwrap();
        assert_eq!(shared.done.load(Ordering::Relaxed), last.step);
        self.screen.tell(last);
    }

    fn press(&mut self, code: KeyCode) -> Reaction {
        let reaction = self.screen.press(KeyEvent::from(code));
        self.obey(false);
        reaction
    }

    fn keys(&mut self, keys: &str) {
        for key in keys.chars() {
            self.press(KeyCode::Char(key));
        }
    }

    fn drawn(&mut self, width: u16, height: u16) -> Buffer {
        drawn(&mut self.screen, width, height)
    }

    fn text(&mut self) -> String {
        text(&self.drawn(100, 24))
    }
}

fn drawn(screen: &mut Screen, width: u16, height: u16) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| screen.draw(frame.area(), frame.buffer_mut())).unwrap();
    terminal.backend().buffer().clone()
}

fn text(buffer: &Buffer) -> String {
    let rows = buffer.content.chunks(usize::from(buffer.area.width));
    let rows = rows.map(|row| row.iter().map(ratatui::buffer::Cell::symbol).collect::<String>());
    rows.collect::<Vec<String>>().join("\n")
}

/// The colours of all half blocks of the area, row by row from the top; None where there is none.
fn halves(buffer: &Buffer, area: Rect) -> Vec<Vec<Option<Color>>> {
    let mut rows = Vec::new();
    for y in area.top()..area.bottom() {
        let cells: Vec<_> = (area.left()..area.right()).map(|x| &buffer[(x, y)]).collect();
        let is_block = |cell: &&ratatui::buffer::Cell| cell.symbol() == "▀";
        rows.push(cells.iter().map(|cell| is_block(cell).then_some(cell.fg)).collect());
        rows.push(cells.iter().map(|cell| is_block(cell).then_some(cell.bg)).collect());
    }
    rows
}

/// Demands that these cells, and no others, are alive in a space of 8 by 8 cells that is drawn with a pixel each. A screen of 8 by 5 characters
/// has one line of words, and 4 of the picture.
fn assert_alive(watched: &mut Watched, alive: &[[usize; 2]]) {
    let buffer = watched.drawn(8, 5);
    let wanted: Vec<Vec<Option<Color>>> = (0..8)
        .map(|row| {
            let y = 7 - row;
            (0..8).map(|x| Some(if alive.contains(&[x, y]) { ALIVE } else { DEAD })).collect()
        })
        .collect();
    assert_eq!(halves(&buffer, Rect::new(0, 1, 8, 4)), wanted);
}

#[test]
fn a_blinker_blinks() {
    let mut watched = Watched::new(life([8, 8, 1], BLINKER), None);
    let upright = [[4, 3], [4, 4], [4, 5]];
    assert_alive(&mut watched, BLINKER);
    watched.keys("n");
    assert_alive(&mut watched, &upright);
    watched.keys("n");
    assert_alive(&mut watched, BLINKER);
    assert!(watched.text().starts_with("step 2  paused  time 1 s  1 step a picture  life  "));
}

#[test]
fn a_glider_is_one_cell_further_after_four_steps() {
    let mut watched = Watched::new(life([8, 8, 1], GLIDER), None);
    assert_alive(&mut watched, GLIDER);
    watched.keys("nnnn");
    // Down and to the right.
    let further: Vec<[usize; 2]> = GLIDER.iter().map(|[x, y]| [x + 1, y - 1]).collect();
    assert_alive(&mut watched, &further);
}

#[test]
fn pictures_come_every_so_many_steps_until_the_end() {
    let mut watched = Watched::new(life([8, 8, 1], BLINKER), Some(7));
    watched.keys("++");
    let mut steps = Vec::new();
    for _ in 0..3 {
        watched.obey(true);
        steps.push(watched.screen.done);
    }
    assert_eq!(steps, [5, 7, 7]);
    assert!(watched.text().starts_with("step 7 of 7  ended: all steps are done  time 3.5 s  "));
    // Nothing goes beyond the end; a new beginning does.
    watched.keys("n ");
    assert_eq!(watched.screen.done, 7);
    watched.keys("r");
    assert_eq!((watched.screen.done, watched.screen.has_ended()), (0, false));
    assert_alive(&mut watched, BLINKER);
}

#[test]
fn the_model_may_end_the_run() {
    let model = Model::builder("short")
        .extents([4, 4, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .substates::<Life>()
        .process(evolve)
        .stop_when(Schedule::Every(1), |state| Ok((state.step() == 3).then(|| "it is enough".to_owned())))
        .build();
    let mut watched = Watched::new(SetUp::new(model.unwrap(), 10), None);
    watched.keys("++++");
    watched.obey(true);
    assert!(watched.text().starts_with("step 3  ended: it is enough  "), "{}", watched.text());
}

#[test]
fn keys_do_what_the_help_says() {
    let mut watched = Watched::new(life([8, 8, 1], BLINKER), None);
    assert!(watched.screen.is_running());
    assert_eq!(watched.press(KeyCode::Char(' ')), Reaction::AtOnce);
    assert!(!watched.screen.is_running() && watched.screen.take_order(true).is_none());
    assert_eq!(watched.press(KeyCode::Char(' ')), Reaction::AtOnce);
    assert!(watched.screen.is_running());
    for code in [KeyCode::Char('q'), KeyCode::Esc] {
        assert_eq!(watched.press(code), Reaction::Quit);
    }
    let key = |code, modifiers| KeyEvent::new(code, modifiers);
    assert_eq!(watched.screen.press(key(KeyCode::Char('c'), KeyModifiers::CONTROL)), Reaction::Interrupt);
    assert_eq!(watched.screen.press(key(KeyCode::Char('q'), KeyModifiers::CONTROL)), Reaction::Nothing);
    let release = KeyEvent { kind: KeyEventKind::Release, ..KeyEvent::from(KeyCode::Char('q')) };
    assert_eq!(watched.screen.press(release), Reaction::Nothing);
    assert_eq!(watched.press(KeyCode::Char('ä')), Reaction::Nothing);
    // Steps that are asked for while others are done are not lost.
    for _ in 0..3 {
        watched.screen.press(KeyEvent::from(KeyCode::Char('.')));
    }
    watched.obey(false);
    assert_eq!((watched.screen.done, watched.screen.is_paused), (3, true));
}

#[test]
fn the_next_substate_has_its_own_scale_and_colours() {
    let mut watched = Watched::new(life([8, 8, 1], BLINKER), None);
    assert!(watched.text().contains("alive  █ 0  █ 1"), "{}", watched.text());
    watched.press(KeyCode::Tab);
    assert!(watched.text().contains("age  █ 0"), "{}", watched.text());
    watched.keys("nn");
    let text = watched.text();
    assert!(text.contains(&format!("age  0 {} 2", "█".repeat(24))), "{text}");
    // All are 2, the end of the scale: Oklab (0.93, 0.165, 103°).
    let buffer = watched.drawn(8, 5);
    assert!(
        halves(&buffer, Rect::new(0, 1, 8, 4)).concat().iter().all(|c| *c == Some(Color::Rgb(252, 236, 87)))
    );
    // Anew, the scale has one value.
    watched.keys("s");
    assert!(watched.text().contains("age  █ 2"), "{}", watched.text());
    watched.press(KeyCode::BackTab);
    assert_alive(&mut watched, BLINKER);
}

#[test]
fn small_spaces_grow_and_large_ones_shrink() {
    let mut watched = Watched::new(life([8, 8, 1], BLINKER), None);
    // Of 12 lines 4 are words. 20 by 16 half blocks are two for each cell, each way, and a margin.
    let rows = halves(&watched.drawn(20, 12), Rect::new(0, 1, 20, 8));
    let row = |margin: usize, cells: &[Color]| -> Vec<Option<Color>> {
        let margin = vec![None; margin];
        [margin.clone(), cells.iter().copied().map(Some).collect(), margin].concat()
    };
    let line = [DEAD, DEAD, DEAD, ALIVE, ALIVE, ALIVE, DEAD, DEAD];
    let twice: Vec<Color> = line.iter().flat_map(|colour| [*colour; 2]).collect();
    assert_eq!([&rows[6], &rows[7]], [&row(2, &twice); 2]);
    assert_eq!([&rows[5], &rows[8]], [&row(2, &[DEAD; 16]); 2]);
    // 20 by 12 half blocks: one for each cell, and a margin on all sides.
    let rows = halves(&watched.drawn(20, 10), Rect::new(0, 1, 20, 6));
    assert_eq!(rows[1], [None; 20]);
    assert_eq!(rows[2 + 3], row(6, &line));
    assert_eq!(rows[2 + 4], row(6, &[DEAD; 8]));
    assert_eq!(rows[10], [None; 20]);
    // A quarter of the cells: the mean of two by two colours, in linear light.
    let mut watched = Watched::new(life([8, 8, 1], &[[0, 0], [1, 0], [2, 2], [6, 0]]), None);
    let rows = halves(&watched.drawn(4, 3), Rect::new(0, 1, 4, 2));
    let (half, quarter) = (Color::Rgb(180, 185, 196), Color::Rgb(214, 218, 224));
    assert_eq!(rows[3], [half, DEAD, DEAD, quarter].map(Some));
    assert_eq!(rows[2], [DEAD, quarter, DEAD, DEAD].map(Some));
    assert_eq!(rows[0], [Some(DEAD); 4]);
}

#[test]
fn close_one_moves_over_the_cells() {
    let mut watched = Watched::new(life([64, 64, 1], &[[0, 63], [30, 32], [63, 0]]), None);
    let place = |watched: &mut Watched| -> Vec<(usize, usize)> {
        let rows = halves(&watched.drawn(8, 5), Rect::new(0, 1, 8, 4));
        let alive = |(y, row): (usize, &Vec<Option<Color>>)| -> Vec<(usize, usize)> {
            let alive = row.iter().enumerate().filter(|(_, colour)| **colour == Some(ALIVE));
            alive.map(|(x, _)| (x, y)).collect()
        };
        rows.iter().enumerate().flat_map(alive).collect()
    };
    assert_eq!(place(&mut watched), []);
    // Eight by eight cells from (28, 28): the row 32 is the fourth from the top.
    watched.keys("z");
    assert_eq!(place(&mut watched), [(2, 3)]);
    watched.press(KeyCode::Right);
    assert_eq!(place(&mut watched), [(0, 3)]);
    watched.press(KeyCode::Up);
    watched.press(KeyCode::Up);
    assert_eq!(place(&mut watched), [(0, 7)]);
    for _ in 0..70 {
        watched.screen.press(KeyEvent::from(KeyCode::Left));
        watched.screen.press(KeyEvent::from(KeyCode::Up));
    }
    assert_eq!(place(&mut watched), [(0, 0)]);
    watched.keys("z");
    assert_eq!(place(&mut watched), []);
    // From far, nothing moves.
    watched.press(KeyCode::Right);
    watched.keys("z");
    assert_eq!(place(&mut watched), [(0, 0)]);
}

#[test]
fn without_colours_there_are_characters() {
    let mut watched = Watched::new(life([8, 8, 1], &[[0, 7], [1, 6], [2, 7], [2, 6]]), None);
    watched.screen.colours = Colours::None;
    let buffer = watched.drawn(8, 5);
    assert_eq!(text(&buffer).lines().nth(1), Some("▀▄█     "));
    assert!(buffer.content.iter().all(|cell| (cell.fg, cell.bg) == (Color::Reset, Color::Reset)));
    assert!(watched.text().contains("alive    0  █ 1"), "{}", watched.text());
    watched.screen.colours = Colours::Indexed;
    let buffer = watched.drawn(8, 5);
    assert!(buffer.content[8..].iter().all(|cell| matches!(cell.bg, Color::Indexed(_))));
}

#[derive(Substates, Clone)]
struct Bar {
    temperature: Real,
}

#[elementary_process]
fn stay(cell: &mut Cell<Bar>) {
    cell.temperature += 0.0;
}

#[test]
fn layers_lie_along_any_axis() {
    // The temperature says where the cell is: 100 x + 10 y + z.
    let model = Model::builder("bar")
        .extents([4, 3, 2])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .substates::<Bar>()
        .process(stay)
        .fill(|[x, y, z]| Bar { temperature: (100 * x + 10 * y + z) as f64 })
        .build();
    let view =
        CellView::named("bar").draw(Bar::TEMPERATURE, "T (K^2)").range(0.0, 321.0).map(ColourMap::Paper);
    let mut watched = Watched::new(SetUp::new(model.unwrap(), 10).cells(view), None);
    let values = |watched: &Watched| watched.screen.news.as_ref().unwrap().sight.values.clone();
    let of_z =
        |z: usize| -> Vec<f64> { (0..12).map(|i| (100 * (i % 4) + 10 * (i / 4) + z) as f64).collect() };
    assert_eq!(values(&watched), of_z(1));
    assert!(watched.text().contains("T (K²)  0 ████████████████████████ 321  layer 1 of 2 along z"));
    watched.keys("[");
    assert_eq!(values(&watched), of_z(0));
    watched.keys("[");
    assert_eq!(values(&watched), of_z(0));
    watched.press(KeyCode::PageUp);
    assert_eq!(values(&watched), of_z(1));
    watched.keys("]a");
    // Seen along x: y across, z up, in the middle layer.
    assert_eq!(values(&watched), [200.0, 210.0, 220.0, 201.0, 211.0, 221.0]);
    assert!(watched.text().contains("layer 2 of 4 along x"));
    watched.keys("a");
    assert_eq!(values(&watched), [10.0, 110.0, 210.0, 310.0, 11.0, 111.0, 211.0, 311.0]);
    // The highest row is drawn above.
    let rows = halves(&watched.drawn(4, 2), Rect::new(0, 1, 4, 1));
    let paper =
        |value: f64| Some(Colours::True.of(ColourMap::Paper.linear((value / 321.0 * 255.0).round() / 255.0)));
    assert_eq!(rows, [[11.0, 111.0, 211.0, 311.0].map(paper), [10.0, 110.0, 210.0, 310.0].map(paper)]);
}

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

/// The items that are seen, as column and row of the pixel and their place on the scale: the places that are not those of the background.
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
    // The first, which stands still, hides the second: its colour is that of 0 (Oklab 0.37, 0.145, 300°), a little darker by its distance.
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

/// A state of any model: `kinds` and `is_layer` as they may be.
fn any_news() -> impl Strategy<Value = News> {
    let value = prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(0.0), Just(1.0), -1e300..1e300];
    let layer = (1_usize..40, 1_usize..40, prop::collection::vec(value.clone(), 1600), 0_usize..3).prop_map(
        |(across, down, mut values, axis)| {
            values.truncate(across * down);
            (Subject::Layer { cells: [across, down], axis, layer: 0, layers: 1 }, values)
        },
    );
    let extents = prop::array::uniform3(1_usize..20);
    let positions = prop::collection::vec(prop::array::uniform3(value.clone()), 0..30);
    let items = (extents, positions, 0.0..3.0, value).prop_map(|(extents, positions, radius, value)| {
        let values = vec![value; positions.len()];
        (Subject::Items { positions, radius, extents }, values)
    });
    (prop_oneof![layer, items], any::<bool>(), any::<bool>()).prop_map(
        |((subject, values), has_kinds, has_ended)| {
            let kinds =
                if has_kinds { vec![(0.0, "none".to_owned()), (1.0, "some".to_owned())] } else { Vec::new() };
            News {
                step: 3,
                sight: Sight {
                    subject,
                    values,
                    substate: "alive".to_owned(),
                    label: "a^2".to_owned(),
                    map: ColourMap::default(),
                    kinds,
                    range: None,
                },
                observables: vec![crate::Observable::new("energy", "J", 1.5)],
                observed: 2,
                end: has_ended.then(|| "ended".to_owned()),
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]
    #[test]
    fn no_state_and_no_size_of_the_terminal_is_too_much(
        news in any_news(),
        sizes in prop::collection::vec((1_u16..60, 1_u16..40), 1..4),
        keys in "[zhjklna+ .-]{0,8}",
        colours in prop_oneof![Just(Colours::True), Just(Colours::Indexed), Just(Colours::None)],
    ) {
        let facts = Facts { note: Some("ein Ü".to_owned()), substates: vec!["alive"], ..Facts::default() };
        let mut screen = Screen::new(facts, colours, Pace::new(1, 20), Look::default());
        for (width, height) in sizes {
            drawn(&mut screen, width, height);
            screen.tell(news.clone());
            for key in keys.chars() {
                screen.press(KeyEvent::from(KeyCode::Char(key)));
                drawn(&mut screen, width, height);
            }
        }
    }
}

#[test]
fn words_give_way_to_the_picture() {
    let mut watched = Watched::new(life([8, 8, 1], BLINKER), None);
    watched.screen.facts.note = Some("this is no GPU".to_owned());
    let mut has = |width, height, what: &str| text(&watched.drawn(width, height)).contains(what);
    assert!(has(1, 1, "s") && has(10, 3, "step 0") && has(10, 3, "▀"));
    assert!(!has(100, 5, "quit") && has(100, 6, "quit"));
    assert!(!has(100, 9, "alive_sum") && has(100, 10, "alive_min 0  alive_sum 3  alive_max 1"));
    assert!(!has(100, 11, "no GPU") && has(100, 12, "note: this is no GPU"));
    assert!(!has(30, 24, "some engine"));
    assert!(has(40, 24, "some engine") && !has(40, 24, "much") && !has(40, 24, "life"));
    assert!(has(100, 24, "some engine with much to say") && has(100, 24, "life"));
}
