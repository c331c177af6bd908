//! Loops over others within a radius that only add numbers of pairs to values of the item or to local sums. A
//! kernel computes these numbers before the rest of the body, for many pairs at a time.

use super::company::return_condition;
use super::local_sums::LocalSum;
use super::mates::{Condition, skip_condition};
use super::plain::is_same_for_all;
use crate::access::{GroupOf, Uses};
use crate::ast::{
    Arm, Block, Builtin, Expression, Function, FunctionKind, Loop, LoopKind, Place, PlaceRoot, Reach,
    Statement,
};
use proc_macro2::Ident;
use syn::BinOp;

/// A loop that only adds.
pub(super) struct Sums<'a> {
    /// The conditions under which an item returns before the loop.
    pub(super) returns: Vec<&'a Expression>,
    pub(super) variable: &'a Ident,
    pub(super) reach: Reach,
    pub(super) radius: &'a Expression,
    /// The conditions of a turn.
    pub(super) conditions: Vec<Condition<'a>>,
    /// The statements of a turn.
    pub(super) turn: Vec<&'a Statement>,
    /// The local sums that stand before the loop.
    pub(super) locals: Vec<LocalSum<'a>>,
}

/// A body, split into the loops at its beginning that only add, and all other statements.
pub(super) struct Split<'a> {
    pub(super) sums: Vec<Sums<'a>>,
    /// The local sums to which these loops add.
    pub(super) locals: Vec<LocalSum<'a>>,
    pub(super) rest: Vec<&'a Statement>,
    /// Whether the rest does nothing.
    pub(super) is_done: bool,
}

