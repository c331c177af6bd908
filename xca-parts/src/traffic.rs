//! Counts of what passes between parts.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// What a part has exchanged with other parts since its start. All clones share the counts.
#[derive(Debug, Clone, Default)]
pub(crate) struct Traffic(Arc<Mutex<Counts>>);

#[derive(Debug, Clone, Copy, Default)]
struct Counts {
    messages: u64,
    bytes: u64,
    agreements: u64,
    waited: Duration,
}

impl Traffic {
    fn count(&self, change: impl FnOnce(&mut Counts)) {
        change(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// Counts a message to another part.
    pub(crate) fn sent(&self, bytes: usize) {
        self.count(|counts| {
            counts.messages += 1;
            counts.bytes += bytes as u64;
        });
    }

    /// Counts an agreement of all parts.
    pub(crate) fn agreed(&self) {
        self.count(|counts| counts.agreements += 1);
    }

    /// The number of agreements so far.
    pub(crate) fn agreements(&self) -> u64 {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).agreements
    }

    /// Waits for other parts, and adds the time.
    pub(crate) fn timed<T>(&self, wait: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = wait();
        self.count(|counts| counts.waited += start.elapsed());
        result
    }

    /// The counts, for reports.
    pub(crate) fn figures(&self) -> [(String, f64); 4] {
        let counts = *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        [
            ("messages_sent", counts.messages as f64),
            ("bytes_sent", counts.bytes as f64),
            ("agreements", counts.agreements as f64),
            ("seconds_waited", counts.waited.as_secs_f64()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
    }
}
