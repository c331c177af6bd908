//! One model on several engines at once, each with a part of the space.
//!
//! Engines that can run a part of a space ([`Engine::start_part`]) work side by side: before a process reads
//! neighbours, parts send each other the edges of their rows. The state after each step has the bits that one
//! engine gives, however the space is cut.
//!
//! [`Parts`] is an engine whose parts are threads of this process. What carries their messages is a
//! [`Transport`]; [`serve`] and [`host`] work with any other one in the same way.

mod border;
mod channels;
mod cut;
mod fault;
mod greeting;
mod host;
mod message;
mod rows;
mod shared;
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

/// An engine made of several, each of which runs a part of the space on a thread of its own.
#[derive(Debug, Clone)]
pub struct Parts {
    /// What runs the parts, in turns.
    engines: Vec<Arc<dyn Engine>>,
    number: Number,
}

/// How many parts there are.
#[derive(Debug, Clone, Copy)]
enum Number {
    Exactly(usize),
    AtMost(usize),
    Cut(Cut),
}

impl Parts {
    /// So many parts, all run by one engine, whose threads they share. A space that is too small for them is
    /// refused when a model is started.
    pub fn new(engine: impl Engine + 'static, parts: NonZeroUsize) -> Self {
        Self { engines: vec![Arc::new(engine)], number: Number::Exactly(parts.get()) }
    }

    /// As many parts as engines, each run by its own. There must be at least one.
    pub fn with_engines(engines: Vec<Arc<dyn Engine>>) -> Self {
        let number = Number::Exactly(engines.len());
        Self { engines, number }
    }

    /// As [`Self::new`], but with fewer parts where the space is too small for so many.
    pub fn at_most(engine: impl Engine + 'static, parts: NonZeroUsize) -> Self {
        Self { engines: vec![Arc::new(engine)], number: Number::AtMost(parts.get()) }
    }

    /// As [`Self::new`], with parts along y and z.
    pub fn with_cut(engine: impl Engine + 'static, cut: Cut) -> Self {
        Self { engines: vec![Arc::new(engine)], number: Number::Cut(cut) }
    }

    /// What runs the part with this number.
    fn engine(&self, number: usize) -> Result<Arc<dyn Engine>, StartError> {
        let engine = self.engines.get(number % self.engines.len().max(1));
        engine.cloned().ok_or_else(|| other("there is no engine to run a part"))
    }

    /// How the space of a model is cut.
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

/// The state of a model in parts: the own part, which this engine runs, is that of number 0. Each other part
/// has to [`serve`] the same model, precision and cut at the other end of the transport.
///
/// # Errors
/// Where a part cannot be started.
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

/// Tells the [`host`] why the part with the transport's number cannot begin.
pub fn decline(reason: &str, mut transport: Box<dyn Transport>) {
    // Where the host has ended there is none to tell.
    let _ = transport.send(0, Tag::Reply, Greeting::declined(reason).bytes());
    transport.end();
}

/// Has an engine run the part with the transport's number as the [`host`] says, until that has ended. The
/// host learns what goes wrong.
pub fn serve(
    engine: &dyn Engine,
    model: &Model,
    precision: Precision,
    cut: Cut,
    transport: Box<dyn Transport>,
) {
    worker::serve(engine, &Shared { model: model.clone(), precision, cut }, transport);
}
