//! Unknown types and what is known about them: union-find.

use crate::error::Problem;
use crate::types::{Type, is_float};
use xca_core::{ScalarType, StateNames};

/// A type that may still be unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Variable(usize);

/// Where the parts of a tuple stand in the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Parts {
    first: usize,
    count: usize,
}

/// What is known about a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Term {
    /// Nothing.
    Any,
    /// It is the type of an integer literal.
    Integer,
    /// It is the type of a decimal fraction.
    Float,
    Unit,
    Bool,
    Scalar(ScalarType),
    Vector(Variable, u8),
    State(&'static StateNames),
    Array(Variable, usize),
    Tuple(Parts),
    Destination,
}

impl Term {
    /// Whether it is one number or truth value, perhaps of a type that is not yet known.
    pub(super) fn is_single(self) -> bool {
        matches!(self, Self::Integer | Self::Float | Self::Bool | Self::Scalar(_))
    }
}

enum Node {
    Same(Variable),
    Root(Term),
}

/// All types of a function.
#[derive(Default)]
pub(super) struct Table {
    nodes: Vec<Node>,
    /// The parts of tuples, one after the other.
    parts: Vec<Variable>,
}

impl Table {
    pub(super) fn variable(&mut self, term: Term) -> Variable {
        self.nodes.push(Node::Root(term));
        Variable(self.nodes.len() - 1)
    }

    /// A tuple of these.
    pub(super) fn tuple(&mut self, parts: &[Variable]) -> Variable {
        let term = Term::Tuple(Parts { first: self.parts.len(), count: parts.len() });
        self.parts.extend(parts);
        self.variable(term)
    }

    fn parts(&self, parts: Parts) -> Vec<Variable> {
        self.parts[parts.first..parts.first + parts.count].to_vec()
    }

    pub(super) fn known(&mut self, type_: &Type) -> Variable {
        let term = match type_ {
            Type::Unit => Term::Unit,
            Type::Bool => Term::Bool,
            Type::Scalar(scalar) => Term::Scalar(*scalar),
            Type::Vector(scalar, lanes) => {
                let scalar = self.variable(Term::Scalar(*scalar));
                Term::Vector(scalar, *lanes)
            }
            Type::State(names) => Term::State(names),
            Type::Array(element, length) => {
                let element = self.known(element);
                Term::Array(element, *length)
            }
            Type::Tuple(parts) => {
                let parts: Vec<Variable> = parts.iter().map(|part| self.known(part)).collect();
                return self.tuple(&parts);
            }
            Type::Destination => Term::Destination,
        };
        self.variable(term)
    }

    fn root(&self, mut variable: Variable) -> (Variable, Term) {
        loop {
            match &self.nodes[variable.0] {
                Node::Same(other) => variable = *other,
                Node::Root(term) => return (variable, *term),
            }
        }
    }

    pub(super) fn term(&self, variable: Variable) -> Term {
        self.root(variable).1
    }

    /// Makes two types one.
    pub(super) fn unify(
        &mut self,
        expected: Variable,
        found: Variable,
        construct: &str,
    ) -> Result<(), Problem> {
        let ((left, left_term), (right, right_term)) = (self.root(expected), self.root(found));
        if left == right {
            return Ok(());
        }
        let term = match (left_term, right_term) {
            (Term::Any, other) | (other, Term::Any) => other,
            (Term::Integer, Term::Integer) => Term::Integer,
            (Term::Float, Term::Float) => Term::Float,
            (Term::Integer, Term::Scalar(scalar)) | (Term::Scalar(scalar), Term::Integer)
                if !is_float(scalar) =>
            {
                Term::Scalar(scalar)
            }
            (Term::Float, Term::Scalar(scalar)) | (Term::Scalar(scalar), Term::Float) if is_float(scalar) => {
                Term::Scalar(scalar)
            }
            (Term::Vector(one, lanes), Term::Vector(other, same)) if lanes == same => {
                self.unify(one, other, construct)?;
                left_term
            }
            (Term::Array(one, length), Term::Array(other, same)) if length == same => {
                self.unify(one, other, construct)?;
                left_term
            }
            (Term::Tuple(one), Term::Tuple(other)) if one.count == other.count => {
                for (one, other) in self.parts(one).into_iter().zip(self.parts(other)) {
                    self.unify(one, other, construct)?;
                }
                left_term
            }
            (one, other) if one == other => one,
            _ => {
                return Err(Problem::Types {
                    construct: construct.to_owned(),
                    expected: self.describe(expected),
                    found: self.describe(found),
                });
            }
        };
        self.nodes[left.0] = Node::Root(term);
        self.nodes[right.0] = Node::Same(left);
        Ok(())
    }

