//! Expressions.

use super::scope::{Binding, Scope};
use super::statements::{Item, is_component, macro_call, strip};
use crate::ast::{Arm, Block, Builtin, Expression, FunctionKind, Pattern};
use syn::spanned::Spanned;
use syn::{BinOp, Error, Expr, ExprMethodCall, Ident, Lit, Member, Pat, Result, UnOp};

/// Methods of numbers and vectors, with the number of further arguments.
const METHODS: [(&str, usize); 16] = [
    ("min", 1),
    ("max", 1),
    ("clamp", 2),
    ("abs", 0),
    ("sqrt", 0),
    ("floor", 0),
    ("ceil", 0),
    ("trunc", 0),
    ("wrapping_add", 1),
    ("wrapping_sub", 1),
    ("wrapping_mul", 1),
    ("count_ones", 0),
    ("dot", 1),
    ("cross", 1),
    ("length", 0),
    ("length_squared", 0),
];

/// Methods of Rust's floats whose bits differ from machine to machine.
const INEXACT: [&str; 22] = [
    "exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "powf", "powi", "sin", "cos", "tan",
    "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "cbrt", "hypot",
];

impl Scope {
    pub(super) fn expression(&mut self, expression: &Expr) -> Result<Expression> {
        match strip(expression) {
            Expr::Lit(literal) => literal_expression(&literal.lit),
            Expr::Path(path) => self.path(path),
            Expr::Field(field) => self.field(field),
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Call(call) => self.call(call),
            Expr::Unary(unary) => match unary.op {
                UnOp::Neg(_) | UnOp::Not(_) => {
                    Ok(Expression::Unary(unary.op, Box::new(self.expression(&unary.expr)?)))
                }
                _ => Err(Error::new_spanned(
                    unary,
                    "there are no references in a process: use the value itself",
                )),
            },
            Expr::Binary(binary) if is_assignment(&binary.op) => Err(Error::new_spanned(
                binary,
                "an assignment has no value; write it as a statement of its own",
            )),
            Expr::Binary(binary) => {
                let left = self.expression(&binary.left);
                let right = self.expression(&binary.right)?;
                Ok(Expression::Binary(binary.op, Box::new(left?), Box::new(right)))
            }
            Expr::Cast(cast) => {
                Ok(Expression::Cast(Box::new(self.expression(&cast.expr)?), (*cast.ty).clone()))
            }
            Expr::Index(index) => {
                let array = self.expression(&index.expr)?;
                Ok(Expression::Element(Box::new(array), Box::new(self.expression(&index.index)?)))
            }
            Expr::Array(array) => {
                let elements =
                    array.elems.iter().map(|element| self.expression(element)).collect::<Result<_>>()?;
                Ok(Expression::Array(elements, array.span()))
            }
            Expr::Repeat(repeat) => {
                let value = self.expression(&repeat.expr)?;
                match strip(&repeat.len) {
                    Expr::Lit(literal) if let Lit::Int(length) = &literal.lit => {
                        Ok(Expression::Repeat(Box::new(value), length.clone()))
                    }
                    other => Err(Error::new_spanned(other, "write the length of the array as a number")),
                }
            }
            Expr::If(if_) => self.if_expression(if_),
            Expr::Match(match_) => self.match_expression(match_),
            Expr::Block(block) if block.label.is_none() => Ok(Expression::Block(self.block(&block.block)?)),
            other => Err(refused(other)),
        }
    }

    fn if_expression(&mut self, if_: &syn::ExprIf) -> Result<Expression> {
        let condition = self.expression(&if_.cond)?;
        let then = self.block(&if_.then_branch)?;
        let otherwise = match &if_.else_branch {
            None => None,
            Some((_, branch)) => Some(self.branch(branch)?),
        };
        Ok(Expression::If { condition: Box::new(condition), then, otherwise, span: if_.span() })
    }

    /// The body of an `else` or of an arm: a block, or one expression.
    fn branch(&mut self, branch: &Expr) -> Result<Block> {
        if let Expr::Block(block) = branch
            && block.label.is_none()
        {
            return self.block(&block.block);
        }
        Ok(match self.item(branch)? {
            Item::Statement(statement) => Block { statements: vec![statement], value: None },
            Item::Value(value) => Block { statements: Vec::new(), value: Some(Box::new(value)) },
        })
    }

