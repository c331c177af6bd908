//! MPI itself: the only file that calls it.

use crate::sending::Sending;
use crate::wire::{Piece, Wire};
use mpi::Threading;
use mpi::environment::{self, Universe};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, MatchedReceiveVec, Source};
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
            _universe: universe,
        })
    }
}

fn poll(world: &SimpleCommunicator) -> Option<Piece> {
    let arrived = world.any_process().immediate_matched_probe()?;
    let (bytes, status) = arrived.matched_receive_vec::<u8>();
    Some(Piece { from: status.source_rank() as usize, tag: status.tag(), bytes })
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
        self.sending.retain_mut(|message| !message.is_sent());
        !self.sending.is_empty()
    }

    fn poll(&mut self) -> Option<Piece> {
        poll(&SimpleCommunicator::world())
    }

    fn finish(&mut self, arrived: &mut dyn FnMut(Piece)) {
        let world = SimpleCommunicator::world();
        while self.is_sending() {
            match poll(&world) {
                Some(piece) => arrived(piece),
                None => thread::yield_now(),
            }
        }
        let mut request = world.immediate_barrier();
        while let Err(pending) = request.test() {
            request = pending;
            match poll(&world) {
                Some(piece) => arrived(piece),
                None => thread::yield_now(),
            }
        }
    }

    fn abort(&self, code: i32) {
        SimpleCommunicator::world().abort(code);
    }
}
