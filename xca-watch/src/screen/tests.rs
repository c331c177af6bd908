//! What is on the screen, half block by half block, of states that are worked out by hand.

mod cells;
mod items;
mod sizes;

use super::*;
use crate::worker::{Shared, Worker};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;
use std::sync::atomic::Ordering;
use std::sync::mpsc;
use xca_core::prelude::*;
use xca_core::{Reference, RunOptions, Simulation};
use xca_record::SetUp;
use xca_record::record::Recorder;

/// The colours of a dead and a living cell: Oklab (0.97, 0.005, 250°) and (0.38, 0.09, 265°) in sRGB.
const DEAD: Color = Color::Rgb(246, 246, 250);
const ALIVE: Color = Color::Rgb(26, 52, 98);

#[derive(Substates, Clone, Copy)]
struct Life {
    alive: u8,
    age: Real,
}

#[elementary_process]
fn evolve(cell: &mut Cell<Life>) {
    let mut count = 0;
    for n in 1..cell.neighbour_count() {
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
        .fill(move |site| {
            let [x, y, _] = site.cell();
            Life { alive: u8::from(alive.contains(&[x, y])), age: 0.0 }
        })
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

    /// Has all orders so far carried out again on a new worker, of which the last answer is shown: so no
    /// state is kept but the screen's.
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

/// Demands that these cells, and no others, are alive in a space of 8 by 8 cells that is drawn with a pixel
/// each. A screen of 8 by 5 characters has one line of words, and 4 of the picture.
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
