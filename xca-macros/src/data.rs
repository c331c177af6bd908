//! The body of a function as data: an expression that builds the `::xca_core::ir::Function`, one to one from
//! the checked function.

mod loops;
mod words;

use crate::ast::{
    Argument, ArgumentNumber, Arm, Block, Expression, Function, FunctionKind, Pattern, Place, PlaceRoot,
    Projection, Role, Statement,
};
use proc_macro2::TokenStream;
use quote::{ToTokens, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Error, Ident, Lit, Path, Result};
use words::{
    binary_operator, bool_literal, builtin, each, float_literal, integer_literal, known_length, lane, lanes,
    optional, text, type_, unary_operator,
};
use xca_methods::Meaning;

/// An expression of type `::xca_core::ir::Function`.
pub(crate) fn function(function: &Function) -> Result<TokenStream> {
    let name = text(&function.name);
    let kind = match function.kind {
        FunctionKind::Cells => quote!(Cells),
        FunctionKind::Items => quote!(Items),
        FunctionKind::Migration => quote!(Migration),
        FunctionKind::Helper => quote!(Helper),
    };
    let arguments = each(&function.arguments, argument)?;
    let result = optional(function.result.as_ref(), type_)?;
    let body = block(&function.body)?;
    Ok(quote! {
        ::xca_core::ir::Function {
            name: #name,
            module: ::core::module_path!(),
            kind: ::xca_core::ir::FunctionKind::#kind,
            arguments: #arguments,
            result: #result,
            body: #body,
        }
    })
}

