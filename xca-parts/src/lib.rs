//! One model on several engines at once, each with a part of the space.
//!
//! The parts run on engines that support parts of a space ([`Engine::start_part`]). Before a process reads
//! neighbours, parts exchange the edges of their rows. The state after each step has the same bits as on one
//! engine, for every cut. The bounds of parts follow the work ([`Balance`]).
//!
//! [`Parts`] is an engine whose parts are threads of this process. A [`Transport`] carries their messages.
//! [`serve`] and [`host`] work with any other transport in the same way.

mod balance;
mod border;
mod bounds;
mod cells;
mod channels;
mod collected;
mod crew;
mod cut;
mod fault;
mod greeting;
mod grid;
mod host;
mod message;
mod relocation;
mod rows;
mod shared;
mod traffic;
mod transport;
mod worker;

pub use balance::Balance;
pub use channels::Channels;
pub use grid::{Grid, GridError};
pub use transport::{Tag, Transport, TransportError};

use border::NAME;
use greeting::Greeting;
use host::Host;
use shared::Shared;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::thread::Builder;
use xca_core::engine::{Engine, Execution, StartError};
use xca_core::{Model, Precision};

/// An engine made of several engines. Each runs a part of the space on its own thread.
#[derive(Debug, Clone)]
pub struct Parts {
    /// The engines that run the parts, in turns.
    engines: Vec<Arc<dyn Engine>>,
    number: Number,
    balance: Balance,
}

/// The number of parts.
#[derive(Debug, Clone, Copy)]
enum Number {
    Exactly(usize),
    AtMost(usize),
    Grid(Grid),
}

impl Parts {
    /// `parts` parts on one engine, which share its threads. Starting a model fails if its space is too small
    /// for them.
    pub fn new(engine: impl Engine + 'static, parts: NonZeroUsize) -> Self {
        Self::on(vec![Arc::new(engine)], Number::Exactly(parts.get()))
    }

    /// One part for each engine. There must be at least one engine.
    pub fn with_engines(engines: Vec<Arc<dyn Engine>>) -> Self {
        let number = Number::Exactly(engines.len());
        Self::on(engines, number)
    }

    /// Like [`Self::new`], but with fewer parts if the space is too small.
    pub fn at_most(engine: impl Engine + 'static, parts: NonZeroUsize) -> Self {
        Self::on(vec![Arc::new(engine)], Number::AtMost(parts.get()))
    }

    /// Like [`Self::new`], with these numbers of parts along y and z.
    pub fn with_grid(engine: impl Engine + 'static, grid: Grid) -> Self {
        Self::on(vec![Arc::new(engine)], Number::Grid(grid))
    }

    /// The same engines, which run the parts of a grid in turns. `None` leaves the number of parts.
    pub fn in_grid(self, grid: impl Into<Option<Grid>>) -> Self {
        Self { number: grid.into().map_or(self.number, Number::Grid), ..self }
    }

    /// When the bounds of parts follow the work. The results are the same for each balance.
    ///
    /// ```
    /// use std::num::NonZeroUsize;
    /// use xca_parts::{Balance, Parts};
    ///
    /// let parts = Parts::new(xca_core::Reference, NonZeroUsize::MIN).with_balance(Balance::NEVER);
    /// ```
    pub fn with_balance(self, balance: Balance) -> Self {
        Self { balance, ..self }
    }

    fn on(engines: Vec<Arc<dyn Engine>>, number: Number) -> Self {
        Self { engines, number, balance: Balance::default() }
    }

    /// The engine of the part with this number.
    fn engine(&self, number: usize) -> Result<Arc<dyn Engine>, StartError> {
        let engine = self.engines.get(number % self.engines.len().max(1));
        engine.cloned().ok_or_else(|| other("there is no engine to run a part"))
    }

    /// The numbers of parts of a model's space.
    fn grid(&self, model: &Model) -> Result<Grid, StartError> {
        match self.number {
            Number::Exactly(parts) => Grid::into_parts(model, parts, NAME),
            Number::AtMost(parts) => {
                let grid = (1..=parts).rev().find_map(|parts| Grid::with_parts(model, parts));
                Ok(grid.unwrap_or(Grid::WHOLE))
            }
            Number::Grid(grid) => grid.check(model.geometry(), NAME).map(|()| grid),
        }
    }
}

