//! Chains such as `(0..n).filter(|i| …).map(|i| …).sum::<Real>()`, which become blocks with a loop.

use super::expressions::{both, strip};
use super::iterators::{Given, Names, Source, hidden, let_};
use super::scope::{Binding, Scope};
use crate::ast::{Block, Expression, Place, PlaceRoot, Statement};
use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{
    BinOp, Error, Expr, ExprClosure, ExprMethodCall, GenericArgument, Ident, LitBool, LitFloat, LitInt, Pat,
    Result, Type, UnOp, parse_quote,
};

/// The last method of a chain.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Any,
    All,
    Count,
    Sum,
    Product,
    Fold,
}

impl End {
    pub(super) fn of(call: &ExprMethodCall) -> Option<Self> {
        Some(match call.method.to_string().as_str() {
            "any" => Self::Any,
            "all" => Self::All,
            "count" => Self::Count,
            "sum" => Self::Sum,
            "product" => Self::Product,
            "fold" => Self::Fold,
            _ => return None,
        })
    }
}

/// A part of a turn of the loop.
enum Part {
    Let(Statement),
    /// The rest of the turn is for those that pass the filter.
    Filter(Expression),
}

/// A turn of the loop, as far as it has been read.
struct Turn {
    given: Given,
    /// The names of what the loop goes through.
    outer: Option<Names>,
    /// What the last `map` gives, before it has a name.
    mapped: Option<Expression>,
    /// The names of what the next closure takes.
    names: Option<Names>,
    parts: Vec<Part>,
}

impl Turn {
    fn new(given: Given) -> Self {
        Self { given, outer: None, mapped: None, names: None, parts: Vec::new() }
    }

    /// The statements of the turn, after those of the closures.
    fn around(self, mut statements: Vec<Statement>) -> (Names, Vec<Statement>) {
        for part in self.parts.into_iter().rev() {
            match part {
                Part::Let(statement) => statements.insert(0, statement),
                Part::Filter(condition) => statements = vec![if_(condition, statements)],
            }
        }
        let nameless = || Names { index: None, value: hidden("value") };
        (self.outer.unwrap_or_else(nameless), statements)
    }
}

/// The `map` and `filter` of a chain, the last one first, and what it goes through.
fn stages(chain: &Expr) -> (Vec<&ExprMethodCall>, &Expr) {
    let (mut stages, mut over) = (Vec::new(), strip(chain));
    while let Expr::MethodCall(stage) = over
        && (stage.method == "map" || stage.method == "filter")
    {
        stages.push(stage);
        over = strip(&stage.receiver);
    }
    (stages, over)
}

impl Scope {
    /// The chain that ends in this method, where it is one. Cells, items, parameters and the space have methods
    /// of their own.
    pub(super) fn chain(&mut self, call: &ExprMethodCall) -> Option<Result<Expression>> {
        let end = End::of(call).filter(|_| self.named(&call.receiver).is_none_or(Binding::is_value))?;
        Some(self.chain_to(end, call))
    }

    fn chain_to(&mut self, end: End, call: &ExprMethodCall) -> Result<Expression> {
        let expected = self.expected.take();
        let (stages, over) = stages(&call.receiver);
        let source = self.source(over)?;
        let (type_, start) = self.start(end, call, expected)?;
        let turn = Turn::new(source.given());
        let (names, body) =
            self.nested(|scope| scope.in_closure(|scope| scope.turn(turn, &stages, end, call)))?;
        let result = hidden("result");
        let statements = vec![let_(&result, type_, true, start), source.into_loop(None, names, body)];
        Ok(Expression::Block(Block { statements, value: Some(Box::new(Expression::Local(result))) }))
    }

    /// The type of the result, where it is known, and its first value.
    fn start(
        &mut self,
        end: End,
        call: &ExprMethodCall,
        expected: Option<Type>,
    ) -> Result<(Option<Type>, Expression)> {
        let integer = |digits| Expression::Integer(LitInt::new(digits, Span::mixed_site()));
        let float = |digits| Expression::Float(LitFloat::new(digits, Span::mixed_site()));
        let arguments = match end {
            End::Count | End::Sum | End::Product => 0,
            End::Any | End::All => 1,
            End::Fold => 2,
        };
        if call.args.len() != arguments {
            let usage = match end {
                End::Any | End::All => format!("write `{}(|value| …)`", call.method),
                End::Fold => "write `fold(start, |result, value| …)`".to_owned(),
                End::Count | End::Sum | End::Product => format!("`{}` takes no arguments", call.method),
            };
            return Err(Error::new_spanned(&call.method, usage));
        }
        Ok(match end {
            End::Any | End::All => {
                (None, Expression::Bool(LitBool::new(end == End::All, Span::mixed_site())))
            }
            End::Count => (Some(parse_quote!(usize)), integer("0")),
            End::Fold => (None, self.expression(&call.args[0])?),
            End::Sum | End::Product => {
                let type_ = number(call, expected)?;
                self.mentions.types.push(type_.clone());
                let is_float = ["Real", "f32", "f64"].iter().any(|word| is_word(&type_, word));
                let start = match (end, is_float) {
                    // As in Rust, the sum of nothing is -0: with 0 the sum of -0 alone would be 0.
                    (End::Sum, true) => {
                        Expression::Unary(UnOp::Neg(syn::Token![-](call.span())), Box::new(float("0.0")))
                    }
                    (End::Sum, false) => integer("0"),
                    (_, true) => float("1.0"),
                    (_, false) => integer("1"),
                };
                (Some(type_), start)
            }
        })
    }

