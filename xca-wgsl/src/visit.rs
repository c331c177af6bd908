//! Goes through all statements and expressions of a body.

use xca_core::ir::{Block, Expression, Pattern, Place, Projection, Statement};

/// Something met on the way.
pub(crate) enum Node<'a> {
    Statement(&'a Statement),
    Expression(&'a Expression),
}

/// Shows each statement and expression of the block to `see`, outer ones before inner ones, in the order of the source.
/// Where it answers `false`, what is inside is left out.
pub(crate) fn block<'a>(block: &'a Block, see: &mut dyn FnMut(Node<'a>) -> bool) {
    for statement in &block.statements {
        self::statement(statement, see);
    }
    if let Some(value) = &block.value {
        expression(value, see);
    }
}

fn statement<'a>(statement: &'a Statement, see: &mut dyn FnMut(Node<'a>) -> bool) {
    if !see(Node::Statement(statement)) {
        return;
    }
    match statement {
        Statement::Let { value, .. } | Statement::Expression(value) => expression(value, see),
        Statement::LetNeighbour { index, .. } => expression(index, see),
        Statement::Assign { place, value, .. } => {
            self::place(place, see);
            expression(value, see);
        }
        Statement::While { condition, body } => {
            expression(condition, see);
            block(body, see);
        }
        Statement::Loop { body } | Statement::ForItems { body, .. } => block(body, see),
        Statement::ForRange { from, to, body, .. } => {
            expression(from, see);
            expression(to, see);
            block(body, see);
        }
        Statement::ForOthers { radius, body, .. } => {
            if let Some(radius) = radius {
                expression(radius, see);
            }
            block(body, see);
        }
        Statement::Return(value) => {
            if let Some(value) = value {
                expression(value, see);
            }
        }
        Statement::Fault { code, value } => {
            expression(code, see);
            expression(value, see);
        }
        Statement::Break | Statement::Continue => {}
    }
}

fn place<'a>(place: &'a Place, see: &mut dyn FnMut(Node<'a>) -> bool) {
    for projection in &place.path {
        if let Projection::Element(index) = projection {
            expression(index, see);
        }
    }
}

/// As [`block`], of one expression.
pub(crate) fn expression<'a>(value: &'a Expression, see: &mut dyn FnMut(Node<'a>) -> bool) {
    if !see(Node::Expression(value)) {
        return;
    }
    match value {
        Expression::Neighbour { index: operand, .. }
        | Expression::Unary(_, operand)
        | Expression::Cast(operand, _)
        | Expression::Component(operand, _)
        | Expression::Repeat(operand, _)
        | Expression::Splat(operand, _) => expression(operand, see),
        Expression::Binary(_, left, right) | Expression::Element(left, right) => {
            expression(left, see);
            expression(right, see);
        }
        Expression::Builtin(_, operands)
        | Expression::Array(operands)
        | Expression::Vector(operands)
        | Expression::Call { arguments: operands, .. } => {
            for operand in operands {
                expression(operand, see);
            }
        }
        Expression::Method { receiver, arguments, .. } => {
            expression(receiver, see);
            for argument in arguments {
                expression(argument, see);
            }
        }
        Expression::If { condition, then, otherwise } => {
            expression(condition, see);
            block(then, see);
            if let Some(otherwise) = otherwise {
                block(otherwise, see);
            }
        }
        Expression::Match { value, arms } => {
            expression(value, see);
            for arm in arms {
                for pattern in &arm.patterns {
                    match pattern {
                        Pattern::Any => {}
                        Pattern::Value(value) => expression(value, see),
                        Pattern::Range(from, to) => {
                            expression(from, see);
                            expression(to, see);
                        }
                    }
                }
                if let Some(guard) = &arm.guard {
                    expression(guard, see);
                }
                block(&arm.body, see);
            }
        }
        Expression::Block(inner) => block(inner, see),
        Expression::Literal(_)
        | Expression::Local(_)
        | Expression::Constant { .. }
        | Expression::Own(_)
        | Expression::OfCell { .. }
        | Expression::NamedNeighbour { .. }
        | Expression::Other { .. }
        | Expression::OtherLabel(_)
        | Expression::Parameter { .. }
        | Expression::Parameters(_)
        | Expression::Space => {}
    }
}

/// Whether control never reaches the end of the block.
pub(crate) fn diverges(block: &Block) -> bool {
    block.statements.iter().any(statement_diverges) || block.value.as_deref().is_some_and(expression_diverges)
}

fn statement_diverges(statement: &Statement) -> bool {
    match statement {
        Statement::Break | Statement::Continue | Statement::Return(_) => true,
        Statement::Expression(value) => expression_diverges(value),
        Statement::Loop { body } => !breaks(body),
        _ => false,
    }
}

/// Whether control never comes back from the expression.
pub(crate) fn expression_diverges(value: &Expression) -> bool {
    match value {
        Expression::If { then, otherwise: Some(otherwise), .. } => diverges(then) && diverges(otherwise),
        Expression::Match { arms, .. } => !arms.is_empty() && arms.iter().all(|arm| diverges(&arm.body)),
        Expression::Block(inner) => diverges(inner),
        _ => false,
    }
}

/// Whether the block has a `break` that ends the loop whose body it is.
pub(crate) fn breaks(block: &Block) -> bool {
    has_of_this_loop(block, |statement| matches!(statement, Statement::Break))
}

/// Whether the block has a `continue` of the loop whose body it is.
pub(crate) fn continues(block: &Block) -> bool {
    has_of_this_loop(block, |statement| matches!(statement, Statement::Continue))
}

fn has_of_this_loop(block: &Block, wanted: impl Fn(&Statement) -> bool) -> bool {
    let mut found = false;
    self::block(block, &mut |node| {
        found |= matches!(&node, Node::Statement(statement) if wanted(statement));
        !matches!(
            node,
            Node::Statement(
                Statement::While { .. }
                    | Statement::Loop { .. }
                    | Statement::ForRange { .. }
                    | Statement::ForOthers { .. }
                    | Statement::ForItems { .. }
            )
        )
    });
    found
}
