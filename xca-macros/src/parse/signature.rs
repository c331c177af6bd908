//! The arguments and the result of a function.

use super::Wanted;
use crate::ast::{Argument, FunctionKind, Role};
use syn::spanned::Spanned;
use syn::{Error, FnArg, GenericArgument, Pat, PathArguments, Result, ReturnType, Type};

pub(super) struct Signature {
    pub(super) kind: FunctionKind,
    pub(super) arguments: Vec<Argument>,
    pub(super) result: Option<Type>,
}

pub(super) fn parse(item: &syn::ItemFn, wanted: Wanted) -> Result<Signature> {
    let signature = &item.sig;
    if let Some(token) = &signature.asyncness {
        return Err(Error::new_spanned(token, "an elementary process cannot be async"));
    }
    if !signature.generics.params.is_empty() || signature.generics.where_clause.is_some() {
        return Err(Error::new_spanned(
            &signature.generics,
            "a process or helper cannot be generic; write `Real` for the floating type that the run chooses",
        ));
    }
    let mut arguments = Vec::new();
    for (position, input) in signature.inputs.iter().enumerate() {
        arguments.push(argument(input, position, wanted)?);
    }
    let kind = kind(item, wanted, &arguments)?;
    check_companions(kind, &arguments, &signature.ident)?;
    let result = match (&signature.output, kind) {
        (ReturnType::Default, FunctionKind::Helper) => {
            return Err(Error::new_spanned(
                &signature.ident,
                "a helper returns a value: add `-> Real` or another type; it cannot change anything by itself",
            ));
        }
        (ReturnType::Default, FunctionKind::Migration) => {
            return Err(Error::new_spanned(
                &signature.ident,
                "a migration returns where the item goes: add `-> Destination`",
            ));
        }
        (ReturnType::Type(_, type_), FunctionKind::Migration) => {
            if last_segment(type_).is_none_or(|segment| segment.ident != "Destination") {
                return Err(Error::new_spanned(type_, "a migration returns `Destination`"));
            }
            Some((**type_).clone())
        }
        (ReturnType::Type(_, type_), FunctionKind::Helper) => Some((**type_).clone()),
        (ReturnType::Default, _) => None,
        (ReturnType::Type(_, type_), _) => {
            return Err(Error::new_spanned(
                type_,
                "an elementary process returns nothing; it writes the substates of its own cell: `cell.substate = …`",
            ));
        }
    };
    Ok(Signature { kind, arguments, result })
}

fn kind(item: &syn::ItemFn, wanted: Wanted, arguments: &[Argument]) -> Result<FunctionKind> {
    let first = arguments.first().map(|argument| &argument.role);
    match (wanted, first) {
        (Wanted::Helper, _) => Ok(FunctionKind::Helper),
        (Wanted::Process, Some(Role::Cell(_))) => Ok(FunctionKind::Cells),
        (Wanted::Process, Some(Role::Slot(_))) => Ok(FunctionKind::Items),
        (Wanted::Migration, Some(Role::Slot(_))) => Ok(FunctionKind::Migration),
        (Wanted::Process, _) => Err(Error::new_spanned(
            &item.sig.ident,
            "the first argument of an elementary process is `cell: &mut Cell<Substates>`, or `me: &mut Slot<Substates>` for a \
             process over the items of a population",
        )),
        (Wanted::Migration, _) => Err(Error::new_spanned(
            &item.sig.ident,
            "the first argument of a migration is `me: &Slot<Substates>`",
        )),
    }
}

