//! Messages of any length, out of pieces, kept until they are asked for.

use crate::wire::{Piece, Wire};
use std::collections::{HashMap, VecDeque};

/// The bytes of a full piece: MPI counts in 31 bits.
const FULL: usize = 1 << 30;

/// The wire of a process, and what has arrived by it.
pub(crate) struct Mailbox {
    pub(crate) wire: Box<dyn Wire>,
    arrived: Arrived,
}

impl std::fmt::Debug for Mailbox {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (rank, size) = (self.wire.rank(), self.wire.size());
        f.debug_struct("Mailbox").field("rank", &rank).field("size", &size).finish_non_exhaustive()
    }
}

/// What has arrived, by sender and tag.
struct Arrived {
    /// A message ends with a piece that is not full.
    full: usize,
    begun: HashMap<(usize, i32), Vec<u8>>,
    whole: HashMap<(usize, i32), VecDeque<Vec<u8>>>,
}

impl Arrived {
    fn take_in(&mut self, piece: Piece) {
        let Piece { from, tag, bytes } = piece;
        let is_last = bytes.len() < self.full;
        let message = match self.begun.remove(&(from, tag)) {
            Some(mut begun) => {
                begun.extend_from_slice(&bytes);
                begun
            }
            None => bytes,
        };
        if is_last {
            self.whole.entry((from, tag)).or_default().push_back(message);
        } else {
            self.begun.insert((from, tag), message);
        }
    }
}

impl Mailbox {
    pub(crate) fn new(wire: Box<dyn Wire>) -> Self {
        Self::with_pieces(wire, FULL)
    }

    /// With full pieces of so many bytes.
    fn with_pieces(wire: Box<dyn Wire>, full: usize) -> Self {
        Self { wire, arrived: Arrived { full, begun: HashMap::new(), whole: HashMap::new() } }
    }

    /// Begins to send a message.
    pub(crate) fn send(&mut self, to: usize, tag: i32, bytes: Vec<u8>) {
        let full = self.arrived.full;
        let mut rest = bytes;
        while rest.len() >= full {
            let after = rest.split_off(full);
            self.wire.send(to, tag, rest);
            rest = after;
        }
        self.wire.send(to, tag, rest);
    }

    /// Whether a message from a process with a tag has arrived.
    pub(crate) fn has(&self, from: usize, tag: i32) -> bool {
        self.arrived.whole.get(&(from, tag)).is_some_and(|messages| !messages.is_empty())
    }

    /// Waits until all processes do the same.
    pub(crate) fn finish(&mut self) {
        let Self { wire, arrived } = self;
        wire.finish(&mut |piece| arrived.take_in(piece));
    }

    /// Forgets what has arrived with these tags.
    pub(crate) fn forget(&mut self, is_meant: impl Fn(i32) -> bool) {
        self.arrived.begun.retain(|(_, tag), _| !is_meant(*tag));
        self.arrived.whole.retain(|(_, tag), _| !is_meant(*tag));
    }

    /// Takes in what has arrived. Returns whether there was anything.
    pub(crate) fn take_in(&mut self) -> bool {
        let mut any = false;
        while let Some(piece) = self.wire.poll() {
            self.arrived.take_in(piece);
            any = true;
        }
        any
    }

    /// The first message from a process with a tag, if it has arrived.
    pub(crate) fn take(&mut self, from: usize, tag: i32) -> Option<Vec<u8>> {
        self.take_in();
        self.arrived.whole.get_mut(&(from, tag))?.pop_front()
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::sync::mpsc::{Receiver, Sender, channel};
    use std::sync::{Arc, Barrier};

    /// A wire between threads.
    pub(crate) struct Threads {
        rank: usize,
        to: Vec<Sender<Piece>>,
        from: Receiver<Piece>,
        all: Arc<Barrier>,
        /// Pieces that the next call of `is_sending` sends, like MPI those that are large. `None` if all are
        /// sent at once.
        late: Option<Vec<(usize, Piece)>>,
    }

    impl Threads {
        pub(crate) fn connect(size: usize) -> Vec<Box<dyn Wire>> {
            Self::all(size, || None)
        }

        /// With pieces that need further calls to be sent.
        pub(crate) fn connect_late(size: usize) -> Vec<Box<dyn Wire>> {
            Self::all(size, || Some(Vec::new()))
        }

        fn all(size: usize, late: fn() -> Option<Vec<(usize, Piece)>>) -> Vec<Box<dyn Wire>> {
            let (to, from): (Vec<_>, Vec<_>) = (0..size).map(|_| channel()).unzip();
            let all = Arc::new(Barrier::new(size));
            let wire =
                |(rank, from)| Self { rank, to: to.clone(), from, all: Arc::clone(&all), late: late() };
            from.into_iter().enumerate().map(wire).map(|wire| Box::new(wire) as Box<dyn Wire>).collect()
        }
    }

    impl Wire for Threads {
        fn rank(&self) -> usize {
            self.rank
        }

        fn size(&self) -> usize {
            self.to.len()
        }

        fn on_this_machine(&self) -> usize {
            self.to.len()
        }

        fn number_on_this_machine(&self) -> usize {
            self.rank % 2
        }

        fn machine(&self) -> String {
            format!("machine {}", self.rank / 2)
        }

        fn send(&mut self, to: usize, tag: i32, bytes: Vec<u8>) {
            let piece = Piece { from: self.rank, tag, bytes };
            match &mut self.late {
                Some(late) => late.push((to, piece)),
                None => self.to[to].send(piece).expect("all are there until the end"),
            }
        }

        fn is_sending(&mut self) -> bool {
            for (to, piece) in self.late.iter_mut().flat_map(|late| late.drain(..)) {
                self.to[to].send(piece).expect("all are there until the end");
            }
            false
        }

        fn poll(&mut self) -> Option<Piece> {
            self.from.try_recv().ok()
        }

        fn finish(&mut self, arrived: &mut dyn FnMut(Piece)) {
            self.is_sending();
            self.all.wait();
            self.from.try_iter().for_each(arrived);
        }

        fn abort(&self, code: i32) {
            panic!("aborted with {code}");
        }
    }

    /// Also those whose last piece is empty.
    #[test]
    fn messages_are_put_together_of_pieces() {
        let mut wires = Threads::connect(3).into_iter().map(|wire| Mailbox::with_pieces(wire, 4));
        let (mut host, mut first, mut second) =
            (wires.next().unwrap(), wires.next().unwrap(), wires.next().unwrap());
        let message = |length: u8| (0..length).collect::<Vec<u8>>();
        for length in [0, 3, 4, 5, 8, 11] {
            first.send(0, 7, message(length));
            first.send(0, 8, message(length + 1));
            second.send(0, 7, message(length + 2));
        }
        for length in [0, 3, 4, 5, 8, 11] {
            assert_eq!(host.take(2, 7), Some(message(length + 2)));
            assert_eq!(host.take(1, 8), Some(message(length + 1)));
            assert_eq!(host.take(1, 7), Some(message(length)));
        }
        assert_eq!(host.take(1, 7), None);
        first.send(0, 7, vec![1]);
        first.send(0, 8, vec![2]);
        assert_eq!(host.take(2, 7), None);
        host.forget(|tag| tag == 7);
        assert_eq!((host.take(1, 7), host.take(1, 8)), (None, Some(vec![2])));
    }
}
