//! A reader at work on damaged files, with its memory and its time.

use crate::ALLOCATED;
use std::error::Error;
use std::fs;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use xca_tests_fuzz::{Container, Mutator};

/// How many files each reader is given, unless `XCA_FUZZ_INPUTS` says it.
const INPUTS: usize = 1000;
/// All mutations follow from this.
const SEED: u64 = 20_261_129;
/// The memory that a reader may take for each byte of the file, in bytes.
const TIMES: usize = 10;
/// The memory that it may take besides, in bytes.
pub(crate) const BESIDES: usize = 16 << 20;
/// No file may take longer.
const LONGEST: Duration = Duration::from_secs(10);
/// How many bad files are kept at most, to be looked at.
const KEPT: usize = 5;

pub(crate) type TestResult = Result<(), Box<dyn Error + Send + Sync>>;

/// Keeps other tests waiting: memory is counted for the whole process.
pub(crate) fn alone() -> MutexGuard<'static, ()> {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A reader and the files that it is given.
pub(crate) struct Subject<'a> {
    pub(crate) name: &'a str,
    /// Where the reader looks for the file.
    pub(crate) path: &'a Path,
    pub(crate) valid: Vec<Box<dyn Container>>,
    /// The memory that it may take for any file, in bytes.
    pub(crate) besides: usize,
    /// A slow reader is given so many times fewer files.
    pub(crate) cost: usize,
    /// Words of the format.
    pub(crate) words: &'static [&'static str],
}

impl Subject<'_> {
    /// Gives the reader damaged files.
    ///
    /// # Errors
    /// Where a file cannot be written.
    ///
    /// # Panics
    /// Where the reader does, or takes too much memory or time. Also where it takes all files, or nearly
    /// none: then mutations do not reach its checks.
    pub(crate) fn check(&self, read: impl Fn(&Path, &mut Mutator) -> TestResult) -> TestResult {
        let inputs = std::env::var("XCA_FUZZ_INPUTS").ok().and_then(|text| text.parse().ok());
        let inputs = inputs.unwrap_or(INPUTS).div_ceil(self.cost);
        let kept = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(self.name);
        let mut mutator = Mutator::new(SEED, self.words);
        let mut problems = Vec::new();
        let mut taken = 0;
        for number in 0..inputs {
            let valid = &self.valid[number % self.valid.len()];
            let bytes = valid.damaged(&mut mutator);
            fs::write(self.path, &bytes)?;
            ALLOCATED.reset_peak_usage();
            let (before, begin) = (ALLOCATED.current_usage(), Instant::now());
            let result = panic::catch_unwind(AssertUnwindSafe(|| read(self.path, &mut mutator)));
            let (memory, time) = (ALLOCATED.peak_usage().saturating_sub(before), begin.elapsed());
            let problem = match &result {
                Err(_) => Some("a panic".to_owned()),
                _ if memory > TIMES * bytes.len() + self.besides => {
                    Some(format!("{memory} bytes of memory for {} bytes", bytes.len()))
                }
                _ if time > LONGEST => Some(format!("{time:?}")),
                _ => None,
            };
            taken += usize::from(matches!(result, Ok(Ok(()))));
            if let Some(problem) = problem {
                let path = kept.with_extension(number.to_string());
                fs::write(&path, &bytes)?;
                problems.push(format!("input {number}: {problem}; kept as {}", path.display()));
                if problems.len() == KEPT {
                    break;
                }
            }
        }
        assert!(problems.is_empty(), "{}:\n{}", self.name, problems.join("\n"));
        let share = taken as f64 / inputs as f64;
        assert!((0.002..0.98).contains(&share), "{}: took {taken} of {inputs} damaged files", self.name);
        Ok(())
    }
}

/// A valid file in its parts.
pub(crate) fn container<C: Container + 'static>(parts: Option<C>) -> Result<Box<dyn Container>, String> {
    parts.map(|parts| Box::new(parts) as Box<dyn Container>).ok_or_else(|| "no valid file".to_owned())
}