    /// The body of the loop, with the names of what it goes through.
    fn turn(
        &mut self,
        mut turn: Turn,
        stages: &[&ExprMethodCall],
        end: End,
        call: &ExprMethodCall,
    ) -> Result<(Names, Block)> {
        self.stages(&mut turn, stages)?;
        let result = || Expression::Local(hidden("result"));
        let add = BinOp::Add(syn::Token![+](call.span()));
        let statements = match end {
            End::Any | End::All => {
                let closure = closure(call.args.last(), 1, &call.method)?;
                self.take(&mut turn, &closure.inputs[0], false)?;
                let value = self.closure_value(closure)?;
                let operator = match end {
                    End::Any => BinOp::Or(syn::Token![||](call.span())),
                    _ => BinOp::And(syn::Token![&&](call.span())),
                };
                vec![set(None, Expression::Binary(operator, Box::new(result()), Box::new(value)))]
            }
            End::Count => {
                self.finish_item(&mut turn);
                vec![set(Some(add), Expression::Integer(LitInt::new("1", Span::mixed_site())))]
            }
            End::Sum => vec![set(Some(add), self.number(&mut turn, call)?)],
            End::Product => {
                let times = BinOp::Mul(syn::Token![*](call.span()));
                vec![set(Some(times), self.number(&mut turn, call)?)]
            }
            End::Fold => {
                let closure = closure(call.args.last(), 2, &call.method)?;
                let before = self.bind_given(&closure.inputs[0], Given::value())?;
                self.take(&mut turn, &closure.inputs[1], false)?;
                let value = self.closure_value(closure)?;
                vec![let_(&before.value, None, false, result()), set(None, value)]
            }
        };
        let is_whole = turn.parts.is_empty();
        let (outer, mut statements) = turn.around(statements);
        // What is known is not asked again.
        if !is_whole && end == End::Any {
            let not = Expression::Unary(UnOp::Not(syn::Token![!](call.span())), Box::new(result()));
            statements = vec![if_(not, statements)];
        } else if !is_whole && end == End::All {
            statements = vec![if_(result(), statements)];
        }
        Ok((outer, Block { statements, value: None }))
    }

    /// The closures of `map` and `filter`.
    fn stages(&mut self, turn: &mut Turn, stages: &[&ExprMethodCall]) -> Result<()> {
        for stage in stages.iter().rev() {
            let closure = closure(stage.args.last().filter(|_| stage.args.len() == 1), 1, &stage.method)?;
            if stage.method == "filter" {
                self.take(turn, &closure.inputs[0], true)?;
                let condition = self.closure_value(closure)?;
                turn.parts.push(Part::Filter(condition));
            } else {
                self.take(turn, &closure.inputs[0], false)?;
                turn.mapped = Some(self.closure_value(closure)?);
                turn.given = Given::value();
            }
        }
        Ok(())
    }

    /// A `for` over a chain without an end: its loop, without the label.
    pub(super) fn filtered_loop(
        &mut self,
        pattern: &Pat,
        over: &Expr,
        body: impl FnOnce(&mut Self) -> Result<Block>,
    ) -> Result<(Source, Names, Block)> {
        let (stages, over) = stages(over);
        let source = self.source(over);
        self.nested(|scope| {
            let mut turn =
                Turn::new(source.as_ref().map_or_else(|_| Given::value().borrowed(), Source::given));
            let bound = match &source {
                Ok(_) => scope
                    .in_closure(|scope| scope.stages(&mut turn, &stages))
                    .and_then(|()| scope.take(&mut turn, pattern, false)),
                Err(_) => scope.bind_anyway(pattern).map(|_| ()),
            };
            let body = body(scope);
            let (source, ()) = both(source, bound)?;
            let Block { statements, value } = body?;
            let (names, statements) = turn.around(statements);
            Ok((source, names, Block { statements, value }))
        })
    }

