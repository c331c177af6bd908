//! Parts in one process: channels between threads.

use crate::transport::{Tag, Transport, TransportError};
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, Sender, channel};

/// The channels from one part to all parts and back.
#[derive(Debug)]
pub struct Channels {
    number: usize,
    /// The senders to all parts. Empty after the own part has ended.
    to: Vec<Sender<Message>>,
    from: Vec<Receiver<Message>>,
    /// Messages from each part that arrived before a message that was waited for.
    early: Vec<VecDeque<Message>>,
}

#[derive(Debug)]
struct Message {
    tag: Tag,
    bytes: Vec<u8>,
}

impl Channels {
    /// Creates channels between `parts` parts, and returns the ends of each part.
    pub fn connect(parts: usize) -> Vec<Self> {
        let mut all: Vec<Self> = (0..parts)
            .map(|number| Self {
                number,
                to: Vec::with_capacity(parts),
                from: Vec::with_capacity(parts),
                early: (0..parts).map(|_| VecDeque::new()).collect(),
            })
            .collect();
        for from in 0..parts {
            for to in 0..parts {
                let (sender, receiver) = channel();
                all[from].to.push(sender);
                all[to].from.push(receiver);
            }
        }
        all
    }
}

impl Transport for Channels {
    fn number(&self) -> usize {
        self.number
    }

    fn count(&self) -> usize {
        self.from.len()
    }

    fn send(&mut self, to: usize, tag: Tag, bytes: Vec<u8>) -> Result<(), TransportError> {
        let sender = self.to.get(to).ok_or(TransportError::Ended { part: self.number })?;
        sender.send(Message { tag, bytes }).map_err(|_| TransportError::Ended { part: to })
    }

    fn receive(&mut self, from: usize, tag: Tag) -> Result<Vec<u8>, TransportError> {
        let ended = TransportError::Ended { part: from };
        let (Some(early), Some(receiver)) = (self.early.get_mut(from), self.from.get(from)) else {
            return Err(ended);
        };
        if let Some(place) = early.iter().position(|message| message.tag == tag) {
            return early.remove(place).map(|message| message.bytes).ok_or(ended);
        }
        loop {
            let message = receiver.recv().map_err(|_| ended.clone())?;
            if message.tag == tag {
                return Ok(message.bytes);
            }
            early.push_back(message);
        }
    }

    fn end(&mut self) {
        self.to.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::Channels;
    use crate::transport::{Tag, Transport, TransportError};
    use std::thread;
    use xca_core::Face;

    #[test]
    fn messages_arrive_by_tag_and_in_order() {
        let mut ends = Channels::connect(2);
        let (mut second, mut first) = (ends.pop().unwrap(), ends.pop().unwrap());
        let [south, north] = [Face::South, Face::North].map(Tag::Edge);
        for (tag, byte) in [(south, 1), (north, 2), (south, 3), (Tag::Command, 4)] {
            first.send(1, tag, vec![byte]).unwrap();
        }
        first.end();
        let got: Vec<_> =
            [Tag::Command, north, south, south].map(|tag| second.receive(0, tag).unwrap()[0]).into();
        assert_eq!(got, [4, 2, 1, 3]);
        assert_eq!(second.receive(0, south), Err(TransportError::Ended { part: 0 }));
        assert_eq!(first.send(1, south, Vec::new()), Err(TransportError::Ended { part: 0 }));
        // The other direction is still open.
        second.send(0, Tag::Reply, vec![5]).unwrap();
        assert_eq!(first.receive(1, Tag::Reply), Ok(vec![5]));
    }

    #[test]
    fn the_least_is_known_to_all() {
        for numbers in [vec![7], vec![3, 9], vec![u64::MAX, 4, 4, 8, 1 << 40]] {
            let wanted = numbers.iter().copied().min().unwrap();
            let ends = Channels::connect(numbers.len());
            let least: Vec<u64> = thread::scope(|scope| {
                let ask = |(mut end, number): (Channels, u64)| {
                    scope.spawn(move || (0..20).map(|_| end.least(number).unwrap()).max().unwrap())
                };
                let threads: Vec<_> = ends.into_iter().zip(numbers).map(ask).collect();
                threads.into_iter().map(|thread| thread.join().unwrap()).collect()
            });
            assert!(least.iter().all(|least| *least == wanted), "{least:?}");
        }
    }
}
