//! What is on the screen, and what keys do to it. Nothing here knows of a terminal, a clock or a simulation.

mod drawing;

use super::colours::Colours;
use super::pace::Pace;
use super::pixels::{looked_along, plane};
use super::window::{Place, Window};
use super::worker::{Advance, News, Order};
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};
use xca_picture::Palette;
use xca_record::record::{Look, Subject};

/// The lightness of items that have no colours: they must stand out from what is behind them.
const DARKEST_ITEM: f32 = 0.5;

/// What stays the same while a run is watched.
#[derive(Debug, Clone, Default)]
pub(super) struct Facts {
    pub(super) title: String,
    /// The engine with all that is to say of it, and its name.
    pub(super) engine: [String; 2],
    /// What has to be known of the engine.
    pub(super) note: Option<String>,
    /// In seconds, if the model says.
    pub(super) time_step: Option<f64>,
    /// How many steps are done, if there is an end.
    pub(super) wanted: Option<u64>,
    pub(super) substates: Vec<&'static str>,
}

/// What a key asks for beyond the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reaction {
    Nothing,
    /// The screen is another one.
    Redraw,
    /// And it must not wait until the next picture.
    AtOnce,
    Quit,
    Interrupt,
}

/// What is on the screen.
#[derive(Debug)]
pub(super) struct Screen {
    pub(super) facts: Facts,
    pub(super) colours: Colours,
    pub(super) pace: Pace,
    pub(super) is_paused: bool,
    /// Steps are being done that no one has asked for one by one.
    pub(super) is_under_way: bool,
    pub(super) place: Place,
    pub(super) news: Option<News>,
    /// The steps that are done, which may be more than those of the news.
    pub(super) done: u64,
    /// Steps a second.
    pub(super) rate: Option<f64>,
    look: Look,
    /// The look that was asked for on the command line, and the substate that it shows.
    first: (Look, Option<String>),
    /// What the next order is to be.
    single_steps: u64,
    is_stale: bool,
    restarts: bool,
    rescales: bool,
    /// The room for the picture.
    room: [usize; 2],
}

impl Screen {
    pub(super) fn new(facts: Facts, colours: Colours, pace: Pace, look: Look) -> Self {
        Self {
            facts,
            colours,
            pace,
            is_paused: false,
            is_under_way: false,
            place: Place::default(),
            news: None,
            done: 0,
            rate: None,
            first: (look.clone(), None),
            look,
            single_steps: 0,
            is_stale: true,
            restarts: false,
            rescales: false,
            room: [0; 2],
        }
    }

    /// Takes what the worker has answered.
    pub(super) fn tell(&mut self, news: News) {
        self.done = news.step;
        self.first.1.get_or_insert_with(|| news.sight.substate.clone());
        self.news = Some(news);
    }

    pub(super) fn has_ended(&self) -> bool {
        self.news.as_ref().is_some_and(|news| news.end.is_some())
    }

    /// Whether steps are done as long as no key says otherwise.
    pub(super) fn is_running(&self) -> bool {
        !self.is_paused && !self.has_ended()
    }

    /// The axis that was chosen, if one was.
    pub(super) fn axis(&self) -> Option<usize> {
        self.look.axis
    }

    /// What the worker should do next.
    pub(super) fn take_order(&mut self, is_picture_due: bool) -> Option<Order> {
        let advance = if std::mem::take(&mut self.restarts) {
            self.single_steps = 0;
            Advance::Restart
        } else if self.single_steps > 0 && !self.has_ended() {
            Advance::Steps(std::mem::take(&mut self.single_steps))
        } else if self.is_stale {
            Advance::None
        } else if self.is_running() && is_picture_due {
            Advance::ToMultiple(self.pace.every())
        } else {
            return None;
        };
        self.is_stale = false;
        Some(Order { advance, look: self.look.clone(), rescales: std::mem::take(&mut self.rescales) })
    }

