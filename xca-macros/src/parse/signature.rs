//! The arguments and the result of a function.

use super::wanted::Wanted;
use crate::ast::{Argument, FunctionKind, Role};
use syn::{
    ConstParam, Error, FnArg, GenericArgument, GenericParam, Ident, ItemFn, Pat, PathArguments, PathSegment,
    Result, ReturnType, Type,
};
use xca_spelling::is_constant;

pub(super) struct Signature {
    pub(super) kind: FunctionKind,
    pub(super) constants: Vec<ConstParam>,
    pub(super) arguments: Vec<Argument>,
    pub(super) result: Option<Type>,
}

const PROCESS_TAKES: &str = "the first argument of an elementary process is `cell: &mut Cell<MySubstates>`, or `me: &mut Slot<MySubstates>` \
                             for a process over the items of a population; then come `&MyParameters` and `&Space`";
const MIGRATION_TAKES: &str =
    "the first argument of a migration is `me: &Slot<MySubstates>`; then come `&MyParameters` and `&Space`";
const HELPER_TAKES: &str =
    "a helper takes values, `&MyParameters` and `&Space`; pass the substates that it needs as values";

pub(super) fn parse(item: &ItemFn, wanted: Wanted) -> Result<Signature> {
    refuse_qualifiers(item, wanted)?;
    refuse_attributes(item, wanted)?;
    let constants = constants(item, wanted)?;
    let mut arguments = Vec::new();
    for (position, input) in item.sig.inputs.iter().enumerate() {
        arguments.push(argument(input, position, wanted)?);
    }
    let kind = kind(item, wanted, &arguments)?;
    check_roles(kind, &arguments)?;
    let result = result(item, kind)?;
    Ok(Signature { kind, constants, arguments, result })
}

fn refuse_qualifiers(item: &ItemFn, wanted: Wanted) -> Result<()> {
    let signature = &item.sig;
    let what = wanted.attribute();
    if let Some(token) = &signature.asyncness {
        return Err(Error::new_spanned(token, format!("a function marked {what} cannot be async")));
    }
    if let syn::Safety::Unsafe(token) = &signature.safety {
        return Err(Error::new_spanned(token, format!("a function marked {what} cannot be unsafe")));
    }
    if let Some(abi) = &signature.abi {
        return Err(Error::new_spanned(abi, format!("a function marked {what} cannot be extern")));
    }
    if let (Some(token), true) = (&signature.constness, wanted != Wanted::Helper) {
        return Err(Error::new_spanned(token, format!("a function marked {what} cannot be const")));
    }
    Ok(())
}

/// The constants that the function is generic in; it is generic in nothing else.
fn constants(item: &ItemFn, wanted: Wanted) -> Result<Vec<ConstParam>> {
    let generics = &item.sig.generics;
    let what = wanted.attribute();
    if let Some(clause) = &generics.where_clause {
        return Err(Error::new_spanned(clause, format!("a function marked {what} has no `where`")));
    }
    let constant = |parameter: &GenericParam| {
        let GenericParam::Const(constant) = parameter else {
            return Err(Error::new_spanned(
                parameter,
                format!(
                    "a function marked {what} is generic in constants only, `const N: usize`; write `Real` for the floating type, which \
                     the run chooses"
                ),
            ));
        };
        let type_ = last_segment(&constant.ty).map(|segment| segment.ident.to_string()).unwrap_or_default();
        if !["bool", "u8", "i32", "u32", "usize"].contains(&type_.as_str()) {
            return Err(Error::new_spanned(&constant.ty, "such a constant is a bool, u8, i32, u32 or usize"));
        }
        if !is_constant(&constant.ident) {
            let capitals = constant.ident.to_string().to_uppercase();
            return Err(Error::new_spanned(
                &constant.ident,
                format!("constants are written in capitals: `{capitals}`"),
            ));
        }
        Ok(constant.clone())
    };
    generics.params.iter().map(constant).collect()
}

/// A process is no function any more: attributes of functions would be lost.
fn refuse_attributes(item: &ItemFn, wanted: Wanted) -> Result<()> {
    let kept = ["doc", "cfg", "allow", "expect", "warn", "deny", "deprecated", "rustfmt"];
    let lost = item.attrs.iter().find(|attribute| {
        attribute.path().segments.first().is_none_or(|first| !kept.iter().any(|word| first.ident == word))
    });
    match lost {
        Some(attribute) if wanted != Wanted::Helper => Err(Error::new_spanned(
            attribute,
            format!("this attribute has no meaning beside {}", wanted.attribute()),
        )),
        _ => Ok(()),
    }
}

