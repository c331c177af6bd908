//! The labels of loops in the generated code.

use proc_macro2::Span;
use syn::Lifetime;

/// The label of a loop in the generated code, apart from the labels that the generated code has for itself.
pub(super) fn hidden_label(label: &Lifetime) -> Lifetime {
    Lifetime::new(&format!("'__xca_loop_{}", label.ident), label.span())
}

/// A loop whose turns are written out.
pub(super) struct Unrolled {
    pub(super) label: Option<Lifetime>,
}

impl Unrolled {
    /// What a `break` or `continue` with this label leaves: nothing where that is another loop.
    pub(super) fn leaves(&self, label: Option<&Lifetime>, whole: bool) -> Option<Lifetime> {
        let own = label.is_none() || label == self.label.as_ref();
        own.then(|| if whole { turns() } else { turn() })
    }
}

/// The label of all turns.
pub(super) fn turns() -> Lifetime {
    Lifetime::new("'__xca_turns", Span::mixed_site())
}

/// The label of one turn.
pub(super) fn turn() -> Lifetime {
    Lifetime::new("'__xca_turn", Span::mixed_site())
}
