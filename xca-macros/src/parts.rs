//! The direct parts of statements, loops and expressions.

use crate::ast::{Expression, LoopKind, Projection, Range, Statement};

impl Expression {
    /// The expressions that this one is made of, in order, without those in its blocks and arms.
    pub(crate) fn parts(&self) -> Vec<&Expression> {
        match self {
            Self::Neighbour { index: value, .. }
            | Self::Unary(_, value)
            | Self::Cast(value, _)
            | Self::Repeat(value, _)
            | Self::Component(value, _)
            | Self::Splat(_, value)
            | Self::If { condition: value, .. }
            | Self::Match { value, .. } => vec![value],
            Self::Binary(_, left, right) | Self::Element(left, right) => vec![left, right],
            Self::Builtin(_, values, _)
            | Self::Call { arguments: values, .. }
            | Self::Array(values, _)
            | Self::Tuple(values, _)
            | Self::Vector(_, values) => values.iter().collect(),
            Self::Method { receiver, arguments, .. } => {
                std::iter::once(&**receiver).chain(arguments).collect()
            }
            Self::Block(_)
            | Self::Own(_)
            | Self::OfCell { .. }
            | Self::NamedNeighbour { .. }
            | Self::Other { .. }
            | Self::Bool(_)
            | Self::Integer(_)
            | Self::Float(_)
            | Self::Local(_)
            | Self::Constant(_)
            | Self::OtherLabel(_)
            | Self::Parameter { .. }
            | Self::Parameters(_)
            | Self::Space(_) => Vec::new(),
        }
    }
}

impl LoopKind {
    /// The expressions of the head of a loop, in order.
    pub(crate) fn parts(&self) -> Vec<&Expression> {
        match self {
            Self::While(value) | Self::Elements { array: value, .. } => vec![value],
            Self::Range { range: Range { from, to, step, .. }, .. } => {
                [from, to].into_iter().chain(step).collect()
            }
            Self::Others { radius, .. } => radius.iter().collect(),
            Self::Forever | Self::Items { .. } => Vec::new(),
        }
    }
}

impl Statement {
    /// The expressions of a statement, in order, without those of a loop.
    pub(crate) fn parts(&self) -> Vec<&Expression> {
        match self {
            Self::Let { value, .. }
            | Self::LetTuple { value, .. }
            | Self::LetNeighbour { index: value, .. }
            | Self::Expression(value) => vec![value],
            Self::Assign { place, value, .. } => {
                let indices = place.path.iter().filter_map(|projection| match projection {
                    Projection::Element(index) => Some(index),
                    Projection::Component(_) => None,
                });
                std::iter::once(value).chain(indices).collect()
            }
            Self::Return(value, _) => value.iter().collect(),
            Self::Fault { code, value } => vec![code, value],
            Self::Loop(_) | Self::Break(..) | Self::Continue(..) => Vec::new(),
        }
    }
}
