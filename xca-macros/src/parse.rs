//! The front end: from Rust's syntax to the checked function.
//!
//! Everything outside the accepted subset is refused here, at the user's own tokens, with what to write instead.

mod expressions;
mod scope;
mod signature;
mod statements;

use crate::ast::{Function, FunctionKind};
use scope::Scope;
pub(crate) use statements::plain_operator;

/// Parses and checks a function of the given kind; for processes the kind (cells or items) follows from the first argument.
pub(crate) fn function(item: &syn::ItemFn, wanted: Wanted) -> syn::Result<Function> {
    let signature = signature::parse(item, wanted)?;
    let mut scope = Scope::new(signature.kind, &signature.arguments);
    let body = scope.block(&item.block);
    scope.finish()?;
    let body = body?;
    if let (FunctionKind::Helper | FunctionKind::Migration, None) = (signature.kind, &body.value)
        && !statements::ends_in_return(&body)
    {
        return Err(syn::Error::new_spanned(&item.sig.output, "the function ends without a value"));
    }
    Ok(Function {
        name: item.sig.ident.clone(),
        visibility: item.vis.clone(),
        attributes: item.attrs.clone(),
        kind: signature.kind,
        arguments: signature.arguments,
        result: signature.result,
        body,
    })
}

/// Which attribute stands on the function.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    Process,
    Migration,
    Helper,
}
