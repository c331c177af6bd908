//! The loop over a row, with the substates that the body uses loaded before and stored after it.
//!
//! Each substate is an argument of its own of the inner function: that tells the compiler that what is written is apart from
//! what is read, without which it would not vectorise.

use super::body::{Writer, own_name, read_name, write_name};
use super::{checked_value, hidden, native_parameters, parameters_type, substate};
use crate::access::{Access, GroupOf, Uses};
use crate::ast::{Function, FunctionKind};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// Neighbourhood sizes that get a kernel of their own, whose loop over neighbours can be unrolled.
const UNROLLED: [usize; 4] = [5, 7, 9, 27];

/// An expression whose value is the kernel for one precision.
pub(super) fn row(function: &Function, uses: &Uses, real: &TokenStream) -> TokenStream {
    let span = function.name.span();
    let name = hidden(&format!("row_{real}"), span);
    let (row, inner) = (hidden("row", span), hidden("inner", span));
    let over_cells = function.kind == FunctionKind::Cells;
    let mut declarations = Vec::new();
    let mut values = Vec::new();
    for (number, access) in uses.accesses.iter().enumerate() {
        let substate = substate(access, function);
        let type_ = quote!(#substate::Native<#real>);
        let cells = over_cells != (access.group == GroupOf::Companion);
        if reads(access) {
            let read = read_name(access.group, &access.field);
            if cells {
                declarations.push(quote!(#read: ::xca_core::kernel::CellRead<'_, #type_>));
                values.push(quote!(#row.read_cells::<#type_>(#number)));
            } else {
                declarations.push(quote!(#read: &[#type_]));
                values.push(quote!(#row.read_items::<#type_>(#number)));
            }
        }
        if access.write {
            let write = write_name(&access.field);
            declarations.push(quote!(#write: &mut [#type_]));
            let take = if cells { quote!(write_cells) } else { quote!(write_items) };
            values.push(quote!(#row.#take::<#type_>(#number)));
        }
    }
    let mut take_parameters = TokenStream::new();
    if let Some(type_) = parameters_type(function) {
        let parameters = hidden("parameters", span);
        let native = native_parameters(type_, real);
        declarations.push(quote!(#parameters: &#native));
        values.push(quote!(#parameters));
        take_parameters = quote!(let ::core::option::Option::Some(#parameters) = #row.parameters::<#native>() else { return; };);
    }
    let unrolled = over_cells && uses.neighbours;
    let size = hidden("SIZE", span);
    let work = if over_cells { cells(function, uses, real, &size) } else { items(function, uses, real) };
    let constants = &function.constants;
    let names: Vec<&Ident> = constants.iter().map(|constant| &constant.ident).collect();
    let call = if unrolled {
        let arms =
            UNROLLED.iter().map(|size| quote!(#size => #inner::<#size, #(#names),*>(#row, #(#values),*),));
        quote! {
            match #row.neighbours() {
                #(#arms)*
                _ => #inner::<0, #(#names),*>(#row, #(#values),*),
            }
        }
    } else {
        quote!(#inner::<0, #(#names),*>(#row, #(#values),*))
    };
    let checked_row = checked_value(&quote!(#row));
    quote! {
        {
            #[allow(warnings, arithmetic_overflow, overflowing_literals, unconditional_panic, clippy::all)]
            fn #name<#(#constants),*>(#row: &::xca_core::kernel::Row<'_>) {
                #[inline(never)]
                fn #inner<const #size: usize, #(#constants),*>(#row: &::xca_core::kernel::Row<'_>, #(#declarations),*) {
                    let #row = #checked_row;
                    #work
                }
                #take_parameters
                #call
            }
            #name::<#(#names),*>
        }
    }
}

/// Whether the old values are read through an argument of their own: not where they are only replaced in place.
fn reads(access: &Access) -> bool {
    access.others || !access.write
}

fn space(real: &TokenStream, span: Span) -> TokenStream {
    let (row, space) = (hidden("row", span), hidden("space", span));
    quote!(let #space = #row.space::<#real>();)
}

fn cells(function: &Function, uses: &Uses, real: &TokenStream, size: &Ident) -> TokenStream {
    let span = function.name.span();
    let [row, x, place, offsets, length] =
        ["row", "x", "place", "offsets", "length"].map(|name| hidden(name, span));
    let space = space(real, span);
    let mut shorten = TokenStream::new();
    let mut load = TokenStream::new();
    let mut store = TokenStream::new();
    for access in uses.accesses.iter().filter(|access| access.group == GroupOf::Subject) {
        let own = own_name(&access.field);
        if access.write {
            let write = write_name(&access.field);
            shorten.extend(quote!(let #write = &mut #write[..#length];));
            let old = if access.others {
                let read = read_name(access.group, &access.field);
                quote!(#read.at(#x, 0))
            } else {
                quote!(#write[#x])
            };
            load.extend(quote!(let mut #own = #old;));
            store.extend(quote!(#write[#x] = #own;));
        } else if access.centre {
            let read = read_name(access.group, &access.field);
            load.extend(quote!(let #own = #read.at(#x, 0);));
        }
    }
    let mut writer = Writer::new(function, real.clone());
    let body = writer.block(&function.body);
    quote! {
        #space
        let #offsets = #row.offsets::<#size>();
        let #length = #row.length();
        #shorten
        let mut #place = #row.place();
        for #x in 0..#length {
            #place.x = #x;
            #load
            'body: #body
            #store
        }
        #place.leave();
    }
}

fn items(function: &Function, uses: &Uses, real: &TokenStream) -> TokenStream {
    let span = function.name.span();
    let [row, x, item, place, first, destinations, answer] =
        ["row", "x", "item", "place", "first", "destinations", "answer"].map(|name| hidden(name, span));
    let space = space(real, span);
    let mut load = TokenStream::new();
    let mut store = TokenStream::new();
    for access in uses.accesses.iter().filter(|access| access.group == GroupOf::Subject) {
        let own = own_name(&access.field);
        if access.write {
            let write = write_name(&access.field);
            let old = if access.others {
                let read = read_name(access.group, &access.field);
                quote!(#read[#item])
            } else {
                quote!(#write[#item - #first])
            };
            load.extend(quote!(let mut #own = #old;));
            store.extend(quote!(#write[#item - #first] = #own;));
        } else if access.centre {
            let read = read_name(access.group, &access.field);
            load.extend(quote!(let #own = #read[#item];));
        }
    }
    let mut writer = Writer::new(function, real.clone());
    let body = writer.block(&function.body);
    let lists = writer.lists();
    let (take, run) = if function.kind == FunctionKind::Migration {
        (
            quote!(let #destinations = #row.destinations();),
            quote!(let #answer: u32 = 'body: #body; #destinations[#item - #first] = #answer;),
        )
    } else {
        (TokenStream::new(), quote!('body: #body))
    };
    quote! {
        #space
        #lists
        #take
        let #first = #row.first_item();
        let mut #place = #row.place();
        for #x in 0..#row.length() {
            #place.x = #x;
            for #item in #row.items(#x) {
                #place.item = ::core::option::Option::Some(#item);
                #load
                #run
                #store
            }
        }
        #place.leave();
    }
}
