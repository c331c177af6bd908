//! Refuses a process that takes the same random number twice.

use crate::ast::{Arm, Block, Builtin, Expression, Statement};
use proc_macro2::Span;
use syn::{Error, Result};

/// Refuses a literal number of a draw that stands twice where one of the two draws always runs if the other
/// does: twice in one block, or in a block and in a branch within or after it. Other pairs can be of cells or
/// items that take different ways.
pub(super) fn check(body: &Block) -> Result<()> {
    let mut draws = Draws::default();
    draws.block(body);
    let taken = |number: &u32| draws.taken.iter().any(|draw| draw.number == *number);
    let errors = draws.twice.iter().map(|again| {
        let free = (0..).find(|number| !taken(number)).unwrap_or_default();
        let Draw { number, span, .. } = again;
        Error::new(
            *span,
            format!(
                "draw {number} is used twice in this process and gives the same number both times; use \
                 another, such as {free}, or keep the number in a variable"
            ),
        )
    });
    let all = errors.reduce(|mut all, error| {
        all.combine(error);
        all
    });
    all.map_or(Ok(()), Err)
}

/// A draw with a literal number.
#[derive(Clone)]
struct Draw {
    number: u32,
    /// The branches in which it stands, from the outermost.
    branches: Vec<u32>,
    span: Span,
}

#[derive(Default)]
struct Draws {
    /// The branches in which the walk is.
    branches: Vec<u32>,
    /// How many branches there were.
    count: u32,
    /// How many statements there were that leave the process or a loop.
    exits: u32,
    taken: Vec<Draw>,
    twice: Vec<Draw>,
}

impl Draws {
    /// Walks through what some cells or items skip.
    fn branch(&mut self, walk: impl FnOnce(&mut Self)) {
        let depth = self.branches.len();
        self.enter();
        walk(self);
        self.branches.truncate(depth);
    }

    fn enter(&mut self) {
        self.count += 1;
        self.branches.push(self.count);
    }

    fn block(&mut self, block: &Block) {
        let depth = self.branches.len();
        for statement in &block.statements {
            let exits = self.exits;
            self.statement(statement);
            if self.exits > exits {
                // The rest of the block is for those that are still there.
                self.enter();
            }
        }
        block.value.iter().for_each(|value| self.expression(value));
        self.branches.truncate(depth);
    }

    fn statement(&mut self, statement: &Statement) {
        statement.parts().into_iter().for_each(|part| self.expression(part));
        match statement {
            Statement::Loop(loop_) => self.branch(|draws| {
                loop_.kind.parts().into_iter().for_each(|part| draws.expression(part));
                draws.block(&loop_.body);
            }),
            Statement::Break(..)
            | Statement::Continue(..)
            | Statement::Return(..)
            | Statement::Fault { .. } => self.exits += 1,
            _ => {}
        }
    }

    fn take(&mut self, arguments: &[Expression]) {
        let [Expression::Integer(literal)] = arguments else { return };
        let Ok(number) = literal.base10_parse() else { return };
        let draw = Draw { number, branches: self.branches.clone(), span: literal.span() };
        let is_same = |other: &&Draw| {
            other.number == number
                && (draw.branches.starts_with(&other.branches) || other.branches.starts_with(&draw.branches))
        };
        if self.taken.iter().any(|other| is_same(&other)) {
            self.twice.push(draw.clone());
        }
        self.taken.push(draw);
    }

    fn expression(&mut self, expression: &Expression) {
        match expression {
            Expression::Builtin(Builtin::Random | Builtin::RandomBits, arguments, _) => self.take(arguments),
            // The second one may be skipped.
            Expression::Binary(syn::BinOp::And(_) | syn::BinOp::Or(_), left, right) => {
                self.expression(left);
                return self.branch(|draws| draws.expression(right));
            }
            _ => {}
        }
        expression.parts().into_iter().for_each(|part| self.expression(part));
        match expression {
            Expression::If { then, otherwise, .. } => {
                let blocks = [Some(then), otherwise.as_ref()].into_iter().flatten();
                blocks.for_each(|block| self.branch(|draws| draws.block(block)));
            }
            Expression::Match { arms, .. } => {
                for Arm { guard, body, .. } in arms {
                    self.branch(|draws| {
                        guard.iter().for_each(|guard| draws.expression(guard));
                        draws.block(body);
                    });
                }
            }
            Expression::Block(block) => self.block(block),
            _ => {}
        }
    }
}
