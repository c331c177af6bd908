//! What shows a run in the terminal.

use super::super::choice::RunInvocation;
use super::super::outcome::{Ended, Unable};
use super::super::prepare::{Prepared, not_started, warn};
use super::super::under_way::engine_words;
use super::arguments::WatchArguments;
use crate::interrupt::Interrupt;
use std::io::{IsTerminal, stdin, stdout};
use xca_core::Simulation;
use xca_watch::Watch;

/// In how many pictures the steps of the model are shown, unless the command line says how many there are
/// from one to the next.
const PICTURES: u64 = 1000;

/// Shows a run in the terminal.
pub(super) fn show(invocation: &RunInvocation<'_>, arguments: &WatchArguments) -> Result<Ended, Unable> {
    if !(stdin().is_terminal() && stdout().is_terminal()) {
        return Err(Unable::refused(
            "`watch` needs a terminal; without one, `run` writes files and `render` draws pictures",
        ));
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
    let watch = Watch {
        recorder: &recorder,
        engine: &*engine,
        engine_words: [engine_words(&report), format!("{} engine", report.engine)],
        options,
        steps: arguments.steps,
        every: arguments.every.unwrap_or(origin.steps_wanted / PICTURES),
        fps: arguments.fps,
        look,
    };
    match watch.show(simulation, interrupt.flag()).map_err(Unable::Failed)? {
        xca_watch::Ended::Left => Ok(Ended::Done),
        xca_watch::Ended::Interrupted => Ok(Ended::Interrupted),
    }
}