    fn match_expression(&mut self, match_: &syn::ExprMatch) -> Result<Expression> {
        let value = Box::new(self.expression(&match_.expr)?);
        let mut arms = Vec::new();
        for arm in &match_.arms {
            let (pattern, guard) = match &arm.pat {
                Pat::Guard(guarded) => (&*guarded.pat, Some(self.expression(&guarded.guard)?)),
                other => (other, None),
            };
            arms.push(Arm { patterns: patterns(pattern)?, guard, body: self.branch(&arm.body)? });
        }
        Ok(Expression::Match { value, arms, span: match_.span() })
    }

    fn path(&mut self, path: &syn::ExprPath) -> Result<Expression> {
        if let Some(name) = path.path.get_ident() {
            match self.binding(name) {
                Some(Binding::Value) => return Ok(Expression::Local(name.clone())),
                Some(Binding::Parameters) => return Ok(Expression::Parameters(name.span())),
                Some(Binding::Space) => return Ok(Expression::Space(name.span())),
                Some(_) => {
                    return Err(Error::new_spanned(
                        name,
                        format!("`{name}` is no value by itself; use its substates, `{name}.substate`"),
                    ));
                }
                None => {}
            }
        }
        if path.qself.is_some() {
            return Err(Error::new_spanned(path, "give the constant a plain path"));
        }
        let segments: Vec<String> =
            path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if let [.., type_, variant] = segments.as_slice()
            && type_ == "Destination"
        {
            return match variant.as_str() {
                "Stay" => Ok(Expression::Builtin(Builtin::Stay, Vec::new(), path.span())),
                "Outside" => Ok(Expression::Builtin(Builtin::Outside, Vec::new(), path.span())),
                _ => Err(Error::new_spanned(
                    path,
                    "a destination is `Destination::Stay`, `Destination::Outside` or `space.cell_containing(position)`",
                )),
            };
        }
        Ok(Expression::Constant(path.path.clone()))
    }

    /// What the expression stands for, where it is a plain name.
    pub(super) fn named(&self, expression: &Expr) -> Option<Binding> {
        match strip(expression) {
            Expr::Path(path) => path.path.get_ident().and_then(|name| self.binding(name)),
            _ => None,
        }
    }

    pub(super) fn is_subject(&self, expression: &Expr) -> bool {
        self.named(expression) == Some(Binding::Subject)
    }

    fn field(&mut self, field: &syn::ExprField) -> Result<Expression> {
        let Member::Named(member) = &field.member else {
            return Err(Error::new_spanned(
                &field.member,
                "tuples are not part of a process; use variables or a small vector",
            ));
        };
        let member = member.clone();
        if let Expr::Path(path) = strip(&field.base)
            && let Some(name) = path.path.get_ident()
        {
            match self.binding(name) {
                Some(Binding::Subject) => return Ok(Expression::Own(member)),
                Some(Binding::CellOfItem) => return Ok(Expression::CellOfItem(member)),
                Some(Binding::Parameters) => return Ok(Expression::Parameter(member)),
                Some(Binding::Neighbour) => {
                    return Ok(Expression::NamedNeighbour { name: name.clone(), field: member });
                }
                Some(Binding::Other) => return Ok(Expression::Other { name: name.clone(), field: member }),
                Some(Binding::Slots) => {
                    return Err(Error::new_spanned(
                        field,
                        format!("go through the items: `for item in {name} {{ … }}`"),
                    ));
                }
                Some(Binding::Space) => {
                    return Err(Error::new_spanned(
                        &field.member,
                        "the space has side(), extents(), step() and cell_containing(position)",
                    ));
                }
                Some(Binding::Value) | None => {}
            }
        }
        if let Expr::MethodCall(call) = strip(&field.base)
            && call.method == "neighbour"
            && self.is_subject(&call.receiver)
        {
            let index = Box::new(self.neighbour_index(call)?);
            return Ok(Expression::Neighbour { index, field: member });
        }
        let value = self.expression(&field.base)?;
        if !is_component(&member) {
            return Err(Error::new_spanned(member, "the components of a vector are x, y, z and w"));
        }
        Ok(Expression::Component(Box::new(value), member))
    }

