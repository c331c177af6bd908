//! `match` and its patterns.

use super::scope::{Binding, Scope};
use crate::ast::{Arm, Block, Expression, Pattern, Statement};
use proc_macro2::Span;
use quote::format_ident;
use syn::spanned::Spanned;
use syn::{Error, Expr, Ident, Lit, LitInt, Pat, Path, Result};

impl Scope {
    pub(super) fn match_expression(&mut self, match_: &syn::ExprMatch) -> Result<Expression> {
        let value = self.expression(&match_.expr);
        let number = self.matches;
        self.matches += 1;
        let (mut arms, mut named) = (Vec::new(), false);
        for arm in &match_.arms {
            super::refusals::refuse_attributes(&arm.attrs)?;
            let (pattern, guard) = match &arm.pat {
                Pat::Guard(guarded) => (&*guarded.pat, Some(&guarded.guard)),
                other => (other, None),
            };
            let name = name(pattern);
            named |= name.is_some();
            arms.push(self.nested(|scope| {
                if let Some(name) = name {
                    scope.bind(name, Binding::Matched(number));
                }
                let guard = guard.map(|guard| scope.expression(guard)).transpose()?;
                Ok::<_, Error>(Arm {
                    patterns: scope.patterns(pattern)?,
                    guard,
                    body: scope.branch(&arm.body)?,
                })
            })?);
        }
        let (value, span) = (Box::new(value?), match_.span());
        if !named {
            return Ok(Expression::Match { value, arms, span });
        }
        let name = matched(number);
        let match_ = Expression::Match { value: Box::new(Expression::Local(name.clone())), arms, span };
        let mut block = Block {
            statements: vec![Statement::Let { name, mutable: false, type_: None, value: *value }],
            value: None,
        };
        if match_.has_value() {
            block.value = Some(Box::new(match_));
        } else {
            block.statements.push(Statement::Expression(match_));
        }
        Ok(Expression::Block(block))
    }

    fn patterns(&mut self, pattern: &Pat) -> Result<Vec<Pattern>> {
        match pattern {
            Pat::Or(or) => {
                let mut all = Vec::new();
                for case in &or.cases {
                    all.extend(self.patterns(case)?);
                }
                Ok(all)
            }
            Pat::Paren(paren) => self.patterns(&paren.pat),
            Pat::Ident(name)
                if self.is_matched(&name.ident)
                    && let Some((_, whole)) = &name.subpat =>
            {
                self.patterns(whole)
            }
            other => self.pattern(other).map(|pattern| vec![pattern]),
        }
    }

    fn pattern(&mut self, pattern: &Pat) -> Result<Pattern> {
        match pattern {
            Pat::Wild(underscore) => Ok(Pattern::Any(underscore.span())),
            Pat::Lit(literal) => literal_pattern(&literal.lit),
            Pat::Ident(name) if name.by_ref.is_some() || name.mutability.is_some() => Err(
                Error::new_spanned(name, "a pattern gives a plain name: `name => …`, `name @ 1..=9 => …`"),
            ),
            Pat::Ident(name) if name.subpat.is_none() && is_constant(&name.ident) => {
                self.constant_pattern(&name.ident.clone().into())
            }
            Pat::Ident(name) if name.subpat.is_none() && self.is_matched(&name.ident) => {
                Ok(Pattern::Any(name.ident.span()))
            }
            Pat::Ident(name) => Err(Error::new_spanned(
                name,
                "only a whole pattern has a name: `name => …`, `name @ (1 | 3) => …`",
            )),
            Pat::Path(path) if path.qself.is_none() => self.constant_pattern(&path.path),
            Pat::Range(range) => {
                if let syn::RangeLimits::HalfOpen(token) = &range.limits {
                    return Err(Error::new_spanned(token, "name the last value of the range: `a..=b`"));
                }
                match (range.start.as_deref().and_then(integer), range.end.as_deref().and_then(integer)) {
                    (Some(from), Some(to)) => Ok(Pattern::Range(from, to)),
                    _ => Err(Error::new_spanned(
                        range,
                        "a range in a pattern has two integers as its ends, `1..=9`; use a guard for others: `_ if x > LIMIT => …`",
                    )),
                }
            }
            other => Err(unsupported(other)),
        }
    }

    fn is_matched(&self, name: &Ident) -> bool {
        matches!(self.binding(name), Some(Binding::Matched(_)))
    }

    fn constant_pattern(&mut self, path: &Path) -> Result<Pattern> {
        if self.is_generic_constant(path) {
            let name = path.get_ident().map(ToString::to_string).unwrap_or_default();
            return Err(Error::new_spanned(
                path,
                format!(
                    "a constant that the function is generic in is no pattern; compare: `if value == {name}`"
                ),
            ));
        }
        self.mentions.patterns.push(path.clone());
        Ok(Pattern::Constant(path.clone()))
    }
}

/// The name that a pattern gives to the whole value.
fn name(pattern: &Pat) -> Option<&Ident> {
    match pattern {
        Pat::Paren(paren) => name(&paren.pat),
        Pat::Ident(pattern) if pattern.subpat.is_some() || !is_constant(&pattern.ident) => {
            Some(&pattern.ident)
        }
        _ => None,
    }
}

/// The variable that holds the value of the `match` with this number.
pub(super) fn matched(number: usize) -> Ident {
    format_ident!("__xca_matched_{number}", span = Span::mixed_site())
}

/// Whether the word is written as constants are.
pub(super) fn is_constant(name: &Ident) -> bool {
    name.to_string().trim_start_matches('_').starts_with(char::is_uppercase)
}

fn unsupported(pattern: &Pat) -> Error {
    Error::new_spanned(
        pattern,
        "patterns in a process are integers, constants, ranges of integers (`a..=b`), alternatives (`a | b`) and `_`",
    )
}

fn literal_pattern(literal: &Lit) -> Result<Pattern> {
    match literal {
        Lit::Float(_) => Err(Error::new_spanned(literal, "compare floats with `if`, not with `match`")),
        Lit::Bool(_) => Ok(Pattern::Literal(literal.clone(), false)),
        Lit::Int(value) => {
            let (value, negative) = unsigned(value);
            Ok(Pattern::Literal(Lit::Int(value), negative))
        }
        _ => Err(Error::new_spanned(literal, "literals in a process are numbers, true and false")),
    }
}

/// An end of a range.
fn integer(expression: &Expr) -> Option<(LitInt, bool)> {
    match expression {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Int(value) => Some(unsigned(value)),
            _ => None,
        },
        _ => None,
    }
}

/// The number without its sign, and whether that was a minus; in a pattern the sign is part of the literal.
fn unsigned(literal: &LitInt) -> (LitInt, bool) {
    match literal.to_string().strip_prefix('-') {
        Some(number) => (LitInt::new(number, literal.span()), true),
        None => (literal.clone(), false),
    }
}
