//! The keys, the clock and the terminal.

use super::full_screen::FullScreen;
use super::keyboard::{Input, Keyboard};
use super::screen::{Reaction, Screen};
use super::worker::{Advance, News, Order, Shared, Worker};
use std::collections::VecDeque;
use std::panic;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};
use std::thread;
use std::time::{Duration, Instant};
use xca_core::Simulation;
use xca_record::Failure;

/// How long one waits for a key before one looks for other things: while steps are done, and else.
const BUSY: Duration = Duration::from_millis(8);
const IDLE: Duration = Duration::from_millis(40);
/// So many keys are heard before the next picture.
const MOST_KEYS: usize = 1000;
/// An order that takes longer than this shows how far it has come.
const LONG: Duration = Duration::from_millis(300);
/// The time over which steps a second are counted.
const WHILE: Duration = Duration::from_secs(2);

/// Why a run is watched no longer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// A key said so.
    Left,
    /// It was interrupted, or the terminal is gone.
    Interrupted,
}

/// Lets the worker run as the keys say, until one says that it is enough.
pub(super) fn watch(
    screen: &mut Screen,
    worker: &Worker<'_>,
    simulation: Simulation,
    interrupt: &AtomicBool,
) -> Result<Ended, Failure> {
    thread::scope(|scope| {
        let (orders, received) = mpsc::channel();
        let (answers, news) = mpsc::channel();
        let at_work = scope.spawn(move || worker.work(simulation, &received, &answers));
        // The terminal is given back at the end of this statement, while the worker may be in a long step.
        let ended = FullScreen::enter().map_err(Failure::from).and_then(|full_screen| {
            let (shared, keyboard) = (worker.shared, Keyboard::listen()?);
            Session { screen, full_screen, keyboard, orders, news, shared, interrupt, under_way: None }.go()
        });
        worker.shared.halt.store(true, Ordering::Relaxed);
        // From now on Ctrl-C is a signal again, and ends the program at once.
        interrupt.store(true, Ordering::Relaxed);
        match at_work.join() {
            Ok(()) => ended,
            Err(panic) => panic::resume_unwind(panic),
        }
    })
}

struct Session<'a> {
    screen: &'a mut Screen,
    full_screen: FullScreen,
    keyboard: Keyboard,
    orders: Sender<Order>,
    news: Receiver<Result<News, Failure>>,
    shared: &'a Shared,
    interrupt: &'a AtomicBool,
    /// The order that has no answer yet, and since when.
    under_way: Option<(Advance, Instant)>,
}

