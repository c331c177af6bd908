//! A thread that looks after messages while the others compute.
//!
//! MPI moves large messages only while the process calls it. Without the thread, a process that waits for one
//! would wait until its sender has computed.

use crate::ranks::Shared;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, Builder, JoinHandle};
use std::time::Duration;

/// The thread. It ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Attendant {
    has_ended: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

/// The pauses between two looks: at first, and at most. Each is twice as long as the one before, until
/// something happens.
const PAUSES: [Duration; 2] = [Duration::from_micros(100), Duration::from_millis(2)];

impl Attendant {
    /// Starts the thread. If the system cannot, messages move more slowly.
    pub(crate) fn start(mailbox: Shared) -> Self {
        let has_ended = Arc::new(AtomicBool::new(false));
        let end = Arc::clone(&has_ended);
        let attend = move || {
            let [first, longest] = PAUSES;
            let mut pause = longest;
            let mut was_sending = false;
            while !end.load(Ordering::Relaxed) {
                let (has_arrived, is_sending) = {
                    let mut mailbox = mailbox.lock();
                    (mailbox.take_in(), mailbox.wire.is_sending())
                };
                let is_new = has_arrived || (is_sending && !was_sending);
                pause = if is_new { first } else { (2 * pause).min(longest) };
                was_sending = is_sending;
                thread::sleep(pause);
            }
        };
        Self { has_ended, thread: Builder::new().name("xca-mpi".to_owned()).spawn(attend).ok() }
    }
}

impl Drop for Attendant {
    fn drop(&mut self) {
        self.has_ended.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // It has nothing to report.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Attendant;
    use crate::mailbox::Mailbox;
    use crate::mailbox::tests::Threads;
    use crate::ranks::Shared;
    use std::thread;

    /// A message is sent although the process does not call the wire again.
    #[test]
    fn messages_are_sent_meanwhile() {
        let mut wires = Threads::connect_late(2).into_iter();
        let (own, mut other) = (Shared::new(Mailbox::new(wires.next().unwrap())), wires.next().unwrap());
        let attendant = Attendant::start(own.clone());
        for byte in 0..3 {
            own.lock().send(1, 7, vec![byte]);
            let piece = std::iter::repeat_with(|| other.poll()).find_map(|piece| piece);
            assert_eq!(piece.unwrap().bytes, [byte]);
        }
        drop(attendant);
    }

    /// A message arrives although no one waits for it.
    #[test]
    fn messages_are_taken_in_meanwhile() {
        let mut wires = Threads::connect(2).into_iter();
        let (own, mut other) = (Shared::new(Mailbox::new(wires.next().unwrap())), wires.next().unwrap());
        let attendant = Attendant::start(own.clone());
        other.send(0, 7, vec![1, 2, 3]);
        while !own.lock().has(1, 7) {
            thread::yield_now();
        }
        drop(attendant);
        other.send(0, 7, vec![4]);
        assert_eq!(own.lock().take(1, 7), Some(vec![1, 2, 3]));
        assert_eq!(own.lock().take(1, 7), Some(vec![4]));
    }
}
