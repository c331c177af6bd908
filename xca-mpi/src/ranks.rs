//! The transport of one execution between the processes of a job.

use crate::mailbox::Mailbox;
use crate::tag::{Kind, number};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use xca_core::Face;
use xca_parts::{Tag, Transport, TransportError};

/// A mailbox that the executions of a process share.
#[derive(Debug, Clone)]
pub(crate) struct Shared(Arc<Mutex<Mailbox>>);

impl Shared {
    pub(crate) fn new(mailbox: Mailbox) -> Self {
        Self(Arc::new(Mutex::new(mailbox)))
    }

    pub(crate) fn lock(&self) -> MutexGuard<'_, Mailbox> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for a message; nothing where the sender has ended.
    pub(crate) fn receive(&self, from: usize, execution: u32, kind: Kind) -> Option<Vec<u8>> {
        let (tag, ended) = (number(execution, kind), number(execution, Kind::Ended));
        let patience = Patience::new(kind);
        loop {
            let mut mailbox = self.lock();
            if let Some(message) = mailbox.take(from, tag) {
                return Some(message);
            }
            // What was sent before the end has arrived before it.
            if mailbox.has(from, ended) {
                return None;
            }
            drop(mailbox);
            patience.wait();
        }
    }
}

/// How to wait: within a step for what comes soon, between commands without work for the processor.
struct Patience {
    begun: Instant,
    is_long: bool,
}

impl Patience {
    /// So long a wait is no wait within a step.
    const SOON: Duration = Duration::from_micros(200);
    /// What a command may be late by.
    const NAP: Duration = Duration::from_millis(1);

    fn new(kind: Kind) -> Self {
        let is_long = matches!(kind, Kind::Order | Kind::Part(Tag::Command));
        Self { begun: Instant::now(), is_long }
    }

    fn wait(&self) {
        if self.is_long && self.begun.elapsed() > Self::SOON {
            thread::sleep(Self::NAP);
        } else {
            // There may be more processes than cores.
            thread::yield_now();
        }
    }
}

/// The way from one process to all others in an execution.
#[derive(Debug)]
pub(crate) struct Ranks {
    mailbox: Shared,
    execution: u32,
    rank: usize,
    size: usize,
    has_ended: bool,
}

impl Ranks {
    pub(crate) fn new(mailbox: Shared, execution: u32) -> Self {
        let (rank, size) = {
            let mailbox = mailbox.lock();
            (mailbox.wire.rank(), mailbox.wire.size())
        };
        Self { mailbox, execution, rank, size, has_ended: false }
    }
}

impl Transport for Ranks {
    fn number(&self) -> usize {
        self.rank
    }

    fn count(&self) -> usize {
        self.size
    }

    fn send(&mut self, to: usize, tag: Tag, bytes: Vec<u8>) -> Result<(), TransportError> {
        if self.has_ended {
            return Err(TransportError::Ended { part: self.rank });
        }
        self.mailbox.lock().send(to, number(self.execution, Kind::Part(tag)), bytes);
        Ok(())
    }

    fn receive(&mut self, from: usize, tag: Tag) -> Result<Vec<u8>, TransportError> {
        let message = self.mailbox.receive(from, self.execution, Kind::Part(tag));
        message.ok_or(TransportError::Ended { part: from })
    }

    fn end(&mut self) {
        if self.has_ended {
            return;
        }
        self.has_ended = true;
        for to in (0..self.size).filter(|to| *to != self.rank) {
            self.mailbox.lock().send(to, number(self.execution, Kind::Ended), Vec::new());
        }
    }
}

impl Drop for Ranks {
    fn drop(&mut self) {
        self.end();
        let kinds = [Kind::Part(Tag::Command), Kind::Part(Tag::Reply), Kind::Part(Tag::Least), Kind::Ended];
        let edges = Face::ALL.map(|face| Kind::Part(Tag::Edge(face)));
        let tags = kinds.into_iter().chain(edges).map(|kind| number(self.execution, kind));
        let tags: Vec<i32> = tags.collect();
        self.mailbox.lock().forget(|tag| tags.contains(&tag));
    }
}
