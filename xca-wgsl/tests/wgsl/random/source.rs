//! What is chosen at random: types, literals, variables.

use super::state::{GROUND, NAMES, PLACE, SCALARS, path, table};
use xca_core::ScalarType;
use xca_core::ir::{BinaryOperator, Builtin, Constant, Expression, Literal, Type};

/// A source of senseless code.
pub(super) struct Source {
    state: u64,
    pub(super) scopes: Vec<Vec<(&'static str, Type, bool)>>,
    /// The loops around the present place, with their labels.
    pub(super) loops: Vec<Option<&'static str>>,
}

pub(super) fn is_float(type_: &Type) -> bool {
    matches!(type_, Type::Scalar(ScalarType::F32 | ScalarType::F64 | ScalarType::Real))
}

pub(super) fn boxed_type(type_: &Type) -> Box<Type> {
    Box::new(type_.clone())
}

pub(super) fn boxed(value: Expression) -> Box<Expression> {
    Box::new(value)
}

impl Source {
    pub(super) fn new(seed: u64) -> Self {
        Self { state: seed, scopes: vec![Vec::new()], loops: Vec::new() }
    }

    pub(super) fn below(&mut self, end: usize) -> usize {
        self.state =
            self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 33) as usize % end
    }

    pub(super) fn any_type(&mut self) -> Type {
        match self.below(12) {
            0 => Type::Bool,
            1 => PLACE,
            2 => table(),
            3 => GROUND,
            4 => path(),
            _ => self.scalar(),
        }
    }

    pub(super) fn scalar(&mut self) -> Type {
        Type::Scalar(SCALARS[self.below(6)].0)
    }

    pub(super) fn integer(&mut self) -> Type {
        Type::Scalar(SCALARS[self.below(3)].0)
    }

    pub(super) fn literal(&mut self, type_: &Type) -> Expression {
        match type_ {
            Type::Bool => Expression::Literal(Literal::Bool(self.below(2) == 0)),
            Type::Scalar(scalar) => {
                let suffix = (self.below(2) == 0 && *scalar != ScalarType::Real).then_some(*scalar);
                Expression::Literal(if is_float(type_) {
                    Literal::Float(["0.0", "1.5", "3e30", "1e-3"][self.below(4)], suffix)
                } else {
                    Literal::Integer([0, 1, 7, 127][self.below(4)], suffix)
                })
            }
            Type::Vector(scalar, lanes) => {
                Expression::Splat(boxed(self.literal(&Type::Scalar(*scalar))), *lanes)
            }
            Type::Tuple(parts) => Expression::Tuple(parts.iter().map(|part| self.literal(part)).collect()),
            Type::Array(element, length) => Expression::Repeat(boxed(self.literal(element)), *length),
            Type::State(names) => {
                let number = self.below(names.states.len());
                let value = Constant::State(number as u8, names);
                Expression::Constant {
                    name: ["Ground::Rock", "Ground::Soil", "Ground::Water"][number],
                    value,
                }
            }
            Type::Destination => Expression::Builtin(Builtin::Stay, Vec::new()),
        }
    }

    /// A substate of this type, if there is one.
    pub(super) fn field(type_: &Type) -> Option<&'static str> {
        match type_ {
            Type::Bool => Some("truth"),
            Type::State(_) => Some("ground"),
            Type::Scalar(scalar) => {
                SCALARS.iter().find(|(known, _)| known == scalar).map(|(_, field)| *field)
            }
            Type::Vector(..) if *type_ == PLACE => Some("place"),
            Type::Array(..) if *type_ == table() => Some("table"),
            Type::Array(..) if *type_ == path() => Some("path"),
            _ => None,
        }
    }

    /// An index that may be anything.
    pub(super) fn index(&mut self, depth: usize) -> Expression {
        let number = boxed(self.expression(&Type::Scalar(ScalarType::U32), depth));
        match self.below(3) {
            0 => Expression::Literal(Literal::Integer(self.below(2) as u64, None)),
            1 => Expression::Binary(
                BinaryOperator::Remainder,
                number,
                boxed(Expression::Literal(Literal::Integer(2, None))),
            ),
            _ => *number,
        }
    }

    /// A variable of this type that is not hidden by another.
    pub(super) fn variable(&mut self, type_: &Type, mutable: bool) -> Option<&'static str> {
        let start = self.below(NAMES.len());
        let names = NAMES.iter().cycle().skip(start).take(NAMES.len());
        names.copied().find(|name| {
            let seen = self.scopes.iter().rev().flat_map(|scope| scope.iter().rev());
            let mut of_name = seen.filter(|(known, ..)| known == name);
            of_name.next().is_some_and(|(_, known, can_change)| known == type_ && (*can_change || !mutable))
        })
    }

    pub(super) fn leaf(&mut self, type_: &Type) -> Expression {
        match self.below(3) {
            0 => self.literal(type_),
            1 => match self.variable(type_, false) {
                Some(name) => Expression::Local(name),
                None => self.own(type_),
            },
            _ => self.own(type_),
        }
    }

    pub(super) fn own(&mut self, type_: &Type) -> Expression {
        let Some(field) = Self::field(type_) else { return self.literal(type_) };
        let index = Box::new(Expression::Literal(Literal::Integer(self.below(9) as u64, None)));
        match self.below(3) {
            0 => Expression::Neighbour { argument: 0, index, field },
            _ => Expression::Own(field),
        }
    }
}
