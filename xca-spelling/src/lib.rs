//! Rust that is spelled out in simpler Rust before the check of the subset: `matches!`, names in patterns,
//! iterators. The compiler checks the original, so what it refuses need not be refused here.

mod chains;
mod patterns;
mod spelled;

use chains::is_chain;
use syn::visit_mut::VisitMut;
use syn::{Error, Expr, ExprClosure, ExprMethodCall, ItemFn, Local, Pat, Stmt, Type, parse_quote};

pub use patterns::spell_out_matches;
pub use spelled::{Spelled, is_constant, strip};

/// Spells out a function.
pub fn spell_out(function: &ItemFn) -> Spelled {
    let mut spelled =
        Spelled { function: function.clone(), references: Vec::new(), errors: Vec::new(), in_closure: false };
    let mut block = spelled.function.block.clone();
    // The type of `values.iter().sum()` at the end is that of the result.
    if let (syn::ReturnType::Type(_, type_), Some(Stmt::Expr(value, None))) =
        (&function.sig.output, block.stmts.last_mut())
    {
        give_type(value, type_);
    }
    spelled.visit_block_mut(&mut block);
    spelled.function.block = block;
    spelled
}

impl VisitMut for Spelled {
    fn visit_expr_closure_mut(&mut self, closure: &mut ExprClosure) {
        let outside = std::mem::replace(&mut self.in_closure, true);
        syn::visit_mut::visit_expr_closure_mut(self, closure);
        self.in_closure = outside;
    }

    fn visit_expr_return_mut(&mut self, return_: &mut syn::ExprReturn) {
        // It would leave the whole function.
        if self.in_closure {
            self.errors.push(Error::new_spanned(return_, "a closure ends with its value, without `return`"));
        }
    }

    fn visit_local_mut(&mut self, local: &mut Local) {
        // `let total: Real = values.iter().sum();`
        if let (Pat::Type(typed), Some(init)) = (&local.pat, &mut local.init) {
            give_type(&mut init.expr, &typed.ty);
        }
        syn::visit_mut::visit_local_mut(self, local);
    }

    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        syn::visit_mut::visit_expr_mut(self, expression);
        let spelled = match expression {
            Expr::ForLoop(for_) => self.for_loop(for_).map(Some),
            Expr::Match(match_) => Ok(patterns::named(match_)),
            Expr::MethodCall(call) if call.method == "contains" => self.contains(call).map(Some),
            Expr::MethodCall(call) if is_chain(call) => self.chain(call).map(Some),
            _ => return,
        };
        match spelled {
            Ok(Some(spelled)) => *expression = spelled,
            Ok(None) => {}
            Err(error) => {
                self.errors.push(error);
                *expression = parse_quote!(false);
            }
        }
    }
}

/// Gives a sum without a type the one that stands beside it.
fn give_type(value: &mut Expr, type_: &Type) {
    if let Expr::MethodCall(ExprMethodCall { method, turbofish: turbofish @ None, .. }) = value
        && method == "sum"
    {
        *turbofish = Some(parse_quote!(::<#type_>));
    }
}
