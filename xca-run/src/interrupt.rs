//! Ctrl-C and termination: the run ends after its current step, with its files complete.

use crate::launcher;
use std::io;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

/// The exit code of a run that was cut short by a signal, as shells report it: 128 + 2 (SIGINT).
pub const EXIT_INTERRUPTED: u8 = 130;

/// Signals cannot be handled.
#[derive(Debug, Clone, thiserror::Error)]
#[error("cannot handle Ctrl-C")]
pub struct InterruptError {
    /// What the system said.
    #[source]
    source: Arc<io::Error>,
}

/// A flag that a signal raises and the run loop polls.
///
/// The first Ctrl-C (or SIGTERM, or SIGHUP) raises the flag, so the run can end after its step. A second one
/// ends the program at once with [`EXIT_INTERRUPTED`]; a file that is being written then stays behind under
/// its temporary name. Of many processes that a launcher has started, only the launcher ends one at once. On
/// Linux a SIGHUP that is ignored, as below `nohup`, stays ignored.
///
/// ```
/// use xca_run::interrupt::Interrupt;
///
/// let interrupt = Interrupt::unconnected();
/// let mut steps = 0;
/// while steps < 1000 && !interrupt.is_raised() {
///     steps += 1;
///     if steps == 3 {
///         interrupt.raise(); // what Ctrl-C does to a flag made by `Interrupt::install`
///     }
/// }
/// assert_eq!(steps, 3);
/// ```
#[derive(Debug, Clone)]
pub struct Interrupt {
    raised: Arc<AtomicBool>,
}

impl Interrupt {
    /// The flag of this process, connected to its signals. Later calls give the same flag.
    ///
    /// # Errors
    /// [`InterruptError`] when the system refuses.
    pub fn install() -> Result<Self, InterruptError> {
        static INSTALLED: OnceLock<Result<Interrupt, InterruptError>> = OnceLock::new();
        INSTALLED
            .get_or_init(|| {
                let interrupt = Self::unconnected();
                listen(Arc::clone(&interrupt.raised))
                    .map_err(|source| InterruptError { source: Arc::new(source) })?;
                Ok(interrupt)
            })
            .clone()
    }

    /// A flag that no signal raises, for programs that handle signals themselves, and for tests.
    #[must_use]
    pub fn unconnected() -> Self {
        Self { raised: Arc::new(AtomicBool::new(false)) }
    }

    /// Whether the run has been asked to end.
    #[must_use]
    pub fn is_raised(&self) -> bool {
        self.raised.load(Ordering::Relaxed)
    }

    /// The flag itself.
    #[cfg(feature = "terminal")]
    pub(crate) fn flag(&self) -> &AtomicBool {
        &self.raised
    }

    /// Asks the run to end.
    pub fn raise(&self) {
        self.raised.store(true, Ordering::Relaxed);
    }

    /// What `main` returns at the end of the run: [`EXIT_INTERRUPTED`] if it was asked to end, else success.
    #[must_use]
    pub fn exit_code(&self) -> ExitCode {
        if self.is_raised() { ExitCode::from(EXIT_INTERRUPTED) } else { ExitCode::SUCCESS }
    }
}

/// Calls [`on_signal`] for each signal, from a thread of its own.
#[cfg(unix)]
fn listen(raised: Arc<AtomicBool>) -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    // An ignored SIGINT is taken all the same: a shell that starts a program in the background lets it ignore
    // that, and `kill -INT` should work.
    let mut all = vec![SIGINT, SIGTERM];
    if !is_ignored(SIGHUP) {
        all.push(SIGHUP);
    }
    let mut signals = signal_hook::iterator::Signals::new(all)?;
    let listener = move || {
        for _ in signals.forever() {
            on_signal(&raised);
        }
    };
    std::thread::Builder::new().name("xca-signals".to_owned()).spawn(listener)?;
    Ok(())
}

/// Whether this process was started with a signal ignored. Only Linux tells that without unsafe code.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let table = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = table.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}

#[cfg(not(unix))]
fn listen(raised: Arc<AtomicBool>) -> io::Result<()> {
    ctrlc::set_handler(move || on_signal(&raised)).map_err(io::Error::other)
}

fn on_signal(raised: &AtomicBool) {
    // A launcher of many processes sends several signals itself, and ends what does not end in time.
    if raised.swap(true, Ordering::Relaxed) && launcher::processes() == 1 {
        #[cfg(feature = "terminal")]
        xca_watch::give_back();
        #[expect(clippy::exit, reason = "the user asked twice, and the run did not answer the first time")]
        std::process::exit(i32::from(EXIT_INTERRUPTED));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clone_sees_the_flag() {
        let interrupt = Interrupt::unconnected();
        let other = interrupt.clone();
        assert!(!other.is_raised());
        interrupt.raise();
        assert!(other.is_raised());
        assert!(!Interrupt::unconnected().is_raised());
    }

    #[cfg(unix)]
    mod signals {
        use super::*;
        use std::io::{BufRead, BufReader, Write};
        use std::process::{Child, Command, Stdio};
        use std::time::{Duration, Instant};

        const ROLE: &str = "XCA_RUN_INTERRUPT_TEST_CHILD";

        /// The other side of the tests below: does nothing unless they start it.
        #[test]
        fn child() {
            if std::env::var_os(ROLE).is_none() {
                return;
            }
            let interrupt = Interrupt::install().unwrap();
            assert!(Arc::ptr_eq(&interrupt.raised, &Interrupt::install().unwrap().raised));
            let mut out = io::stdout();
            writeln!(out, "ready").unwrap();
            let start = Instant::now();
            while !interrupt.is_raised() && start.elapsed() < Duration::from_secs(60) {
                std::thread::sleep(Duration::from_millis(2));
            }
            writeln!(out, "raised {}", interrupt.is_raised()).unwrap();
            // The run does not end: only a second signal does it.
            std::thread::sleep(Duration::from_secs(60));
        }

        fn send(child: &Child, signal: &str) {
            assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        }

        fn wait_for(lines: &mut impl Iterator<Item = io::Result<String>>, word: &str) {
            assert!(lines.any(|line| line.unwrap().contains(word)), "the child never said `{word}`");
        }

        #[test]
        fn the_first_signal_raises_the_flag_and_the_second_ends_the_program() {
            // What these tests are started with the program is too: after `nohup` a terminal that hangs up is
            // no signal.
            let hangup = (!is_ignored(signal_hook::consts::SIGHUP)).then_some("-HUP");
            for signal in ["-INT", "-TERM"].into_iter().chain(hangup) {
                let mut child = Command::new(std::env::current_exe().unwrap())
                    .args(["--exact", "interrupt::tests::signals::child", "--nocapture"])
                    .env(ROLE, "1")
                    .stdout(Stdio::piped())
                    .spawn()
                    .unwrap();
                let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
                wait_for(&mut lines, "ready");
                send(&child, signal);
                wait_for(&mut lines, "raised true");
                send(&child, signal);
                assert_eq!(child.wait().unwrap().code(), Some(i32::from(EXIT_INTERRUPTED)));
            }
        }
    }
}
