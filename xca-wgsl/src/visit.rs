//! Goes through all statements and expressions of a body.

use xca_core::ir::{Block, Expression, Loop, LoopKind, Pattern, Place, Projection, Statement};

/// Something met on the way.
pub(crate) enum Node<'a> {
    Statement(&'a Statement),
    Expression(&'a Expression),
}

/// Shows each statement and expression of the block to `see`, outer ones before inner ones, in the order of
/// the source. Where it answers `false`, what is inside is left out.
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
        Statement::Let { value, .. } | Statement::LetTuple { value, .. } | Statement::Expression(value) => {
            expression(value, see);
        }
        Statement::LetNeighbour { index, .. } => expression(index, see),
        Statement::Assign { place, value, .. } => {
            self::place(place, see);
            expression(value, see);
        }
        Statement::Loop(loop_) => {
            match &loop_.kind {
                LoopKind::While(value) | LoopKind::Elements { array: value, .. } => expression(value, see),
                LoopKind::Range { range, .. } => {
                    expression(&range.from, see);
                    expression(&range.to, see);
                    if let Some(step) = &range.step {
                        expression(step, see);
                    }
                }
                LoopKind::Others { radius: Some(radius), .. } => expression(radius, see),
                LoopKind::Others { radius: None, .. } | LoopKind::Forever | LoopKind::Items { .. } => {}
            }
            block(&loop_.body, see);
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
        Statement::Break(_) | Statement::Continue(_) => {}
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
        | Expression::Tuple(operands)
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
        Statement::Break(_) | Statement::Continue(_) | Statement::Return(_) => true,
        Statement::Expression(value) => expression_diverges(value),
        Statement::Loop(loop_) => matches!(loop_.kind, LoopKind::Forever) && !breaks(loop_),
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

/// Whether a `break` ends the loop, from within the loops in its body too.
pub(crate) fn breaks(loop_: &Loop) -> bool {
    let own = has_of_this_loop(&loop_.body, |statement| matches!(statement, Statement::Break(None)));
    own || labelled(&loop_.body).any(|jump| jump.is_break && Some(jump.label) == loop_.label)
}

/// Whether something leaves a turn of the loop early: for the next turn, for what follows the loop, or for a
/// loop around it.
pub(crate) fn turns_end_early(loop_: &Loop) -> bool {
    let own = |statement: &Statement| matches!(statement, Statement::Break(None) | Statement::Continue(None));
    has_of_this_loop(&loop_.body, own) || labelled(&loop_.body).any(|jump| !jump.stays)
}

/// Whether something in the body ends the loop: a `break`, or a jump to a loop around it.
pub(crate) fn ends_early(loop_: &Loop) -> bool {
    breaks(loop_) || labelled(&loop_.body).any(|jump| !jump.stays && Some(jump.label) != loop_.label)
}

/// Whether a loop in the body has a `break` that ends this loop, or a `continue` with its next turn.
pub(crate) fn jumps_from_within(loop_: &Loop, is_break: bool) -> bool {
    let mut found = false;
    block(&loop_.body, &mut |node| {
        if let Node::Statement(Statement::Loop(inner)) = node {
            found |= labelled(&inner.body)
                .any(|jump| jump.is_break == is_break && Some(jump.label) == loop_.label);
        }
        true
    });
    found
}

/// A `break` or `continue` with a label.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jump {
    pub(crate) label: &'static str,
    pub(crate) is_break: bool,
    /// Whether the loop that it goes to is in the block.
    pub(crate) stays: bool,
}

/// The jumps in a block that have a label.
pub(crate) fn labelled(block: &Block) -> impl Iterator<Item = Jump> {
    let mut labels = Vec::new();
    let mut jumps = Vec::new();
    self::block(block, &mut |node| {
        if let Node::Statement(statement) = node {
            match statement {
                Statement::Loop(loop_) => labels.extend(loop_.label),
                Statement::Break(Some(label)) => jumps.push((*label, true)),
                Statement::Continue(Some(label)) => jumps.push((*label, false)),
                _ => {}
            }
        }
        true
    });
    jumps.into_iter().map(move |(label, is_break)| Jump { label, is_break, stays: labels.contains(&label) })
}

fn has_of_this_loop(block: &Block, wanted: impl Fn(&Statement) -> bool) -> bool {
    let mut found = false;
    self::block(block, &mut |node| {
        found |= matches!(&node, Node::Statement(statement) if wanted(statement));
        !matches!(node, Node::Statement(Statement::Loop(_)))
    });
    found
}
