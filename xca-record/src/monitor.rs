//! Who watches a run.

/// Is told how far a run has come, and asked whether it should end. `()` watches nothing.
pub trait Monitor {
    /// The steps begin: so many are done already.
    fn begin(&mut self, step: u64) {
        let _ = step;
    }

    /// So many steps are done.
    fn at(&mut self, step: u64) {
        let _ = step;
    }

    /// Whether the run should end after its present step, with all files complete.
    fn is_interrupted(&self) -> bool {
        false
    }
}

impl Monitor for () {}
