//! Who watches a run.

/// Follows a run, and can end it. `()` does neither.
///
/// ```
/// # let temporary = tempfile::tempdir()?;
/// # let out = temporary.path().join("growth");
/// # use xca_core::prelude::*;
/// # #[derive(Substates, Clone)]
/// # struct Colony { size: Real }
/// # #[elementary_process]
/// # fn grow(cell: &mut Cell<Colony>) { cell.size *= 1.01; }
/// # let builder = Model::builder("growth").extents([8, 8, 1]).substates::<Colony>();
/// # let model = builder.process(grow).fill(|_| Colony { size: 1.0 }).build()?;
/// use xca_record::{Monitor, Outcome, Run, SetUp};
///
/// /// Ends the run after 30 steps.
/// struct Limit {
///     done: u64,
/// }
///
/// impl Monitor for Limit {
///     fn at(&mut self, step: u64) {
///         self.done = step;
///     }
///
///     fn is_interrupted(&self) -> bool {
///         self.done >= 30
///     }
/// }
///
/// let run = Run::new(SetUp::new(model, 100))?.every(10);
/// let outcome = run.begin(&out, &Reference)?.go(&mut Limit { done: 0 })?;
/// assert_eq!(outcome, Outcome::Interrupted);
/// # Ok::<(), Box<dyn std::error::Error + Send + Sync>>(())
/// ```
pub trait Monitor {
    /// Called before the steps, with the number of steps already done.
    fn begin(&mut self, step: u64) {
        let _ = step;
    }

    /// Called during the run, with the number of steps done.
    fn at(&mut self, step: u64) {
        let _ = step;
    }

    /// Whether the run should end now, with all files complete.
    fn is_interrupted(&self) -> bool {
        false
    }
}

impl Monitor for () {}
