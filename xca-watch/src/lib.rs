//! A run that is watched in the terminal: pictures of half blocks, and keys that pause, step and look
//! elsewhere.
//!
//! The steps are done on a thread of their own ([`Watch::show`]), so that keys are heard during a long one.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod blocks;
mod colours;
mod full_screen;
mod keyboard;
mod keys;
mod pace;
mod pixels;
mod screen;
mod session;
mod window;
mod words;
mod worker;

pub use full_screen::give_back;
pub use session::Ended;

use colours::Colours;
use pace::Pace;
use screen::{Facts, Screen};
use std::sync::atomic::AtomicBool;
use worker::{Shared, Worker};
use xca_core::{Engine, RunOptions, Simulation};
use xca_record::Failure;
use xca_record::record::{Look, Recorder};

/// A run that is to be watched.
#[derive(Debug)]
pub struct Watch<'a> {
    /// What is shown of the model.
    pub recorder: &'a Recorder,
    /// The engine, on which the run is begun anew if a key says so.
    pub engine: &'a dyn Engine,
    /// The engine with all that is to say of it, and its name.
    pub engine_words: [String; 2],
    /// Precision and seed.
    pub options: RunOptions,
    /// The steps after which the run ends, if it does.
    pub steps: Option<u64>,
    /// The steps from one picture to the next.
    pub every: u64,
    /// The most pictures a second.
    pub fps: u16,
    /// What is looked at.
    pub look: Look,
}

impl Watch<'_> {
    /// Takes the terminal, and shows the run until it is left by a key, by `interrupt`, or as the terminal is
    /// gone.
    ///
    /// # Errors
    /// Where the terminal cannot be taken or drawn on, or the run fails.
    pub fn show(self, simulation: Simulation, interrupt: &AtomicBool) -> Result<Ended, Failure> {
        let Self { recorder, engine, options, .. } = self;
        let facts = Facts {
            title: recorder.set_up().title.clone(),
            engine: self.engine_words,
            note: engine.note(),
            time_step: recorder.set_up().time_step,
            wanted: self.steps,
            substates: recorder.substates(),
        };
        let pace = Pace::new(self.every, self.fps);
        let mut screen = Screen::new(facts, Colours::of_environment(), pace, self.look);
        let shared = Shared::default();
        let worker = Worker { recorder, engine, options, wanted: self.steps, shared: &shared };
        session::watch(&mut screen, &worker, simulation, interrupt)
    }
}
