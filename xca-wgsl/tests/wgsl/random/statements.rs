//! Statements, blocks and matches at random.

use super::source::{Source, boxed, boxed_type};
use super::state::{NAMES, PLACE};
use xca_core::ScalarType;
use xca_core::ir::{
    Arm, BinaryOperator, Block, Expression, Literal, Loop, LoopKind, Pattern, Place, PlaceRoot, Projection,
    Range, Statement, Type,
};

impl Source {
    pub(super) fn match_(&mut self, type_: Option<&Type>, depth: usize) -> Expression {
        let matched = self.integer();
        let value = boxed(self.expression(&matched, depth));
        let literal = |value| Expression::Literal(Literal::Integer(value, None));
        let mut arms = Vec::new();
        for patterns in [
            vec![Pattern::Value(literal(3))],
            vec![Pattern::Range(literal(4), literal(9)), Pattern::Value(literal(0))],
            vec![Pattern::Any],
            vec![Pattern::Any],
        ] {
            let last = arms.len() == 3;
            let guard = (!last && self.below(2) == 0).then(|| self.expression(&Type::Bool, depth));
            arms.push(Arm { patterns, guard, body: self.block_or_leave(type_, depth, !last) });
        }
        Expression::Match { value, arms }
    }

    pub(super) fn block(&mut self, value: Option<&Type>, depth: usize) -> Block {
        self.block_or_leave(value, depth, false)
    }

    pub(super) fn block_or_leave(&mut self, value: Option<&Type>, depth: usize, may_leave: bool) -> Block {
        self.scopes.push(Vec::new());
        let count = self.below(3);
        let statements = (0..count).map(|_| self.statement(depth)).collect();
        let value = match value {
            Some(_) if may_leave && self.below(8) == 0 => {
                // Control may leave instead of giving a value.
                let leave = self.leave();
                self.scopes.pop();
                let mut statements: Vec<Statement> = statements;
                statements.push(leave);
                return Block { statements, value: None };
            }
            Some(type_) => Some(boxed(self.expression(type_, depth))),
            None => None,
        };
        self.scopes.pop();
        Block { statements, value }
    }

    pub(super) fn statement(&mut self, depth: usize) -> Statement {
        if depth == 0 {
            return self.assignment(0);
        }
        let next = depth - 1;
        match self.below(9) {
            0..=2 => {
                let type_ = self.any_type();
                let value = self.expression(&type_, next);
                let (name, mutable) = (NAMES[self.below(NAMES.len())], self.below(2) == 0);
                // The type is written where the value might not decide it.
                let written = Some(type_.clone());
                if let Some(scope) = self.scopes.last_mut() {
                    scope.push((name, type_, mutable));
                }
                Statement::Let { name, mutable, type_: written, value }
            }
            3 => {
                let condition = boxed(self.expression(&Type::Bool, next));
                let otherwise = (self.below(2) == 0).then(|| self.block(None, next));
                Statement::Expression(Expression::If { condition, then: self.block(None, next), otherwise })
            }
            4 => Statement::Expression(self.match_(None, next)),
            5 => {
                // The condition cannot leave the loop around it.
                let loops = std::mem::take(&mut self.loops);
                let condition = self.expression(&Type::Bool, next);
                self.loops = loops;
                self.loop_(LoopKind::While(condition), next)
            }
            6 => {
                let counter = self.integer();
                let (from, to) = (self.expression(&counter, next), self.expression(&counter, next));
                let (variable, inclusive) = (NAMES[self.below(NAMES.len())], self.below(2) == 0);
                let step = (self.below(3) == 0).then(|| self.expression(&Type::Scalar(ScalarType::U32), 0));
                self.scopes.push(vec![(variable, counter, false)]);
                let reversed = self.below(3) == 0;
                let range = Range { from, to, inclusive, reversed, step };
                let loop_ = self.loop_(LoopKind::Range { variable, range }, next);
                self.scopes.pop();
                loop_
            }
            7 if self.below(2) == 0 => {
                let element = self.scalar();
                let array = self.expression(&Type::Array(boxed_type(&element), 3), next);
                let variable = NAMES[self.below(NAMES.len())];
                self.scopes.push(vec![(variable, element, false)]);
                let loop_ = self.loop_(LoopKind::Elements { variable, array }, next);
                self.scopes.pop();
                loop_
            }
            7 => Statement::Fault {
                code: self.expression(&Type::Scalar(ScalarType::U32), next),
                value: self.expression(&Type::Scalar(ScalarType::Real), next),
            },
            _ => self.assignment(next),
        }
    }

    pub(super) fn loop_(&mut self, kind: LoopKind, depth: usize) -> Statement {
        const LABELS: [&str; 6] = ["outer", "second", "third", "fourth", "fifth", "sixth"];
        let label = LABELS.get(self.loops.len()).copied().filter(|_| self.below(2) == 0);
        self.loops.push(label);
        let body = self.block(None, depth);
        self.loops.pop();
        Statement::Loop(Loop { label, kind, body })
    }

    /// Leaves a block: for a loop around it, or the function.
    pub(super) fn leave(&mut self) -> Statement {
        if self.loops.is_empty() {
            return Statement::Return(None);
        }
        let labels: Vec<&'static str> = self.loops.iter().flatten().copied().collect();
        let label = match labels.len() {
            0 => None,
            count => Some(labels[self.below(count)]).filter(|_| self.below(3) > 0),
        };
        if self.below(2) == 0 { Statement::Break(label) } else { Statement::Continue(label) }
    }

    pub(super) fn assignment(&mut self, depth: usize) -> Statement {
        let type_ = self.any_type();
        let root = match self.variable(&type_, true) {
            Some(name) => PlaceRoot::Local(name),
            None => PlaceRoot::Own(Self::field(&type_).unwrap_or("place")),
        };
        let (mut type_, mut path) = (type_, Vec::new());
        if type_ == PLACE && self.below(2) == 0 {
            path.push(Projection::Component(self.below(3) as u8));
            type_ = Type::Scalar(ScalarType::Real);
        } else if let Type::Array(element, _) = &type_ {
            type_ = (**element).clone();
            path.push(Projection::Element(self.index(depth)));
        }
        let numeric = matches!(type_, Type::Scalar(_));
        let operator = (numeric && self.below(2) == 0).then(|| {
            [BinaryOperator::Add, BinaryOperator::Subtract, BinaryOperator::Multiply][self.below(3)]
        });
        let value = self.expression(&type_, depth);
        Statement::Assign { place: Place { root, path }, operator, value }
    }
}
