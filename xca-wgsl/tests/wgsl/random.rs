//! Processes made at random: whatever is written must be accepted by naga.
//!
//! They are well typed but senseless, with blocks, branches and loops as values, shadowed names and mixed types everywhere.
//! The environment variable `SEEDS` says how many are made.

use crate::common::validate;
use xca_core::ir::{
    Argument, Arm, BinaryOperator, Block, Builtin, Constant, Expression, Function, FunctionKind, Literal,
    Loop, LoopKind, Operation, Pattern, Place, PlaceRoot, Projection, Range, Role, Statement, Type,
    UnaryOperator,
};
use xca_core::prelude::*;
use xca_core::{ScalarType, Schema};
use xca_wgsl::{Options, shader};

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Ground {
    Rock,
    Soil,
    Water,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct State {
    truth: bool,
    ground: Ground,
    table: [i32; 3],
    path: [Vector2<Real>; 2],
    byte: u8,
    signed: i32,
    unsigned: u32,
    single: f32,
    double: f64,
    real: Real,
    place: Vector3<Real>,
}

const SCHEMA: &Schema = State::SCHEMA;
const NAMES: [&str; 6] = ["a", "b", "cell", "end", "value", "operand"];
const SCALARS: [(ScalarType, &str); 6] = [
    (ScalarType::U8, "byte"),
    (ScalarType::I32, "signed"),
    (ScalarType::U32, "unsigned"),
    (ScalarType::F32, "single"),
    (ScalarType::F64, "double"),
    (ScalarType::Real, "real"),
];
const PLACE: Type = Type::Vector(ScalarType::Real, 3);
const PAIR: Type = Type::Vector(ScalarType::Real, 2);
const GROUND: Type = Type::State(Ground::NAMES);

fn table() -> Type {
    Type::Array(Box::new(Type::Scalar(ScalarType::I32)), 3)
}

fn path() -> Type {
    Type::Array(Box::new(PAIR), 2)
}

struct Source {
    state: u64,
    scopes: Vec<Vec<(&'static str, Type, bool)>>,
    /// The loops around the present place, with their labels.
    loops: Vec<Option<&'static str>>,
}

fn is_float(type_: &Type) -> bool {
    matches!(type_, Type::Scalar(ScalarType::F32 | ScalarType::F64 | ScalarType::Real))
}

fn boxed_type(type_: &Type) -> Box<Type> {
    Box::new(type_.clone())
}

fn boxed(value: Expression) -> Box<Expression> {
    Box::new(value)
}

impl Source {
    fn below(&mut self, end: usize) -> usize {
        self.state =
            self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 33) as usize % end
    }

    fn any_type(&mut self) -> Type {
        match self.below(12) {
            0 => Type::Bool,
            1 => PLACE,
            2 => table(),
            3 => GROUND,
            4 => path(),
            _ => self.scalar(),
        }
    }

    fn scalar(&mut self) -> Type {
        Type::Scalar(SCALARS[self.below(6)].0)
    }

    fn integer(&mut self) -> Type {
        Type::Scalar(SCALARS[self.below(3)].0)
    }

    fn literal(&mut self, type_: &Type) -> Expression {
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
    fn field(type_: &Type) -> Option<&'static str> {
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
    fn index(&mut self, depth: usize) -> Expression {
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
    fn variable(&mut self, type_: &Type, mutable: bool) -> Option<&'static str> {
        let start = self.below(NAMES.len());
        let names = NAMES.iter().cycle().skip(start).take(NAMES.len());
        names.copied().find(|name| {
            let seen = self.scopes.iter().rev().flat_map(|scope| scope.iter().rev());
            let mut of_name = seen.filter(|(known, ..)| known == name);
            of_name.next().is_some_and(|(_, known, can_change)| known == type_ && (*can_change || !mutable))
        })
    }

    fn leaf(&mut self, type_: &Type) -> Expression {
        match self.below(3) {
            0 => self.literal(type_),
            1 => match self.variable(type_, false) {
                Some(name) => Expression::Local(name),
                None => self.own(type_),
            },
            _ => self.own(type_),
        }
    }

    fn own(&mut self, type_: &Type) -> Expression {
        let Some(field) = Self::field(type_) else { return self.literal(type_) };
        let index = Box::new(Expression::Literal(Literal::Integer(self.below(9) as u64, None)));
        match self.below(3) {
            0 => Expression::Neighbour { argument: 0, index, field },
            _ => Expression::Own(field),
        }
    }

    fn expression(&mut self, type_: &Type, depth: usize) -> Expression {
        if depth == 0 {
            return self.leaf(type_);
        }
        let next = depth - 1;
        match (self.below(10), type_) {
            (0, _) => {
                let condition = boxed(self.expression(&Type::Bool, next));
                let then = self.block_or_leave(Some(type_), next, true);
                let otherwise = self.block(Some(type_), next);
                Expression::If { condition, then, otherwise: Some(otherwise) }
            }
            (1, _) => Expression::Block(self.block(Some(type_), next)),
            (2, _) => self.match_(Some(type_), next),
            (_, Type::Bool) => self.truth(next),
            (_, Type::State(_)) => self.own(type_),
            (_, Type::Vector(..)) if *type_ == PAIR => {
                let array = boxed(self.expression(&path(), next));
                Expression::Element(array, boxed(self.index(next)))
            }
            (3, Type::Array(..)) => self.own(type_),
            (_, Type::Vector(scalar, lanes)) => self.vector(*scalar, *lanes, next),
            (_, Type::Array(element, length)) => {
                Expression::Array((0..*length).map(|_| self.expression(element, next)).collect())
            }
            (3, Type::Scalar(scalar)) => {
                let from = self.scalar();
                Expression::Cast(boxed(self.expression(&from, next)), Type::Scalar(*scalar))
            }
            (4, Type::Scalar(ScalarType::Real)) => {
                Expression::Component(boxed(self.expression(&PLACE, next)), self.below(3) as u8)
            }
            (4, Type::Scalar(ScalarType::I32)) => {
                let array = boxed(self.expression(&table(), next));
                Expression::Element(array, boxed(self.index(next)))
            }
            (5, _) => self.method(type_, next),
            (6, _) if *type_ == Type::Scalar(ScalarType::I32) || is_float(type_) => {
                Expression::Unary(UnaryOperator::Negate, boxed(self.expression(type_, next)))
            }
            (6, _) => Expression::Unary(UnaryOperator::Not, boxed(self.expression(type_, next))),
            _ => self.arithmetic(type_, next),
        }
    }

    fn arithmetic(&mut self, type_: &Type, depth: usize) -> Expression {
        use BinaryOperator::{
            Add, BitAnd, BitOr, BitXor, Divide, Multiply, Remainder, ShiftLeft, ShiftRight, Subtract,
        };
        let left = boxed(self.expression(type_, depth));
        if is_float(type_) {
            let operator = [Add, Subtract, Multiply, Divide, Remainder][self.below(5)];
            return Expression::Binary(operator, left, boxed(self.expression(type_, depth)));
        }
        let operator =
            [Add, Subtract, Multiply, BitAnd, BitOr, BitXor, Divide, Remainder, ShiftLeft, ShiftRight]
                [self.below(10)];
        let right = match operator {
            // Rust itself refuses a division by a literal 0.
            Divide | Remainder if self.below(2) == 0 => self.own(type_),
            Divide | Remainder => Expression::Method {
                method: Operation::Max,
                receiver: boxed(self.own(type_)),
                arguments: vec![Expression::Literal(Literal::Integer(1, None))],
            },
            ShiftLeft | ShiftRight => {
                let places = self.integer();
                self.expression(&places, depth)
            }
            _ => self.expression(type_, depth),
        };
        Expression::Binary(operator, left, boxed(right))
    }

    fn method(&mut self, type_: &Type, depth: usize) -> Expression {
        use Operation::{
            Abs, Ceiling, Clamp, CopySign, DivideEuclid, Dot, Floor, Fraction, Max, Min, Reciprocal,
            RemainderEuclid, Round, Signum, SquareRoot, Truncate, WrappingAdd, WrappingMultiply,
        };
        if *type_ == Type::Scalar(ScalarType::Real) && self.below(2) == 0 {
            let (receiver, argument) =
                (boxed(self.expression(&PLACE, depth)), self.expression(&PLACE, depth));
            return match self.below(3) {
                0 => Expression::Method { method: Dot, receiver, arguments: vec![argument] },
                1 => Expression::Method { method: Operation::Length, receiver, arguments: Vec::new() },
                _ => Expression::Method { method: Operation::LengthSquared, receiver, arguments: Vec::new() },
            };
        }
        let method = if is_float(type_) {
            [
                Min,
                Max,
                Clamp,
                Abs,
                SquareRoot,
                Floor,
                Ceiling,
                Truncate,
                Round,
                Fraction,
                Signum,
                CopySign,
                Reciprocal,
                RemainderEuclid,
                DivideEuclid,
            ][self.below(15)]
        } else {
            [Min, Max, Clamp, WrappingAdd, WrappingMultiply][self.below(5)]
        };
        let count = method.method().map_or(0, |method| method.arguments.len());
        let receiver = boxed(self.expression(type_, depth));
        Expression::Method {
            method,
            receiver,
            arguments: (0..count).map(|_| self.expression(type_, depth)).collect(),
        }
    }

    fn truth(&mut self, depth: usize) -> Expression {
        use BinaryOperator::{And, BitAnd, BitXor, Equal, Greater, Less, NotEqual, Or};
        let (operator, of) = match self.below(6) {
            3 => ([Equal, NotEqual][self.below(2)], [table(), path()][self.below(2)].clone()),
            4 => ([Equal, NotEqual, Less][self.below(3)], GROUND),
            0 => ([And, Or, BitAnd, BitXor][self.below(4)], Type::Bool),
            1 => ([Equal, NotEqual][self.below(2)], PLACE),
            2 => return Expression::Unary(UnaryOperator::Not, boxed(self.expression(&Type::Bool, depth))),
            _ => ([Less, Greater, Equal][self.below(3)], self.scalar()),
        };
        Expression::Binary(operator, boxed(self.expression(&of, depth)), boxed(self.expression(&of, depth)))
    }

    fn vector(&mut self, scalar: ScalarType, lanes: u8, depth: usize) -> Expression {
        use BinaryOperator::{Add, Divide, Multiply, Subtract};
        let (vector, single) = (Type::Vector(scalar, lanes), Type::Scalar(scalar));
        match self.below(5) {
            0 => Expression::Vector((0..lanes).map(|_| self.expression(&single, depth)).collect()),
            1 => Expression::Binary(
                Multiply,
                boxed(self.expression(&single, depth)),
                boxed(self.expression(&vector, depth)),
            ),
            2 => Expression::Binary(
                [Multiply, Divide][self.below(2)],
                boxed(self.expression(&vector, depth)),
                boxed(self.expression(&single, depth)),
            ),
            3 => Expression::Method {
                method: Operation::Cross,
                receiver: boxed(self.expression(&vector, depth)),
                arguments: vec![self.expression(&vector, depth)],
            },
            _ => Expression::Binary(
                [Add, Subtract][self.below(2)],
                boxed(self.expression(&vector, depth)),
                boxed(self.expression(&vector, depth)),
            ),
        }
    }

    fn match_(&mut self, type_: Option<&Type>, depth: usize) -> Expression {
        let matched = self.integer();
        let value = boxed(self.expression(&matched, depth));
        let literal = |value| Expression::Literal(Literal::Integer(value, None));
        let mut arms = Vec::new();
        for patterns in [
            vec![Pattern::Value(literal(3))],
            vec![Pattern::Range(literal(4), literal(9)), Pattern::Value(literal(0))],
            vec![Pattern::Any],
            vec![Pattern::Any],
        ] {
            let last = arms.len() == 3;
            let guard = (!last && self.below(2) == 0).then(|| self.expression(&Type::Bool, depth));
            arms.push(Arm { patterns, guard, body: self.block_or_leave(type_, depth, !last) });
        }
        Expression::Match { value, arms }
    }

    fn block(&mut self, value: Option<&Type>, depth: usize) -> Block {
        self.block_or_leave(value, depth, false)
    }

    fn block_or_leave(&mut self, value: Option<&Type>, depth: usize, may_leave: bool) -> Block {
        self.scopes.push(Vec::new());
        let count = self.below(3);
        let statements = (0..count).map(|_| self.statement(depth)).collect();
        let value = match value {
            Some(_) if may_leave && self.below(8) == 0 => {
                // Control may leave instead of giving a value.
                let leave = self.leave();
                self.scopes.pop();
                let mut statements: Vec<Statement> = statements;
                statements.push(leave);
                return Block { statements, value: None };
            }
            Some(type_) => Some(boxed(self.expression(type_, depth))),
            None => None,
        };
        self.scopes.pop();
        Block { statements, value }
    }

    fn statement(&mut self, depth: usize) -> Statement {
        if depth == 0 {
            return self.assignment(0);
        }
        let next = depth - 1;
        match self.below(9) {
            0..=2 => {
                let type_ = self.any_type();
                let value = self.expression(&type_, next);
                let (name, mutable) = (NAMES[self.below(NAMES.len())], self.below(2) == 0);
                // The type is written where the value might not decide it.
                let written = Some(type_.clone());
                if let Some(scope) = self.scopes.last_mut() {
                    scope.push((name, type_, mutable));
                }
                Statement::Let { name, mutable, type_: written, value }
            }
            3 => {
                let condition = boxed(self.expression(&Type::Bool, next));
                let otherwise = (self.below(2) == 0).then(|| self.block(None, next));
                Statement::Expression(Expression::If { condition, then: self.block(None, next), otherwise })
            }
            4 => Statement::Expression(self.match_(None, next)),
            5 => {
                // The condition cannot leave the loop around it.
                let loops = std::mem::take(&mut self.loops);
                let condition = self.expression(&Type::Bool, next);
                self.loops = loops;
                self.loop_(LoopKind::While(condition), next)
            }
            6 => {
                let counter = self.integer();
                let (from, to) = (self.expression(&counter, next), self.expression(&counter, next));
                let (variable, inclusive) = (NAMES[self.below(NAMES.len())], self.below(2) == 0);
                let step = (self.below(3) == 0).then(|| self.expression(&Type::Scalar(ScalarType::U32), 0));
                self.scopes.push(vec![(variable, counter, false)]);
                let reversed = self.below(3) == 0;
                let range = Range { from, to, inclusive, reversed, step };
                let loop_ = self.loop_(LoopKind::Range { variable, range }, next);
                self.scopes.pop();
                loop_
            }
            7 if self.below(2) == 0 => {
                let element = self.scalar();
                let array = self.expression(&Type::Array(boxed_type(&element), 3), next);
                let variable = NAMES[self.below(NAMES.len())];
                self.scopes.push(vec![(variable, element, false)]);
                let loop_ = self.loop_(LoopKind::Elements { variable, array }, next);
                self.scopes.pop();
                loop_
            }
            7 => Statement::Fault {
                code: self.expression(&Type::Scalar(ScalarType::U32), next),
                value: self.expression(&Type::Scalar(ScalarType::Real), next),
            },
            _ => self.assignment(next),
        }
    }

    fn loop_(&mut self, kind: LoopKind, depth: usize) -> Statement {
        const LABELS: [&str; 6] = ["outer", "second", "third", "fourth", "fifth", "sixth"];
        let label = LABELS.get(self.loops.len()).copied().filter(|_| self.below(2) == 0);
        self.loops.push(label);
        let body = self.block(None, depth);
        self.loops.pop();
        Statement::Loop(Loop { label, kind, body })
    }

    /// Leaves a block: for a loop around it, or the function.
    fn leave(&mut self) -> Statement {
        if self.loops.is_empty() {
            return Statement::Return(None);
        }
        let labels: Vec<&'static str> = self.loops.iter().flatten().copied().collect();
        let label = match labels.len() {
            0 => None,
            count => Some(labels[self.below(count)]).filter(|_| self.below(3) > 0),
        };
        if self.below(2) == 0 { Statement::Break(label) } else { Statement::Continue(label) }
    }

    fn assignment(&mut self, depth: usize) -> Statement {
        let type_ = self.any_type();
        let root = match self.variable(&type_, true) {
            Some(name) => PlaceRoot::Local(name),
            None => PlaceRoot::Own(Self::field(&type_).unwrap_or("place")),
        };
        let (mut type_, mut path) = (type_, Vec::new());
        if type_ == PLACE && self.below(2) == 0 {
            path.push(Projection::Component(self.below(3) as u8));
            type_ = Type::Scalar(ScalarType::Real);
        } else if let Type::Array(element, _) = &type_ {
            type_ = (**element).clone();
            path.push(Projection::Element(self.index(depth)));
        }
        let numeric = matches!(type_, Type::Scalar(_));
        let operator = (numeric && self.below(2) == 0).then(|| {
            [BinaryOperator::Add, BinaryOperator::Subtract, BinaryOperator::Multiply][self.below(3)]
        });
        let value = self.expression(&type_, depth);
        Statement::Assign { place: Place { root, path }, operator, value }
    }
}

#[test]
fn whatever_is_written_is_valid() {
    for seed in 0..std::env::var("SEEDS").map_or(300, |text| text.parse().unwrap()) {
        let mut source = Source { state: seed, scopes: vec![Vec::new()], loops: Vec::new() };
        let body = source.block(None, 5);
        let process = Function {
            name: "senseless",
            module: "wgsl::random",
            kind: FunctionKind::Cells,
            arguments: vec![Argument { name: "cell", role: Role::Cell(SCHEMA) }],
            result: None,
            body,
        };
        for precision in [Precision::F32, Precision::F64] {
            let options = Options { precision, neighbourhood_size: Some(7), ..Options::default() };
            match shader(&process, &options) {
                Ok(shader) => drop(validate(&shader)),
                Err(error) => panic!("seed {seed}: {error}\n{process:#?}"),
            }
        }
    }
}
