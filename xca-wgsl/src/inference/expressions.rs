//! The types in expressions.

use super::Inference;
use super::table::{Term, Variable};
use crate::error::Problem;
use crate::types::{Type, is_float};
use xca_core::ScalarType;
use xca_core::ir::{
    Arm, Builtin, Constant, Expression, Function, Literal, Operation, Pattern, Role, UnaryOperator,
};
use xca_methods::{Method, Outcome};

impl<'a> Inference<'a> {
    pub(super) fn expression(&mut self, value: &'a Expression) -> Result<Variable, Problem> {
        let variable = self.type_of(value)?;
        self.types.insert(&raw const *value, variable);
        Ok(variable)
    }

    fn type_of(&mut self, value: &'a Expression) -> Result<Variable, Problem> {
        Ok(match value {
            Expression::Literal(literal) => self.literal(literal),
            Expression::Local(name) => {
                let number = self.look_up(name)?;
                self.uses.insert(&raw const *value, number);
                self.locals[number.0].0
            }
            Expression::Constant { name, value } => {
                let type_ = constant(name, value)?;
                self.table.known(&type_)
            }
            Expression::Own(name) => self.substate(0, name)?,
            Expression::OfCell { argument, field } => self.substate(*argument, field)?,
            Expression::Neighbour { argument, index, field } => {
                self.expect(index, ScalarType::U32, "the index of a neighbour")?;
                self.substate(*argument, field)?
            }
            Expression::NamedNeighbour { argument, name, field }
            | Expression::Other { argument, name, field } => {
                let number = self.look_up(name)?;
                self.uses.insert(&raw const *value, number);
                self.substate(*argument, field)?
            }
            Expression::OtherLabel(name) => {
                let number = self.look_up(name)?;
                self.uses.insert(&raw const *value, number);
                self.scalar(ScalarType::U32)
            }
            Expression::Parameter { argument, field } => self.parameter(argument, field)?,
            Expression::Parameters(_) | Expression::Space => {
                return Err(Problem::unsupported(
                    "the parameters or the space as a value",
                    "they can only be passed on to a helper",
                ));
            }
            Expression::Builtin(builtin, arguments) => self.builtin(*builtin, arguments)?,
            Expression::Unary(operator, operand) => {
                let variable = self.expression(operand)?;
                if *operator == UnaryOperator::Negate && self.table.term(variable) == Term::Bool {
                    return Err(Problem::unsupported("`-` of a bool", "write `!`"));
                }
                variable
            }
            Expression::Binary(operator, left, right) => {
                let (left, right) = (self.expression(left)?, self.expression(right)?);
                self.binary(*operator, left, right)?
            }
            Expression::Cast(operand, target) => self.cast(operand, &Type::from(target))?,
            Expression::Call { function, arguments } => self.call(*function, arguments)?,
            Expression::Method { method, receiver, arguments } => {
                self.method(*method, receiver, arguments)?
            }
            Expression::Component(operand, lane) => {
                let of = self.expression(operand)?;
                self.component(of, *lane)?
            }
            Expression::Element(array, index) => {
                let (of, index) = (self.expression(array)?, self.expression(index)?);
                self.element(of, index)?
            }
            Expression::Array(elements) => {
                let element = self.same(elements, "the elements of an array")?;
                self.table.variable(Term::Array(element, elements.len()))
            }
            Expression::Tuple(parts) => {
                let parts: Vec<Variable> =
                    parts.iter().map(|part| self.expression(part)).collect::<Result<_, _>>()?;
                self.table.tuple(&parts)
            }
            Expression::Repeat(element, length) => {
                let element = self.expression(element)?;
                self.table.variable(Term::Array(element, *length))
            }
            Expression::Vector(components) => {
                let scalar = self.same(components, "the components of a vector")?;
                let lanes = lanes(components.len())?;
                self.table.variable(Term::Vector(scalar, lanes))
            }
            Expression::Splat(component, lanes) => {
                let scalar = self.expression(component)?;
                self.table.variable(Term::Vector(scalar, *lanes))
            }
            Expression::If { condition, then, otherwise } => {
                self.condition(condition)?;
                let then_type = self.block(then)?;
                let otherwise_type = match otherwise {
                    Some(otherwise) => self.block(otherwise)?,
                    None => self.table.variable(Term::Unit),
                };
                let result = self.table.variable(Term::Any);
                self.table.unify(result, then_type, "`if`")?;
                self.table.unify(result, otherwise_type, "`if`")?;
                result
            }
            Expression::Match { value, arms } => self.match_(value, arms)?,
            Expression::Block(block) => self.block(block)?,
        })
    }

