//! `matches!(value, pattern)` as the `match` that it stands for.

use syn::visit_mut::VisitMut;
use syn::{Expr, ExprMatch, Macro, Pat, Result, Stmt, Token, parse_quote};

/// Spells out each `matches!` of a function, so that its parts are read like the rest of the body.
pub(crate) fn spell_out(function: &mut syn::ItemFn) {
    Spell.visit_block_mut(&mut function.block);
}

struct Spell;

impl VisitMut for Spell {
    fn visit_stmt_mut(&mut self, statement: &mut Stmt) {
        if let Stmt::Macro(call) = statement
            && let Some(Ok(match_)) = matched(&call.mac)
        {
            *statement = Stmt::Expr(Expr::Match(match_), call.semi_token);
        }
        syn::visit_mut::visit_stmt_mut(self, statement);
    }

    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        if let Expr::Macro(call) = expression
            && let Some(Ok(match_)) = matched(&call.mac)
        {
            *expression = Expr::Match(match_);
        }
        syn::visit_mut::visit_expr_mut(self, expression);
    }
}

/// The `match`, where the macro is `matches!`.
fn matched(call: &Macro) -> Option<Result<ExprMatch>> {
    call.path.is_ident("matches").then(|| {
        call.parse_body_with(|input: syn::parse::ParseStream<'_>| {
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
    })
}
