//! Loops around a place in a function.

use crate::visit::Jump;
use xca_core::ir::Loop;

/// A loop around the present place.
#[derive(Debug, Default)]
pub(super) struct Frame {
    pub(super) label: Option<&'static str>,
    /// Of a search in several cells: the flag that ends it.
    pub(super) ended: Option<String>,
    /// The flags by which loops within end this one, and go on with its next turn.
    pub(super) left: Option<String>,
    pub(super) continued: Option<String>,
}

impl Frame {
    pub(super) fn new(loop_: &Loop, ended: Option<String>) -> Self {
        Self { label: loop_.label, ended, ..Self::default() }
    }

    pub(super) fn flag(&self, jump: Jump) -> Option<&String> {
        let flag = if jump.is_break { &self.left } else { &self.continued };
        flag.as_ref().filter(|_| self.label == Some(jump.label))
    }
}