impl<'a> Split<'a> {
    pub(super) fn of(function: &'a Function, uses: &Uses) -> Self {
        let Block { statements, value } = &function.body;
        // An item whose values go to a second buffer must be copied there first.
        let copies = uses.accesses.iter().any(|access| access.write && access.others);
        let (mut sums, mut rest, mut returns): (Vec<Sums<'_>>, _, _) = (Vec::new(), Vec::new(), Vec::new());
        let mut locals: Vec<LocalSum<'_>> = Vec::new();
        let mut remaining = statements.iter();
        if function.kind == FunctionKind::Items && value.is_none() && !copies {
            while let Some(statement) = remaining.as_slice().first() {
                if let Some(condition) =
                    return_condition(statement).filter(|value| is_of_pair(value, None, &[], uses))
                {
                    returns.push(condition);
                    rest.push(statement);
                } else if let Some(local) = LocalSum::of(statement, &locals) {
                    locals.push(local);
                    rest.push(statement);
                } else if let Some(loop_) = Sums::of(statement, &returns, &locals, uses) {
                    sums.push(loop_);
                } else {
                    break;
                }
                remaining.next();
            }
        }
        let is_done = !sums.is_empty() && remaining.len() == 0;
        rest.extend(remaining);
        locals.retain(|local| sums.iter().any(|sums| sums.adds_to(local.name)));
        rest.retain(|statement| !locals.iter().any(|local| std::ptr::eq(local.statement, *statement)));
        Self { sums, locals, rest, is_done }
    }
}

impl<'a> Sums<'a> {
    fn of(
        statement: &'a Statement,
        returns: &[&'a Expression],
        locals: &[LocalSum<'a>],
        uses: &Uses,
    ) -> Option<Self> {
        let Statement::Loop(Loop { kind, body, .. }) = statement else { return None };
        let LoopKind::Others { variable, reach, radius: Some(radius) } = kind else { return None };
        let mut conditions = Vec::new();
        let turn = turn(body, &mut conditions)?;
        let is_of_pair = |value| is_of_pair(value, Some(variable), locals, uses);
        let is_local = |name: &Ident| locals.iter().any(|local| local.name == name);
        let mut added = Vec::new();
        for statement in &turn {
            let value = match statement {
                // Another variable with the name of a sum hides it.
                Statement::Let { name, .. } if is_local(name) => return None,
                Statement::LetTuple { parts, .. }
                    if parts.iter().filter_map(|part| part.name.as_ref()).any(is_local) =>
                {
                    return None;
                }
                Statement::Let { value, .. } | Statement::LetTuple { value, .. } => value,
                Statement::Assign { place, operator: Some(BinOp::Add(_) | BinOp::Sub(_)), value, .. } => {
                    let Place { root, path } = place;
                    let is_known = match root {
                        PlaceRoot::Own(_) => true,
                        PlaceRoot::Local(name) => is_local(name),
                    };
                    // Numbers are added place by place, so each place can be in one sum only.
                    if !is_known || !path.is_empty() || added.contains(&root) {
                        return None;
                    }
                    added.push(root);
                    value
                }
                _ => return None,
            };
            if !is_of_pair(value) {
                return None;
            }
        }
        let is_known = !is_local(variable)
            && is_same_for_all(radius)
            && conditions.iter().all(|condition: &Condition<'_>| is_of_pair(condition.expression));
        (is_known && !added.is_empty()).then_some(Self {
            returns: returns.to_vec(),
            variable,
            reach: *reach,
            radius,
            conditions,
            turn,
            locals: locals.to_vec(),
        })
    }

    /// Whether the loop adds to this local sum.
    pub(super) fn adds_to(&self, name: &Ident) -> bool {
        self.turn.iter().any(|statement| match statement {
            Statement::Assign { place: Place { root: PlaceRoot::Local(local), .. }, .. } => local == name,
            _ => false,
        })
    }
}

/// The statements of a turn, without the conditions around and before them.
fn turn<'a>(body: &'a Block, conditions: &mut Vec<Condition<'a>>) -> Option<Vec<&'a Statement>> {
    let mut statements = body.statements.as_slice();
    while let [first, rest @ ..] = statements
        && let Some(expression) = skip_condition(first)
    {
        conditions.push(Condition { expression, value: false });
        statements = rest;
    }
    let only = match (statements, body.value.as_deref()) {
        ([], Some(only)) | ([Statement::Expression(only)], None) => only,
        (_, None) => return Some(statements.iter().collect()),
        _ => return None,
    };
    let Expression::If { condition, then, otherwise: None, .. } = only else { return None };
    conditions.push(Condition { expression: condition, value: true });
    turn(then, conditions)
}

/// Whether a number depends only on the values of the item and of this other that the process does not
/// write, and on what is the same for all items. Not on local sums.
fn is_of_pair(number: &Expression, other: Option<&Ident>, locals: &[LocalSum<'_>], uses: &Uses) -> bool {
    let is_of_pair = |number: &Expression| is_of_pair(number, other, locals, uses);
    let is_of_block = |block: &Block| {
        let is_plain = |statement: &Statement| match statement {
            Statement::Let { value, .. } | Statement::LetTuple { value, .. } => is_of_pair(value),
            _ => false,
        };
        block.statements.iter().all(is_plain) && block.value.iter().all(|value| is_of_pair(value))
    };
    let is_plain = match number {
        Expression::Own(field) => {
            let is_written = |access: &&crate::access::Access| access.write && access.field == *field;
            let mut of_item = uses.accesses.iter().filter(|access| access.group == GroupOf::SUBJECT);
            !of_item.any(|access| is_written(&access))
        }
        Expression::Other { name, .. } => other == Some(name),
        Expression::Local(name) => !locals.iter().any(|local| local.name == name),
        Expression::Builtin(builtin, ..) => {
            use Builtin::{Extents, NearestImage, Side, Wrapped};
            matches!(builtin, Side | Extents | NearestImage | Wrapped)
        }
        Expression::If { then, otherwise, .. } => is_of_block(then) && otherwise.iter().all(is_of_block),
        Expression::Match { arms, .. } => arms.iter().all(|Arm { guard, body, .. }| {
            guard.iter().all(is_of_pair) && is_of_block(body)
        }),
        Expression::Block(block) => is_of_block(block),
        Expression::OfCell { .. }
        | Expression::Neighbour { .. }
        | Expression::NamedNeighbour { .. }
        | Expression::OtherLabel(_)
        // An array is read from memory where one element is wanted.
        | Expression::Element(..) => false,
        _ => true,
    };
    is_plain && number.parts().into_iter().all(is_of_pair)
}
