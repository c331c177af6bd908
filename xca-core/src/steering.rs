//! Steering: global operations between steps.

use crate::state::State;
use std::fmt;
use std::sync::Arc;

/// When a steering operation runs. Step numbers count from the initial state, which is step 0.
///
/// ```
/// use xca_core::prelude::*;
///
/// assert!(Schedule::Every(10).is_due(30));
/// assert!(!Schedule::Every(10).is_due(0));
/// assert!(Schedule::EveryFromStart(10).is_due(0));
/// assert!(Schedule::At(vec![3, 50]).is_due(50));
/// ```
///
/// An interval must be at least 1 step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Schedule {
    /// Before the first step, for the initial state.
    Start,
    /// After every n-th step: n, 2n, 3n and so on.
    Every(u64),
    /// On the initial state, and after every n-th step.
    EveryFromStart(u64),
    /// After these steps. 0 is the initial state.
    At(Vec<u64>),
    /// At the end of the run, when the host calls [`crate::Simulation::finish`].
    End,
}

impl Schedule {
    /// Whether it is due after this step. `Start` and `End` are not steps: always `false`.
    pub fn is_due(&self, step: u64) -> bool {
        match self {
            Self::Start | Self::End => false,
            Self::Every(interval) => step > 0 && *interval > 0 && step.is_multiple_of(*interval),
            Self::EveryFromStart(interval) => *interval > 0 && step.is_multiple_of(*interval),
            Self::At(steps) => steps.contains(&step),
        }
    }

    /// The first number of steps after this one at which it is time, if that comes.
    pub(crate) fn next_after(&self, step: u64) -> Option<u64> {
        match self {
            Self::Start | Self::End => None,
            Self::Every(interval) | Self::EveryFromStart(interval) => {
                step.checked_div(*interval)?.checked_add(1)?.checked_mul(*interval)
            }
            Self::At(steps) => steps.iter().copied().filter(|due| *due > step).min(),
        }
    }
}

/// The error of a steering operation: any error.
pub type SteeringError = Box<dyn std::error::Error + Send + Sync>;

type Operation = dyn Fn(&mut State<'_>) -> Result<(), SteeringError> + Send + Sync;

/// An operation with its schedule.
#[derive(Clone)]
pub(crate) struct Steering {
    pub(crate) schedule: Schedule,
    pub(crate) operation: Arc<Operation>,
}

impl Steering {
    pub(crate) fn new(
        schedule: Schedule,
        operation: impl Fn(&mut State<'_>) -> Result<(), SteeringError> + Send + Sync + 'static,
    ) -> Self {
        Self { schedule, operation: Arc::new(operation) }
    }
}

impl fmt::Debug for Steering {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Steering").field(&self.schedule).finish()
    }
}
