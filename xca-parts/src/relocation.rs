//! Rows that go from part to part when the bounds of parts move.

use crate::border::{Link, broken};
use crate::cut::Cut;
use crate::message::{decode, encode};
use crate::rows::{Lengths, Rows};
use crate::transport::{Tag, TransportError};
use xca_core::Geometry;
use xca_core::engine::{EngineFailure, Population};

/// The rows that a part gives to others, and those that it gets from them. All parts give and take the planes
/// of the state in the same order.
pub(crate) struct Relocation {
    link: Link,
    /// The number of the own part.
    own: usize,
    /// The rows of the old part, with the new parts that get them.
    given: Rows,
    /// The rows of the new part, with the old parts that had them.
    taken: Rows,
}

impl Relocation {
    pub(crate) fn new(link: Link, geometry: &Geometry, old: &Cut, new: &Cut) -> Self {
        let own = link.lock().number();
        let given = Rows::of(geometry, old.part(own).runs(geometry).flatten(), new);
        let taken = Rows::of(geometry, new.part(own).runs(geometry).flatten(), old);
        Self { link, own, given, taken }
    }

    /// Sends other parts their rows of the old part's values, each of `length` bytes. Returns the own ones.
    pub(crate) fn give(&self, values: &[u8], length: usize) -> Result<Vec<u8>, EngineFailure> {
        let shares = self.given.scatter(values, Lengths::Same(length));
        self.send(shares, Ok)
    }

    /// The values of the new part, of which `own` are there already.
    pub(crate) fn take(&self, own: Vec<u8>, length: usize) -> Result<Vec<u8>, EngineFailure> {
        let shares = self.receive(own, Ok)?;
        self.taken.gather(&shares, Lengths::Same(length)).ok_or_else(garbled)
    }

    /// As [`Self::give`], of items. `sizes` are those of their substates, in bytes.
    pub(crate) fn give_items(
        &self,
        items: &Population,
        sizes: &[usize],
    ) -> Result<Population, EngineFailure> {
        let shares = self.given.scatter_items(items, sizes);
        self.send(shares, |share| encode(&share))
    }

    /// As [`Self::take`], of items.
    pub(crate) fn take_items(&self, own: Population, sizes: &[usize]) -> Result<Population, EngineFailure> {
        let nothing = || Population { fields: vec![Vec::new(); sizes.len()], ..Population::default() };
        let mut shares = self.receive(own, |bytes| decode(&bytes))?;
        let empty = shares.iter_mut().filter(|share| share.counts.is_empty());
        empty.for_each(|share| *share = nothing());
        self.taken.gather_items(shares, sizes).ok_or_else(garbled)
    }

    /// Sends each part its share. Returns the own one.
    fn send<T: Default>(
        &self,
        shares: Vec<T>,
        bytes: impl Fn(T) -> Result<Vec<u8>, String>,
    ) -> Result<T, EngineFailure> {
        let mut own = T::default();
        for (part, share) in shares.into_iter().enumerate() {
            if part == self.own {
                own = share;
            } else if self.given.has(part) {
                // A part that has ended tells the host why. The others need their rows all the same.
                let _ = self.link.lock().send(part, Tag::Rows, bytes(share).map_err(broken)?);
            }
        }
        Ok(own)
    }

    /// The shares of all parts.
    fn receive<T: Default>(
        &self,
        own: T,
        share: impl Fn(Vec<u8>) -> Result<T, String>,
    ) -> Result<Vec<T>, EngineFailure> {
        let mut own = Some(own);
        let mut shares = Vec::new();
        for part in 0..self.taken.parts() {
            let of_part = if part == self.own {
                own.take().unwrap_or_default()
            } else if self.taken.has(part) {
                let received: Result<Vec<u8>, TransportError> = self.link.lock().receive(part, Tag::Rows);
                share(received.map_err(|_| EngineFailure::Elsewhere)?).map_err(broken)?
            } else {
                T::default()
            };
            shares.push(of_part);
        }
        Ok(shares)
    }
}

fn garbled() -> EngineFailure {
    broken("the rows of another part do not fit".to_owned())
}
