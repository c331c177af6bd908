//! Demands on types that are not known yet.

use super::table::Variable;

/// A demand that waits until a type is known.
pub(super) enum Waiting {
    Arithmetic {
        left: Variable,
        right: Variable,
        result: Variable,
    },
    Component {
        of: Variable,
        lane: u8,
        result: Variable,
    },
    Element {
        of: Variable,
        result: Variable,
    },
    /// The scalar of a number or vector.
    ScalarOf {
        of: Variable,
        result: Variable,
    },
}
