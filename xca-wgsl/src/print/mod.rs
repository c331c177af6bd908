//! Writes a function's body as WGSL.

mod cast;
mod constant;
mod control;
mod element;
mod expression;
mod loops;
mod method;
mod operator;
mod range;
mod search;
mod statement;
mod text;

use crate::error::Problem;
use crate::fault;
use crate::glossary::Glossary;
use crate::inference::{Analysis, LocalNumber};
use crate::names::Names;
use crate::program::{Program, Roles};
use crate::routine::Routines;
use crate::shader::Options;
use crate::types::Type;
use range::Range;
use std::collections::{HashMap, HashSet};
use std::fmt::Write as _;
use text::Text;
use xca_core::ir::{Expression, Function, FunctionKind, Role};

pub(crate) use constant::constant_text;

/// What all functions of a module share.
pub(crate) struct Shared<'a> {
    pub(crate) program: &'a Program,
    pub(crate) options: &'a Options,
    pub(crate) glossary: &'a Glossary,
    pub(crate) names: &'a mut Names,
    pub(crate) routines: &'a mut Routines,
}

/// Writes one function.
struct Writer<'a, 's> {
    shared: &'s mut Shared<'a>,
    function: &'a Function,
    roles: Roles<'a>,
    analysis: Analysis,
    out: String,
    indent: usize,
    /// What the variables of the source are called here.
    locals: HashMap<LocalNumber, String>,
    /// Variables that are the index of a neighbour that exists.
    neighbours: HashSet<LocalNumber>,
    /// The numbers that variables can be which never change, where these are not all of their type.
    ranges: HashMap<LocalNumber, Range>,
    /// Variables of loops that are written out, with their present value.
    counted: HashMap<LocalNumber, usize>,
    /// The loops around the present place.
    loops: Vec<loops::Frame>,
}

/// Where a value goes.
#[derive(Debug, Clone, Copy)]
enum Target<'t> {
    Nowhere,
    Variable(&'t str),
    Return,
}

/// The text of a function of the program: the body, apart from the entry point.
pub(crate) fn function(shared: &mut Shared<'_>, number: usize) -> Result<String, Problem> {
    let program = shared.program;
    let function = &program.functions[number];
    let analysis = Analysis::of(program, number)?;
    shared.names.open();
    let writer = Writer {
        roles: Roles::of(function),
        shared,
        function,
        analysis,
        out: String::new(),
        indent: 0,
        locals: HashMap::new(),
        neighbours: HashSet::new(),
        ranges: HashMap::new(),
        counted: HashMap::new(),
        loops: Vec::new(),
    };
    writer.run(number)
}

impl Writer<'_, '_> {
    fn run(mut self, number: usize) -> Result<String, Problem> {
        let mut arguments = Vec::new();
        for (position, argument) in self.function.arguments.iter().enumerate() {
            if let (Role::Value(written), Some(local)) = (&argument.role, self.analysis.arguments[position]) {
                let name = self.shared.names.local(argument.name);
                let type_ = Type::from(written);
                self.check_type(&type_)?;
                arguments.push(format!("{name}: {}", type_.wgsl()));
                self.locals.insert(local, name);
            }
        }
        let result = self.analysis.result.clone();
        self.check_type(&result)?;
        let arrow = if result == Type::Unit { String::new() } else { format!(" -> {}", result.wgsl()) };
        let name = self.shared.glossary.functions[number].clone();
        self.line(&format!("fn {name}({}){arrow} {{", arguments.join(", ")));
        self.indent += 1;
        let function = self.function;
        let target = if result == Type::Unit { Target::Nowhere } else { Target::Return };
        self.block_into(&function.body, target)?;
        if result != Type::Unit && !statement::ends_in_return(&function.body) {
            // Never reached, but naga wants to see a `return` at the end.
            self.line(&format!("return {};", zero(&result)));
        }
        self.indent -= 1;
        self.line("}");
        self.shared.names.close();
        Ok(self.out)
    }

    fn line(&mut self, text: &str) {
        let _ = writeln!(self.out, "{:width$}{text}", "", width = 4 * self.indent);
    }

    /// At the beginning of a loop that has an end only with the right values.
    fn end_after_fault(&mut self) {
        self.out.push_str(&fault::exit(self.indent));
    }

    /// Writes something in braces; the caller has written the opening one.
    fn inside<T>(&mut self, write: impl FnOnce(&mut Self) -> Result<T, Problem>) -> Result<T, Problem> {
        self.indent += 1;
        self.shared.names.open();
        let result = write(self);
        self.shared.names.close();
        self.indent -= 1;
        result
    }

    /// Gives a value a name, so that it is computed here and now.
    fn keep(&mut self, name: &str, type_: &Type, value: &Text) -> Text {
        let name = self.shared.names.local(name);
        self.line(&format!("let {name}: {} = {};", type_.wgsl(), value.plain()));
        Text::primary(name)
    }

    fn type_of(&self, value: &Expression) -> Type {
        self.analysis.type_of(value).clone()
    }

    fn over_cells(&self) -> bool {
        self.function.kind == FunctionKind::Cells
    }

    fn local(&self, number: LocalNumber) -> Result<String, Problem> {
        self.locals
            .get(&number)
            .cloned()
            .ok_or_else(|| Problem::unsupported("a variable", "it has no name here"))
    }

    /// Whether WGSL has the type; a tuple gets a struct.
    fn check_type(&mut self, type_: &Type) -> Result<(), Problem> {
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
fn zero(type_: &Type) -> String {
    format!("{}()", type_.wgsl())
}