impl Engine for Parts {
    fn name(&self) -> &str {
        NAME
    }

    fn threads(&self) -> usize {
        self.engines.iter().map(|engine| engine.threads()).sum()
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        let parts = match self.number {
            Number::Exactly(parts) => parts.to_string(),
            Number::AtMost(parts) => format!("at most {parts}"),
            Number::Grid(grid) => grid.to_string(),
        };
        let mut facts = vec![("parts", parts)];
        if let Some(engine) = self.engines.first() {
            facts.push(("part_engine", engine.name().to_owned()));
            let all: Vec<_> = self.engines.iter().map(|engine| engine.facts()).collect();
            facts.extend(facts_of_parts(&all));
        }
        facts
    }

    fn note(&self) -> Option<String> {
        self.engines.iter().find_map(|engine| engine.note())
    }

    fn least_memory(&self, model: &Model, precision: Precision) -> u128 {
        self.engines.first().map_or(0, |engine| engine.least_memory(model, precision))
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let shared = Shared::even(model, precision, self.grid(model)?);
        let mut ends = Channels::connect(shared.cut.count()).into_iter();
        let own = ends.next().ok_or_else(|| other("there is no part"))?;
        let mut threads = Vec::new();
        for end in ends {
            let (engine, shared) = (self.engine(end.number())?, shared.clone());
            let builder = Builder::new().name(format!("xca-part-{}", end.number()));
            let work = move || worker::serve(engine, &shared, Box::new(end));
            threads.push(builder.spawn(work).map_err(|error| other(&error.to_string()))?);
        }
        Ok(Box::new(Host::start(self.engine(0)?, shared, self.balance, Box::new(own), threads)?))
    }
}

/// The facts of the engines of parts, in the order of parts: each once if it is the same in all, else one for
/// each part.
pub fn facts_of_parts(all: &[Vec<(&'static str, String)>]) -> Vec<(&'static str, String)> {
    let Some(first) = all.first() else { return Vec::new() };
    let mut names: Vec<&'static str> = Vec::new();
    for (name, _) in all.iter().flatten() {
        if !names.contains(name) {
            names.push(name);
        }
    }
    let value = |facts: &[(&'static str, String)], name| {
        facts.iter().find(|(other, _)| *other == name).map(|(_, value)| value.clone())
    };
    let merged = |name| {
        let own = value(first, name);
        if all.iter().all(|facts| value(facts, name) == own) {
            return own.unwrap_or_default();
        }
        let each = all
            .iter()
            .enumerate()
            .filter_map(|(part, facts)| Some(format!("{part}: {}", value(facts, name)?)));
        each.collect::<Vec<_>>().join("; ")
    };
    names.into_iter().map(|name| (name, merged(name))).collect()
}

fn other(reason: &str) -> StartError {
    StartError::Other { engine: NAME.to_owned(), reason: reason.to_owned() }
}

/// Starts a model in parts, and returns its state. This engine runs part 0. Every other part must [`serve`]
/// the same model, precision and grid at the other end of the transport. The host alone has a balance.
///
/// # Errors
/// If a part cannot be started.
pub fn host(
    engine: Arc<dyn Engine>,
    model: &Model,
    precision: Precision,
    grid: Grid,
    balance: Balance,
    transport: Box<dyn Transport>,
) -> Result<Box<dyn Execution>, StartError> {
    grid.check(model.geometry(), NAME)?;
    let shared = Shared::even(model, precision, grid);
    Ok(Box::new(Host::start(engine, shared, balance, transport, Vec::new())?))
}

/// Reports to the [`host`] why the part with the transport's number cannot begin.
pub fn decline(reason: &str, mut transport: Box<dyn Transport>) {
    // If the host has ended, no one receives this.
    let _ = transport.send(0, Tag::Reply, Greeting::declined(reason).bytes());
    transport.end();
}

/// Runs the part with the transport's number on an engine, by the commands of the [`host`], until the host
/// ends. Reports failures to the host.
pub fn serve(
    engine: Arc<dyn Engine>,
    model: &Model,
    precision: Precision,
    grid: Grid,
    transport: Box<dyn Transport>,
) {
    match grid.check(model.geometry(), NAME) {
        Ok(()) => worker::serve(engine, &Shared::even(model, precision, grid), transport),
        Err(error) => decline(&error.to_string(), transport),
    }
}
