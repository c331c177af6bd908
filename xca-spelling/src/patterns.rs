//! Names in the patterns of a `match`, and `matches!`.

use crate::spelled::{hidden, is_constant};
use syn::visit_mut::VisitMut;
use syn::{Expr, ExprMatch, Ident, ItemFn, Macro, Pat, Result, Stmt, StmtMacro, Token, parse_quote};

/// Writes each `matches!(value, pattern)` of a function as the `match` that it stands for.
pub fn spell_out_matches(function: &mut ItemFn) {
    Matches.visit_block_mut(&mut function.block);
}

struct Matches;

impl VisitMut for Matches {
    fn visit_stmt_mut(&mut self, statement: &mut Stmt) {
        if let Stmt::Macro(StmtMacro { mac, semi_token, .. }) = statement {
            *statement = Stmt::Expr(parse_quote!(#mac), *semi_token);
        }
        syn::visit_mut::visit_stmt_mut(self, statement);
    }

    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        if let Expr::Macro(call) = expression
            && let Ok(match_) = matched(&call.mac)
        {
            *expression = match_;
        }
        syn::visit_mut::visit_expr_mut(self, expression);
    }
}

fn matched(call: &Macro) -> Result<Expr> {
    call.parse_body_with(|input: syn::parse::ParseStream<'_>| {
        if !call.path.is_ident("matches") {
            return Err(input.error("another macro"));
        }
        let value: Expr = input.parse()?;
        input.parse::<Token![,]>()?;
        let pattern = Pat::parse_multi_with_leading_vert(input)?;
        let guard: Option<(Token![if], Expr)> =
            if input.peek(Token![if]) { Some((input.parse()?, input.parse()?)) } else { None };
        input.parse::<Option<Token![,]>>()?;
        let guard = guard.map(|(token, guard)| quote::quote!(#token #guard));
        Ok(parse_quote! {
            match #value {
                #pattern #guard => true,
                _ => false,
            }
        })
    })
}

/// A `match` whose patterns give names to the whole value, without these names.
pub(crate) fn named(match_: &ExprMatch) -> Option<Expr> {
    let mut match_ = match_.clone();
    let (value, matched) = (match_.expr.clone(), hidden("matched"));
    let mut has_names = false;
    for arm in &mut match_.arms {
        let (pattern, guard) = match &mut arm.pat {
            Pat::Guard(guarded) => (&mut *guarded.pat, Some(&mut guarded.guard)),
            pattern => (pattern, None),
        };
        let Some(name) = take_name(pattern) else { continue };
        has_names = true;
        if let Some(guard) = guard {
            **guard = parse_quote!({ let #name = #matched; #guard });
        }
        let body = &arm.body;
        arm.body = parse_quote!({ let #name = #matched; #body });
    }
    match_.expr = parse_quote!(#matched);
    has_names.then(|| parse_quote!({ let #matched = #value; #match_ }))
}

/// Takes the name that a pattern gives to the whole value.
fn take_name(pattern: &mut Pat) -> Option<Ident> {
    match pattern {
        Pat::Paren(paren) => take_name(&mut paren.pat),
        Pat::Ident(whole) if whole.by_ref.is_none() && whole.mutability.is_none() => {
            let name = whole.ident.clone();
            let rest = match whole.subpat.take() {
                Some((_, rest)) => *rest,
                None if is_constant(&name) => return None,
                None => parse_quote!(_),
            };
            *pattern = rest;
            Some(name)
        }
        _ => None,
    }
}