    fn literal(&mut self, literal: &Literal) -> Variable {
        let term = match literal {
            Literal::Bool(_) => Term::Bool,
            Literal::Integer(_, Some(scalar)) | Literal::Float(_, Some(scalar)) => Term::Scalar(*scalar),
            Literal::Integer(_, None) => Term::Integer,
            Literal::Float(_, None) => Term::Float,
        };
        self.table.variable(term)
    }

    /// Expressions that have one type.
    fn same(&mut self, values: &'a [Expression], construct: &str) -> Result<Variable, Problem> {
        let common = self.table.variable(Term::Any);
        for value in values {
            let variable = self.expression(value)?;
            self.table.unify(common, variable, construct)?;
        }
        Ok(common)
    }

    fn builtin(&mut self, builtin: Builtin, arguments: &'a [Expression]) -> Result<Variable, Problem> {
        let argument_type = match builtin {
            Builtin::Random
            | Builtin::RandomBits
            | Builtin::Opposite
            | Builtin::Displacement
            | Builtin::Exists => Some(Type::U32),
            Builtin::NearestImage | Builtin::Wrapped | Builtin::CellContaining => {
                Some(Type::Vector(ScalarType::Real, 3))
            }
            _ => None,
        };
        for argument in arguments {
            let found = self.expression(argument)?;
            if let Some(expected) = &argument_type {
                let expected = self.table.known(expected);
                self.table.unify(expected, found, "an argument")?;
            }
        }
        let result = match builtin {
            Builtin::NeighbourCount
            | Builtin::Opposite
            | Builtin::Label
            | Builtin::RandomBits
            | Builtin::Step => Type::U32,
            Builtin::Exists => Type::Bool,
            Builtin::Index | Builtin::Extents | Builtin::Displacement => Type::Vector(ScalarType::I32, 3),
            Builtin::Random | Builtin::Side => Type::Scalar(ScalarType::Real),
            Builtin::NearestImage | Builtin::Wrapped => Type::Vector(ScalarType::Real, 3),
            Builtin::CellContaining | Builtin::Stay | Builtin::Outside => Type::Destination,
        };
        Ok(self.table.known(&result))
    }

    /// A literal that is cast takes the type of the cast where it can, as in Rust.
    fn cast(&mut self, operand: &'a Expression, target: &Type) -> Result<Variable, Problem> {
        let found = self.expression(operand)?;
        let target_variable = self.table.known(target);
        let mut bare = operand;
        let mut negated = false;
        while let Expression::Unary(operator, inner) = bare {
            negated |= *operator == UnaryOperator::Negate;
            bare = inner;
        }
        if let (Expression::Literal(_), Type::Scalar(scalar)) = (bare, target) {
            let fits = match self.table.term(found) {
                Term::Integer if negated => *scalar == ScalarType::I32,
                Term::Integer => !is_float(*scalar),
                Term::Float => is_float(*scalar),
                _ => false,
            };
            if fits {
                self.table.unify(target_variable, found, "a cast")?;
            }
        }
        Ok(target_variable)
    }