    pub(super) fn neighbour_index(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        if self.kind != FunctionKind::Cells {
            return Err(Error::new_spanned(
                &call.method,
                "a process over items reaches its neighbours' items: `for other in me.others_in_neighbours() { … }`",
            ));
        }
        match call.args.first() {
            Some(index) if call.args.len() == 1 => self.expression(index),
            _ => Err(Error::new_spanned(
                call,
                "give the index of the neighbour: `cell.neighbour(n)`, with 0 for the cell itself",
            )),
        }
    }

    fn method_call(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        if let Some(turbofish) = &call.turbofish {
            return Err(Error::new_spanned(turbofish, "methods take no type arguments in a process"));
        }
        let name = match strip(&call.receiver) {
            Expr::Path(path) => path.path.get_ident(),
            _ => None,
        };
        match name.and_then(|name| self.binding(name)) {
            Some(Binding::Subject) => return self.subject_method(call),
            Some(Binding::Space) => return self.space_method(call),
            Some(Binding::Other) if let Some(name) = name => {
                return if call.method == "label" && call.args.is_empty() {
                    Ok(Expression::OtherLabel(name.clone()))
                } else {
                    Err(Error::new_spanned(&call.method, "another item has its substates and label()"))
                };
            }
            Some(Binding::Value) | None => {}
            Some(_) => {
                return Err(Error::new_spanned(
                    &call.method,
                    "this has no methods in a process; use its fields",
                ));
            }
        }
        let method = call.method.to_string();
        if INEXACT.contains(&method.as_str()) {
            return Err(Error::new_spanned(
                &call.method,
                format!(
                    "`{method}` gives other bits on other machines and is not part of a process; the exact operations are + - * / \
                     sqrt abs floor ceil trunc min max clamp (write powers as products)"
                ),
            ));
        }
        if method == "round" {
            return Err(Error::new_spanned(
                &call.method,
                "round differs between engines at halves; write (value + 0.5).floor()",
            ));
        }
        if method == "mul_add" {
            return Err(Error::new_spanned(
                &call.method,
                "fused operations differ between engines; write a * b + c",
            ));
        }
        let Some((_, count)) = METHODS.iter().find(|(known, _)| *known == method) else {
            return Err(Error::new_spanned(
                &call.method,
                format!(
                    "`{method}` is not part of a process; numbers and vectors have {}",
                    METHODS.map(|(known, _)| known).join(", ")
                ),
            ));
        };
        if call.args.len() != *count {
            return Err(Error::new_spanned(call, format!("`{method}` takes {count} arguments")));
        }
        let receiver = Box::new(self.expression(&call.receiver)?);
        let arguments = call.args.iter().map(|argument| self.expression(argument)).collect::<Result<_>>()?;
        Ok(Expression::Method { method: call.method.clone(), receiver, arguments })
    }

    fn subject_method(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        let cells = self.kind == FunctionKind::Cells;
        let method = call.method.to_string();
        let (builtin, count) = match method.as_str() {
            "neighbours" if cells => (Builtin::Neighbours, 0),
            "index" => (Builtin::Index, 0),
            "label" if !cells => (Builtin::Label, 0),
            "random" => (Builtin::Random, 1),
            "random_bits" => (Builtin::RandomBits, 1),
            "neighbour" => {
                return Err(Error::new_spanned(
                    call,
                    "read a substate of the neighbour, `cell.neighbour(n).substate`, or name it: `let other = cell.neighbour(n);`",
                ));
            }
            "fault" => {
                return Err(Error::new_spanned(call, "`fault` is a statement: `cell.fault(code, value);`"));
            }
            _ if method.starts_with("others") => {
                return Err(Error::new_spanned(
                    call,
                    "searches are for loops: `for other in me.others_within(radius) { … }`",
                ));
            }
            _ => {
                return Err(Error::new_spanned(
                    &call.method,
                    if cells {
                        "a cell has its substates and neighbours(), neighbour(n), index(), random(draw), random_bits(draw), fault(code, value)"
                    } else {
                        "an item has its substates and label(), index(), random(draw), random_bits(draw), fault(code, value), and the searches others…()"
                    },
                ));
            }
        };
        self.builtin(builtin, count, call)
    }