fn result(item: &ItemFn, kind: FunctionKind) -> Result<Option<Type>> {
    let name = &item.sig.ident;
    match (&item.sig.output, kind) {
        (ReturnType::Default, FunctionKind::Helper) => Err(Error::new_spanned(
            name,
            "a helper returns a value: add `-> Real` or another type; it cannot change anything by itself",
        )),
        (ReturnType::Default, FunctionKind::Migration) => Err(Error::new_spanned(
            name,
            "a migration returns the cell that the item goes to: add `-> Destination`",
        )),
        (ReturnType::Type(_, type_), FunctionKind::Migration) => {
            if last_segment(type_).is_none_or(|segment| segment.ident != "Destination") {
                return Err(Error::new_spanned(type_, "a migration returns `Destination`"));
            }
            Ok(Some((**type_).clone()))
        }
        (ReturnType::Type(_, type_), FunctionKind::Helper) => Ok(Some((**type_).clone())),
        (ReturnType::Default, _) => Ok(None),
        (ReturnType::Type(_, type_), _) => Err(Error::new_spanned(
            type_,
            "an elementary process returns nothing; it writes the substates of its own cell: `cell.substate = …;`",
        )),
    }
}

fn kind(item: &ItemFn, wanted: Wanted, arguments: &[Argument]) -> Result<FunctionKind> {
    let first = arguments.first().map(|argument| &argument.role);
    let explain = |message| match item.sig.inputs.first() {
        Some(FnArg::Typed(argument)) => Error::new_spanned(&argument.ty, message),
        _ => Error::new_spanned(&item.sig.ident, message),
    };
    match (wanted, first) {
        (Wanted::Helper, _) => Ok(FunctionKind::Helper),
        (Wanted::Process, Some(Role::Cell(_))) => Ok(FunctionKind::Cells),
        (Wanted::Process, Some(Role::Slot(_))) => Ok(FunctionKind::Items),
        (Wanted::Migration, Some(Role::Slot(_))) => Ok(FunctionKind::Migration),
        (Wanted::Process, _) => Err(explain(PROCESS_TAKES)),
        (Wanted::Migration, _) => Err(explain(MIGRATION_TAKES)),
    }
}

fn check_roles(kind: FunctionKind, arguments: &[Argument]) -> Result<()> {
    let mut seen: Vec<&'static str> = Vec::new();
    for (position, Argument { name, role }) in arguments.iter().enumerate() {
        let over_items = matches!(kind, FunctionKind::Items | FunctionKind::Migration);
        let (word, fits) = match role {
            Role::Cell(_) => ("cell", position > 0 || !over_items),
            Role::Slot(_) => ("item", position == 0),
            Role::Slots(_) => ("set of items", kind == FunctionKind::Cells),
            Role::Parameters(_) => ("parameters", true),
            Role::Space => ("space", true),
            Role::Value(_) => continue,
        };
        let is_helpers = matches!(role, Role::Parameters(_) | Role::Space);
        if kind == FunctionKind::Helper && !is_helpers {
            return Err(Error::new_spanned(name, HELPER_TAKES));
        }
        // Of cells and parameters there can be several structs.
        let several = matches!(role, Role::Cell(_) | Role::Parameters(_));
        if !several && seen.contains(&word) {
            return Err(Error::new_spanned(name, format!("there can be one {word} only")));
        }
        if let Some(twin) = arguments[..position].iter().find(|earlier| same_struct(&earlier.role, role)) {
            let twin = &twin.name;
            return Err(Error::new_spanned(name, format!("`{twin}` is this struct already; use that")));
        }
        if !fits {
            let message = match role {
                Role::Slots(_) => {
                    "a process over items takes its cell, `&Cell<…>`; other items are found by `me.others_in_cell()` and its kin"
                }
                _ => {
                    "an item is the first argument, `me: &mut Slot<…>`; a process over cells takes all items of the cell, `&Slots<…>`"
                }
            };
            return Err(Error::new_spanned(name, message));
        }
        seen.push(word);
    }
    Ok(())
}