fn argument(argument: &Argument) -> Result<TokenStream> {
    let name = text(&argument.name);
    let role = match &argument.role {
        Role::Cell(substates) => quote!(Cell(<#substates as ::xca_core::Substates>::SCHEMA)),
        Role::Slot(substates) => quote!(Slot(<#substates as ::xca_core::Substates>::SCHEMA)),
        Role::Slots(substates) => quote!(Slots(<#substates as ::xca_core::Substates>::SCHEMA)),
        Role::Parameters(parameters) => quote!(Parameters(<#parameters as ::xca_core::Parameters>::SCHEMA)),
        Role::Space => quote!(Space),
        Role::Value(value) => {
            let value = type_(value)?;
            quote!(Value(#value))
        }
    };
    Ok(quote!(::xca_core::ir::Argument { name: #name, role: ::xca_core::ir::Role::#role }))
}

fn block(block: &Block) -> Result<TokenStream> {
    let statements = each(&block.statements, statement)?;
    let value = optional(block.value.as_deref(), boxed)?;
    Ok(quote!(::xca_core::ir::Block { statements: #statements, value: #value }))
}

fn statement(statement: &Statement) -> Result<TokenStream> {
    let variant = match statement {
        Statement::Let { name, mutable, type_: written, value } => {
            let name = text(name);
            let written = optional(written.as_ref(), type_)?;
            let value = expression(value)?;
            quote!(Let { name: #name, mutable: #mutable, type_: #written, value: #value })
        }
        Statement::LetTuple { parts, type_: written, value } => {
            let parts = each(parts, |part| {
                let mutable = part.mutable;
                let name = optional(part.name.as_ref(), |name| {
                    let name = text(name);
                    Ok(quote!(#name))
                })?;
                Ok(quote!(::xca_core::ir::TuplePart { name: #name, mutable: #mutable }))
            })?;
            let written = optional(written.as_ref(), type_)?;
            let value = expression(value)?;
            quote!(LetTuple { parts: #parts, type_: #written, value: #value })
        }
        Statement::LetNeighbour { name, index } => {
            let name = text(name);
            let index = expression(index)?;
            quote!(LetNeighbour { name: #name, index: #index })
        }
        Statement::Assign { place: assigned, operator, value, span } => {
            let place = place(assigned)?;
            let operator = optional(operator.as_ref(), |operator| binary_operator(operator, *span))?;
            let value = expression(value)?;
            quote!(Assign { place: #place, operator: #operator, value: #value })
        }
        Statement::Expression(value) => {
            let value = expression(value)?;
            quote!(Expression(#value))
        }
        Statement::Loop(loop_) => {
            let loop_ = loops::loop_(loop_)?;
            quote!(Loop(#loop_))
        }
        Statement::Break(label, _) => {
            let label = loops::label(label.as_ref());
            quote!(Break(#label))
        }
        Statement::Continue(label, _) => {
            let label = loops::label(label.as_ref());
            quote!(Continue(#label))
        }
        Statement::Return(value, _) => {
            let value = optional(value.as_ref(), expression)?;
            quote!(Return(#value))
        }
        Statement::Fault { code, value } => {
            let code = expression(code)?;
            let value = expression(value)?;
            quote!(Fault { code: #code, value: #value })
        }
    };
    Ok(quote!(::xca_core::ir::Statement::#variant))
}

fn place(place: &Place) -> Result<TokenStream> {
    let root = match &place.root {
        PlaceRoot::Local(name) => {
            let name = text(name);
            quote!(Local(#name))
        }
        PlaceRoot::Own(name) => {
            let name = text(name);
            quote!(Own(#name))
        }
    };
    let path = each(&place.path, |projection| {
        let variant = match projection {
            Projection::Component(name) => {
                let lane = lane(name)?;
                quote!(Component(#lane))
            }
            Projection::Element(index) => {
                let index = expression(index)?;
                quote!(Element(#index))
            }
        };
        Ok(quote!(::xca_core::ir::Projection::#variant))
    })?;
    Ok(quote!(::xca_core::ir::Place { root: ::xca_core::ir::PlaceRoot::#root, path: #path }))
}

fn expression(value: &Expression) -> Result<TokenStream> {
    let variant = match value {
        Expression::Bool(literal) => {
            let literal = bool_literal(literal);
            quote!(Literal(#literal))
        }
        Expression::Integer(literal) => {
            let literal = integer_literal(literal)?;
            quote!(Literal(#literal))
        }
        Expression::Float(literal) => {
            let literal = float_literal(literal)?;
            quote!(Literal(#literal))
        }
        Expression::Local(name) => {
            let name = text(name);
            quote!(Local(#name))
        }
        Expression::Constant(path) => return Ok(constant(path)),
        Expression::Own(field) => {
            let field = text(field);
            quote!(Own(#field))
        }
        Expression::OfCell { argument: ArgumentNumber(argument), field } => {
            let field = text(field);
            quote!(OfCell { argument: #argument, field: #field })
        }
        Expression::Neighbour { argument: ArgumentNumber(argument), index, field } => {
            let index = boxed(index)?;
            let field = text(field);
            quote!(Neighbour { argument: #argument, index: #index, field: #field })
        }
        Expression::NamedNeighbour { argument: ArgumentNumber(argument), name, field } => {
            let (name, field) = (text(name), text(field));
            quote!(NamedNeighbour { argument: #argument, name: #name, field: #field })
        }
        Expression::Other { argument: ArgumentNumber(argument), name, field } => {
            let (name, field) = (text(name), text(field));
            quote!(Other { argument: #argument, name: #name, field: #field })
        }
        Expression::OtherLabel(name) => {
            let name = text(name);
            quote!(OtherLabel(#name))
        }
        Expression::Parameter { argument, field } => {
            let (argument, field) = (text(argument), text(field));
            quote!(Parameter { argument: #argument, field: #field })
        }
        Expression::Parameters(argument) => {
            let argument = text(argument);
            quote!(Parameters(#argument))
        }
        Expression::Space(_) => quote!(Space),
        Expression::Builtin(which, arguments, _) => {
            let which = builtin(*which);
            let arguments = each(arguments, expression)?;
            quote!(Builtin(::xca_core::ir::Builtin::#which, #arguments))
        }
        Expression::Unary(operator, operand) => {
            let operator = unary_operator(operator)?;
            let operand = boxed(operand)?;
            quote!(Unary(#operator, #operand))
        }
        Expression::Binary(operator, left, right) => {
            let operator = binary_operator(operator, operator.span())?;
            let (left, right) = (boxed(left)?, boxed(right)?);
            quote!(Binary(#operator, #left, #right))
        }
        Expression::Cast(operand, target) => {
            let operand = boxed(operand)?;
            let target = type_(target)?;
            quote!(Cast(#operand, #target))
        }
        Expression::Call { function, constants, arguments } => {
            let arguments = each(arguments, expression)?;
            // With the span of the call, where constants are missing that the helper is generic in.
            let body = quote_spanned!(function.span()=> #function::body #constants);
            quote!(Call { function: #body, arguments: #arguments })
        }
        Expression::Method { method, name, receiver, arguments } => match method.meaning {
            Meaning::Operation(operation) => {
                let operation = Ident::new(&format!("{operation:?}"), name.span());
                let receiver = boxed(receiver)?;
                let arguments = each(arguments, expression)?;
                quote! {
                    Method {
                        method: ::xca_core::ir::Operation::#operation,
                        receiver: #receiver,
                        arguments: #arguments,
                    }
                }
            }
            Meaning::Function(function) => {
                let function = Ident::new(function, name.span());
                let mut values = vec![expression(receiver)?];
                for argument in arguments {
                    values.push(expression(argument)?);
                }
                quote! {
                    Call { function: ::xca_core::math::#function::body, arguments: ::std::vec![#(#values),*] }
                }
            }
        },
        Expression::Component(operand, name) => {
            let operand = boxed(operand)?;
            let lane = lane(name)?;
            quote!(Component(#operand, #lane))
        }
        Expression::Element(operand, index) => {
            let (operand, index) = (boxed(operand)?, boxed(index)?);
            quote!(Element(#operand, #index))
        }
        Expression::Array(elements, _) => {
            let elements = each(elements, expression)?;
            quote!(Array(#elements))
        }
        Expression::Tuple(parts, _) => {
            let parts = each(parts, expression)?;
            quote!(Tuple(#parts))
        }
        Expression::Repeat(element, length) => {
            let element = boxed(element)?;
            let length = known_length(length);
            quote!(Repeat(#element, #length))
        }
        Expression::Vector(name, components) => {
            let lanes = usize::from(lanes(name)?);
            if components.len() != lanes {
                let found = components.len();
                return Err(Error::new(
                    name.span(),
                    format!("{name}::new takes {lanes} values, not {found}"),
                ));
            }
            let components = each(components, expression)?;
            quote!(Vector(#components))
        }
        Expression::Splat(name, component) => {
            let lanes = lanes(name)?;
            let component = boxed(component)?;
            quote!(Splat(#component, #lanes))
        }
        Expression::If { condition, then, otherwise, .. } => {
            let condition = boxed(condition)?;
            let then = block(then)?;
            let otherwise = optional(otherwise.as_ref(), block)?;
            quote!(If { condition: #condition, then: #then, otherwise: #otherwise })
        }
        Expression::Match { value, arms, .. } => {
            let value = boxed(value)?;
            let arms = each(arms, arm)?;
            quote!(Match { value: #value, arms: #arms })
        }
        Expression::Block(inner) => {
            let inner = block(inner)?;
            quote!(Block(#inner))
        }
    };
    Ok(quote!(::xca_core::ir::Expression::#variant))
}

fn constant(path: &Path) -> TokenStream {
    let name = path.to_token_stream().to_string().replace(' ', "");
    // The span is the user's, so that a constant of another type is reported where it stands.
    let value = quote_spanned!(path.span()=> ::xca_core::ir::ConstantValue::constant(&#path));
    quote!(::xca_core::ir::Expression::Constant { name: #name, value: #value })
}

fn arm(arm: &Arm) -> Result<TokenStream> {
    let patterns = each(&arm.patterns, pattern)?;
    let guard = optional(arm.guard.as_ref(), expression)?;
    let body = block(&arm.body)?;
    Ok(quote!(::xca_core::ir::Arm { patterns: #patterns, guard: #guard, body: #body }))
}

fn pattern(pattern: &Pattern) -> Result<TokenStream> {
    let variant = match pattern {
        Pattern::Any(_) => quote!(Any),
        Pattern::Literal(literal, negative) => {
            let value = match literal {
                Lit::Bool(literal) => bool_literal(literal),
                Lit::Int(literal) => integer_literal(literal)?,
                other => {
                    return Err(Error::new(
                        other.span(),
                        "a pattern is an integer, a constant, a range or `_`",
                    ));
                }
            };
            let value = negated(quote!(::xca_core::ir::Expression::Literal(#value)), *negative);
            quote!(Value(#value))
        }
        Pattern::Constant(path) => {
            let value = constant(path);
            quote!(Value(#value))
        }
        Pattern::Range((from, from_negative), (to, to_negative)) => {
            let (from, to) = (integer_literal(from)?, integer_literal(to)?);
            let from = negated(quote!(::xca_core::ir::Expression::Literal(#from)), *from_negative);
            let to = negated(quote!(::xca_core::ir::Expression::Literal(#to)), *to_negative);
            quote!(Range(#from, #to))
        }
    };
    Ok(quote!(::xca_core::ir::Pattern::#variant))
}

fn negated(value: TokenStream, negative: bool) -> TokenStream {
    if negative {
        quote! {
            ::xca_core::ir::Expression::Unary(
                ::xca_core::ir::UnaryOperator::Negate,
                ::std::boxed::Box::new(#value),
            )
        }
    } else {
        value
    }
}

fn boxed(value: &Expression) -> Result<TokenStream> {
    let value = expression(value)?;
    Ok(quote!(::std::boxed::Box::new(#value)))
}