impl Session<'_> {
    fn go(mut self) -> Result<Ended, Failure> {
        let mut rate = Rate::default();
        let mut picture = Instant::now();
        let mut is_stale = true;
        loop {
            if self.interrupt.load(Ordering::Relaxed) {
                return Ok(Ended::Interrupted);
            }
            match self.news.try_recv() {
                Ok(news) => {
                    self.screen.tell(news?);
                    (self.under_way, is_stale) = (None, true);
                }
                Err(TryRecvError::Empty) => {}
                // The worker has panicked; whoever waits for it will see.
                Err(TryRecvError::Disconnected) => return Ok(Ended::Left),
            }
            let now = Instant::now();
            if self.under_way.is_none()
                && let Some(order) = self.screen.take_order(now >= picture)
            {
                if matches!(order.advance, Advance::ToMultiple(_)) {
                    // In time with the clock, unless pictures take longer than that.
                    let interval = self.screen.pace.interval();
                    picture = if now > picture + interval { now + interval } else { picture + interval };
                }
                self.shared.halt.store(false, Ordering::Relaxed);
                self.under_way = Some((order.advance, now));
                // Where the worker is gone, the next look for news tells.
                let _ = self.orders.send(order);
            }
            if let Some((_, since)) = self.under_way
                && now - since > LONG
            {
                let done = self.shared.done.load(Ordering::Relaxed);
                is_stale |= done != self.screen.done;
                self.screen.done = done;
            }
            self.screen.is_under_way = matches!(self.under_way, Some((Advance::ToMultiple(_), _)));
            self.screen.rate = rate.of(self.screen.is_running(), self.screen.done, now);
            if is_stale {
                let screen = &mut *self.screen;
                let drawn = self.full_screen.draw(|area, buffer| screen.draw(area, buffer));
                if let Err(error) = drawn {
                    return if self.is_alone() { Ok(Ended::Interrupted) } else { Err(error.into()) };
                }
                is_stale = false;
            }
            let mut patience = if self.screen.is_running() || self.under_way.is_some() { BUSY } else { IDLE };
            for _ in 0..MOST_KEYS {
                match self.keyboard.next(patience) {
                    Input::Nothing => break,
                    Input::Closed => return Ok(Ended::Interrupted),
                    Input::Resized => {
                        self.full_screen.resize()?;
                        is_stale = true;
                    }
                    Input::Key(key) => match self.screen.press(key) {
                        Reaction::Nothing => {}
                        Reaction::Redraw => is_stale = true,
                        Reaction::AtOnce => {
                            self.hurry();
                            is_stale = true;
                        }
                        Reaction::Quit => return Ok(Ended::Left),
                        Reaction::Interrupt => return Ok(Ended::Interrupted),
                    },
                }
                patience = Duration::ZERO;
            }
        }
    }

    /// Whether the terminal has gone, which its keys and a signal tell soon after a picture could not be
    /// drawn.
    fn is_alone(&mut self) -> bool {
        loop {
            match self.keyboard.next(LONG) {
                Input::Closed => return true,
                Input::Nothing => return self.interrupt.load(Ordering::Relaxed),
                Input::Key(_) | Input::Resized => {}
            }
        }
    }

    /// Ends the order under way after its present step, unless it is one that was asked for step by step.
    fn hurry(&self) {
        if let Some((Advance::ToMultiple(_), _)) = self.under_way {
            self.shared.halt.store(true, Ordering::Relaxed);
        }
    }
}

/// Steps a second, as of late.
#[derive(Debug, Default)]
struct Rate {
    marks: VecDeque<(Instant, u64)>,
}

impl Rate {
    fn of(&mut self, is_running: bool, done: u64, now: Instant) -> Option<f64> {
        if !is_running || self.marks.back().is_some_and(|(_, last)| *last > done) {
            self.marks.clear();
        }
        if self.marks.back().is_none_or(|(_, last)| *last != done) {
            self.marks.push_back((now, done));
        }
        // One mark is kept from before that while, or a slow model would have no rate.
        while self.marks.get(1).is_some_and(|(at, _)| now - *at > WHILE) {
            self.marks.pop_front();
        }
        let ((from, first), (to, last)) = (self.marks.front()?, self.marks.back()?);
        let seconds = (*to - *from).as_secs_f64();
        (seconds > 0.0).then(|| (last - first) as f64 / seconds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_is_that_of_the_last_while() {
        let begin = Instant::now();
        let at = |millis: u64| begin + Duration::from_millis(millis);
        let mut rate = Rate::default();
        assert_eq!(rate.of(true, 0, at(0)), None);
        assert_eq!(rate.of(true, 10, at(1000)), Some(10.0));
        // Nothing happens for a moment.
        assert_eq!(rate.of(true, 10, at(1500)), Some(10.0));
        assert_eq!(rate.of(true, 110, at(2000)), Some(55.0));
        assert_eq!(rate.of(true, 210, at(3000)), Some(70.0));
        // What was first is forgotten.
        assert_eq!(rate.of(true, 310, at(4000)), Some(100.0));
        // A pause, and a new beginning.
        assert_eq!(rate.of(false, 310, at(4100)), None);
        assert_eq!(rate.of(true, 320, at(5100)), Some(10.0));
        assert_eq!(rate.of(true, 330, at(6100)), Some(10.0));
        assert_eq!(rate.of(true, 5, at(6200)), None);
        // A slow model.
        assert_eq!(rate.of(true, 6, at(16_200)), Some(0.1));
    }
}