    /// Does what a key stands for.
    pub(super) fn press(&mut self, key: KeyEvent) -> Reaction {
        if key.kind == KeyEventKind::Release {
            return Reaction::Nothing;
        }
        if key.modifiers.contains(KeyModifiers::CONTROL) {
            return if key.code == KeyCode::Char('c') { Reaction::Interrupt } else { Reaction::Nothing };
        }
        match key.code {
            KeyCode::Char('q') | KeyCode::Esc => return Reaction::Quit,
            KeyCode::Char(' ') => {
                self.is_paused = !self.is_paused;
                return Reaction::AtOnce;
            }
            KeyCode::Char('n' | '.') if !self.has_ended() => {
                (self.is_paused, self.single_steps) = (true, self.single_steps + 1);
                return Reaction::AtOnce;
            }
            KeyCode::Char('r') => {
                (self.restarts, self.rescales) = (true, true);
                return Reaction::AtOnce;
            }
            KeyCode::Char('+' | '=') => self.pace.faster(),
            KeyCode::Char('-' | '_') => self.pace.slower(),
            KeyCode::Char('z') => self.place.is_close = !self.place.is_close,
            KeyCode::Left | KeyCode::Char('h') => self.move_by([-1, 0]),
            KeyCode::Right | KeyCode::Char('l') => self.move_by([1, 0]),
            KeyCode::Up | KeyCode::Char('k') => self.move_by([0, 1]),
            KeyCode::Down | KeyCode::Char('j') => self.move_by([0, -1]),
            KeyCode::Char('s') => return self.stale(|screen| screen.rescales = true),
            KeyCode::Char('a') => return self.stale(Self::turn),
            KeyCode::Tab => return self.stale(|screen| screen.next_substate(1)),
            KeyCode::BackTab => {
                return self
                    .stale(|screen| screen.next_substate(screen.facts.substates.len().saturating_sub(1)));
            }
            KeyCode::Char(']') | KeyCode::PageUp => return self.stale(|screen| screen.change_layer(1)),
            KeyCode::Char('[') | KeyCode::PageDown => return self.stale(|screen| screen.change_layer(-1)),
            _ => return Reaction::Nothing,
        }
        Reaction::Redraw
    }

    /// Changes what is looked at.
    fn stale(&mut self, change: impl FnOnce(&mut Self)) -> Reaction {
        let before = (self.look.clone(), self.rescales);
        change(self);
        if before == (self.look.clone(), self.rescales) {
            return Reaction::Nothing;
        }
        self.is_stale = true;
        Reaction::AtOnce
    }

    fn subject(&self) -> Option<&Subject> {
        self.news.as_ref().map(|news| &news.sight.subject)
    }

    /// What is on the screen as a whole, in cells.
    fn plane(&self) -> Option<[usize; 2]> {
        self.subject().map(|subject| plane(subject, self.look.axis))
    }

    fn window(&self) -> Option<Window> {
        let are_cells_drawn = matches!(self.subject()?, Subject::Layer { .. });
        Window::new(self.plane()?, self.room, self.place, are_cells_drawn)
    }

    fn move_by(&mut self, by: [i8; 2]) {
        if !self.place.is_close {
            return;
        }
        if let (Some(plane), Some(window)) = (self.plane(), self.window()) {
            self.place = window.moved(plane, by);
        }
    }

    /// Looks along the next axis.
    fn turn(&mut self) {
        let now = match self.subject() {
            // A plane has no other sides.
            Some(Subject::Layer { axis: 2, layers: 1, .. }) | None => return,
            Some(Subject::Layer { axis, .. }) => self.look.axis.unwrap_or(*axis),
            Some(Subject::Items { extents, .. }) => looked_along(self.look.axis, *extents),
        };
        (self.look.axis, self.look.layer) = (Some((now + 1) % 3), None);
        self.place.middle = [0.5; 2];
    }

    fn change_layer(&mut self, by: i64) {
        if let Some(&Subject::Layer { layer, layers, .. }) = self.subject() {
            let layer = self.look.layer.unwrap_or(layer) as i64 + by;
            self.look.layer = Some(layer.clamp(0, layers as i64 - 1) as usize);
        }
    }

    fn next_substate(&mut self, by: usize) {
        let names = &self.facts.substates;
        let shown = self.news.as_ref().map(|news| &news.sight.substate);
        let Some(shown) = self.look.substate.as_ref().or(shown) else { return };
        let place = names.iter().position(|name| name == shown);
        let next = place.map_or(0, |place| (place + by) % names.len().max(1));
        let Some(name) = names.get(next).filter(|name| *name != shown) else { return };
        let (first, of_first) = &self.first;
        // The range of the command line is that of the substate that is shown first.
        self.look.range = first.range.filter(|_| of_first.as_deref() == Some(*name));
        self.look.substate = Some((*name).to_owned());
    }

    /// The colours of what is seen.
    pub(super) fn palette(&self) -> Option<Palette> {
        let sight = &self.news.as_ref()?.sight;
        Some(match (self.colours, &sight.subject) {
            (Colours::None, Subject::Items { .. }) => Palette::shades(DARKEST_ITEM, sight.kinds.len()),
            (Colours::None, Subject::Layer { .. }) => Palette::shades(0.0, sight.kinds.len()),
            _ => Palette::coloured(sight.map, &sight.kinds),
        })
    }
}

#[cfg(test)]
mod tests;
