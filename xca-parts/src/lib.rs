//! One model on several engines at once, each with a part of the space.
//!
//! The parts run on engines that support parts of a space ([`Engine::start_part`]). Before a process reads
//! neighbours, parts exchange the edges of their rows. The state after each step has the same bits as on one
//! engine, for every cut.
//!
//! [`Parts`] is an engine whose parts are threads of this process. A [`Transport`] carries their messages.
//! [`serve`] and [`host`] work with any other transport in the same way.

mod border;
mod channels;
mod cut;
mod fault;
mod greeting;
mod host;
mod message;
mod rows;
mod shared;
mod traffic;
mod transport;
mod worker;

pub use channels::Channels;
pub use cut::Cut;
pub use transport::{Tag, Transport, TransportError};

use border::NAME;
use greeting::Greeting;
use host::Host;
use shared::Shared;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::thread::Builder;
use xca_core::engine::{Engine, Execution, StartError};
use xca_core::{Geometry, Model, Precision};

/// An engine made of several engines. Each runs a part of the space on its own thread.
#[derive(Debug, Clone)]
pub struct Parts {
    /// The engines that run the parts, in turns.
    engines: Vec<Arc<dyn Engine>>,
    number: Number,
}

/// The number of parts.
#[derive(Debug, Clone, Copy)]
enum Number {
    Exactly(usize),
    AtMost(usize),
    Cut(Cut),
}

impl Parts {
    /// `parts` parts on one engine, which share its threads. Starting a model fails if its space is too small
    /// for them.
    pub fn new(engine: impl Engine + 'static, parts: NonZeroUsize) -> Self {
        Self { engines: vec![Arc::new(engine)], number: Number::Exactly(parts.get()) }
    }

    /// One part for each engine. There must be at least one engine.
    pub fn with_engines(engines: Vec<Arc<dyn Engine>>) -> Self {
        let number = Number::Exactly(engines.len());
        Self { engines, number }
    }

    /// Like [`Self::new`], but with fewer parts if the space is too small.
    pub fn at_most(engine: impl Engine + 'static, parts: NonZeroUsize) -> Self {
        Self { engines: vec![Arc::new(engine)], number: Number::AtMost(parts.get()) }
    }

    /// Like [`Self::new`], with parts along y and z.
    pub fn with_cut(engine: impl Engine + 'static, cut: Cut) -> Self {
        Self { engines: vec![Arc::new(engine)], number: Number::Cut(cut) }
    }

    /// The engine of the part with this number.
    fn engine(&self, number: usize) -> Result<Arc<dyn Engine>, StartError> {
        let engine = self.engines.get(number % self.engines.len().max(1));
        engine.cloned().ok_or_else(|| other("there is no engine to run a part"))
    }

    /// The cut of a model's space.
    fn cut(&self, geometry: &Geometry) -> Result<Cut, StartError> {
        match self.number {
            Number::Exactly(parts) => Cut::into_parts(geometry, parts, NAME),
            Number::AtMost(parts) => {
                let cut = (1..=parts).rev().find_map(|parts| Cut::even(geometry, parts));
                Ok(cut.unwrap_or(Cut { y: 1, z: 1 }))
            }
            Number::Cut(cut) => {
                if cut.count() == 0 {
                    let reason = "a cut has at least one part along y and one along z".to_owned();
                    return Err(StartError::NoParts { engine: NAME.to_owned(), reason });
                }
                (0..cut.count()).try_for_each(|number| cut.part(geometry, number).check(geometry))?;
                Ok(cut)
            }
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
            Number::Cut(Cut { y, z }) => format!("{y}x{z}"),
        };
        let mut facts = vec![("parts", parts)];
        if let Some(engine) = self.engines.first() {
            facts.push(("part_engine", engine.name().to_owned()));
            facts.extend(engine.facts());
        }
        facts
    }

    fn note(&self) -> Option<String> {
        self.engines.first()?.note()
    }

    fn least_memory(&self, model: &Model, precision: Precision) -> u128 {
        self.engines.first().map_or(0, |engine| engine.least_memory(model, precision))
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let cut = self.cut(model.geometry())?;
        let shared = Shared { model: model.clone(), precision, cut };
        let mut ends = Channels::connect(cut.count()).into_iter();
        let own = ends.next().ok_or_else(|| other("there is no part"))?;
        let mut threads = Vec::new();
        for end in ends {
            let (engine, shared) = (self.engine(end.number())?, shared.clone());
            let builder = Builder::new().name(format!("xca-part-{}", end.number()));
            let work = move || worker::serve(&*engine, &shared, Box::new(end));
            threads.push(builder.spawn(work).map_err(|error| other(&error.to_string()))?);
        }
        Ok(Box::new(Host::start(&*self.engine(0)?, shared, Box::new(own), threads)?))
    }
}

fn other(reason: &str) -> StartError {
    StartError::Other { engine: NAME.to_owned(), reason: reason.to_owned() }
}

/// Starts a model in parts, and returns its state. This engine runs part 0. Every other part must [`serve`]
/// the same model, precision and cut at the other end of the transport.
///
/// # Errors
/// If a part cannot be started.
pub fn host(
    engine: &dyn Engine,
    model: &Model,
    precision: Precision,
    cut: Cut,
    transport: Box<dyn Transport>,
) -> Result<Box<dyn Execution>, StartError> {
    let shared = Shared { model: model.clone(), precision, cut };
    Ok(Box::new(Host::start(engine, shared, transport, Vec::new())?))
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
    engine: &dyn Engine,
    model: &Model,
    precision: Precision,
    cut: Cut,
    transport: Box<dyn Transport>,
) {
    worker::serve(engine, &Shared { model: model.clone(), precision, cut }, transport);
}
