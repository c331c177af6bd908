//! The members of an ensemble, and what comes of them.

use serde::Serialize;
use xca_record::Observable;

/// One run of an ensemble.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Member {
    /// Its place in the table, from 0.
    pub number: usize,
    /// The seed of its random numbers.
    pub seed: u64,
    /// Its values of the parameters that vary.
    pub parameters: Vec<Assigned>,
}

/// A parameter with the text of its value.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Assigned {
    /// The name of the parameter.
    pub parameter: String,
    /// The text of its value.
    pub value: String,
}

/// How a member has come to its end.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// After all steps.
    Done,
    /// The model stopped it, for this reason.
    Stopped(String),
    /// It failed, for this reason.
    Failed(String),
}

/// A member that has come to its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Finished {
    /// The member.
    pub member: Member,
    /// How it ended.
    pub end: End,
    /// The number of steps done.
    pub steps: u64,
    /// What was observed at the end; nothing of a member that failed.
    pub observables: Vec<Observable>,
}

impl Finished {
    /// Of a member that could not be run, or fails in some way.
    pub(super) fn failed(member: Member, steps: u64, reason: impl std::fmt::Display) -> Self {
        Self { member, end: End::Failed(reason.to_string()), steps, observables: Vec::new() }
    }
}
