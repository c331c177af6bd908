//! Calls of methods and helpers.

use super::expressions::no_destination;
use super::refusals;
use super::scope::{Binding, Scope};
use crate::ast::{Builtin, Expression, FunctionKind};
use syn::spanned::Spanned;
use syn::{
    AngleBracketedGenericArguments, Error, Expr, ExprMethodCall, GenericArgument, Ident, Path, PathArguments,
    Result, Type,
};
use xca_methods::Method;
use xca_spelling::{is_constant, strip};

/// What an item can do in a process over items and in a migration.
const OF_ITEM: &str = "an item has its substates (`me.substate`), label(), index(), random(draw), random_bits(draw), fault(code, value) and \
                       the searches others_…()";

/// What a cell can do.
const OF_CELL: &str = "a cell has its substates (`cell.substate`), neighbour_count(), neighbour(n), opposite(n), \
                       displacement(n), exists(n), index(), random(draw), random_bits(draw) and fault(code, value)";

/// What can be asked of the space.
pub(super) const SPACE_METHODS: &str = "the space has side(), extents(), step(), nearest_image(separation), wrapped(position) and, for a \
     migration, cell_containing(position)";

impl Scope {
    pub(super) fn method_call(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        if let Some(turbofish) = &call.turbofish {
            return Err(Error::new_spanned(turbofish, "methods take no type arguments in a process"));
        }
        if let Expr::MethodCall(inner) = strip(&call.receiver)
            && inner.method == "neighbour"
            && self.cell_argument(&inner.receiver).is_some()
        {
            return Err(no_method_of(
                "a neighbour has its substates, `cell.neighbour(n).substate`",
                &call.method,
            ));
        }
        match self.named(&call.receiver) {
            Some(Binding::Subject) => return self.subject_method(call),
            Some(Binding::Space) => return self.space_method(call),
            Some(Binding::Other(_)) => return self.other_method(call),
            Some(Binding::Neighbour(_)) => {
                return Err(no_method_of("a neighbour has its substates, as fields", &call.method));
            }
            Some(Binding::Cell(_)) => {
                return Err(no_method_of(
                    "this argument has its substates, as fields, and neighbour(n); ask the cell or item that the process \
                     runs for, its first argument",
                    &call.method,
                ));
            }
            Some(Binding::Parameters) => {
                return Err(no_method_of("parameters are read as fields, `p.name`", &call.method));
            }
            Some(Binding::Slots(_)) => {
                return Err(Error::new_spanned(
                    &call.method,
                    "go through the items, and count what you need: `for item in slots { … }`",
                ));
            }
            Some(Binding::Value | Binding::Argument) | None => {}
        }
        self.number_method(call)
    }

    fn number_method(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        let name = &call.method;
        let Some(method) = Method::named(&name.to_string()) else {
            return Err(refusals::method(name));
        };
        let receiver = self.expression(&call.receiver);
        let arguments: Vec<Expression> =
            call.args.iter().map(|argument| self.expression(argument)).collect::<Result<_>>()?;
        if arguments.len() != method.arguments.len() {
            return Err(Error::new_spanned(name, format!("write `value.{}`", method.usage())));
        }
        Ok(Expression::Method { method, name: name.clone(), receiver: Box::new(receiver?), arguments })
    }

    /// A method of the cell or item that the process runs for.
    fn subject_method(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        let cells = self.over_cells();
        let method = call.method.to_string();
        let (builtin, count) = match method.as_str() {
            "neighbour_count" if cells => (Builtin::NeighbourCount, 0),
            "opposite" if cells => (Builtin::Opposite, 1),
            "displacement" if cells => (Builtin::Displacement, 1),
            "exists" if cells => (Builtin::Exists, 1),
            "index" => (Builtin::Index, 0),
            "label" if !cells => (Builtin::Label, 0),
            "random" => (Builtin::Random, 1),
            "random_bits" => (Builtin::RandomBits, 1),
            "neighbour" if cells => {
                return Err(Error::new_spanned(
                    call,
                    "read a substate of the neighbour, `cell.neighbour(n).substate`, or give it a name: \
                     `let other = cell.neighbour(n);`",
                ));
            }
            "neighbours" if cells => {
                return Err(Error::new_spanned(
                    &call.method,
                    "the number of cells in the neighbourhood is `cell.neighbour_count()`; a neighbour is \
                     `cell.neighbour(n)`",
                ));
            }
            "neighbour" | "neighbours" | "neighbour_count" | "opposite" | "displacement" | "exists" => {
                return Err(Error::new_spanned(
                    &call.method,
                    "an item has no neighbours; it reaches the items of the neighbouring cells by \
                     `for other in me.others_in_neighbours() { … }`",
                ));
            }
            "fault" => {
                return Err(Error::new_spanned(
                    call,
                    "`fault` has no value; write it as a statement of its own",
                ));
            }
            _ if method.starts_with("others") => {
                return Err(Error::new_spanned(
                    &call.method,
                    "searches are for loops: `for other in me.others_within(radius) { … }`",
                ));
            }
            _ => return Err(no_method_of(if cells { OF_CELL } else { OF_ITEM }, &call.method)),
        };
        self.builtin(builtin, count, call)
    }

