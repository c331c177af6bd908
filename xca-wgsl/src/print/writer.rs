//! The text of a function while it is written.

use super::frame::Frame;
use super::range::Range;
use super::text::Text;
use crate::error::Problem;
use crate::fault;
use crate::glossary::Glossary;
use crate::inference::{Analysis, LocalNumber};
use crate::names::Names;
use crate::program::{Program, Roles};
use crate::routine::Routines;
use crate::shader::Options;
use crate::types::Type;
use std::collections::{HashMap, HashSet};
use std::fmt::Write as _;
use xca_core::ir::{Expression, Function, FunctionKind};

/// What all functions of a module share.
pub(crate) struct Shared<'a> {
    pub(crate) program: &'a Program,
    pub(crate) options: &'a Options,
    pub(crate) glossary: &'a Glossary,
    pub(crate) names: &'a mut Names,
    pub(crate) routines: &'a mut Routines,
}

/// Writes one function.
pub(super) struct Writer<'a, 's> {
    pub(super) shared: &'s mut Shared<'a>,
    pub(super) function: &'a Function,
    pub(super) roles: Roles<'a>,
    pub(super) analysis: Analysis,
    pub(super) out: String,
    pub(super) indent: usize,
    /// What the variables of the source are called here.
    pub(super) locals: HashMap<LocalNumber, String>,
    /// Variables that are the index of a neighbour that exists.
    pub(super) neighbours: HashSet<LocalNumber>,
    /// The numbers that variables can be which never change, where these are not all of their type.
    pub(super) ranges: HashMap<LocalNumber, Range>,
    /// Variables of loops that are written out, with their present value.
    pub(super) counted: HashMap<LocalNumber, usize>,
    /// The loops around the present place.
    pub(super) loops: Vec<Frame>,
}

/// Where a value goes.
#[derive(Debug, Clone, Copy)]
pub(super) enum Target<'t> {
    Nowhere,
    Variable(&'t str),
    Return,
}

impl Writer<'_, '_> {
    pub(super) fn line(&mut self, text: &str) {
        let _ = writeln!(self.out, "{:width$}{text}", "", width = 4 * self.indent);
    }

    /// At the beginning of a loop that has an end only with the right values.
    pub(super) fn end_after_fault(&mut self) {
        self.out.push_str(&fault::exit(self.indent));
    }

    /// Writes something in braces; the caller has written the opening one.
    pub(super) fn inside<T>(
        &mut self,
        write: impl FnOnce(&mut Self) -> Result<T, Problem>,
    ) -> Result<T, Problem> {
        self.indent += 1;
        self.shared.names.open();
        let result = write(self);
        self.shared.names.close();
        self.indent -= 1;
        result
    }

    /// Gives a value a name, so that it is computed here and now.
    pub(super) fn keep(&mut self, name: &str, type_: &Type, value: &Text) -> Text {
        let name = self.shared.names.local(name);
        self.line(&format!("let {name}: {} = {};", type_.wgsl(), value.plain()));
        Text::primary(name)
    }

    pub(super) fn type_of(&self, value: &Expression) -> Type {
        self.analysis.type_of(value).clone()
    }

    pub(super) fn over_cells(&self) -> bool {
        self.function.kind == FunctionKind::Cells
    }

    pub(super) fn local(&self, number: LocalNumber) -> Result<String, Problem> {
        self.locals
            .get(&number)
            .cloned()
            .ok_or_else(|| Problem::unsupported("a variable", "it has no name here"))
    }

    /// Whether WGSL has the type; a tuple gets a struct.
    pub(super) fn check_type(&mut self, type_: &Type) -> Result<(), Problem> {
        match type_ {
            Type::Tuple(parts) => {
                self.shared.routines.need_tuple(type_, parts);
                parts.iter().try_for_each(|part| self.check_type(part))
            }
            Type::Array(_, 0) => Err(Problem::unsupported("an empty array", "WGSL has none")),
            Type::Array(element, _) => self.check_type(element),
            _ => Ok(()),
        }
    }
}

/// The zero value of a type.
pub(super) fn zero(type_: &Type) -> String {
    format!("{}()", type_.wgsl())
}
