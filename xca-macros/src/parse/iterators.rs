//! What a `for` and a chain such as `(0..n).any(|i| …)` go through, and the names for what comes from it.

use super::expressions::strip;
use super::refusals::WRITE_BY_INDEX;
use super::scope::{Binding, Scope};
use crate::ast::{ArgumentNumber, Block, Expression, Loop, LoopKind, Range, Reach, Statement};
use proc_macro2::Span;
use quote::format_ident;
use syn::{Error, Expr, ExprMethodCall, Ident, Lifetime, LitInt, Pat, Result, Type};
use xca_methods::Method;

/// What is gone through.
pub(super) enum Source {
    Range(Range),
    Elements {
        array: Expression,
        /// `values.iter()`: references to the elements, not copies.
        borrowed: bool,
        /// `.enumerate()`
        numbered: bool,
    },
    Search(Reach, Option<Expression>),
    Items(ArgumentNumber),
}

/// What an iterator gives, as Rust sees it.
#[derive(Clone, Copy)]
pub(super) struct Given {
    /// What a name for it stands for.
    binding: Binding,
    /// References around it.
    references: usize,
    /// It comes in a pair with its index: the references around the pair.
    pair: Option<usize>,
}

/// The names of what an iterator gives.
#[derive(Clone)]
pub(super) struct Names {
    /// That of the index, where it comes with one.
    pub(super) index: Option<Ident>,
    pub(super) value: Ident,
}

impl Given {
    /// What stands for itself, a number for instance.
    pub(super) fn value() -> Self {
        Self { binding: Binding::Value, references: 0, pair: None }
    }

    /// The same behind a reference.
    pub(super) fn borrowed(self) -> Self {
        match self.pair {
            Some(around) => Self { pair: Some(around + 1), ..self },
            None => Self { references: self.references + 1, ..self },
        }
    }

    fn referred(references: usize) -> Self {
        Self { references, ..Self::value() }
    }

    /// Whether it stands for itself, unlike another item.
    pub(super) fn is_value(self) -> bool {
        self.binding == Binding::Value
    }

    pub(super) fn is_pair(self) -> bool {
        self.pair.is_some()
    }
}

impl Source {
    pub(super) fn given(&self) -> Given {
        match self {
            Self::Range(_) => Given::value(),
            Self::Elements { borrowed, numbered, .. } => {
                Given { pair: numbered.then_some(0), ..Given::referred(usize::from(*borrowed)) }
            }
            Self::Search(..) => Given { binding: Binding::Other(ArgumentNumber::SUBJECT), ..Given::value() },
            Self::Items(argument) => Given { binding: Binding::Other(*argument), ..Given::value() },
        }
    }

    /// The loop.
    pub(super) fn into_loop(self, label: Option<Lifetime>, names: Names, body: Block) -> Statement {
        let variable = names.value.clone();
        let kind = match self {
            Self::Range(range) => LoopKind::Range { variable, range },
            Self::Elements { array, borrowed, numbered: true } => {
                return numbered_loop(array, borrowed, label, names, body);
            }
            Self::Elements { array, .. } => LoopKind::Elements { variable, array },
            Self::Search(reach, radius) => LoopKind::Others { variable, reach, radius },
            Self::Items(_) => LoopKind::Items { variable },
        };
        Statement::Loop(Loop { label, kind, body })
    }
}

/// `for (index, value) in array.iter().enumerate()`: a loop over the indices, which reads the element first.
fn numbered_loop(
    array: Expression,
    borrowed: bool,
    label: Option<Lifetime>,
    names: Names,
    mut body: Block,
) -> Statement {
    let Names { index, value } = names;
    let index = index.unwrap_or_else(|| hidden("index"));
    let mut statements = Vec::new();
    let elements = match array {
        // What is borrowed does not change meanwhile.
        Expression::Local(name) if borrowed => name,
        array => {
            let elements = hidden("elements");
            statements.push(let_(&elements, None, false, array));
            elements
        }
    };
    let local = |name: &Ident| Box::new(Expression::Local(name.clone()));
    body.statements
        .insert(0, let_(&value, None, false, Expression::Element(local(&elements), local(&index))));
    let range = Range {
        from: Expression::Integer(LitInt::new("0", Span::mixed_site())),
        to: length(local(&elements)),
        inclusive: false,
        reversed: false,
        step: None,
    };
    statements.push(Statement::Loop(Loop { label, kind: LoopKind::Range { variable: index, range }, body }));
    Statement::Expression(Expression::Block(Block { statements, value: None }))
}

/// `array.len()`
fn length(array: Box<Expression>) -> Expression {
    match Method::named("len") {
        Some(method) => Expression::Method {
            method,
            name: Ident::new("len", Span::mixed_site()),
            receiver: array,
            arguments: Vec::new(),
        },
        None => *array,
    }
}

/// A name that no name of the user can meet.
pub(super) fn hidden(name: &str) -> Ident {
    format_ident!("__xca_{name}", span = Span::mixed_site())
}

/// `let name: type_ = value;`
pub(super) fn let_(name: &Ident, type_: Option<Type>, mutable: bool, value: Expression) -> Statement {
    Statement::Let { name: name.clone(), mutable, type_, value }
}

