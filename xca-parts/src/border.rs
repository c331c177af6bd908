//! The connection of a part's engine to the other parts.

use crate::cut::Cut;
use crate::traffic::Traffic;
use crate::transport::{Tag, Transport, TransportError};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use xca_core::engine::{Border, EngineFailure};
use xca_core::{Face, Faces, Geometry};

/// The name of the engine.
pub(crate) const NAME: &str = "parts";

/// A transport shared by a part's engine and by the code that gives it commands. They never use it at the
/// same time.
#[derive(Clone)]
pub(crate) struct Link(Arc<Mutex<Box<dyn Transport>>>);

impl Link {
    pub(crate) fn new(transport: Box<dyn Transport>) -> Self {
        Self(Arc::new(Mutex::new(transport)))
    }

    pub(crate) fn lock(&self) -> MutexGuard<'_, Box<dyn Transport>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The border of a part. If a message does not arrive, the part ends, so that no other part waits for it.
pub(crate) struct PartBorder {
    link: Link,
    /// The number of the part beyond each face. `None` if no part lies beyond it.
    beyond: Faces<Option<usize>>,
    /// Messages from before the last agreement are out of date.
    traffic: Traffic,
}

impl PartBorder {
    pub(crate) fn new(link: Link, geometry: &Geometry, cut: &Cut, traffic: Traffic) -> Self {
        let number = link.lock().number();
        let borders = cut.part(number).borders(geometry);
        let beyond = Faces::from_fn(|face| borders[face].then(|| cut.beyond(number, face)));
        Self { link, beyond, traffic }
    }

    fn beyond(&self, face: Face) -> Result<usize, EngineFailure> {
        self.beyond[face].ok_or_else(|| broken(format!("no part lies beyond the {face} face of this one")))
    }

    /// Uses the transport. Ends it after an error.
    fn with<T>(
        &self,
        work: impl FnOnce(&mut dyn Transport) -> Result<T, TransportError>,
    ) -> Result<T, EngineFailure> {
        let mut transport = self.link.lock();
        work(&mut **transport).map_err(|error| {
            transport.end();
            match error {
                TransportError::Ended { .. } => EngineFailure::Elsewhere,
                other => broken(other.to_string()),
            }
        })
    }
}

impl Border for PartBorder {
    fn send(&mut self, face: Face, bytes: Vec<u8>) -> Result<(), EngineFailure> {
        let to = self.beyond(face)?;
        self.traffic.sent(bytes.len());
        let bytes = Stamp { agreements: self.traffic.agreements(), has_given_up: false }.put_on(bytes);
        self.with(|transport| transport.send(to, Tag::Edge(face), bytes))
    }

    fn receive(&mut self, face: Face) -> Result<Vec<u8>, EngineFailure> {
        let from = self.beyond(face)?;
        let next = |transport: &mut dyn Transport| transport.receive(from, Tag::Edge(face.opposite()));
        loop {
            let mut bytes = self.traffic.timed(|| self.with(next))?;
            let stamp = Stamp::take_from(&mut bytes)
                .ok_or_else(|| broken(TransportError::Garbled { part: from }.to_string()))?;
            match stamp {
                // The part gave up waiting for this one before the last agreement.
                Stamp { agreements, .. } if agreements < self.traffic.agreements() => {}
                Stamp { has_given_up: true, .. } => return Err(EngineFailure::Elsewhere),
                Stamp { .. } => return Ok(bytes),
            }
        }
    }

    fn give_up(&mut self) -> Result<(), EngineFailure> {
        let stamp = Stamp { agreements: self.traffic.agreements(), has_given_up: true };
        for face in Face::ALL {
            if let Some(to) = self.beyond[face] {
                self.with(|transport| transport.send(to, Tag::Edge(face), stamp.put_on(Vec::new())))?;
            }
        }
        Ok(())
    }

    fn least(&mut self, number: u64) -> Result<u64, EngineFailure> {
        self.traffic.agreed();
        self.traffic.timed(|| self.with(|transport| transport.least(number)))
    }
}

/// The end of a message between neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Stamp {
    /// The number of agreements before the message.
    agreements: u64,
    /// Whether the part sends nothing more before the next agreement.
    has_given_up: bool,
}

impl Stamp {
    fn put_on(self, mut bytes: Vec<u8>) -> Vec<u8> {
        bytes.extend_from_slice(&(self.agreements << 1 | u64::from(self.has_given_up)).to_le_bytes());
        bytes
    }

    /// `None` if the message is too short.
    fn take_from(bytes: &mut Vec<u8>) -> Option<Self> {
        let number = u64::from_le_bytes(*bytes.last_chunk()?);
        bytes.truncate(bytes.len() - size_of::<u64>());
        Some(Self { agreements: number >> 1, has_given_up: number & 1 == 1 })
    }
}

/// A failure of this engine.
pub(crate) fn broken(reason: String) -> EngineFailure {
    EngineFailure::Broken { engine: NAME.to_owned(), reason }
}
