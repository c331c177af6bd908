//! The threads of the engine, and how they receive work.

use rayon::ThreadPool;
use std::fmt;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::thread::{self, Builder};
use xca_core::engine::Workers;

/// The threads of an engine.
#[derive(Clone)]
pub(crate) struct Threads(Arc<ThreadPool>);

/// Work in progress.
enum Work<F, R> {
    Waiting(F),
    Done(R),
    /// A panic has ended the work.
    Lost,
}

impl Threads {
    pub(crate) fn new(pool: ThreadPool) -> Self {
        Self(Arc::new(pool))
    }

    pub(crate) fn count(&self) -> usize {
        self.0.current_num_threads()
    }

    /// Does the work on these threads, and waits for it. Parallel iterators run on the threads that start
    /// them.
    ///
    /// A waiting thread of another pool would take other work of that pool. A simulation in a parallel
    /// iterator would start the next simulation below itself, and so on. All would be alive at once, each
    /// with its locks. Such a thread therefore waits for a thread outside all pools.
    pub(crate) fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        let is_foreign = rayon::current_thread_index().is_some() && self.0.current_thread_index().is_none();
        if !is_foreign {
            return self.0.install(work);
        }
        let mut work = Work::Waiting(work);
        let ended = thread::scope(|scope| {
            let go = || {
                if let Work::Waiting(waiting) = std::mem::replace(&mut work, Work::Lost) {
                    work = Work::Done(self.0.install(waiting));
                }
            };
            // If the system cannot start the thread, the work is still waiting.
            Builder::new().spawn_scoped(scope, go).map_or(Ok(()), thread::ScopedJoinHandle::join)
        });
        match (ended, work) {
            (_, Work::Done(result)) => result,
            (_, Work::Waiting(work)) => self.0.install(work),
            (Err(panic), Work::Lost) => resume_unwind(panic),
            (Ok(()), Work::Lost) => unreachable!("work that has not panicked is done"),
        }
    }
}

impl Workers for Threads {
    fn run(&self, work: &mut (dyn FnMut() + Send)) {
        Self::run(self, work);
    }
}

impl fmt::Debug for Threads {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.count().fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::Mutex;
    use std::sync::atomic::{AtomicUsize, Ordering};

    fn threads(number: usize) -> Threads {
        Threads::new(rayon::ThreadPoolBuilder::new().num_threads(number).build().unwrap())
    }

    /// Members on a pool of two threads. Each waits for its own threads.
    #[test]
    fn a_thread_of_another_pool_does_nothing_else_while_it_waits() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let (alive, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let lock = Mutex::new(0_u32);
        pool.install(|| {
            (0..64).into_par_iter().with_max_len(1).for_each(|member| {
                most.fetch_max(1 + alive.fetch_add(1, Ordering::SeqCst), Ordering::SeqCst);
                // A member that started another one below itself would deadlock here.
                let held = (member % 2 == 0).then(|| lock.lock().unwrap());
                let sum: usize = threads(2).run(|| (0..1000).into_par_iter().map(|i: usize| i % 7).sum());
                assert_eq!(sum, (0..1000).map(|i| i % 7).sum());
                drop(held);
                alive.fetch_sub(1, Ordering::SeqCst);
            });
        });
        assert!(most.into_inner() <= 2);
    }

    #[test]
    fn a_panic_comes_back() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let own = threads(1);
        let caught = pool.install(|| {
            catch_unwind(AssertUnwindSafe(|| own.run(|| -> u32 { panic!("as it was planned") })))
        });
        assert_eq!(caught.unwrap_err().downcast_ref(), Some(&"as it was planned"));
        assert_eq!(pool.install(|| own.run(|| own.run(|| 3))), 3);
    }
}
