//! What a folder or a checkpoint holds.

use super::state::{Place, Statistics};
use serde::Serialize;
use serde_json::Value;
use std::path::PathBuf;
use xca_checkpoint::{Exact, Parameter};

/// What there is to tell.
#[derive(Debug, Serialize)]
pub(super) struct Findings {
    /// `run.json`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) run: Option<Value>,
    /// The checkpoints of the folder, the latest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) checkpoints: Vec<Listed>,
    /// The one that is looked into.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) state: Option<Inside>,
}

/// A checkpoint of a folder.
#[derive(Debug, Serialize)]
pub(super) struct Listed {
    pub(super) path: PathBuf,
    /// Why it cannot be used.
    pub(super) problem: Option<String>,
}

/// What is in a checkpoint.
#[derive(Debug, Serialize)]
pub(super) struct Inside {
    pub(super) path: PathBuf,
    pub(super) program: String,
    pub(super) version: String,
    pub(super) step: u64,
    pub(super) time: Exact,
    pub(super) steps_wanted: u64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) parameters: Vec<Parameter>,
    pub(super) substates: Vec<Statistics>,
    /// The cell and the items that were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) places: Vec<Place>,
}