    /// Gives names to what a closure takes.
    fn take(&mut self, turn: &mut Turn, pattern: &Pat, borrowed: bool) -> Result<()> {
        let given = if borrowed { turn.given.borrowed() } else { turn.given };
        let names = self.bind_given(pattern, given)?;
        let before = turn.names.replace(names.clone());
        if let Some(value) = turn.mapped.take() {
            turn.parts.push(Part::Let(let_(&names.value, None, false, value)));
            return Ok(());
        }
        let Some(before) = before else {
            turn.outer = Some(names);
            return Ok(());
        };
        let pairs = [(Some(before.value), Some(names.value)), (before.index, names.index)];
        for (before, name) in pairs {
            let (Some(before), Some(name)) = (before, name) else { continue };
            if before == name {
                continue;
            }
            if !turn.given.is_value() {
                return Err(Error::new_spanned(
                    pattern,
                    format!("give it the same name as before, `{before}`"),
                ));
            }
            turn.parts.push(Part::Let(let_(&name, None, false, Expression::Local(before))));
        }
        Ok(())
    }

    /// The number that is added or multiplied.
    fn number(&mut self, turn: &mut Turn, call: &ExprMethodCall) -> Result<Expression> {
        if let Some(value) = turn.mapped.take() {
            return Ok(value);
        }
        if turn.given.is_pair() || !turn.given.is_value() {
            let advice = format!("say what of each: `.map(|value| …).{}::<Real>()`", call.method);
            return Err(Error::new_spanned(&call.method, advice));
        }
        let names = turn.names.clone().unwrap_or_else(|| Names { index: None, value: hidden("value") });
        let value = names.value.clone();
        turn.outer.get_or_insert(names);
        Ok(Expression::Local(value))
    }

    /// Computes what the last `map` gives, though it is only counted.
    fn finish_item(&mut self, turn: &mut Turn) {
        if let Some(value) = turn.mapped.take() {
            turn.parts.push(Part::Let(let_(&hidden("value"), None, false, value)));
        }
    }

    fn closure_value(&mut self, closure: &ExprClosure) -> Result<Expression> {
        match self.branch(&closure.body)? {
            Block { statements, value: Some(value) } if statements.is_empty() => Ok(*value),
            block if block.value.is_some() => Ok(Expression::Block(block)),
            _ => Err(Error::new_spanned(&closure.body, "a closure ends with its value, without `;`")),
        }
    }
}

/// `result = value;`, `result += value;`
fn set(operator: Option<BinOp>, value: Expression) -> Statement {
    let place = Place { root: PlaceRoot::Local(hidden("result")), path: Vec::new() };
    Statement::Assign { place, operator, value, span: Span::mixed_site() }
}

fn if_(condition: Expression, statements: Vec<Statement>) -> Statement {
    let (then, span) = (Block { statements, value: None }, Span::mixed_site());
    Statement::Expression(Expression::If { condition: Box::new(condition), then, otherwise: None, span })
}

/// The closure that a method takes, with so many arguments.
fn closure<'a>(argument: Option<&'a Expr>, count: usize, method: &Ident) -> Result<&'a ExprClosure> {
    let usage = match count {
        1 => format!("`{method}` takes a closure with one argument: `{method}(|value| …)`"),
        _ => format!("`{method}` takes a closure with two arguments: `{method}(start, |result, value| …)`"),
    };
    match argument {
        Some(Expr::Closure(closure)) if closure.inputs.len() == count && closure.asyncness.is_none() => {
            Ok(closure)
        }
        Some(other) => Err(Error::new_spanned(other, usage)),
        None => Err(Error::new_spanned(method, usage)),
    }
}

/// The type of a sum or product.
fn number(call: &ExprMethodCall, expected: Option<Type>) -> Result<Type> {
    let method = &call.method;
    let numbers = ["Real", "f32", "f64", "u8", "i32", "u32", "usize"];
    let written = match call.turbofish.as_ref().and_then(|turbofish| turbofish.args.first()) {
        Some(GenericArgument::Type(type_)) => Some(type_.clone()),
        _ => expected,
    };
    match written {
        Some(type_) if numbers.iter().any(|word| is_word(&type_, word)) => Ok(type_),
        Some(other) => Err(Error::new_spanned(
            other,
            format!("`{method}` is for numbers; for vectors write `fold(start, |sum, value| sum + value)`"),
        )),
        None => Err(Error::new_spanned(method, format!("give the type: `{method}::<Real>()`"))),
    }
}

fn is_word(type_: &Type, word: &str) -> bool {
    matches!(type_, Type::Path(path) if path.path.is_ident(word))
}
