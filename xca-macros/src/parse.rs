//! The front end: from Rust's syntax to the checked function.
//!
//! Everything outside the accepted subset is refused here, at the user's own tokens, with what to write
//! instead.

mod calls;
mod draws;
mod expressions;
mod loops;
mod matches;
mod places;
mod refusals;
mod scope;
mod signature;
mod similar;
mod statements;
mod wanted;

use crate::ast::{Function, FunctionKind, Role};
use crate::checked::checked;
pub(crate) use places::plain_operator;
use scope::Scope;
use syn::{Error, Result};
pub(crate) use wanted::Wanted;
use xca_spelling::Spelled;

/// Parses and checks a function of the given kind; for processes the kind (cells or items) follows from the
/// first argument.
pub(crate) fn function(spelled: Spelled, wanted: Wanted) -> Result<Function> {
    let item = &spelled.function;
    let signature = signature::parse(item, wanted)?;
    let mut scope =
        Scope::new(signature.kind, item.sig.ident.clone(), &signature.arguments, &signature.constants);
    scope.mentions.references = spelled.references;
    spelled.errors.into_iter().for_each(|error| scope.keep(error));
    let body = scope.block(&item.block);
    scope.finish()?;
    let body = body?;
    draws::check(&body)?;
    let answers = matches!(signature.kind, FunctionKind::Helper | FunctionKind::Migration);
    if answers && body.value.is_none() && !statements::ends_in_return(&body) {
        return Err(Error::new_spanned(
            &item.sig.output,
            "the function ends without this value; end it with the value, without `;`",
        ));
    }
    if !answers
        && body.value.is_some()
        && let Some(last) = item.block.stmts.last()
    {
        return Err(Error::new_spanned(
            last,
            "an elementary process has no value; assign it to a substate: `cell.substate = …;`",
        ));
    }
    let mut mentions = scope.mentions;
    let mut arguments = signature.arguments;
    for argument in &mut arguments {
        match &mut argument.role {
            Role::Cell(type_) | Role::Slot(type_) | Role::Slots(type_) => {
                mentions.substates.push(std::mem::replace(type_, checked(type_)));
            }
            Role::Parameters(type_) => {
                mentions.parameters.push(std::mem::replace(type_, checked(type_)));
            }
            Role::Value(type_) => mentions.types.push(type_.clone()),
            Role::Space => {}
        }
    }
    mentions.types.extend(signature.result.clone());
    Ok(Function {
        name: item.sig.ident.clone(),
        visibility: item.vis.clone(),
        attributes: item.attrs.clone(),
        kind: signature.kind,
        constants: signature.constants,
        arguments,
        result: signature.result,
        body,
        mentions,
    })
}
