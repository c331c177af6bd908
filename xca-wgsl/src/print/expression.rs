//! Expressions. What WGSL has no expression for (an `if` with a value, a block) is computed in statements
//! before.

use super::text::{Level, Text};
use super::writer::{Target, Writer, zero};
use crate::constant::constant_text;
use crate::error::Problem;
use crate::types::{self, Type};
use crate::visit::{self, Node};
use crate::{literal, names};
use xca_core::ScalarType;
use xca_core::ir::{BinaryOperator, Block, Builtin, Constant, Expression, Role, UnaryOperator};
use xca_core::kernel::{OUTSIDE, STAY};

const LANES: [&str; 4] = ["x", "y", "z", "w"];

impl Writer<'_, '_> {
    pub(super) fn expression(&mut self, value: &Expression) -> Result<Text, Problem> {
        match value {
            Expression::Literal(literal) => {
                let type_ = self.type_of(value);
                let text = literal::literal(literal, &type_, self.shared.options)?;
                Ok(self.number(text))
            }
            Expression::Constant { name, value } => {
                let text = self.constant(name, value)?;
                Ok(self.number(text))
            }
            Expression::Local(_) => Ok(Text::primary(self.local(self.analysis.local(value)?)?)),
            Expression::Own(name) => Ok(Text::primary(self.own(name)?)),
            Expression::OfCell { argument, field } => {
                let variable = self.shared.glossary.central(*argument)?;
                Ok(Text::primary(format!("{variable}.{}", names::field(field))))
            }
            Expression::Neighbour { argument, index, field } => {
                let number = self.neighbour(index)?;
                self.value_of(*argument, field, number.plain())
            }
            Expression::NamedNeighbour { argument, field, .. }
            | Expression::Other { argument, field, .. } => {
                let name = self.local(self.analysis.local(value)?)?;
                self.value_of(*argument, field, &name)
            }
            Expression::OtherLabel(_) => {
                let name = self.local(self.analysis.local(value)?)?;
                Ok(Text::primary(format!("item_labels[{name}]")))
            }
            Expression::Parameter { argument, field } => {
                let text = self.parameter(argument, field)?;
                Ok(Text::primary(match self.type_of(value) {
                    Type::Bool => types::loaded(ScalarType::Bool, &text),
                    Type::Array(element, length) if *element == Type::Bool => {
                        format!("{}({text})", self.shared.routines.need_truths(length))
                    }
                    _ => text,
                }))
            }
            Expression::Parameters(_) | Expression::Space => Err(Problem::unsupported(
                "the parameters or the space as a value",
                "they can only be passed on to a helper",
            )),
            Expression::Builtin(builtin, arguments) => self.builtin(*builtin, arguments),
            Expression::Unary(operator, operand) => self.unary(*operator, operand),
            Expression::Binary(operator @ (BinaryOperator::And | BinaryOperator::Or), left, right) => {
                self.logical(*operator, left, right)
            }
            Expression::Binary(operator, left, right) => self.binary(*operator, left, right),
            Expression::Cast(operand, target) => self.cast(operand, &Type::from(target)),
            Expression::Call { function, arguments } => {
                let number = self.shared.program.helper(*function);
                let number = number.ok_or_else(|| Problem::unknown("helper", "?"))?;
                let program = self.shared.program;
                let roles = program.functions[number].arguments.iter().map(|argument| &argument.role);
                let values: Vec<&Expression> = arguments
                    .iter()
                    .zip(roles)
                    .filter_map(|(value, role)| matches!(role, Role::Value(_)).then_some(value))
                    .collect();
                let texts = self.operands(&values)?;
                let name = &self.shared.glossary.functions[number];
                Ok(Text::primary(format!("{name}({})", list(&texts))))
            }
            Expression::Method { method, receiver, arguments } => self.method(*method, receiver, arguments),
            Expression::Component(operand, lane) => {
                let operand = self.expression(operand)?.at_least(Level::Primary);
                Ok(Text::primary(format!("{operand}.{}", self.lane(*lane)?)))
            }
            Expression::Element(array, index) => self.element(array, index),
            Expression::Array(elements) => {
                let values: Vec<&Expression> = elements.iter().collect();
                self.constructor(value, &values)
            }
            Expression::Tuple(parts) => {
                let values: Vec<&Expression> = parts.iter().collect();
                self.constructor(value, &values)
            }
            Expression::Vector(components) => {
                let values: Vec<&Expression> = components.iter().collect();
                self.constructor(value, &values)
            }
            Expression::Splat(component, _) => self.constructor(value, &[&**component]),
            Expression::Repeat(element, length) => self.repeat(value, element, *length),
            Expression::If { condition, then, otherwise: Some(otherwise) }
                if let Some((one, other)) = self.selectable(value, then, otherwise) =>
            {
                let (one, other) = (self.expression(one)?.argument(), self.expression(other)?.argument());
                let condition = self.expression(condition)?.argument();
                Ok(Text::primary(format!("select({other}, {one}, {condition})")))
            }
            Expression::Block(Block { statements, value: Some(inner) }) if statements.is_empty() => {
                self.expression(inner)
            }
            Expression::If { .. } | Expression::Match { .. } | Expression::Block(_) => {
                let type_ = self.type_of(value);
                self.check_type(&type_)?;
                if type_ == Type::Unit {
                    return Err(Problem::unsupported("a block without a value", "a value is needed here"));
                }
                let name = self.shared.names.local("value");
                self.line(&format!("var {name}: {};", type_.wgsl()));
                self.value_into(value, Target::Variable(&name))?;
                Ok(Text::primary(name))
            }
        }
    }

