//! Cells, and the keys.

use super::*;
use xca_picture::ColourMap;
use xca_record::CellView;

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
    let (half, quarter) = (Color::Rgb(182, 184, 194), Color::Rgb(217, 218, 224));
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
        .fill(|site| {
            let [x, y, z] = site.cell();
            Bar { temperature: (100 * x + 10 * y + z) as f64 }
        })
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
