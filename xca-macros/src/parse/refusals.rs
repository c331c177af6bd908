//! What is no part of a process, and what to write instead.

use super::scope::Binding;
use crate::ast::FunctionKind;
use syn::{Attribute, Error, Expr, Ident, Result};
use xca_methods::METHODS;

/// What to write instead of a write to an element of an iterator.
pub(super) const WRITE_BY_INDEX: &str =
    "elements are written by their index: `for i in 0..values.len() { values[i] = …; }`";

/// Why an expression is no part of a process.
pub(super) fn refused(expression: &Expr) -> Error {
    let advice = match expression {
        Expr::Macro(call) => return macro_call(&call.mac),
        Expr::Closure(_) => {
            "a closure stands only in a chain, such as `(0..n).any(|i| …)`; write the code in place, or as a \
             function marked #[helper]"
        }
        Expr::Reference(_) | Expr::RawAddr(_) => {
            "there are no references in a process: use the value itself, without `&`"
        }
        Expr::Tuple(tuple) if tuple.elems.is_empty() => {
            "`()` is not part of a process; write an empty block, `{}`"
        }
        Expr::Tuple(_) => "a tuple has two parts or more: leave out the comma",
        Expr::Struct(_) => {
            "structs cannot be made in a process; assign the substates one by one: `cell.substate = …`"
        }
        Expr::Range(_) => "a range stands only in `for i in 0..n` and in patterns",
        Expr::Let(_) => "`let` in a condition is not part of a process; compare with `==`, or with `match`",
        Expr::Unsafe(_) => "unsafe code is not part of a process",
        Expr::Const(_) => "`const` blocks are not part of a process; write a constant beside it",
        Expr::Try(_) => {
            "`?` is not part of a process; report an impossible state by `cell.fault(code, value);`"
        }
        Expr::Await(_) | Expr::Async(_) => "asynchronous code is not part of a process",
        Expr::Assign(_) => "an assignment has no value; write it as a statement of its own",
        Expr::While(_) | Expr::Loop(_) | Expr::ForLoop(_) => {
            "a loop has no value here; assign the result to a variable within the loop"
        }
        Expr::Break(_) | Expr::Continue(_) | Expr::Return(_) => {
            "this has no value; write it as a statement of its own"
        }
        Expr::Block(block) if block.label.is_some() => {
            "only loops have labels in a process; use `if`, or a function marked #[helper] with `return`"
        }
        Expr::Infer(_) => "give the value; `_` stands only in patterns and in `for _ in 0..n`",
        _ => "this is not part of the Rust that a process can use",
    };
    Error::new_spanned(expression, advice)
}

pub(super) fn macro_call(call: &syn::Macro) -> Error {
    let name = call.path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
    let advice = match name.as_str() {
        "assert" | "assert_eq" | "assert_ne" | "debug_assert" | "debug_assert_eq" | "panic" | "todo"
        | "unreachable" | "unimplemented" => {
            "a process does not panic; report an impossible state by `cell.fault(code, value);`, which stops the run and names the cell"
        }
        "print" | "println" | "eprint" | "eprintln" | "dbg" => {
            "a process cannot print; write what you want to see into a substate and look at it between steps"
        }
        "vec" => "there are no lists in a process; use an array of fixed length: `[0.0; 4]`",
        "matches" => "write `matches!(value, pattern)`",
        _ => {
            "macros cannot be called in a process; write the code in place, or as a function marked #[helper]"
        }
    };
    Error::new_spanned(call, advice)
}

pub(super) fn cannot_write(binding: Binding, kind: FunctionKind) -> &'static str {
    match binding {
        Binding::Neighbour(_) => {
            "a process writes only its own cell, not a neighbour; let each cell compute what it receives, from what it reads of its \
             neighbours"
        }
        Binding::Other(_) if kind == FunctionKind::Cells => {
            "a process over cells cannot write the items; a process over items can: `fn name(me: &mut Slot<…>, cell: &Cell<…>)`"
        }
        Binding::Other(_) => {
            "a process writes only its own item, not another; let each item compute the effect on itself"
        }
        Binding::Cell(_) if kind == FunctionKind::Cells => {
            "a process writes one struct of the cell, its first argument; write the others in processes of their own"
        }
        Binding::Cell(_) => {
            "a process over items cannot write the cell; a process over cells can, and reads the items through `slots: &Slots<…>`"
        }
        Binding::Slots(_) => {
            "a process over cells cannot write the items; a process over items can: `fn name(me: &mut Slot<…>, cell: &Cell<…>)`"
        }
        Binding::Parameters => {
            "parameters are the same in all cells; only steering changes them, between steps"
        }
        Binding::Space => "the space cannot be changed",
        Binding::Subject if kind == FunctionKind::Migration => {
            "a migration only says where the item goes; change its substates in an elementary process"
        }
        Binding::Subject | Binding::Value | Binding::Argument => "this cannot be written in a process",
    }
}