fn check_companions(kind: FunctionKind, arguments: &[Argument], name: &syn::Ident) -> Result<()> {
    let mut seen: Vec<&'static str> = Vec::new();
    for (position, argument) in arguments.iter().enumerate() {
        let (word, fits) = match &argument.role {
            Role::Cell(_) => {
                ("Cell", position == 0 || matches!(kind, FunctionKind::Items | FunctionKind::Migration))
            }
            Role::Slot(_) => ("Slot", position == 0),
            Role::Slots(_) => ("Slots", kind == FunctionKind::Cells),
            Role::Parameters(_) => ("parameters", true),
            Role::Space => ("Space", true),
            Role::Value(_) => continue,
        };
        if kind == FunctionKind::Helper && !matches!(argument.role, Role::Parameters(_) | Role::Space) {
            return Err(Error::new_spanned(
                &argument.name,
                "a helper takes values, parameters and the space; pass the substates that it needs as values",
            ));
        }
        if !fits || seen.contains(&word) {
            return Err(Error::new_spanned(
                &argument.name,
                format!(
                    "`{name}` cannot take this {word} argument here; it takes one cell or item, and at most one each of parameters, space, and companion"
                ),
            ));
        }
        seen.push(word);
    }
    Ok(())
}

fn argument(input: &FnArg, position: usize, wanted: Wanted) -> Result<Argument> {
    let FnArg::Typed(typed) = input else {
        return Err(Error::new_spanned(input, "a process is a free function, without `self`"));
    };
    let Pat::Ident(pattern) = &*typed.pat else {
        return Err(Error::new_spanned(&typed.pat, "give the argument a plain name"));
    };
    if pattern.mutability.is_some() {
        return Err(Error::new_spanned(
            pattern,
            "an argument cannot be `mut`; start with `let mut copy = argument;`",
        ));
    }
    let name = pattern.ident.clone();
    let role = match &*typed.ty {
        Type::Reference(reference) => referenced(reference, position, wanted)?,
        other if wanted == Wanted::Helper => Role::Value(other.clone()),
        other => {
            return Err(Error::new_spanned(
                other,
                "a process takes references: `&mut Cell<S>` or `&mut Slot<S>`, then `&Parameters`, `&Space`",
            ));
        }
    };
    Ok(Argument { name, role })
}

fn referenced(reference: &syn::TypeReference, position: usize, wanted: Wanted) -> Result<Role> {
    let Some(segment) = last_segment(&reference.elem) else {
        return Err(Error::new_spanned(&reference.elem, "expected the name of a struct here"));
    };
    let word = segment.ident.to_string();
    let mutable = reference.mutability.is_some();
    let role = match word.as_str() {
        "Cell" => Role::Cell(type_argument(segment)?),
        "Slot" => Role::Slot(type_argument(segment)?),
        "Slots" => Role::Slots(type_argument(segment)?),
        "Space" => Role::Space,
        _ => Role::Parameters((*reference.elem).clone()),
    };
    let wants_mutable =
        position == 0 && wanted == Wanted::Process && matches!(role, Role::Cell(_) | Role::Slot(_));
    if wants_mutable && !mutable {
        return Err(Error::new(
            reference.span(),
            format!(
                "write `&mut {word}<…>`: an elementary process writes the substates of its own {}",
                word.to_lowercase()
            ),
        ));
    }
    if mutable && !wants_mutable {
        return Err(Error::new_spanned(
            reference,
            "only the cell or item that an elementary process runs for can be written; remove `mut`",
        ));
    }
    Ok(role)
}

fn last_segment(type_: &Type) -> Option<&syn::PathSegment> {
    match type_ {
        Type::Path(path) if path.qself.is_none() => path.path.segments.last(),
        Type::Group(group) => last_segment(&group.elem),
        Type::Paren(paren) => last_segment(&paren.elem),
        _ => None,
    }
}

fn type_argument(segment: &syn::PathSegment) -> Result<Type> {
    if let PathArguments::AngleBracketed(arguments) = &segment.arguments
        && arguments.args.len() == 1
        && let Some(GenericArgument::Type(type_)) = arguments.args.first()
    {
        return Ok(type_.clone());
    }
    let word = &segment.ident;
    Err(Error::new_spanned(segment, format!("name the struct of the substates: `{word}<MySubstates>`")))
}
