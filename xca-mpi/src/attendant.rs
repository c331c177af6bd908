//! A thread that takes messages in while the others compute.
//!
//! MPI moves large messages only while both processes call it. Without the thread, a process that sends to
//! one that computes would wait for it.

use crate::ranks::Shared;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, Builder, JoinHandle};
use std::time::{Duration, Instant};

/// The thread. It ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Attendant {
    has_ended: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

/// The pause between two looks while messages come.
const SHORT: Duration = Duration::from_micros(100);

/// The pause after a while without messages.
const LONG: Duration = Duration::from_millis(2);

/// The length of that while.
const WHILE: Duration = Duration::from_millis(50);

impl Attendant {
    /// Starts the thread. If the system cannot, messages move more slowly.
    pub(crate) fn start(mailbox: Shared) -> Self {
        let has_ended = Arc::new(AtomicBool::new(false));
        let end = Arc::clone(&has_ended);
        let attend = move || {
            let mut last = Instant::now();
            while !end.load(Ordering::Relaxed) {
                if mailbox.lock().take_in() {
                    last = Instant::now();
                }
                thread::sleep(if last.elapsed() < WHILE { SHORT } else { LONG });
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

    /// A message arrives although no one waits for it.
    #[test]
    fn messages_are_taken_in_meanwhile() {
        let mut wires = Threads::connect(2).into_iter();
        let (own, mut other) = (Shared::new(Mailbox::new(wires.next().unwrap())), wires.next().unwrap());
        let attendant = Attendant::start(own.clone());
        other.send(0, 7, &[1, 2, 3], &mut |_| {});
        while !own.lock().has(1, 7) {
            thread::yield_now();
        }
        drop(attendant);
        other.send(0, 7, &[4], &mut |_| {});
        assert_eq!(own.lock().take(1, 7), Some(vec![1, 2, 3]));
        assert_eq!(own.lock().take(1, 7), Some(vec![4]));
    }
}
