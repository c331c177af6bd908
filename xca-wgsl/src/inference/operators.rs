//! What operators, components and elements demand of their operands.

use super::Inference;
use super::table::{Term, Variable};
use super::waiting::Waiting;
use crate::error::Problem;
use xca_core::ScalarType;
use xca_core::ir::BinaryOperator;

impl Inference<'_> {
    /// The type of `left operator right`.
    pub(super) fn binary(
        &mut self,
        operator: BinaryOperator,
        left: Variable,
        right: Variable,
    ) -> Result<Variable, Problem> {
        match operator {
            BinaryOperator::And | BinaryOperator::Or => {
                let truth = self.table.variable(Term::Bool);
                self.table.unify(truth, left, "a logical operator")?;
                self.table.unify(truth, right, "a logical operator")?;
                Ok(truth)
            }
            BinaryOperator::Equal
            | BinaryOperator::NotEqual
            | BinaryOperator::Less
            | BinaryOperator::LessEqual
            | BinaryOperator::Greater
            | BinaryOperator::GreaterEqual => {
                self.table.unify(left, right, "a comparison")?;
                Ok(self.table.variable(Term::Bool))
            }
            // The number of places may be of any integer type.
            BinaryOperator::ShiftLeft | BinaryOperator::ShiftRight => Ok(left),
            BinaryOperator::Add
            | BinaryOperator::Subtract
            | BinaryOperator::Multiply
            | BinaryOperator::Divide
            | BinaryOperator::Remainder
            | BinaryOperator::BitAnd
            | BinaryOperator::BitOr
            | BinaryOperator::BitXor => {
                let result = self.table.variable(Term::Any);
                self.demand(Waiting::Arithmetic { left, right, result })?;
                Ok(result)
            }
        }
    }

    pub(super) fn component(&mut self, of: Variable, lane: u8) -> Result<Variable, Problem> {
        let result = self.table.variable(Term::Any);
        self.demand(Waiting::Component { of, lane, result })?;
        Ok(result)
    }

    pub(super) fn element(&mut self, of: Variable, index: Variable) -> Result<Variable, Problem> {
        self.indices.push(index);
        self.element_of(of)
    }

    /// The type of the elements of an array.
    pub(super) fn element_of(&mut self, of: Variable) -> Result<Variable, Problem> {
        let result = self.table.variable(Term::Any);
        self.demand(Waiting::Element { of, result })?;
        Ok(result)
    }

    pub(super) fn scalar_of(&mut self, of: Variable) -> Result<Variable, Problem> {
        let result = self.table.variable(Term::Any);
        self.demand(Waiting::ScalarOf { of, result })?;
        Ok(result)
    }

    fn demand(&mut self, waiting: Waiting) -> Result<(), Problem> {
        if !self.meet(&waiting, false)? {
            self.waiting.push(waiting);
        }
        Ok(())
    }

    /// Meets all demands; where nothing more can be learned, operands are taken to be of one type.
    pub(super) fn settle(&mut self) -> Result<(), Problem> {
        for force in [false, true] {
            loop {
                let before = self.waiting.len();
                for waiting in std::mem::take(&mut self.waiting) {
                    if !self.meet(&waiting, force)? {
                        self.waiting.push(waiting);
                    }
                }
                if self.waiting.len() == before {
                    break;
                }
            }
        }
        // An index that nothing else decides is a `usize` in Rust and a `u32` here.
        for index in std::mem::take(&mut self.indices) {
            if self.table.term(index) == Term::Integer {
                let number = self.scalar(ScalarType::U32);
                self.table.unify(number, index, "an index")?;
            }
        }
        Ok(())
    }

    /// Whether enough was known to meet the demand.
    fn meet(&mut self, waiting: &Waiting, force: bool) -> Result<bool, Problem> {
        match *waiting {
            Waiting::Arithmetic { left, right, result } => self.arithmetic(left, right, result, force),
            Waiting::Component { of, lane, result } => match self.table.term(of) {
                Term::Vector(scalar, lanes) if lane < lanes => {
                    self.table.unify(scalar, result, "a component")?;
                    Ok(true)
                }
                Term::Any => Ok(false),
                _ => Err(Problem::unsupported("a component", "the value is no vector with that many lanes")),
            },
            Waiting::Element { of, result } => match self.table.term(of) {
                Term::Array(element, _) => {
                    self.table.unify(element, result, "an element")?;
                    Ok(true)
                }
                Term::Any => Ok(false),
                _ => Err(Problem::unsupported("an index in brackets", "the value is no array")),
            },
            Waiting::ScalarOf { of, result } => match self.table.term(of) {
                Term::Vector(scalar, _) => {
                    self.table.unify(scalar, result, "a method of vectors")?;
                    Ok(true)
                }
                Term::Any => Ok(false),
                _ => Err(Problem::unsupported("a method of vectors", "the value is no vector")),
            },
        }
    }

    fn arithmetic(
        &mut self,
        left: Variable,
        right: Variable,
        result: Variable,
        force: bool,
    ) -> Result<bool, Problem> {
        let construct = "an operator";
        let (left_term, right_term) = (self.table.term(left), self.table.term(right));
        match (left_term, right_term) {
            (Term::Vector(..), Term::Vector(..)) => {
                self.table.unify(left, right, construct)?;
                self.table.unify(left, result, construct)?;
            }
            (Term::Vector(scalar, _), single) if single.is_single() => {
                self.table.unify(scalar, right, construct)?;
                self.table.unify(left, result, construct)?;
            }
            (single, Term::Vector(scalar, _)) if single.is_single() => {
                self.table.unify(scalar, left, construct)?;
                self.table.unify(right, result, construct)?;
            }
            (one, other) if force || (one.is_single() && other.is_single()) => {
                self.table.unify(left, right, construct)?;
                self.table.unify(left, result, construct)?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}
