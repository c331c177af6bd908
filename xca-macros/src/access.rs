//! Which substates a body reads and writes, and where.

use crate::ast::{
    Block, Expression, Function, FunctionKind, LoopKind, Place, PlaceRoot, Projection, Reach, Role, Statement,
};
use syn::{Ident, Type};

/// How a body uses one substate.
pub(crate) struct Access {
    pub(crate) field: Ident,
    pub(crate) group: GroupOf,
    pub(crate) centre: bool,
    pub(crate) others: bool,
    pub(crate) write: bool,
}

/// Whose substate.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum GroupOf {
    Subject,
    Companion,
    /// The substate marked `#[position]` of the subject, as a search reads it.
    Position,
}

/// Everything that a body uses.
pub(crate) struct Uses {
    pub(crate) accesses: Vec<Access>,
    /// Whether cells of the neighbourhood, or their items, are looked at.
    pub(crate) neighbours: bool,
}

impl Uses {
    pub(crate) fn of(function: &Function) -> Self {
        let mut uses = Self { accesses: Vec::new(), neighbours: false };
        let over_cells = function.kind == FunctionKind::Cells;
        uses.block(&function.body, over_cells);
        uses
    }

    fn entry(&mut self, field: &Ident, group: GroupOf) -> &mut Access {
        let known = self.accesses.iter().position(|access| access.group == group && access.field == *field);
        let index = known.unwrap_or_else(|| {
            self.accesses.push(Access {
                field: field.clone(),
                group,
                centre: false,
                others: false,
                write: false,
            });
            self.accesses.len() - 1
        });
        &mut self.accesses[index]
    }

    fn block(&mut self, block: &Block, over_cells: bool) {
        for statement in &block.statements {
            self.statement(statement, over_cells);
        }
        if let Some(value) = &block.value {
            self.expression(value, over_cells);
        }
    }

    fn statement(&mut self, statement: &Statement, over_cells: bool) {
        match statement {
            Statement::Let { value, .. }
            | Statement::LetTuple { value, .. }
            | Statement::Expression(value) => self.expression(value, over_cells),
            Statement::LetNeighbour { index, .. } => {
                self.neighbours = true;
                self.expression(index, over_cells);
            }
            Statement::Assign { place, operator, value, .. } => {
                self.expression(value, over_cells);
                self.place(place, operator.is_some(), over_cells);
            }
            Statement::Loop(loop_) => {
                self.loop_kind(&loop_.kind, over_cells);
                self.block(&loop_.body, over_cells);
            }
            Statement::Break(..) | Statement::Continue(..) => {}
            Statement::Return(value, _) => {
                if let Some(value) = value {
                    self.expression(value, over_cells);
                }
            }
            Statement::Fault { code, value } => {
                self.expression(code, over_cells);
                self.expression(value, over_cells);
            }
        }
    }

    fn loop_kind(&mut self, kind: &LoopKind, over_cells: bool) {
        match kind {
            LoopKind::While(condition) => self.expression(condition, over_cells),
            LoopKind::Range { range, .. } => {
                self.expression(&range.from, over_cells);
                self.expression(&range.to, over_cells);
                if let Some(step) = &range.step {
                    self.expression(step, over_cells);
                }
            }
            LoopKind::Elements { array, .. } => self.expression(array, over_cells),
            LoopKind::Others { variable, reach, radius } => {
                self.neighbours |= *reach != Reach::Cell;
                if let Some(radius) = radius {
                    self.expression(radius, over_cells);
                    let position = Ident::new("position", variable.span());
                    let access = self.entry(&position, GroupOf::Position);
                    access.centre = true;
                    access.others = true;
                }
            }
            LoopKind::Forever | LoopKind::Items { .. } => {}
        }
    }

    fn place(&mut self, place: &Place, compound: bool, over_cells: bool) {
        if let PlaceRoot::Own(field) = &place.root {
            let partial = !place.path.is_empty();
            let access = self.entry(field, GroupOf::Subject);
            access.write = true;
            access.centre |= compound || partial;
        }
        for projection in &place.path {
            if let Projection::Element(index) = projection {
                self.expression(index, over_cells);
            }
        }
    }

    fn expression(&mut self, expression: &Expression, over_cells: bool) {
        match expression {
            Expression::Own(field) => self.entry(field, GroupOf::Subject).centre = true,
            Expression::CellOfItem(field) => self.entry(field, GroupOf::Companion).centre = true,
            Expression::NamedNeighbour { field, .. } => self.entry(field, GroupOf::Subject).others = true,
            Expression::Neighbour { index, field } => {
                self.neighbours = true;
                self.entry(field, GroupOf::Subject).others = true;
                self.expression(index, over_cells);
            }
            Expression::Other { field, .. } => {
                // In a process over cells the other items are those of the cell.
                let group = if over_cells { GroupOf::Companion } else { GroupOf::Subject };
                self.entry(field, group).others = true;
            }
            Expression::Builtin(builtin, arguments, _) => {
                self.neighbours |= *builtin == crate::ast::Builtin::Neighbours;
                arguments.iter().for_each(|argument| self.expression(argument, over_cells));
            }
            Expression::Unary(_, value) | Expression::Cast(value, _) | Expression::Repeat(value, _) => {
                self.expression(value, over_cells);
            }
            Expression::Component(value, _) | Expression::Splat(_, value) => {
                self.expression(value, over_cells);
            }
            Expression::Binary(_, left, right) | Expression::Element(left, right) => {
                self.expression(left, over_cells);
                self.expression(right, over_cells);
            }
            Expression::Call { arguments, .. }
            | Expression::Array(arguments, _)
            | Expression::Tuple(arguments, _)
            | Expression::Vector(_, arguments) => {
                arguments.iter().for_each(|argument| self.expression(argument, over_cells));
            }
            Expression::Method { receiver, arguments, .. } => {
                self.expression(receiver, over_cells);
                arguments.iter().for_each(|argument| self.expression(argument, over_cells));
            }
            Expression::If { condition, then, otherwise, .. } => {
                self.expression(condition, over_cells);
                self.block(then, over_cells);
                if let Some(otherwise) = otherwise {
                    self.block(otherwise, over_cells);
                }
            }
            Expression::Match { value, arms, .. } => {
                self.expression(value, over_cells);
                for arm in arms {
                    if let Some(guard) = &arm.guard {
                        self.expression(guard, over_cells);
                    }
                    self.block(&arm.body, over_cells);
                }
            }
            Expression::Block(block) => self.block(block, over_cells),
            Expression::Bool(_)
            | Expression::Integer(_)
            | Expression::Float(_)
            | Expression::Local(_)
            | Expression::Constant(_)
            | Expression::OtherLabel(_)
            | Expression::Parameter(_)
            | Expression::Parameters(_)
            | Expression::Space(_) => {}
        }
    }
}

/// The struct of the subject and of the companion, where there is one.
pub(crate) fn groups(function: &Function) -> (Option<&Type>, Option<&Type>) {
    let mut subject = None;
    let mut companion = None;
    for (position, argument) in function.arguments.iter().enumerate() {
        match &argument.role {
            Role::Cell(type_) | Role::Slot(type_) if position == 0 => subject = Some(type_),
            Role::Cell(type_) | Role::Slot(type_) | Role::Slots(type_) => companion = Some(type_),
            _ => {}
        }
    }
    (subject, companion)
}
