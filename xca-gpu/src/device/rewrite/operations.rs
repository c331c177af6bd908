//! Operations of floats replaced by calls of functions.

mod text;

use super::module::Checked;
use super::operation::{Kind, Manner, Operation};
use crate::device::corrections::Corrections;
use naga::{
    Block, Expression, Function, Handle, MathFunction, Module, Range, ScalarKind, Span, Statement, TypeInner,
};
use std::collections::{BTreeSet, HashMap};

/// The operations that are replaced, and by what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::device) struct Replacements {
    pub(in crate::device) manner: Manner,
    pub(in crate::device) of: Corrections,
}

impl Replacements {
    fn replaces(self, operation: Operation) -> bool {
        let of = match operation.kind {
            Kind::Quotient => self.of.divisions,
            Kind::Root => self.of.roots,
            Kind::Truncation | Kind::Floor | Kind::Ceiling => self.of.roundings,
        };
        match operation.width {
            4 => of[0],
            8 => of[1],
            _ => false,
        }
    }

    /// The functions that stand for the operations of the code.
    pub(super) fn text(self, code: &Checked) -> String {
        let mut needed = BTreeSet::new();
        for (handle, function) in code.module.functions.iter() {
            needed.extend(operations(&code.module, function, &code.info[handle]).map(|(_, found)| found));
        }
        for (number, entry) in code.module.entry_points.iter().enumerate() {
            let info = code.info.get_entry_point(number);
            needed.extend(operations(&code.module, &entry.function, info).map(|(_, found)| found));
        }
        needed.retain(|operation| self.replaces(*operation));
        text::functions(self.manner, &needed)
    }
}

/// The operations of floats in a function that can be replaced.
fn operations<'a>(
    module: &'a Module,
    function: &'a Function,
    info: &'a naga::valid::FunctionInfo,
) -> impl Iterator<Item = (Handle<Expression>, Operation)> + 'a {
    function.expressions.iter().filter_map(|(handle, expression)| {
        let kind = match expression {
            Expression::Binary { op: naga::BinaryOperator::Divide, .. } => Kind::Quotient,
            Expression::Math { fun: MathFunction::Sqrt, .. } => Kind::Root,
            Expression::Math { fun: MathFunction::Trunc, .. } => Kind::Truncation,
            Expression::Math { fun: MathFunction::Floor, .. } => Kind::Floor,
            Expression::Math { fun: MathFunction::Ceil, .. } => Kind::Ceiling,
            _ => return None,
        };
        let (scalar, lanes) = match info[handle].ty.inner_with(&module.types) {
            TypeInner::Scalar(scalar) => (scalar, 1),
            TypeInner::Vector { size, scalar } => (scalar, *size as u8),
            _ => return None,
        };
        let operation = Operation { kind, width: scalar.width, lanes };
        (scalar.kind == ScalarKind::Float).then_some((handle, operation))
    })
}

/// Replaces the operations, outside of the functions that stand for them. Tells whether there were any.
pub(super) fn replace(code: &mut Checked, replacements: Replacements) -> Result<bool, String> {
    let Checked { module, info } = code;
    let names: HashMap<String, Handle<Function>> = module
        .functions
        .iter()
        .filter_map(|(handle, function)| Some((function.name.clone()?, handle)))
        .collect();
    let calls = |module: &Module, function: &Function, info: &naga::valid::FunctionInfo| {
        let mut calls = Calls::new();
        let own = function.name.as_deref().unwrap_or_default();
        if text::stands_for_operation(replacements.manner, own) {
            return Ok(calls);
        }
        for (handle, operation) in operations(module, function, info) {
            if replacements.replaces(operation) {
                let name = text::name(replacements.manner, operation);
                let callee = names.get(&name).ok_or_else(|| format!("there is no function {name}"))?;
                calls.insert(handle, *callee);
            }
        }
        Ok::<_, String>(calls)
    };
    let mut any = false;
    let handles: Vec<_> = module.functions.iter().map(|(handle, _)| handle).collect();
    for handle in handles {
        let calls = calls(module, &module.functions[handle], &info[handle])?;
        any |= !calls.is_empty();
        call(module.functions.get_mut(handle), &calls);
    }
    for number in 0..module.entry_points.len() {
        let calls = calls(module, &module.entry_points[number].function, info.get_entry_point(number))?;
        any |= !calls.is_empty();
        call(&mut module.entry_points[number].function, &calls);
    }
    Ok(any)
}

/// The functions that are called in place of expressions.
type Calls = HashMap<Handle<Expression>, Handle<Function>>;

fn call(function: &mut Function, calls: &Calls) {
    if calls.is_empty() {
        return;
    }
    let mut arguments = HashMap::new();
    for (handle, callee) in calls {
        let expression = function.expressions.get_mut(*handle);
        let operands = match expression {
            Expression::Binary { left, right, .. } => vec![*left, *right],
            Expression::Math { arg, .. } => vec![*arg],
            _ => Vec::new(),
        };
        *expression = Expression::CallResult(*callee);
        arguments.insert(*handle, operands);
    }
    let body = std::mem::take(&mut function.body);
    function.body = called(body, calls, &arguments);
}

/// A block in which expressions are computed up to a call, then the call is made.
fn called(
    block: Block,
    calls: &Calls,
    arguments: &HashMap<Handle<Expression>, Vec<Handle<Expression>>>,
) -> Block {
    let inside = |block| called(block, calls, arguments);
    let mut out = Block::new();
    for (statement, span) in block.span_into_iter() {
        let statement = match statement {
            Statement::Emit(range) => {
                emit(&mut out, range, calls, arguments);
                continue;
            }
            Statement::Block(block) => Statement::Block(inside(block)),
            Statement::If { condition, accept, reject } => {
                Statement::If { condition, accept: inside(accept), reject: inside(reject) }
            }
            Statement::Switch { selector, mut cases } => {
                for case in &mut cases {
                    case.body = inside(std::mem::take(&mut case.body));
                }
                Statement::Switch { selector, cases }
            }
            Statement::Loop { body, continuing, break_if } => {
                Statement::Loop { body: inside(body), continuing: inside(continuing), break_if }
            }
            other => other,
        };
        out.push(statement, span);
    }
    out
}

fn emit(
    out: &mut Block,
    range: Range<Expression>,
    calls: &Calls,
    arguments: &HashMap<Handle<Expression>, Vec<Handle<Expression>>>,
) {
    let mut run: Option<(Handle<Expression>, Handle<Expression>)> = None;
    let flush = |out: &mut Block, run: &mut Option<(Handle<Expression>, Handle<Expression>)>| {
        if let Some((first, last)) = run.take() {
            out.push(Statement::Emit(Range::new_from_bounds(first, last)), Span::default());
        }
    };
    for handle in range {
        if let Some(function) = calls.get(&handle) {
            flush(out, &mut run);
            let arguments = arguments.get(&handle).cloned().unwrap_or_default();
            let call = Statement::Call { function: *function, arguments, result: Some(handle) };
            out.push(call, Span::default());
        } else {
            run = Some((run.map_or(handle, |(first, _)| first), handle));
        }
    }
    flush(out, &mut run);
}
