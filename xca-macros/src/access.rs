//! Which substates a body reads and writes, and where.

use crate::ast::{
    ArgumentNumber, Block, Builtin, Expression, Function, LoopKind, Place, PlaceRoot, Projection, Reach,
    Role, Statement,
};
use syn::Ident;

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
    /// Of the struct with this number.
    Argument(ArgumentNumber),
    /// The substate marked `#[position]` of the subject, as a search reads it.
    Position,
}

impl GroupOf {
    /// Of the cell or item that the process runs for.
    pub(crate) const SUBJECT: Self = Self::Argument(ArgumentNumber::SUBJECT);

    /// The number of the struct.
    pub(crate) fn argument(self) -> ArgumentNumber {
        match self {
            Self::Argument(number) => number,
            Self::Position => ArgumentNumber::SUBJECT,
        }
    }
}

/// Everything that a body uses.
pub(crate) struct Uses {
    pub(crate) accesses: Vec<Access>,
    /// Whether cells of the neighbourhood, or their items, are looked at.
    pub(crate) neighbours: bool,
    /// Whether it is asked where neighbours lie: their displacements, opposites, whether they exist.
    pub(crate) directions: bool,
    /// Whether opposites are asked for.
    pub(crate) opposites: bool,
    /// Whether random numbers or the number of the step are asked for.
    pub(crate) step: bool,
}

impl Uses {
    pub(crate) fn of(function: &Function) -> Self {
        let mut uses = Self {
            accesses: Vec::new(),
            neighbours: false,
            directions: false,
            opposites: false,
            step: false,
        };
        uses.block(&function.body);
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

    fn block(&mut self, block: &Block) {
        for statement in &block.statements {
            self.statement(statement);
        }
        if let Some(value) = &block.value {
            self.expression(value);
        }
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Let { value, .. }
            | Statement::LetTuple { value, .. }
            | Statement::Expression(value) => self.expression(value),
            Statement::LetNeighbour { index, .. } => {
                self.neighbours = true;
                self.expression(index);
            }
            Statement::Assign { place, operator, value, .. } => {
                self.expression(value);
                self.place(place, operator.is_some());
            }
            Statement::Loop(loop_) => {
                self.loop_kind(&loop_.kind);
                self.block(&loop_.body);
            }
            Statement::Break(..) | Statement::Continue(..) => {}
            Statement::Return(value, _) => {
                if let Some(value) = value {
                    self.expression(value);
                }
            }
            Statement::Fault { code, value } => {
                self.expression(code);
                self.expression(value);
            }
        }
    }

    fn loop_kind(&mut self, kind: &LoopKind) {
        match kind {
            LoopKind::While(condition) => self.expression(condition),
            LoopKind::Range { range, .. } => {
                self.expression(&range.from);
                self.expression(&range.to);
                if let Some(step) = &range.step {
                    self.expression(step);
                }
            }
            LoopKind::Elements { array, .. } => self.expression(array),
            LoopKind::Others { variable, reach, radius } => {
                self.neighbours |= *reach != Reach::Cell;
                if let Some(radius) = radius {
                    self.expression(radius);
                    let position = Ident::new("position", variable.span());
                    let access = self.entry(&position, GroupOf::Position);
                    access.centre = true;
                    access.others = true;
                }
            }
            LoopKind::Forever | LoopKind::Items { .. } => {}
        }
    }

    fn place(&mut self, place: &Place, compound: bool) {
        if let PlaceRoot::Own(field) = &place.root {
            let partial = !place.path.is_empty();
            let access = self.entry(field, GroupOf::SUBJECT);
            access.write = true;
            access.centre |= compound || partial;
        }
        for projection in &place.path {
            if let Projection::Element(index) = projection {
                self.expression(index);
            }
        }
    }

    fn expression(&mut self, expression: &Expression) {
        match expression {
            Expression::Own(field) => self.entry(field, GroupOf::SUBJECT).centre = true,
            Expression::OfCell { argument, field } => {
                self.entry(field, GroupOf::Argument(*argument)).centre = true;
            }
            Expression::NamedNeighbour { argument, field, .. }
            | Expression::Other { argument, field, .. } => {
                self.entry(field, GroupOf::Argument(*argument)).others = true;
            }
            Expression::Neighbour { argument, index, field } => {
                self.neighbours = true;
                self.entry(field, GroupOf::Argument(*argument)).others = true;
                self.expression(index);
            }
            Expression::Builtin(builtin, arguments, _) => {
                self.opposites |= *builtin == Builtin::Opposite;
                self.step |= matches!(builtin, Builtin::Random | Builtin::RandomBits | Builtin::Step);
                self.directions |=
                    matches!(builtin, Builtin::Opposite | Builtin::Displacement | Builtin::Exists);
                self.neighbours |= self.directions || *builtin == Builtin::NeighbourCount;
                arguments.iter().for_each(|argument| self.expression(argument));
            }
            Expression::Unary(_, value) | Expression::Cast(value, _) | Expression::Repeat(value, _) => {
                self.expression(value);
            }
            Expression::Component(value, _) | Expression::Splat(_, value) => {
                self.expression(value);
            }
            Expression::Binary(_, left, right) | Expression::Element(left, right) => {
                self.expression(left);
                self.expression(right);
            }
            Expression::Call { arguments, .. }
            | Expression::Array(arguments, _)
            | Expression::Tuple(arguments, _)
            | Expression::Vector(_, arguments) => {
                arguments.iter().for_each(|argument| self.expression(argument));
            }
            Expression::Method { receiver, arguments, .. } => {
                self.expression(receiver);
                arguments.iter().for_each(|argument| self.expression(argument));
            }
            Expression::If { condition, then, otherwise, .. } => {
                self.expression(condition);
                self.block(then);
                if let Some(otherwise) = otherwise {
                    self.block(otherwise);
                }
            }
            Expression::Match { value, arms, .. } => {
                self.expression(value);
                for arm in arms {
                    if let Some(guard) = &arm.guard {
                        self.expression(guard);
                    }
                    self.block(&arm.body);
                }
            }
            Expression::Block(block) => self.block(block),
            Expression::Bool(_)
            | Expression::Integer(_)
            | Expression::Float(_)
            | Expression::Local(_)
            | Expression::Constant(_)
            | Expression::OtherLabel(_)
            | Expression::Parameter { .. }
            | Expression::Parameters(_)
            | Expression::Space(_) => {}
        }
    }
}

/// The structs of substates that a process takes, by their numbers.
pub(crate) fn structs(function: &Function) -> impl Iterator<Item = &Role> {
    let roles = function.arguments.iter().map(|argument| &argument.role);
    roles.filter(|role| matches!(role, Role::Cell(_) | Role::Slot(_) | Role::Slots(_)))
}
