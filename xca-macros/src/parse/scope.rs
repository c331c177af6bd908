//! Which name stands for what, while a body is read.

use crate::ast::{Argument, FunctionKind, Role};
use std::collections::HashMap;
use syn::{Error, Ident, Result};

/// What a name stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Binding {
    /// A variable or value argument.
    Value,
    /// The cell or item that the process runs for.
    Subject,
    /// The cell of the item.
    CellOfItem,
    /// The items of the cell.
    Slots,
    Parameters,
    Space,
    /// A neighbour bound by `let`.
    Neighbour,
    /// Another item, the variable of a `for`.
    Other,
}

pub(super) struct Scope {
    pub(super) kind: FunctionKind,
    levels: Vec<HashMap<String, Binding>>,
    loops: usize,
    errors: Option<Error>,
}

impl Scope {
    pub(super) fn new(kind: FunctionKind, arguments: &[Argument]) -> Self {
        let names = arguments.iter().enumerate().map(|(position, argument)| {
            let binding = match argument.role {
                Role::Cell(_) | Role::Slot(_) if position == 0 => Binding::Subject,
                Role::Cell(_) | Role::Slot(_) => Binding::CellOfItem,
                Role::Slots(_) => Binding::Slots,
                Role::Parameters(_) => Binding::Parameters,
                Role::Space => Binding::Space,
                Role::Value(_) => Binding::Value,
            };
            (argument.name.to_string(), binding)
        });
        Self { kind, levels: vec![names.collect()], loops: 0, errors: None }
    }

    pub(super) fn bind(&mut self, name: &Ident, binding: Binding) {
        if let Some(level) = self.levels.last_mut() {
            level.insert(name.to_string(), binding);
        }
    }

    pub(super) fn binding(&self, name: &Ident) -> Option<Binding> {
        let name = name.to_string();
        self.levels.iter().rev().find_map(|level| level.get(&name).copied())
    }

    /// Reads something in a scope of its own.
    pub(super) fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> T {
        self.levels.push(HashMap::new());
        let result = read(self);
        self.levels.pop();
        result
    }

    /// Reads the body of a loop.
    pub(super) fn in_loop<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> T {
        self.loops += 1;
        let result = read(self);
        self.loops -= 1;
        result
    }

    pub(super) fn inside_loop(&self) -> bool {
        self.loops > 0
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
