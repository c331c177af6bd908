//! The functions that stand for operations, as WGSL.

mod quotients;
mod roundings;

use crate::device::rewrite::operation::{Kind, Manner, Operation};
use std::collections::BTreeSet;

/// Whether a function of this name keeps its operations: in corrected ones those of the driver remain, be
/// they rough.
pub(super) fn stands_for_operation(manner: Manner, name: &str) -> bool {
    let rough = name.starts_with(Manner::Rough.prefix());
    rough || manner == Manner::Corrected && name.starts_with(Manner::Corrected.prefix())
}

/// The name of the function that stands for an operation.
pub(super) fn name(manner: Manner, operation: Operation) -> String {
    let word = match operation.kind {
        Kind::Quotient => "quotient",
        Kind::Root => "root",
        Kind::Truncation => "truncation",
        Kind::Floor => "floor",
        Kind::Ceiling => "ceiling",
    };
    let lanes = if operation.lanes > 1 { format!("_{}", operation.lanes) } else { String::new() };
    format!("{}{word}_{}{lanes}", manner.prefix(), scalar(operation.width))
}

fn scalar(width: u8) -> &'static str {
    if width == 8 { "f64" } else { "f32" }
}

/// The functions for operations, with all that they call. A corrected function divides and takes roots as
/// the driver does.
pub(super) fn functions(manner: Manner, operations: &BTreeSet<Operation>) -> String {
    let mut text = String::new();
    for width in [4, 8] {
        let of_width = || operations.iter().filter(|operation| operation.width == width);
        let is_quotient = |operation: &&Operation| matches!(operation.kind, Kind::Quotient | Kind::Root);
        if of_width().any(|operation| is_quotient(&operation)) {
            text += &quotients::text(manner, width);
        }
        if !of_width().all(|operation| is_quotient(&operation)) {
            text += &roundings::text(manner, scalar(width));
        }
        for operation in of_width().filter(|operation| operation.lanes > 1) {
            text += &by_lanes(manner, *operation);
        }
    }
    text
}

/// An operation of vectors, lane by lane.
fn by_lanes(manner: Manner, operation: Operation) -> String {
    let vector = format!("vec{}<{}>", operation.lanes, scalar(operation.width));
    let one = name(manner, Operation { lanes: 1, ..operation });
    let of_two = operation.kind == Kind::Quotient;
    let lanes = ["x", "y", "z", "w"]
        .iter()
        .take(operation.lanes.into())
        .map(|lane| if of_two { format!("{one}(a.{lane}, b.{lane})") } else { format!("{one}(a.{lane})") });
    let lanes = lanes.collect::<Vec<_>>().join(", ");
    let arguments = if of_two { format!("a: {vector}, b: {vector}") } else { format!("a: {vector}") };
    let name = name(manner, operation);
    format!("fn {name}({arguments}) -> {vector} {{\n    return {vector}({lanes});\n}}\n")
}
