//! Finds again the types that Rust infers.
//!
//! The data of a body holds only the types that the user wrote. Here each expression gets a type: unknown
//! ones are variables that are made one wherever the language demands the same type. What depends on a type
//! that is not known yet (is `a * b` a vector times a number?) waits until it is.

mod expressions;
mod operators;
mod statements;
mod table;
mod waiting;

use crate::error::Problem;
use crate::program::{Program, Roles, field_number};
use crate::types::Type;
pub(crate) use expressions::{constant as constant_type, definition};
use std::collections::HashMap;
use table::{Table, Term, Variable};
use waiting::Waiting;
use xca_core::ir::{Block, Expression, Function, Place, Role, Statement, TuplePart};
use xca_core::{ScalarType, Schema};

/// The number of a variable of the source; shadowed ones are told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct LocalNumber(pub(crate) usize);

/// A variable of the source.
#[derive(Debug)]
pub(crate) struct Local {
    pub(crate) type_: Type,
    pub(crate) mutable: bool,
}

/// What was found out about a function. Expressions, places and statements are known by their address.
pub(crate) struct Analysis {
    types: HashMap<*const Expression, Type>,
    place_types: HashMap<*const Place, Type>,
    uses: HashMap<*const Expression, LocalNumber>,
    place_roots: HashMap<*const Place, LocalNumber>,
    bindings: HashMap<*const Statement, LocalNumber>,
    parts: HashMap<*const TuplePart, LocalNumber>,
    pub(crate) locals: Vec<Local>,
    /// The variables of the arguments that are values.
    pub(crate) arguments: Vec<Option<LocalNumber>>,
    pub(crate) result: Type,
}

impl Analysis {
    /// Works out the types of one function of the program.
    pub(crate) fn of(program: &Program, function: usize) -> Result<Self, Problem> {
        Inference::run(program, &program.functions[function])
    }

    pub(crate) fn type_of(&self, expression: &Expression) -> &Type {
        self.types.get(&(&raw const *expression)).unwrap_or(&Type::Unit)
    }

    pub(crate) fn type_of_place(&self, place: &Place) -> &Type {
        self.place_types.get(&(&raw const *place)).unwrap_or(&Type::Unit)
    }

    /// The variable that an expression means.
    pub(crate) fn local(&self, expression: &Expression) -> Result<LocalNumber, Problem> {
        self.uses.get(&(&raw const *expression)).copied().ok_or_else(lost)
    }

    /// The variable in which a place starts.
    pub(crate) fn place_root(&self, place: &Place) -> Result<LocalNumber, Problem> {
        self.place_roots.get(&(&raw const *place)).copied().ok_or_else(lost)
    }

    /// The variable that takes a part of a tuple.
    pub(crate) fn part(&self, part: &TuplePart) -> Result<LocalNumber, Problem> {
        self.parts.get(&(&raw const *part)).copied().ok_or_else(lost)
    }

    /// The variable that a statement makes.
    pub(crate) fn bound(&self, statement: &Statement) -> Result<LocalNumber, Problem> {
        self.bindings.get(&(&raw const *statement)).copied().ok_or_else(lost)
    }
}

fn lost() -> Problem {
    Problem::unsupported("a variable", "it was not seen by the type inference")
}

struct Inference<'a> {
    program: &'a Program,
    roles: Roles<'a>,
    table: Table,
    scopes: Vec<HashMap<&'static str, LocalNumber>>,
    locals: Vec<(Variable, bool)>,
    waiting: Vec<Waiting>,
    indices: Vec<Variable>,
    result: Variable,
    types: HashMap<*const Expression, Variable>,
    place_types: HashMap<*const Place, Variable>,
    uses: HashMap<*const Expression, LocalNumber>,
    place_roots: HashMap<*const Place, LocalNumber>,
    bindings: HashMap<*const Statement, LocalNumber>,
    parts: HashMap<*const TuplePart, LocalNumber>,
}