    fn space_method(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        let (builtin, count) = match call.method.to_string().as_str() {
            "side" => (Builtin::Side, 0),
            "extents" => (Builtin::Extents, 0),
            "step" => (Builtin::Step, 0),
            "cell_containing" if self.kind == FunctionKind::Migration => (Builtin::CellContaining, 1),
            "cell_containing" => {
                return Err(Error::new_spanned(
                    &call.method,
                    "only a #[migration] asks which cell contains a position",
                ));
            }
            _ => {
                return Err(Error::new_spanned(
                    &call.method,
                    "the space has side(), extents(), step() and cell_containing(position)",
                ));
            }
        };
        self.builtin(builtin, count, call)
    }

    fn builtin(&mut self, builtin: Builtin, count: usize, call: &ExprMethodCall) -> Result<Expression> {
        if call.args.len() != count {
            return Err(Error::new_spanned(call, format!("`{}` takes {count} arguments", call.method)));
        }
        let arguments = call.args.iter().map(|argument| self.expression(argument)).collect::<Result<_>>()?;
        Ok(Expression::Builtin(builtin, arguments, call.span()))
    }

    fn call(&mut self, call: &syn::ExprCall) -> Result<Expression> {
        let Expr::Path(function) = strip(&call.func) else {
            return Err(Error::new_spanned(&call.func, "call a helper by its name"));
        };
        let arguments: Vec<Expression> =
            call.args.iter().map(|argument| self.argument(argument)).collect::<Result<_>>()?;
        let segments: Vec<&syn::PathSegment> = function.path.segments.iter().collect();
        if let [.., type_, method] = segments.as_slice()
            && ["Vector2", "Vector3", "Vector4"].iter().any(|name| type_.ident == name)
        {
            return vector(&type_.ident, &method.ident, arguments, call);
        }
        if let [only] = segments.as_slice()
            && only.ident.to_string().starts_with(char::is_uppercase)
        {
            return Err(Error::new_spanned(
                call,
                "only small vectors can be made in a process: `Vector3::new(x, y, z)`",
            ));
        }
        if segments.len() > 1
            && segments[segments.len() - 2].ident.to_string().starts_with(char::is_uppercase)
        {
            return Err(Error::new_spanned(
                &call.func,
                "associated functions cannot be called in a process; write a free function marked #[helper]",
            ));
        }
        if let Some(name) = function.path.get_ident()
            && self.binding(name).is_some()
        {
            return Err(Error::new_spanned(
                name,
                "this is no function; helpers are free functions marked #[helper]",
            ));
        }
        Ok(Expression::Call { function: function.path.clone(), arguments })
    }

    fn argument(&mut self, argument: &Expr) -> Result<Expression> {
        if let Expr::Reference(reference) = strip(argument) {
            return Err(Error::new_spanned(
                reference,
                "pass the value itself; parameters and space are references already",
            ));
        }
        self.expression(argument)
    }
}

fn vector(
    type_: &Ident,
    method: &Ident,
    mut arguments: Vec<Expression>,
    call: &syn::ExprCall,
) -> Result<Expression> {
    let lanes = match type_.to_string().as_str() {
        "Vector2" => 2,
        "Vector3" => 3,
        _ => 4,
    };
    if method == "new" && arguments.len() == lanes {
        return Ok(Expression::Vector(type_.clone(), arguments));
    }
    if method == "splat"
        && arguments.len() == 1
        && let Some(value) = arguments.pop()
    {
        return Ok(Expression::Splat(type_.clone(), Box::new(value)));
    }
    Err(Error::new_spanned(
        call,
        format!("make a vector by `{type_}::new` with {lanes} components or by `{type_}::splat(value)`"),
    ))
}

fn literal_expression(literal: &Lit) -> Result<Expression> {
    match literal {
        Lit::Bool(value) => Ok(Expression::Bool(value.clone())),
        Lit::Int(value) if value.suffix() == "f32" || value.suffix() == "f64" => {
            Err(Error::new_spanned(value, "write the decimal point: `1.0`"))
        }
        Lit::Int(value) => Ok(Expression::Integer(value.clone())),
        Lit::Float(value) => Ok(Expression::Float(value.clone())),
        other => Err(Error::new_spanned(other, "literals in a process are numbers, true and false")),
    }
}