    fn call(&mut self, function: fn() -> Function, arguments: &'a [Expression]) -> Result<Variable, Problem> {
        let program = self.program;
        let number = program.helper(function).ok_or_else(|| Problem::unknown("helper", "?"))?;
        let helper = &program.functions[number];
        let construct = format!("an argument of `{}`", helper.name);
        if helper.arguments.len() != arguments.len() {
            return Err(Problem::unsupported(construct, "their number differs from the helper's"));
        }
        for (argument, value) in helper.arguments.iter().zip(arguments) {
            match (&argument.role, value) {
                (Role::Value(written), value) => {
                    let expected = self.table.known(&Type::from(written));
                    let found = self.expression(value)?;
                    self.table.unify(expected, found, &construct)?;
                }
                (Role::Parameters(schema), Expression::Parameters(name)) => {
                    if self.roles.parameters(name)? != *schema {
                        return Err(Problem::unsupported(
                            construct,
                            "it takes other parameters than the process",
                        ));
                    }
                }
                (Role::Space, Expression::Space) => {}
                _ => {
                    let reason = "a helper takes values, the parameters and the space";
                    return Err(Problem::unsupported(construct, reason));
                }
            }
        }
        Ok(self.table.known(&helper.result.as_ref().map_or(Type::Unit, Type::from)))
    }

    fn method(
        &mut self,
        method: Operation,
        receiver: &'a Expression,
        arguments: &'a [Expression],
    ) -> Result<Variable, Problem> {
        let of = self.expression(receiver)?;
        for argument in arguments {
            let found = self.expression(argument)?;
            self.table.unify(of, found, "an argument of a method")?;
        }
        match definition(method)?.result {
            Outcome::Same => Ok(of),
            Outcome::Truth => Ok(self.table.variable(Term::Bool)),
            Outcome::Count => Ok(self.scalar(ScalarType::U32)),
            Outcome::Lane => self.scalar_of(of),
        }
    }

    fn match_(&mut self, value: &'a Expression, arms: &'a [Arm]) -> Result<Variable, Problem> {
        let matched = self.expression(value)?;
        let result = self.table.variable(Term::Any);
        for arm in arms {
            for pattern in &arm.patterns {
                let ends = match pattern {
                    Pattern::Any => [None, None],
                    Pattern::Value(value) => [Some(value), None],
                    Pattern::Range(from, to) => [Some(from), Some(to)],
                };
                for end in ends.into_iter().flatten() {
                    let variable = self.expression(end)?;
                    self.table.unify(matched, variable, "a pattern")?;
                }
            }
            if let Some(guard) = &arm.guard {
                self.condition(guard)?;
            }
            let body = self.block(&arm.body)?;
            self.table.unify(result, body, "`match`")?;
        }
        Ok(result)
    }
}

/// What the list of methods says about an operation.
pub(crate) fn definition(operation: Operation) -> Result<&'static Method, Problem> {
    let unlisted = || Problem::unsupported(format!("{operation:?}"), "it is no method of the list");
    operation.method().ok_or_else(unlisted)
}

fn lanes(count: usize) -> Result<u8, Problem> {
    match count {
        2 => Ok(2),
        3 => Ok(3),
        4 => Ok(4),
        other => {
            Err(Problem::unsupported(format!("a vector of {other} components"), "vectors have 2, 3 or 4"))
        }
    }
}

/// The type of a constant.
pub(crate) fn constant(name: &str, value: &Constant) -> Result<Type, Problem> {
    let unsupported = |reason: &str| Problem::unsupported(format!("the constant `{name}`"), reason);
    Ok(match value {
        Constant::Bool(_) => Type::Bool,
        Constant::U8(_) => Type::Scalar(ScalarType::U8),
        Constant::I32(_) => Type::Scalar(ScalarType::I32),
        Constant::U32(_) => Type::Scalar(ScalarType::U32),
        Constant::F32(_) => Type::Scalar(ScalarType::F32),
        Constant::Real(_) => Type::Scalar(ScalarType::Real),
        Constant::State(_, names) => Type::State(names),
        Constant::Vector(lanes) => match lanes.first().map(|lane| constant(name, lane)).transpose()? {
            Some(Type::Scalar(scalar)) => Type::Vector(scalar, self::lanes(lanes.len())?),
            _ => return Err(unsupported("vectors are of numbers")),
        },
        Constant::Array(elements) => match elements.first() {
            Some(element) => Type::Array(Box::new(constant(name, element)?), elements.len()),
            None => return Err(unsupported("WGSL has no empty arrays")),
        },
    })
}