impl<'a> Inference<'a> {
    fn run(program: &'a Program, function: &'a Function) -> Result<Analysis, Problem> {
        let mut table = Table::default();
        let result = table.known(&function.result.as_ref().map_or(Type::Unit, Type::from));
        let mut inference = Self {
            program,
            roles: Roles::of(function),
            table,
            scopes: vec![HashMap::new()],
            locals: Vec::new(),
            waiting: Vec::new(),
            indices: Vec::new(),
            result,
            types: HashMap::new(),
            place_types: HashMap::new(),
            uses: HashMap::new(),
            place_roots: HashMap::new(),
            bindings: HashMap::new(),
            parts: HashMap::new(),
        };
        let arguments = function
            .arguments
            .iter()
            .map(|argument| match &argument.role {
                Role::Value(written) => {
                    let variable = inference.table.known(&Type::from(written));
                    Some(inference.bind(argument.name, variable, false))
                }
                _ => None,
            })
            .collect();
        inference.body(&function.body)?;
        inference.settle()?;
        Ok(inference.finish(arguments))
    }

    fn body(&mut self, body: &'a Block) -> Result<(), Problem> {
        let value = self.block(body)?;
        self.table.unify(self.result, value, "the value of the function")
    }

    fn finish(self, arguments: Vec<Option<LocalNumber>>) -> Analysis {
        let table = &self.table;
        let local = |(variable, mutable)| Local { type_: table.resolve(variable), mutable };
        Analysis {
            types: self.types.iter().map(|(key, variable)| (*key, table.resolve(*variable))).collect(),
            place_types: self
                .place_types
                .iter()
                .map(|(key, variable)| (*key, table.resolve(*variable)))
                .collect(),
            uses: self.uses,
            place_roots: self.place_roots,
            bindings: self.bindings,
            parts: self.parts,
            locals: self.locals.into_iter().map(local).collect(),
            arguments,
            result: table.resolve(self.result),
        }
    }

    fn bind(&mut self, name: &'static str, variable: Variable, mutable: bool) -> LocalNumber {
        let number = LocalNumber(self.locals.len());
        self.locals.push((variable, mutable));
        if let Some(scope) = self.scopes.last_mut() {
            scope.insert(name, number);
        }
        number
    }

    fn look_up(&self, name: &str) -> Result<LocalNumber, Problem> {
        self.scopes
            .iter()
            .rev()
            .find_map(|scope| scope.get(name).copied())
            .ok_or_else(|| Problem::unknown("variable", name))
    }

    fn scoped<T>(&mut self, work: impl FnOnce(&mut Self) -> Result<T, Problem>) -> Result<T, Problem> {
        self.scopes.push(HashMap::new());
        let result = work(self);
        self.scopes.pop();
        result
    }

    fn scalar(&mut self, scalar: ScalarType) -> Variable {
        self.table.variable(Term::Scalar(scalar))
    }

    /// The type of a field of a struct of substates or parameters.
    /// A substate of the struct with this number.
    fn substate(&mut self, argument: usize, name: &str) -> Result<Variable, Problem> {
        let named = self.roles.substates.get(argument);
        let schema = named.ok_or_else(|| Problem::unknown("substate", name))?.schema;
        self.field(schema, "substate", name)
    }

    /// A field of the struct of parameters that the source calls so.
    fn parameter(&mut self, argument: &str, name: &str) -> Result<Variable, Problem> {
        let schema = self.roles.parameters(argument)?;
        self.field(schema, "parameter", name)
    }

    fn field(
        &mut self,
        schema: &'static Schema,
        kind: &'static str,
        name: &str,
    ) -> Result<Variable, Problem> {
        let number = field_number(schema, name).ok_or_else(|| Problem::unknown(kind, name))?;
        Ok(self.table.known(&Type::of_value(schema.fields[number].value_type)))
    }
}