    /// Several values, computed from the first to the last: where a later one needs statements that could
    /// change an earlier one, the earlier one is kept.
    pub(super) fn operands(&mut self, values: &[&Expression]) -> Result<Vec<Text>, Problem> {
        let mut texts = Vec::new();
        for (position, value) in values.iter().enumerate() {
            let mut text = self.expression(value)?;
            let hoists = values[position + 1..].iter().any(|later| self.hoists(later));
            if hoists && (!self.stable(value) || self.may_stop(value)) {
                let type_ = self.type_of(value);
                text = self.keep("operand", &type_, &text);
            }
            texts.push(text);
        }
        Ok(texts)
    }

    /// Whether the expression needs statements of its own.
    pub(super) fn hoists(&self, value: &Expression) -> bool {
        let mut found = false;
        visit::expression(value, &mut |node| {
            if let Node::Expression(inner) = node {
                found |= match inner {
                    Expression::If { then, otherwise: Some(otherwise), .. } => {
                        self.selectable(inner, then, otherwise).is_none()
                    }
                    Expression::Block(block) => !block.statements.is_empty() || block.value.is_none(),
                    Expression::If { .. } | Expression::Match { .. } => true,
                    _ => false,
                };
            }
            !found
        });
        found
    }

    /// Whether no statement of the process can change the value.
    pub(super) fn stable(&self, value: &Expression) -> bool {
        let mut stable = true;
        visit::expression(value, &mut |node| {
            if let Node::Expression(inner) = node {
                stable &= match inner {
                    Expression::Own(_) => false,
                    Expression::Local(_) => {
                        self.analysis.local(inner).is_ok_and(|local| !self.analysis.locals[local.0].mutable)
                    }
                    _ => true,
                };
            }
            stable
        });
        stable
    }