impl Scope {
    /// What an expression goes through, at the place of an iterator.
    pub(super) fn source(&mut self, over: &Expr) -> Result<Source> {
        match strip(over) {
            over @ Expr::Range(_) => self.range(over).map(Source::Range),
            Expr::MethodCall(call) if self.is_subject(&call.receiver) => {
                self.search(call).map(|(reach, radius)| Source::Search(reach, radius))
            }
            over @ Expr::MethodCall(call) if call.method == "rev" || call.method == "step_by" => {
                self.range(over).map(Source::Range)
            }
            Expr::MethodCall(call) => match call.method.to_string().as_str() {
                "iter" => self.elements(call, true),
                "into_iter" => match self.named(&call.receiver) {
                    Some(Binding::Slots(argument)) => Ok(Source::Items(argument)),
                    _ => self.elements(call, false),
                },
                "iter_mut" => Err(Error::new_spanned(&call.method, WRITE_BY_INDEX)),
                "enumerate" => match self.source(&call.receiver)? {
                    Source::Elements { array, borrowed, numbered: false } => {
                        Ok(Source::Elements { array, borrowed, numbered: true })
                    }
                    _ => Err(Error::new_spanned(
                        &call.method,
                        "only the elements of an array are numbered: `values.iter().enumerate()`",
                    )),
                },
                "copied" | "cloned" => match self.source(&call.receiver)? {
                    Source::Elements { array, numbered: false, .. } => {
                        Ok(Source::Elements { array, borrowed: false, numbered: false })
                    }
                    _ => Err(Error::new_spanned(
                        &call.method,
                        format!("values are copied by themselves: leave out `.{}()`", call.method),
                    )),
                },
                _ => self.array(over, false),
            },
            Expr::Path(_) if let Some(Binding::Slots(argument)) = self.named(over) => {
                Ok(Source::Items(argument))
            }
            Expr::Reference(reference) => match self.named(&reference.expr) {
                Some(Binding::Slots(_)) => {
                    Err(Error::new_spanned(reference, "it is a reference already: leave out the `&`"))
                }
                _ if reference.mutability.is_some() => Err(Error::new_spanned(reference, WRITE_BY_INDEX)),
                _ => self.array(&reference.expr, true),
            },
            Expr::Lit(literal) => Err(Error::new_spanned(
                literal,
                "a `for` runs over a range (`for i in 0..n`) or an array (`for value in values`)",
            )),
            array => self.array(array, false),
        }
    }

    /// `array.iter()` and `array.into_iter()`.
    fn elements(&mut self, call: &ExprMethodCall, borrowed: bool) -> Result<Source> {
        if !call.args.is_empty() {
            return Err(Error::new_spanned(&call.method, format!("`{}()` takes no arguments", call.method)));
        }
        self.array(&call.receiver, borrowed)
    }

    fn array(&mut self, array: &Expr, borrowed: bool) -> Result<Source> {
        let array = self.expression(array)?;
        Ok(Source::Elements { array, borrowed, numbered: false })
    }

    /// Gives names to what an iterator gives, by the pattern of a `for` or of a closure.
    pub(super) fn bind_given(&mut self, pattern: &Pat, given: Given) -> Result<Names> {
        let Some(around) = given.pair else {
            return match strip_pattern(pattern) {
                Pat::Tuple(pair) => Err(Error::new_spanned(
                    pair,
                    "only `enumerate` gives pairs: `for (i, value) in values.iter().enumerate()`",
                )),
                pattern => Ok(Names { index: None, value: self.bind_name(pattern, given)? }),
            };
        };
        match strip_pattern(pattern) {
            Pat::Reference(inner) if around > 0 => {
                self.bind_given(&inner.pat, Given { pair: Some(around - 1), ..given })
            }
            Pat::Tuple(pair) if pair.elems.len() == 2 => {
                let index = self.bind_name(&pair.elems[0], Given::referred(around))?;
                let value = self.bind_name(&pair.elems[1], Given::referred(given.references + around))?;
                Ok(Names { index: Some(index), value })
            }
            other => Err(Error::new_spanned(
                other,
                "`enumerate` gives pairs: `for (i, value) in values.iter().enumerate()`",
            )),
        }
    }

    fn bind_name(&mut self, pattern: &Pat, given: Given) -> Result<Ident> {
        match strip_pattern(pattern) {
            Pat::Reference(inner) if given.references > 0 && inner.mutability.is_none() => {
                self.bind_name(&inner.pat, Given { references: given.references - 1, ..given })
            }
            Pat::Ident(name)
                if name.by_ref.is_none() && name.mutability.is_none() && name.subpat.is_none() =>
            {
                let binding = if given.references > 0 && given.binding == Binding::Value {
                    self.mentions.references.push(name.ident.clone());
                    Binding::Reference
                } else {
                    given.binding
                };
                self.bind(&name.ident, binding);
                Ok(name.ident.clone())
            }
            Pat::Wild(underscore) => Ok(Ident::new("_unused", underscore.underscore_token.span)),
            other => {
                Err(Error::new_spanned(other, "the variable of a loop is a plain name: `for i in 0..n`"))
            }
        }
    }

    /// Binds the names of a pattern whose source is wrong, so that their uses make no more errors.
    pub(super) fn bind_anyway(&mut self, pattern: &Pat) -> Result<Names> {
        match strip_pattern(pattern) {
            Pat::Reference(inner) => return self.bind_anyway(&inner.pat),
            Pat::Tuple(parts) => {
                for part in &parts.elems {
                    self.bind_anyway(part)?;
                }
            }
            other => return self.bind_given(other, Given::referred(1)),
        }
        Ok(Names { index: None, value: hidden("value") })
    }
}

/// Without parentheses and types, which the compiler compares.
fn strip_pattern(pattern: &Pat) -> &Pat {
    match pattern {
        Pat::Paren(paren) => strip_pattern(&paren.pat),
        Pat::Type(typed) => strip_pattern(&typed.pat),
        other => other,
    }
}