/// Attributes that only speak to the compiler or to tools are harmless; others would be lost.
pub(super) fn refuse_attributes(attributes: &[Attribute]) -> Result<()> {
    let harmless = ["allow", "expect", "warn", "deny", "doc", "rustfmt"];
    let refused = attributes.iter().find(|attribute| {
        attribute.path().segments.first().is_none_or(|first| !harmless.iter().any(|word| first.ident == word))
    });
    match refused {
        Some(attribute) => {
            Err(Error::new_spanned(attribute, "this attribute has no meaning within a process"))
        }
        None => Ok(()),
    }
}

pub(super) fn is_component(name: &Ident) -> bool {
    name == "x" || name == "y" || name == "z" || name == "w"
}

pub(super) fn no_component(name: &Ident) -> Error {
    Error::new_spanned(
        name,
        format!("`{name}` is no component: those of a vector are x, y, z and w; numbers have none"),
    )
}

/// What to write for a method that Rust has and a process has not.
pub(super) fn no_method(name: &str) -> Option<String> {
    let instead = match name {
        "mul_add" => {
            return Some("`mul_add` rounds once and differs between engines; write `a * b + c`".to_owned());
        }
        "log" => "x.ln() / base.ln()",
        "sin_cos" => "x.sin()` and `x.cos()",
        "asinh" => "(x + (x * x + 1.0).sqrt()).ln()",
        "acosh" => "(x + (x * x - 1.0).sqrt()).ln()",
        "atanh" => "0.5 * ((1.0 + x) / (1.0 - x)).ln()",
        "pow" => "x.powi(3)` or, for integers, `x * x * x",
        "round_ties_even" => "x.round()",
        "is_sign_positive" => "!x.is_sign_negative()",
        "is_positive" => "x > 0",
        "is_negative" => "x < 0",
        "abs_diff" => "a.max(b) - a.min(b)",
        "is_empty" => "values.len() == 0",
        "total_cmp" | "partial_cmp" | "cmp" => "a < b",
        "normalized" | "normalise" => "vector.normalize()",
        "norm" | "magnitude" => "vector.length()",
        "norm_squared" | "magnitude_squared" => "vector.length_squared()",
        _ => return None,
    };
    Some(format!("`{name}` is not part of a process; write `{instead}`"))
}

/// Why a method of Rust is no method of numbers in a process.
pub(super) fn method(method: &Ident) -> Error {
    let name = method.to_string();
    if let Some(advice) = no_method(&name) {
        return Error::new_spanned(method, advice);
    }
    let advice = match name.as_str() {
        "clone" | "to_owned" | "copied" => format!("values are copied by themselves: leave out `.{name}()`"),
        "into" | "try_into" => {
            format!("`{name}` is not part of a process; cast: `value as Real`, `value as u32`")
        }
        "iter" | "into_iter" | "iter_mut" | "enumerate" | "map" | "filter" | "any" | "all" | "count"
        | "sum" | "fold" => {
            "iterators stand in a `for` and in chains that end in any, all, count, sum or fold: \
                     `values.iter().any(|value| …)`"
                .to_owned()
        }
        "zip" | "skip" | "take" | "chain" | "windows" | "chunks" | "position" | "find" | "last"
        | "for_each" => {
            format!("a process has no `{name}`; write a loop: `for i in 0..values.len() {{ … values[i] … }}`")
        }
        "push" | "pop" | "insert" | "remove" | "extend" | "collect" => {
            format!(
                "there are no lists in a process, so no `{name}`; use an array, such as `[0.0; 8]`, and a counter"
            )
        }
        "unwrap" | "expect" | "unwrap_or" | "unwrap_or_default" | "is_some" | "is_none" | "ok" => {
            format!(
                "there is no `Option` and no `Result` in a process, so no `{name}`; use a value and a `bool`"
            )
        }
        "rev" | "step_by" => format!("`{name}` stands only in `for i in (a..b).{name}(…)`"),
        _ => {
            let known = METHODS.iter().map(|method| method.name);
            match super::similar::similar(&name, known.clone()) {
                Some(similar) => format!("there is no method `{name}`; did you mean `{similar}`?"),
                None => {
                    let all: Vec<&str> = known.collect();
                    format!(
                        "`{name}` is not part of a process; numbers, vectors and arrays have {}",
                        all.join(", ")
                    )
                }
            }
        }
    };
    Error::new_spanned(method, advice)
}