    /// The two values of an `if` that may as well both be computed.
    fn selectable<'e>(
        &self,
        whole: &Expression,
        then: &'e Block,
        otherwise: &'e Block,
    ) -> Option<(&'e Expression, &'e Expression)> {
        let of = self.analysis.type_of(whole);
        if !matches!(of, Type::Bool | Type::Scalar(_) | Type::Vector(..) | Type::State(_)) {
            return None;
        }
        let simple = |block: &'e Block| match &block.value {
            Some(value) if block.statements.is_empty() && is_simple(value) => Some(&**value),
            _ => None,
        };
        Some((simple(then)?, simple(otherwise)?))
    }

    fn constant(&self, name: &str, value: &Constant) -> Result<String, Problem> {
        match self.shared.glossary.constant(name, value) {
            Some(known) => Ok(known.to_owned()),
            None => constant_text(name, value, self.shared.options),
        }
    }

    fn number(&mut self, text: String) -> Text {
        self.shared.routines.need_infinities(&text);
        Text::number(text)
    }

    pub(super) fn own(&self, name: &str) -> Result<String, Problem> {
        Ok(format!("{}.{}", self.shared.glossary.central(0)?, names::field(name)))
    }

    /// A parameter as it lies in memory. A helper has its own name for the struct.
    pub(super) fn parameter(&self, argument: &str, field: &str) -> Result<String, Problem> {
        let schema = self.roles.parameters(argument)?;
        Ok(format!("{}.{}", self.shared.glossary.parameters(schema)?, names::field(field)))
    }

    /// A substate of the cell or item with this number, as it was before the process.
    pub(super) fn value_of(&self, argument: usize, field: &str, number: &str) -> Result<Text, Problem> {
        Ok(Text::primary(self.shared.glossary.buffer(argument, field)?.read(number)))
    }

    fn unary(&mut self, operator: UnaryOperator, operand: &Expression) -> Result<Text, Problem> {
        let type_ = self.type_of(operand);
        if let (
            UnaryOperator::Negate,
            Expression::Literal(xca_core::ir::Literal::Integer(value, _)),
            Type::Scalar(scalar),
        ) = (operator, operand, &type_)
        {
            return Ok(Text::number(literal::integer(-i128::from(*value), *scalar)?));
        }
        let text = self.expression(operand)?;
        Ok(match (operator, &type_) {
            (UnaryOperator::Negate, _) => text.negated(),
            (UnaryOperator::Not, Type::Bool) => text.inverted("!"),
            (UnaryOperator::Not, type_) => self.wrapped(text.inverted("~"), type_),
        })
    }

    fn builtin(&mut self, builtin: Builtin, arguments: &[Expression]) -> Result<Text, Problem> {
        if let (Builtin::Opposite | Builtin::Displacement | Builtin::Exists, [index]) = (builtin, arguments) {
            return self.direction(builtin, index);
        }
        let values: Vec<&Expression> = arguments.iter().collect();
        let arguments = list(&self.operands(&values)?);
        Ok(Text::primary(match builtin {
            Builtin::NeighbourCount => self.shared.glossary.neighbours.clone(),
            Builtin::Opposite | Builtin::Displacement | Builtin::Exists => {
                return Err(Problem::unsupported("a neighbour", "the number of arguments is wrong"));
            }
            Builtin::Index => "here_index".to_owned(),
            Builtin::Label => "item_labels[this_item]".to_owned(),
            Builtin::Random => format!("random_real({arguments})"),
            Builtin::RandomBits => format!("random_bits({arguments})"),
            Builtin::Side => "space.side".to_owned(),
            Builtin::Extents => "space.extents".to_owned(),
            Builtin::Step => "moment.step.x".to_owned(),
            Builtin::NearestImage => {
                self.shared.routines.nearest_image = true;
                format!("nearest_image({arguments})")
            }
            Builtin::Wrapped => {
                self.shared.routines.wrapped = true;
                format!("wrapped({arguments})")
            }
            Builtin::CellContaining => {
                self.shared.routines.cell_containing = true;
                format!("cell_containing({arguments})")
            }
            Builtin::Stay => format!("{STAY:#x}u"),
            Builtin::Outside => format!("{OUTSIDE:#x}u"),
        }))
    }

    fn constructor(&mut self, whole: &Expression, values: &[&Expression]) -> Result<Text, Problem> {
        let type_ = self.type_of(whole);
        self.check_type(&type_)?;
        let texts = self.operands(values)?;
        Ok(Text::primary(format!("{}({})", type_.wgsl(), list(&texts))))
    }

    fn repeat(&mut self, whole: &Expression, element: &Expression, length: usize) -> Result<Text, Problem> {
        let type_ = self.type_of(whole);
        self.check_type(&type_)?;
        let text = self.expression(element)?;
        if matches!(text.plain(), "false" | "0u" | "0i" | "0.0f" | "0.0lf") {
            return Ok(Text::primary(zero(&type_)));
        }
        let routine = self.shared.routines.need_repeat(&self.type_of(element), length);
        Ok(Text::primary(format!("{routine}({})", text.plain())))
    }

    pub(super) fn lane(&self, lane: u8) -> Result<&'static str, Problem> {
        LANES
            .get(usize::from(lane))
            .copied()
            .ok_or_else(|| Problem::unsupported("a component", "there are x, y, z and w"))
    }
}

/// Arguments, separated by commas.
pub(super) fn list(texts: &[Text]) -> String {
    match texts {
        [only] => only.plain().to_owned(),
        several => several.iter().map(Text::argument).collect::<Vec<_>>().join(", "),
    }
}

/// Whether computing the value costs nothing.
pub(super) fn is_simple(value: &Expression) -> bool {
    match value {
        Expression::Literal(_)
        | Expression::Constant { .. }
        | Expression::Local(_)
        | Expression::Own(_)
        | Expression::OfCell { .. }
        | Expression::Parameter { .. }
        | Expression::Builtin(
            Builtin::NeighbourCount | Builtin::Side | Builtin::Extents | Builtin::Stay | Builtin::Outside,
            _,
        ) => true,
        Expression::Unary(_, operand) | Expression::Component(operand, _) => is_simple(operand),
        _ => false,
    }
}