    fn other_method(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        match strip(&call.receiver) {
            Expr::Path(path)
                if call.method == "label"
                    && let Some(name) = path.path.get_ident() =>
            {
                let [] = self.arguments(call, "`label()` takes no arguments")?;
                Ok(Expression::OtherLabel(name.clone()))
            }
            _ => Err(no_method_of("another item has its substates, as fields, and label()", &call.method)),
        }
    }

    fn space_method(&mut self, call: &ExprMethodCall) -> Result<Expression> {
        let (builtin, count) = match call.method.to_string().as_str() {
            "side" => (Builtin::Side, 0),
            "extents" => (Builtin::Extents, 0),
            "step" => (Builtin::Step, 0),
            "nearest_image" => (Builtin::NearestImage, 1),
            "wrapped" => (Builtin::Wrapped, 1),
            "cell_containing" if self.kind == FunctionKind::Migration => (Builtin::CellContaining, 1),
            "cell_containing" => {
                return Err(Error::new_spanned(
                    &call.method,
                    "only a #[migration] asks which cell contains a position; here compute with \
                     `position.x / space.side()`",
                ));
            }
            _ => {
                return Err(Error::new_spanned(&call.method, SPACE_METHODS));
            }
        };
        self.builtin(builtin, count, call)
    }

    fn builtin(&mut self, builtin: Builtin, count: usize, call: &ExprMethodCall) -> Result<Expression> {
        let arguments: Vec<Expression> =
            call.args.iter().map(|argument| self.expression(argument)).collect::<Result<_>>()?;
        if arguments.len() != count {
            return Err(match builtin {
                Builtin::Random | Builtin::RandomBits => Error::new_spanned(
                    &call.method,
                    format!(
                        "`{}` takes the number of the draw: 0 for the first in this process, 1 for the second, …",
                        call.method
                    ),
                ),
                Builtin::Opposite | Builtin::Displacement | Builtin::Exists => Error::new_spanned(
                    &call.method,
                    format!("give the number of the neighbour: `cell.{}(n)`", call.method),
                ),
                _ => wrong_count(&call.method, count),
            });
        }
        Ok(Expression::Builtin(builtin, arguments, call.span()))
    }

    /// The arguments of a method that takes `N`.
    pub(super) fn arguments<const N: usize>(
        &mut self,
        call: &ExprMethodCall,
        usage: &str,
    ) -> Result<[Expression; N]> {
        let arguments: Vec<Expression> =
            call.args.iter().map(|argument| self.expression(argument)).collect::<Result<_>>()?;
        arguments.try_into().map_err(|_| Error::new_spanned(&call.method, usage))
    }

    pub(super) fn call(&mut self, call: &syn::ExprCall) -> Result<Expression> {
        let Expr::Path(function) = strip(&call.func) else {
            return Err(Error::new_spanned(&call.func, "call a helper by its name"));
        };
        let path = &function.path;
        let words: Vec<&Ident> = path.segments.iter().map(|segment| &segment.ident).collect();
        if function.qself.is_some() {
            return Err(Error::new_spanned(function, "call a function that is marked #[helper] by its name"));
        }
        if let [.., type_, method] = words[..] {
            if ["Vector2", "Vector3", "Vector4"].iter().any(|name| type_ == name) {
                return self.vector(type_, method, call);
            }
            if type_ == "Destination" {
                return Err(no_destination(call));
            }
            if is_type(type_) {
                return Err(associated_function(type_, method, call));
            }
        }
        if let [only] = words[..] {
            if let Some(binding) = self.binding(only) {
                return Err(Error::new_spanned(
                    only,
                    match binding {
                        Binding::Value | Binding::Argument => "this is a variable, not a function",
                        _ => "this is no function",
                    },
                ));
            }
            if is_constant(only) {
                return Err(Error::new_spanned(
                    call,
                    "only small vectors can be made in a process: `Vector3::new(x, y, z)`",
                ));
            }
            if *only == self.function {
                return Err(Error::new_spanned(
                    only,
                    "a function cannot call itself here: shaders know no recursion; write a loop",
                ));
            }
        }
        let (path, constants) = without_constants(path)?;
        let arguments: Vec<Expression> =
            call.args.iter().map(|argument| self.argument(argument)).collect::<Result<_>>()?;
        let alias = self.alias(&path);
        Ok(Expression::Call { function: alias.into(), constants, arguments })
    }