    fn describe(&self, variable: Variable) -> String {
        match self.term(variable) {
            Term::Any => "_".to_owned(),
            Term::Integer => "an integer".to_owned(),
            Term::Float => "a float".to_owned(),
            Term::Unit => "()".to_owned(),
            Term::Bool => "bool".to_owned(),
            Term::Scalar(scalar) => scalar.to_string(),
            Term::Vector(scalar, lanes) => format!("Vector{lanes}<{}>", self.describe(scalar)),
            Term::State(names) => names.name.to_owned(),
            Term::Array(element, length) => format!("[{}; {length}]", self.describe(element)),
            Term::Tuple(parts) => {
                let parts: Vec<String> =
                    self.parts(parts).into_iter().map(|part| self.describe(part)).collect();
                format!("({})", parts.join(", "))
            }
            Term::Destination => "Destination".to_owned(),
        }
    }

    /// The type, with Rust's own choice where nothing has decided it: `i32` for integers and `f64` for
    /// fractions.
    pub(super) fn resolve(&self, variable: Variable) -> Type {
        match self.term(variable) {
            Term::Any | Term::Unit => Type::Unit,
            Term::Integer => Type::Scalar(ScalarType::I32),
            Term::Float => Type::Scalar(ScalarType::F64),
            Term::Bool => Type::Bool,
            Term::Scalar(scalar) => Type::Scalar(scalar),
            Term::Vector(scalar, lanes) => match self.resolve(scalar) {
                Type::Scalar(scalar) => Type::Vector(scalar, lanes),
                other => other,
            },
            Term::State(names) => Type::State(names),
            Term::Array(element, length) => Type::Array(Box::new(self.resolve(element)), length),
            Term::Tuple(parts) => {
                Type::Tuple(self.parts(parts).into_iter().map(|part| self.resolve(part)).collect())
            }
            Term::Destination => Type::Destination,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Table, Term};
    use crate::types::Type;
    use xca_core::ScalarType;

    #[test]
    fn literals_take_the_type_of_their_use() {
        let mut table = Table::default();
        let literal = table.variable(Term::Integer);
        let other = table.variable(Term::Integer);
        table.unify(literal, other, "`+`").unwrap();
        let byte = table.known(&Type::Scalar(ScalarType::U8));
        table.unify(byte, other, "`+`").unwrap();
        assert_eq!(table.resolve(literal), Type::Scalar(ScalarType::U8));
        let fraction = table.variable(Term::Float);
        let error = table.unify(literal, fraction, "`+`").unwrap_err();
        assert_eq!(error.to_string(), "`+` needs `u8` but has `a float`");
    }

    #[test]
    fn defaults_are_those_of_rust() {
        let mut table = Table::default();
        let scalar = table.variable(Term::Float);
        let vector = table.variable(Term::Vector(scalar, 3));
        assert_eq!(table.resolve(vector), Type::Vector(ScalarType::F64, 3));
        let integer = table.variable(Term::Integer);
        assert_eq!(table.resolve(integer), Type::Scalar(ScalarType::I32));
    }
}
