//! The types in statements.

use super::Inference;
use super::table::{Term, Variable};
use crate::error::Problem;
use crate::types::Type;
use crate::visit;
use xca_core::ScalarType;
use xca_core::ir::{Block, Expression, Loop, LoopKind, Place, PlaceRoot, Projection, Statement};

impl<'a> Inference<'a> {
    /// The type of the block's value: anything where control does not reach its end.
    pub(super) fn block(&mut self, block: &'a Block) -> Result<Variable, Problem> {
        self.scoped(|inference| {
            for statement in &block.statements {
                inference.statement(statement)?;
            }
            match &block.value {
                Some(value) => inference.expression(value),
                None if visit::diverges(block) => Ok(inference.table.variable(Term::Any)),
                None => Ok(inference.table.variable(Term::Unit)),
            }
        })
    }

    fn statement(&mut self, statement: &'a Statement) -> Result<(), Problem> {
        match statement {
            Statement::Let { name, mutable, type_, value } => {
                let found = self.expression(value)?;
                let variable = match type_ {
                    Some(written) => {
                        let written = self.table.known(&Type::from(written));
                        self.table.unify(written, found, &format!("`let {name}`"))?;
                        written
                    }
                    None => found,
                };
                let number = self.bind(name, variable, *mutable);
                self.bindings.insert(&raw const *statement, number);
            }
            Statement::LetTuple { parts, type_, value } => {
                let found = self.expression(value)?;
                let variables: Vec<Variable> = parts.iter().map(|_| self.table.variable(Term::Any)).collect();
                let tuple = self.table.tuple(&variables);
                self.table.unify(tuple, found, "`let` with a tuple")?;
                if let Some(written) = type_ {
                    let written = self.table.known(&Type::from(written));
                    self.table.unify(written, tuple, "`let` with a tuple")?;
                }
                for (part, variable) in parts.iter().zip(variables) {
                    if let Some(name) = part.name {
                        let number = self.bind(name, variable, part.mutable);
                        self.parts.insert(&raw const *part, number);
                    }
                }
            }
            Statement::LetNeighbour { name, index } => {
                self.expect(index, ScalarType::U32, "the index of a neighbour")?;
                self.bind_number(statement, name);
            }
            Statement::Assign { place, operator, value } => {
                let found = self.expression(value)?;
                let target = self.place(place)?;
                match operator {
                    None => self.table.unify(target, found, "an assignment")?,
                    Some(operator) => {
                        let result = self.binary(*operator, target, found)?;
                        self.table.unify(target, result, "an assignment")?;
                    }
                }
            }
            Statement::Expression(value) => {
                self.expression(value)?;
            }
            Statement::Loop(loop_) => self.loop_(statement, loop_)?,
            Statement::Break(_) | Statement::Continue(_) => {}
            Statement::Return(value) => {
                let found = match value {
                    Some(value) => self.expression(value)?,
                    None => self.table.variable(Term::Unit),
                };
                self.table.unify(self.result, found, "`return`")?;
            }
            Statement::Fault { code, value } => {
                self.expect(code, ScalarType::U32, "the code of a fault")?;
                self.expect(value, ScalarType::Real, "the value of a fault")?;
            }
        }
        Ok(())
    }

    fn loop_(&mut self, statement: &'a Statement, loop_: &'a Loop) -> Result<(), Problem> {
        let (variable, type_) = match &loop_.kind {
            LoopKind::While(condition) => {
                self.condition(condition)?;
                return self.block(&loop_.body).map(|_| ());
            }
            LoopKind::Forever => return self.block(&loop_.body).map(|_| ()),
            LoopKind::Range { variable, range } => {
                let counter = self.expression(&range.from)?;
                let end = self.expression(&range.to)?;
                self.table.unify(counter, end, "a range")?;
                if let Some(step) = &range.step {
                    self.expect(step, ScalarType::U32, "the step of a range")?;
                }
                (variable, counter)
            }
            LoopKind::Elements { variable, array } => {
                let array = self.expression(array)?;
                (variable, self.element_of(array)?)
            }
            LoopKind::Others { variable, radius, .. } => {
                if let Some(radius) = radius {
                    self.expect(radius, ScalarType::Real, "the radius of a search")?;
                }
                (variable, self.scalar(ScalarType::U32))
            }
            LoopKind::Items { variable } => (variable, self.scalar(ScalarType::U32)),
        };
        self.scoped(|inference| {
            let number = inference.bind(variable, type_, false);
            inference.bindings.insert(&raw const *statement, number);
            inference.block(&loop_.body).map(|_| ())
        })
    }

    /// Binds a name that stands for a cell: its number.
    fn bind_number(&mut self, statement: &'a Statement, name: &'static str) {
        let variable = self.scalar(ScalarType::U32);
        let number = self.bind(name, variable, false);
        self.bindings.insert(&raw const *statement, number);
    }

    fn place(&mut self, place: &'a Place) -> Result<Variable, Problem> {
        let mut variable = match &place.root {
            PlaceRoot::Local(name) => {
                let number = self.look_up(name)?;
                self.place_roots.insert(&raw const *place, number);
                self.locals[number.0].0
            }
            PlaceRoot::Own(name) => self.substate(0, name)?,
        };
        for projection in &place.path {
            variable = match projection {
                Projection::Component(lane) => self.component(variable, *lane)?,
                Projection::Element(index) => {
                    let index = self.expression(index)?;
                    self.element(variable, index)?
                }
            };
        }
        self.place_types.insert(&raw const *place, variable);
        Ok(variable)
    }

    /// An expression that must have this type.
    pub(super) fn expect(
        &mut self,
        value: &'a Expression,
        scalar: ScalarType,
        construct: &str,
    ) -> Result<(), Problem> {
        let found = self.expression(value)?;
        let expected = self.scalar(scalar);
        self.table.unify(expected, found, construct)
    }

    pub(super) fn condition(&mut self, value: &'a Expression) -> Result<(), Problem> {
        let found = self.expression(value)?;
        let expected = self.table.variable(Term::Bool);
        self.table.unify(expected, found, "a condition")
    }
}