    fn argument(&mut self, argument: &Expr) -> Result<Expression> {
        match strip(argument) {
            Expr::Reference(reference) => Err(Error::new_spanned(
                reference,
                "pass the value itself, without `&`; parameters and space are references already",
            )),
            other
                if let Some(
                    Binding::Subject
                    | Binding::Cell(_)
                    | Binding::Slots(_)
                    | Binding::Neighbour(_)
                    | Binding::Other(_),
                ) = self.named(other) =>
            {
                Err(Error::new_spanned(
                    other,
                    "a helper takes values: pass the substates that it needs, `cell.substate`, or the parameters and the space",
                ))
            }
            other => self.expression(other),
        }
    }

    fn vector(&mut self, type_: &Ident, method: &Ident, call: &syn::ExprCall) -> Result<Expression> {
        let mut arguments: Vec<Expression> =
            call.args.iter().map(|argument| self.expression(argument)).collect::<Result<_>>()?;
        let lanes = match type_.to_string().as_str() {
            "Vector2" => 2,
            "Vector3" => 3,
            _ => 4,
        };
        if method == "new" && arguments.len() == lanes {
            return Ok(Expression::Vector(type_.clone(), arguments));
        }
        if method == "splat"
            && arguments.len() == 1
            && let Some(value) = arguments.pop()
        {
            return Ok(Expression::Splat(type_.clone(), Box::new(value)));
        }
        Err(Error::new_spanned(
            call,
            format!("make a vector by `{type_}::new` with {lanes} components or by `{type_}::splat(value)`"),
        ))
    }
}

/// The path of a helper, and the constants for which it is called, `::<N>`.
fn without_constants(path: &Path) -> Result<(Path, Option<AngleBracketedGenericArguments>)> {
    let mut path = path.clone();
    let Some(last) = path.segments.last_mut() else { return Ok((path, None)) };
    let constants = match std::mem::take(&mut last.arguments) {
        PathArguments::AngleBracketed(constants) => Some(constants),
        _ => None,
    };
    if let Some(segment) =
        path.segments.iter().find(|segment| !matches!(segment.arguments, PathArguments::None))
    {
        return Err(Error::new_spanned(segment, "only the helper itself takes constants, `helper::<N>(…)`"));
    }
    for constant in constants.iter().flat_map(|constants| &constants.args) {
        if let GenericArgument::Type(Type::Infer(_)) = constant {
            return Err(Error::new_spanned(constant, "write the constant itself: `helper::<5>(…)`"));
        }
    }
    Ok((path, constants))
}

fn is_type(word: &Ident) -> bool {
    let numbers = [
        "bool", "char", "str", "u8", "u16", "u32", "u64", "u128", "usize", "i8", "i16", "i32", "i64", "i128",
        "isize", "f32", "f64",
    ];
    is_constant(word) || numbers.iter().any(|number| word == number)
}

fn associated_function(type_: &Ident, method: &Ident, call: &syn::ExprCall) -> Error {
    let advice = if let Some(known) = Method::named(&method.to_string()) {
        format!("write it as a method: `value.{}`", known.usage())
    } else if let Some(advice) = refusals::no_method(&method.to_string()) {
        advice
    } else if method == "from" || method == "try_from" {
        format!("cast: `value as {type_}`")
    } else {
        "a process calls no functions of types; write a free function marked #[helper]".to_owned()
    };
    Error::new_spanned(&call.func, advice)
}

fn wrong_count(method: &Ident, count: usize) -> Error {
    let message = match count {
        0 => format!("`{method}()` takes no arguments"),
        1 => format!("`{method}` takes one argument"),
        _ => format!("`{method}` takes {count} arguments"),
    };
    Error::new_spanned(method, message)
}

/// The most frequent mistake here is to read or write a substate by a method.
fn no_method_of(has: &str, method: &Ident) -> Error {
    let name = method.to_string();
    let message = match name.strip_prefix("set_") {
        Some(substate) => format!("substates are written by assignment, `cell.{substate} = …`; {has}"),
        None if name == "clone" => format!("it cannot be copied; {has}"),
        None => format!("`{name}` is no method here; {has}"),
    };
    Error::new_spanned(method, message)
}