fn same_struct(one: &Role, other: &Role) -> bool {
    let type_ = |role: &Role| match role {
        Role::Cell(type_) | Role::Slot(type_) | Role::Slots(type_) | Role::Parameters(type_) => {
            Some(quote::quote!(#type_).to_string())
        }
        Role::Space | Role::Value(_) => None,
    };
    type_(one).is_some_and(|one| type_(other) == Some(one))
}

fn argument(input: &FnArg, position: usize, wanted: Wanted) -> Result<Argument> {
    let FnArg::Typed(typed) = input else {
        return Err(Error::new_spanned(
            input,
            format!("a function marked {} is a free function, without `self`", wanted.attribute()),
        ));
    };
    let Pat::Ident(pattern) = &*typed.pat else {
        return Err(Error::new_spanned(&typed.pat, "give the argument a plain name"));
    };
    let name = pattern.ident.clone();
    if pattern.mutability.is_some() {
        return Err(Error::new_spanned(
            pattern,
            format!("an argument cannot be `mut`; begin with `let mut {name} = {name};`"),
        ));
    }
    let role = match &*typed.ty {
        Type::Reference(reference) => referenced(reference, &name, position, wanted)?,
        other if wanted == Wanted::Helper => Role::Value(other.clone()),
        other => return Err(Error::new_spanned(other, wanting(other, &name, position, wanted))),
    };
    Ok(Argument { name, role })
}

/// What to write instead of an argument that is no reference.
fn wanting(type_: &Type, name: &Ident, position: usize, wanted: Wanted) -> String {
    let word = last_segment(type_).map(|segment| segment.ident.to_string()).unwrap_or_default();
    match word.as_str() {
        "Cell" | "Slot" if position == 0 && wanted == Wanted::Process => format!("write `&mut {word}<…>`"),
        "Cell" | "Slot" | "Slots" => format!("write `&{word}<…>`"),
        "Space" => "write `&Space`".to_owned(),
        _ if position == 0 && wanted == Wanted::Process => PROCESS_TAKES.to_owned(),
        _ if position == 0 => MIGRATION_TAKES.to_owned(),
        "" => "a process takes the cell or item, then `&MyParameters` and `&Space`".to_owned(),
        _ if crate::fields::is_value_type(&word) => no_argument(name),
        _ => format!(
            "parameters come as a reference to their struct: `&{word}`; the struct derives `Parameters`"
        ),
    }
}

fn no_argument(name: &Ident) -> String {
    format!("`{name}` cannot be an argument of its own; make it a field of the struct of parameters")
}

fn referenced(reference: &syn::TypeReference, name: &Ident, position: usize, wanted: Wanted) -> Result<Role> {
    let Some(segment) = last_segment(&reference.elem) else {
        return Err(Error::new_spanned(
            &reference.elem,
            match wanted {
                Wanted::Helper => HELPER_TAKES,
                Wanted::Process => PROCESS_TAKES,
                Wanted::Migration => MIGRATION_TAKES,
            },
        ));
    };
    let word = segment.ident.to_string();
    if crate::fields::is_value_type(&word) {
        let message = match wanted {
            Wanted::Helper => format!("values are passed as they are, without `&`: `{name}: {word}`"),
            _ => no_argument(name),
        };
        return Err(Error::new_spanned(reference, message));
    }
    let mutable = reference.mutability.is_some();
    let role = match word.as_str() {
        "Cell" => Role::Cell(type_argument(segment)?),
        "Slot" => Role::Slot(type_argument(segment)?),
        "Slots" => Role::Slots(type_argument(segment)?),
        "Space" => Role::Space,
        _ => Role::Parameters((*reference.elem).clone()),
    };
    if wanted == Wanted::Helper && !matches!(role, Role::Parameters(_) | Role::Space) {
        return Err(Error::new_spanned(reference, HELPER_TAKES));
    }
    let own = position == 0 && matches!(role, Role::Cell(_) | Role::Slot(_));
    if own && wanted == Wanted::Process && !mutable {
        let own = word.to_lowercase().replace("slot", "item");
        return Err(Error::new_spanned(
            reference,
            format!("write `&mut {word}<…>`: an elementary process writes the substates of its own {own}"),
        ));
    }
    if mutable && !(own && wanted == Wanted::Process) {
        let message = match (&role, wanted) {
            (_, Wanted::Helper) => HELPER_TAKES,
            (Role::Cell(_) | Role::Slot(_), Wanted::Process) => {
                "the cell or item that the process writes is its first argument"
            }
            (Role::Parameters(_), Wanted::Process) if position == 0 => PROCESS_TAKES,
            (Role::Parameters(_), _) => {
                "parameters are read only; steering changes them: leave out the `mut`"
            }
            (_, Wanted::Migration) => {
                "a migration only says where the item goes and changes nothing: leave out the `mut`"
            }
            _ => "only the cell or item that the process runs for can be written: leave out the `mut`",
        };
        return Err(Error::new_spanned(reference, message));
    }
    Ok(role)
}

fn last_segment(type_: &Type) -> Option<&PathSegment> {
    match type_ {
        Type::Path(path) if path.qself.is_none() => path.path.segments.last(),
        Type::Group(group) => last_segment(&group.elem),
        Type::Paren(paren) => last_segment(&paren.elem),
        _ => None,
    }
}

fn type_argument(segment: &PathSegment) -> Result<Type> {
    if let PathArguments::AngleBracketed(arguments) = &segment.arguments
        && arguments.args.len() == 1
        && let Some(GenericArgument::Type(type_)) = arguments.args.first()
    {
        return Ok(type_.clone());
    }
    let word = &segment.ident;
    Err(Error::new_spanned(segment, format!("name the struct of the substates: `{word}<MySubstates>`")))
}
