//! `match` and its patterns.

use super::scope::Scope;
use crate::ast::{Arm, Expression, Pattern};
use syn::spanned::Spanned;
use syn::{Error, Expr, Lit, LitInt, Pat, Path, Result};
use xca_spelling::is_constant;

impl Scope {
    pub(super) fn match_expression(&mut self, match_: &syn::ExprMatch) -> Result<Expression> {
        let value = self.expression(&match_.expr);
        let mut arms = Vec::new();
        for arm in &match_.arms {
            super::refusals::refuse_attributes(&arm.attrs)?;
            let (pattern, guard) = match &arm.pat {
                Pat::Guard(guarded) => (&*guarded.pat, Some(self.expression(&guarded.guard)?)),
                other => (other, None),
            };
            let patterns = self.patterns(pattern)?;
            arms.push(Arm { patterns, guard, body: self.branch(&arm.body)? });
        }
        Ok(Expression::Match { value: Box::new(value?), arms, span: match_.span() })
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
            other => self.pattern(other).map(|pattern| vec![pattern]),
        }
    }

    fn pattern(&mut self, pattern: &Pat) -> Result<Pattern> {
        match pattern {
            Pat::Wild(underscore) => Ok(Pattern::Any(underscore.span())),
            Pat::Lit(literal) => literal_pattern(&literal.lit),
            Pat::Ident(name) if name.subpat.is_none() && is_constant(&name.ident) => {
                self.constant_pattern(&name.ident.clone().into())
            }
            Pat::Ident(name) => Err(Error::new_spanned(
                name,
                "a pattern gives a plain name to the whole value: `name => …`, `name @ (1 | 3) => …`",
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
