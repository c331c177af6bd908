//! Which name stands for what, while a body is read.

use super::similar::similar;
use crate::ast::{Argument, ArgumentNumber, Call, FunctionKind, Mentions, Role};
use quote::{format_ident, quote};
use std::collections::HashMap;
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{ConstParam, Error, Ident, Lifetime, Path, Result};

/// What a name stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Binding {
    /// A variable.
    Value,
    /// An argument of a helper, which is a value too.
    Argument,
    /// The cell or item that the process runs for.
    Subject,
    /// Another struct of the cell, or of the cell that the item stands in.
    Cell(ArgumentNumber),
    /// The items of the cell.
    Slots(ArgumentNumber),
    Parameters,
    Space,
    /// A neighbour bound by `let`.
    Neighbour(ArgumentNumber),
    /// Another item, the variable of a `for`.
    Other(ArgumentNumber),
}

/// Functions that Rust has everywhere.
const IN_RUSTS_PRELUDE: [&str; 5] = ["drop", "size_of", "size_of_val", "align_of", "align_of_val"];

impl Binding {
    pub(super) fn is_value(self) -> bool {
        matches!(self, Self::Value | Self::Argument)
    }
}

pub(super) struct Scope {
    pub(super) kind: FunctionKind,
    /// The name of the function.
    pub(super) function: Ident,
    pub(super) mentions: Mentions,
    /// The constants that the function is generic in.
    constants: Vec<Ident>,
    levels: Vec<HashMap<String, Binding>>,
    /// The loops around the present place, with their labels.
    loops: Vec<Option<String>>,
    errors: Option<Error>,
}

impl Scope {
    pub(super) fn new(
        kind: FunctionKind,
        function: Ident,
        arguments: &[Argument],
        constants: &[ConstParam],
    ) -> Self {
        let mut substates = (0..).map(ArgumentNumber);
        let mut next = || substates.next().unwrap_or(ArgumentNumber::SUBJECT);
        let names = arguments.iter().map(|argument| {
            let binding = match argument.role {
                Role::Cell(_) | Role::Slot(_) => match next() {
                    ArgumentNumber::SUBJECT => Binding::Subject,
                    number => Binding::Cell(number),
                },
                Role::Slots(_) => Binding::Slots(next()),
                Role::Parameters(_) => Binding::Parameters,
                Role::Space => Binding::Space,
                Role::Value(_) => Binding::Argument,
            };
            (argument.name.unraw().to_string(), binding)
        });
        Self {
            kind,
            function,
            mentions: Mentions::default(),
            constants: constants.iter().map(|constant| constant.ident.clone()).collect(),
            levels: vec![names.collect()],
            loops: Vec::new(),
            errors: None,
        }
    }

    pub(super) fn over_cells(&self) -> bool {
        self.kind == FunctionKind::Cells
    }

    pub(super) fn bind(&mut self, name: &Ident, binding: Binding) {
        if let Some(level) = self.levels.last_mut() {
            level.insert(name.unraw().to_string(), binding);
        }
    }

    pub(super) fn binding(&self, name: &Ident) -> Option<Binding> {
        let name = name.unraw().to_string();
        self.levels.iter().rev().find_map(|level| level.get(&name).copied())
    }

    /// Whether the function is generic in the constant.
    pub(super) fn is_generic_constant(&self, path: &Path) -> bool {
        path.get_ident().is_some_and(|name| self.constants.contains(name))
    }

    /// A name that is bound and much like this one.
    pub(super) fn similar_name(&self, name: &Ident) -> Option<String> {
        let bound = self.levels.iter().flat_map(HashMap::keys).map(String::as_str);
        similar(&name.to_string(), bound)
    }

    /// Reads something in a scope of its own.
    pub(super) fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> T {
        self.levels.push(HashMap::new());
        let result = read(self);
        self.levels.pop();
        result
    }

    /// Reads the body of a loop with this label.
    pub(super) fn in_loop<T>(&mut self, label: Option<&Lifetime>, read: impl FnOnce(&mut Self) -> T) -> T {
        self.loops.push(label.map(|label| label.ident.to_string()));
        let result = read(self);
        self.loops.pop();
        result
    }

    pub(super) fn inside_loop(&self) -> bool {
        !self.loops.is_empty()
    }

    /// The labels of the loops around the present place, from outside.
    pub(super) fn labels(&self) -> impl Iterator<Item = &str> {
        self.loops.iter().flatten().map(String::as_str)
    }

    /// The alias of a helper that is called.
    pub(super) fn alias(&mut self, function: &Path) -> Ident {
        // An import of these would be ambiguous where a helper has such a name.
        if let Some(name) = function.get_ident()
            && IN_RUSTS_PRELUDE.iter().any(|known| name == known)
        {
            return name.clone();
        }
        let text = quote!(#function).to_string();
        let same = |call: &&Call| {
            let function = &call.function;
            quote!(#function).to_string() == text
        };
        if let Some(known) = self.mentions.calls.iter().find(same) {
            return known.alias.clone();
        }
        let number = self.mentions.calls.len();
        let [import, alias] =
            ["import", "helper"].map(|word| format_ident!("__xca_{word}_{number}", span = function.span()));
        self.mentions.calls.push(Call { function: function.clone(), import, alias: alias.clone() });
        alias
    }

    /// Keeps an error and goes on, so that one compilation shows them all.
    pub(super) fn keep(&mut self, error: Error) {
        match &mut self.errors {
            Some(errors) => errors.combine(error),
            None => self.errors = Some(error),
        }
    }

    /// All errors that were kept.
    pub(super) fn finish(&mut self) -> Result<()> {
        self.errors.take().map_or(Ok(()), Err)
    }
}