fn patterns(pattern: &Pat) -> Result<Vec<Pattern>> {
    match pattern {
        Pat::Or(or) => {
            let mut all = Vec::new();
            for case in &or.cases {
                all.extend(patterns(case)?);
            }
            Ok(all)
        }
        Pat::Paren(paren) => patterns(&paren.pat),
        other => single_pattern(other).map(|pattern| vec![pattern]),
    }
}

fn single_pattern(pattern: &Pat) -> Result<Pattern> {
    let unsupported = || {
        Error::new_spanned(
            pattern,
            "patterns in a process are integers, constants, ranges of integers `a..=b`, and `_`",
        )
    };
    match pattern {
        Pat::Lit(literal) => match &literal.lit {
            Lit::Float(_) => Err(Error::new_spanned(literal, "compare floats with `if`, not `match`")),
            Lit::Int(_) | Lit::Bool(_) => Ok(Pattern::Literal(literal.lit.clone(), false)),
            _ => Err(unsupported()),
        },
        Pat::Ident(name)
            if name.ident.to_string().starts_with(char::is_uppercase) && name.subpat.is_none() =>
        {
            Ok(Pattern::Constant(name.ident.clone().into()))
        }
        Pat::Path(path) => Ok(Pattern::Constant(path.path.clone())),
        Pat::Range(range) => {
            if let syn::RangeLimits::HalfOpen(token) = &range.limits {
                return Err(Error::new_spanned(token, "write the range with its last value: `a..=b`"));
            }
            match (range.start.as_deref().and_then(integer), range.end.as_deref().and_then(integer)) {
                (Some(from), Some(to)) => Ok(Pattern::Range(from, to)),
                _ => Err(unsupported()),
            }
        }
        other => {
            let text = quote::quote!(#other).to_string();
            if text == "_" {
                return Ok(Pattern::Any(other.span()));
            }
            if let Some(number) = text.strip_prefix('-')
                && let Ok(mut literal) = syn::parse_str::<syn::LitInt>(number.trim())
            {
                literal.set_span(other.span());
                return Ok(Pattern::Literal(Lit::Int(literal), true));
            }
            Err(unsupported())
        }
    }
}

fn integer(expression: &Expr) -> Option<(syn::LitInt, bool)> {
    match expression {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Int(value) => Some((value.clone(), false)),
            _ => None,
        },
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            integer(&unary.expr).map(|(value, sign)| (value, !sign))
        }
        _ => None,
    }
}

fn is_assignment(operator: &BinOp) -> bool {
    matches!(
        operator,
        BinOp::AddAssign(_)
            | BinOp::SubAssign(_)
            | BinOp::MulAssign(_)
            | BinOp::DivAssign(_)
            | BinOp::RemAssign(_)
            | BinOp::BitXorAssign(_)
            | BinOp::BitAndAssign(_)
            | BinOp::BitOrAssign(_)
            | BinOp::ShlAssign(_)
            | BinOp::ShrAssign(_)
    )
}

/// Why an expression is no part of a process, and what to write instead.
fn refused(expression: &Expr) -> Error {
    let advice = match expression {
        Expr::Macro(call) => return macro_call(&call.mac),
        Expr::Closure(_) => {
            "closures are not part of a process; write the code in place or as a function marked #[helper]"
        }
        Expr::Reference(_) | Expr::RawAddr(_) => "there are no references in a process: use the value itself",
        Expr::Tuple(_) => "tuples are not part of a process; use variables, a small vector or an array",
        Expr::Struct(_) => "structs cannot be made in a process; assign the substates one by one",
        Expr::Range(_) => "a range stands only in `for i in a..b`",
        Expr::Let(_) => "`if let` is not part of a process; compare with `if` or `match`",
        Expr::Unsafe(_) => "unsafe code is not part of a process",
        Expr::Try(_) => {
            "`?` is not part of a process; report an impossible state by `cell.fault(code, value);`"
        }
        Expr::Await(_) | Expr::Async(_) => "asynchronous code is not part of a process",
        Expr::Assign(_)
        | Expr::While(_)
        | Expr::Loop(_)
        | Expr::ForLoop(_)
        | Expr::Break(_)
        | Expr::Continue(_)
        | Expr::Return(_) => "this has no value; write it as a statement of its own",
        Expr::Block(_) => "blocks have no labels in a process",
        _ => "this is not part of the Rust that a process can use",
    };
    Error::new_spanned(expression, advice)
}
