//! Parts of a space whose messages are late: how much of the delay a run shows.

use crate::timing::{Times, interleaved};
use std::error::Error;
use std::fmt;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};
use xca_core::engine::{Execution, StartError};
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_parts::{Balance, Channels, Grid, Tag, Transport, TransportError, host, serve};

/// Two parts with one thread each, whose messages about edges arrive after a delay.
#[derive(Debug)]
struct Late {
    delay: Duration,
}

/// The transport of one part.
struct Delayed {
    channels: Channels,
    delay: Duration,
    /// The origin of the times in messages.
    start: Instant,
}

impl Delayed {
    const STAMP: usize = size_of::<u64>();
}

impl Transport for Delayed {
    fn number(&self) -> usize {
        self.channels.number()
    }

    fn count(&self) -> usize {
        self.channels.count()
    }

    fn send(&mut self, to: usize, tag: Tag, mut bytes: Vec<u8>) -> Result<(), TransportError> {
        let arrival = self.start.elapsed() + self.delay;
        bytes.extend_from_slice(&(arrival.as_nanos() as u64).to_le_bytes());
        self.channels.send(to, tag, bytes)
    }

    fn receive(&mut self, from: usize, tag: Tag) -> Result<Vec<u8>, TransportError> {
        let mut bytes = self.channels.receive(from, tag)?;
        let stamp = *bytes.last_chunk::<{ Self::STAMP }>().ok_or(TransportError::Garbled { part: from })?;
        bytes.truncate(bytes.len() - Self::STAMP);
        let arrival = Duration::from_nanos(u64::from_le_bytes(stamp));
        if matches!(tag, Tag::Edge(_)) {
            thread::sleep(arrival.saturating_sub(self.start.elapsed()));
        }
        Ok(bytes)
    }

    fn end(&mut self) {
        self.channels.end();
    }
}

impl Engine for Late {
    fn name(&self) -> &str {
        "late parts"
    }

    fn threads(&self) -> usize {
        2
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let other = |error: &dyn fmt::Display| StartError::Other {
            engine: self.name().to_owned(),
            reason: error.to_string(),
        };
        let grid = Grid::into_parts(model, 2, self.name())?;
        let start = Instant::now();
        let late = |channels| Box::new(Delayed { channels, delay: self.delay, start });
        let [own, second] = <[Channels; 2]>::try_from(Channels::connect(2))
            .map_err(|ends| other(&format!("{} ends", ends.len())))?
            .map(late);
        let engine = || Cpu::with_threads(1).map(Arc::new).map_err(|error| other(&error));
        let (beside, of_second) = (engine()?, model.clone());
        thread::spawn(move || serve(beside, &of_second, precision, grid, second));
        host(engine()?, model, precision, grid, Balance::NEVER, own)
    }
}

/// The cost of a step with each delay.
pub(crate) struct Cost {
    name: &'static str,
    /// The messages that a part waits for in a step, one after the other.
    messages: f64,
    delays: Vec<(Duration, Times)>,
}

/// Runs a model with each delay, in turns. The first delay should be zero.
pub(crate) fn cost(
    name: &'static str,
    model: &Model,
    delays: &[Duration],
    rounds: usize,
    steps: u64,
) -> Result<Cost, Box<dyn Error>> {
    let options = RunOptions { precision: Precision::F64, seed: 1 };
    let mut simulations = Vec::new();
    for delay in delays {
        simulations.push(Simulation::new(model, &Late { delay: *delay }, options)?);
    }
    let failures = std::cell::RefCell::new(Vec::new());
    let mut runs: Vec<Box<dyn FnMut() + '_>> = Vec::new();
    for simulation in &mut simulations {
        let failures = &failures;
        runs.push(Box::new(move || failures.borrow_mut().extend(simulation.run(steps).err())));
    }
    let mut contenders: Vec<&mut dyn FnMut()> = runs.iter_mut().map(|run| &mut **run as _).collect();
    let times = interleaved(rounds, &mut contenders);
    drop(runs);
    if let Some(failure) = failures.into_inner().into_iter().next() {
        return Err(failure.into());
    }
    let first = simulations.first().ok_or("no delays")?;
    let sent = first.figures().into_iter().find(|figure| figure.name == "part_0_messages_sent");
    let messages = sent.map_or(0.0, |sent| sent.value) / first.step_number() as f64;
    let times = times.into_iter().map(|times| times.per(steps as usize));
    Ok(Cost { name, messages, delays: delays.iter().copied().zip(times).collect() })
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} in two parts, {:.0} messages to wait for in a step:", self.name, self.messages)?;
        let without = self.delays.first().map_or(0.0, |(_, times)| times.median());
        for (delay, times) in &self.delays {
            let (low, high) = times.spread();
            let milliseconds = times.median() * 1e3;
            write!(f, "\n  delay {} ms: {milliseconds:.2} ms a step", delay.as_secs_f64() * 1e3)?;
            write!(f, " ({:.2} to {:.2})", low * 1e3, high * 1e3)?;
            let late = delay.as_secs_f64() * self.messages;
            if late > 0.0 {
                let hidden = 1.0 - (times.median() - without) / late;
                write!(f, "; of {:.2} ms of delays {:.0} % are hidden", late * 1e3, hidden * 100.0)?;
            }
        }
        Ok(())
    }
}
