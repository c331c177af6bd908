//! MPI itself: the only file that calls it.

use crate::sending::Sending;
use crate::spare::Spare;
use crate::wire::{Piece, Wire};
use mpi::Threading;
use mpi::environment::{self, Universe};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Equivalence, Source};
use std::mem::take;
use std::thread;

/// All processes of an MPI job. Dropping it ends MPI for this process, which begins only once.
pub struct Library {
    rank: usize,
    size: usize,
    on_this_machine: usize,
    number_on_this_machine: usize,
    machine: String,
    /// What the other processes have not taken in yet.
    sending: Vec<Sending>,
    spare: Spare,
    /// Ends MPI when it is dropped.
    _universe: Universe,
}

impl std::fmt::Debug for Library {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Library").field("rank", &self.rank).field("size", &self.size).finish_non_exhaustive()
    }
}

/// MPI that cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LibraryError {
    /// It has begun already, or has ended.
    #[error("MPI has begun already in this process, or has ended")]
    Begun,
    /// Calls from other threads than the first are not allowed.
    #[error("the MPI library cannot be called from several threads; use one with MPI_THREAD_SERIALIZED")]
    Threads,
}

impl Library {
    /// Begins MPI. All processes of a job do it at the same time.
    ///
    /// # Errors
    /// Where it has begun already, and where the library is of no use here.
    pub fn begin() -> Result<Self, LibraryError> {
        // Simulations run on the threads of engines, one at a time.
        let (universe, threading) =
            environment::initialize_with_threading(Threading::Serialized).ok_or(LibraryError::Begun)?;
        if threading < Threading::Serialized {
            return Err(LibraryError::Threads);
        }
        let world = SimpleCommunicator::world();
        let machine = world.split_shared(world.rank());
        Ok(Self {
            rank: world.rank() as usize,
            size: world.size() as usize,
            on_this_machine: machine.size() as usize,
            number_on_this_machine: machine.rank() as usize,
            machine: environment::processor_name().unwrap_or_else(|_| "unknown".to_owned()),
            sending: Vec::new(),
            spare: Spare::default(),
            _universe: universe,
        })
    }
}

impl Wire for Library {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.size
    }

    fn on_this_machine(&self) -> usize {
        self.on_this_machine
    }

    fn number_on_this_machine(&self) -> usize {
        self.number_on_this_machine
    }

    fn machine(&self) -> String {
        self.machine.clone()
    }

    fn send(&mut self, to: usize, tag: i32, bytes: Vec<u8>) {
        let world = SimpleCommunicator::world();
        self.sending.push(Sending::begin(&world.process_at_rank(to as i32), tag, bytes));
    }

    fn is_sending(&mut self) -> bool {
        for message in take(&mut self.sending) {
            match message.go_on() {
                Ok(bytes) => self.spare.keep(bytes),
                Err(message) => self.sending.push(message),
            }
        }
        !self.sending.is_empty()
    }

    fn poll(&mut self) -> Option<Piece> {
        let (message, status) = SimpleCommunicator::world().any_process().immediate_matched_probe()?;
        let length = usize::try_from(status.count(u8::equivalent_datatype())).unwrap_or(0);
        let mut bytes = self.spare.take(length);
        message.matched_receive_into(&mut bytes[..]);
        Some(Piece { from: status.source_rank() as usize, tag: status.tag(), bytes })
    }

    fn finish(&mut self, arrived: &mut dyn FnMut(Piece)) {
        let world = SimpleCommunicator::world();
        while self.is_sending() {
            match self.poll() {
                Some(piece) => arrived(piece),
                None => thread::yield_now(),
            }
        }
        let mut request = world.immediate_barrier();
        while let Err(pending) = request.test() {
            request = pending;
            match self.poll() {
                Some(piece) => arrived(piece),
                None => thread::yield_now(),
            }
        }
    }

    fn abort(&self, code: i32) {
        SimpleCommunicator::world().abort(code);
    }
}
