//! What shows a run in the terminal.

mod blocks;
mod keyboard;
mod keys;
mod pace;
mod pixels;
mod screen;
mod session;
mod window;
mod words;
mod worker;

use super::super::parse::RunInvocation;
use super::super::prepare::{Prepared, warn};
use super::super::run::not_started;
use super::super::under_way::engine_words;
use super::super::{Ended, Unable};
use super::WatchArguments;
use crate::interrupt::Interrupt;
use blocks::Colours;
use pace::Pace;
use screen::{Facts, Screen};
use std::io::{IsTerminal, stdin, stdout};
use worker::{Shared, Worker};
use xca_core::Simulation;

/// In how many pictures the steps of the model are shown, unless the command line says how many there are from one to the next.
const PICTURES: u64 = 1000;

/// Shows a run in the terminal.
pub(super) fn show(invocation: &RunInvocation<'_>, arguments: &WatchArguments) -> Result<Ended, Unable> {
    let name = invocation.model.definition.name;
    if !(stdin().is_terminal() && stdout().is_terminal()) {
        return Err(Unable::refused(format!(
            "`{name} watch` needs a terminal to draw on and to read keys from; without one, `{name} run` writes files and `{name} render` draws pictures"
        )));
    }
    let Prepared { engine, run } = Prepared::new(invocation, &invocation.engine)?;
    let origin = run.origin().on(&*engine);
    let (report, options) = (run.report(&*engine, &origin), run.run_options());
    let recorder = run.into_recorder();
    let look = arguments.look.look();
    recorder.sighting(&look).map_err(Unable::refused)?;
    let simulation = Simulation::new(recorder.model(), &*engine, options).map_err(not_started)?;
    // They are read when the terminal is given back.
    warn(recorder.set_up());
    let interrupt = Interrupt::install().map_err(Unable::failed)?;
    let facts = Facts {
        title: recorder.set_up().title.clone(),
        engine: [engine_words(&report), format!("{} engine", report.engine)],
        note: engine.note(),
        time_step: recorder.set_up().time_step,
        wanted: arguments.steps,
        substates: recorder.substates(),
    };
    let every = arguments.every.unwrap_or(origin.steps_wanted / PICTURES);
    let pace = Pace::new(every, arguments.fps);
    let mut screen = Screen::new(facts, Colours::of_environment(), pace, look);
    let shared = Shared::default();
    let worker =
        Worker { recorder: &recorder, engine: &*engine, options, wanted: arguments.steps, shared: &shared };
    session::watch(&mut screen, &worker, simulation, &interrupt).map_err(Unable::Failed)
}
