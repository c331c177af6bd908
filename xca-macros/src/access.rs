//! Which substates a body reads and writes, and where.

use crate::ast::{
    ArgumentNumber, Block, Builtin, Expression, Function, LoopKind, Place, PlaceRoot, Reach, Role, Statement,
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
#[derive(Default)]
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
        let mut uses = Self::default();
        uses.block(&function.body);
        uses
    }

    /// What expressions use.
    pub(crate) fn of_expressions<'a>(expressions: impl Iterator<Item = &'a Expression>) -> Self {
        let mut uses = Self::default();
        expressions.for_each(|expression| uses.expression(expression));
        uses
    }

    /// What statements use.
    pub(crate) fn of_statements(statements: &[&Statement]) -> Self {
        let mut uses = Self::default();
        statements.iter().for_each(|statement| uses.statement(statement));
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
        block.statements.iter().for_each(|statement| self.statement(statement));
        block.value.iter().for_each(|value| self.expression(value));
    }

    fn statement(&mut self, statement: &Statement) {
        statement.parts().into_iter().for_each(|part| self.expression(part));
        match statement {
            Statement::LetNeighbour { .. } => self.neighbours = true,
            Statement::Assign { place, operator, .. } => self.place(place, operator.is_some()),
            Statement::Loop(loop_) => {
                self.loop_kind(&loop_.kind);
                self.block(&loop_.body);
            }
            _ => {}
        }
    }

    fn loop_kind(&mut self, kind: &LoopKind) {
        kind.parts().into_iter().for_each(|part| self.expression(part));
        if let LoopKind::Others { variable, reach, radius } = kind {
            self.neighbours |= *reach != Reach::Cell;
            if radius.is_some() {
                let position = Ident::new("position", variable.span());
                let access = self.entry(&position, GroupOf::Position);
                access.centre = true;
                access.others = true;
            }
        }
    }

    fn place(&mut self, place: &Place, compound: bool) {
        if let PlaceRoot::Own(field) = &place.root {
            let partial = !place.path.is_empty();
            let access = self.entry(field, GroupOf::SUBJECT);
            access.write = true;
            access.centre |= compound || partial;
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
            Expression::Neighbour { argument, field, .. } => {
                self.neighbours = true;
                self.entry(field, GroupOf::Argument(*argument)).others = true;
            }
            Expression::Builtin(builtin, ..) => {
                self.opposites |= *builtin == Builtin::Opposite;
                self.step |= matches!(builtin, Builtin::Random | Builtin::RandomBits | Builtin::Step);
                self.directions |=
                    matches!(builtin, Builtin::Opposite | Builtin::Displacement | Builtin::Exists);
                self.neighbours |= self.directions || *builtin == Builtin::NeighbourCount;
            }
            _ => {}
        }
        expression.parts().into_iter().for_each(|part| self.expression(part));
        match expression {
            Expression::If { then, otherwise, .. } => {
                self.block(then);
                otherwise.iter().for_each(|otherwise| self.block(otherwise));
            }
            Expression::Match { arms, .. } => {
                for arm in arms {
                    arm.guard.iter().for_each(|guard| self.expression(guard));
                    self.block(&arm.body);
                }
            }
            Expression::Block(block) => self.block(block),
            _ => {}
        }
    }
}

/// The structs of substates that a process takes, by their numbers.
pub(crate) fn structs(function: &Function) -> impl Iterator<Item = &Role> {
    let roles = function.arguments.iter().map(|argument| &argument.role);
    roles.filter(|role| matches!(role, Role::Cell(_) | Role::Slot(_) | Role::Slots(_)))
}
