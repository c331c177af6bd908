//! A process together with the helpers that it calls.

use crate::error::{Error, Problem};
use crate::visit::{self, Node};
use std::collections::HashMap;
use xca_core::Schema;
use xca_core::ir::{Expression, Function, FunctionKind, Role};

/// The process (number 0) and the helpers, callees after callers. Once collected they do not move:
/// what is known about a part of a body is kept by its address.
pub(crate) struct Program {
    pub(crate) functions: Vec<Function>,
    by_address: HashMap<usize, usize>,
}

impl Program {
    pub(crate) fn collect(process: &Function) -> Result<Self, Error> {
        if process.kind == FunctionKind::Helper {
            return Err(error(process.name, process.name, Problem::NotAProcess));
        }
        let mut program = Self { functions: vec![process.clone()], by_address: HashMap::new() };
        program.add_callees(0)?;
        Ok(program)
    }

    pub(crate) fn process(&self) -> &Function {
        &self.functions[0]
    }

    /// The number of the helper that a call means.
    pub(crate) fn helper(&self, function: fn() -> Function) -> Option<usize> {
        self.by_address.get(&(function as usize)).copied()
    }

    fn add_callees(&mut self, caller: usize) -> Result<(), Error> {
        let mut calls: Vec<fn() -> Function> = Vec::new();
        visit::block(&self.functions[caller].body, &mut |node| {
            if let Node::Expression(Expression::Call { function, .. }) = node {
                calls.push(*function);
            }
            true
        });
        for call in calls {
            if self.by_address.contains_key(&(call as usize)) {
                continue;
            }
            let helper = call();
            // A function may have several addresses; its text decides.
            let text = format!("{helper:?}");
            let known = self.functions.iter().position(|known| format!("{known:?}") == text);
            if let Some(known) = known {
                self.by_address.insert(call as usize, known);
                continue;
            }
            let (name, kind) = (helper.name, helper.kind);
            if kind != FunctionKind::Helper {
                let problem =
                    Problem::unsupported(format!("a call of `{name}`"), "only helpers can be called");
                return Err(self.error(caller, problem));
            }
            let number = self.functions.len();
            self.functions.push(helper);
            self.by_address.insert(call as usize, number);
            self.add_callees(number)?;
        }
        Ok(())
    }

    /// An error in one of the functions.
    pub(crate) fn error(&self, function: usize, problem: Problem) -> Error {
        error(self.process().name, self.functions[function].name, problem)
    }
}

fn error(process: &str, function: &str, problem: Problem) -> Error {
    Error { process: process.to_owned(), function: function.to_owned(), problem }
}

/// What the arguments of a function stand for.
#[derive(Clone, Default)]
pub(crate) struct Roles<'a> {
    /// The structs of substates: first that of the cell or item that the process runs for.
    pub(crate) substates: Vec<Named<'a>>,
    /// The structs of parameters.
    pub(crate) parameters: Vec<Named<'a>>,
}

/// A struct that a function takes.
#[derive(Clone, Copy)]
pub(crate) struct Named<'a> {
    /// What the source calls the argument.
    pub(crate) name: &'a str,
    /// The fields.
    pub(crate) schema: &'static Schema,
}

impl<'a> Roles<'a> {
    pub(crate) fn of(function: &'a Function) -> Self {
        let mut roles = Self::default();
        for argument in &function.arguments {
            let name = argument.name;
            match argument.role {
                Role::Cell(schema) | Role::Slot(schema) | Role::Slots(schema) => {
                    roles.substates.push(Named { name, schema });
                }
                Role::Parameters(schema) => roles.parameters.push(Named { name, schema }),
                Role::Space | Role::Value(_) => {}
            }
        }
        roles
    }

    /// The struct of parameters that the source calls so.
    pub(crate) fn parameters(&self, name: &str) -> Result<&'static Schema, Problem> {
        let named = self.parameters.iter().find(|named| bare(named.name) == bare(name));
        named.map(|named| named.schema).ok_or_else(|| Problem::unknown("struct of parameters", name))
    }
}

/// The number of the field with this name, raw identifiers being the same as plain ones.
pub(crate) fn field_number(schema: &Schema, name: &str) -> Option<usize> {
    schema.fields.iter().position(|field| bare(field.name) == bare(name))
}

/// A name without `r#`.
pub(crate) fn bare(name: &str) -> &str {
    name.strip_prefix("r#").unwrap_or(name)
}
