//! The loop over a row, with the substates that the body uses loaded before and stored after it.
//!
//! Each substate is an argument of its own of the inner function: that tells the compiler that what is
//! written is apart from what is read, without which it would not vectorise.

use super::blocks::Blocks;
use super::body::Writer;
use super::company::{Company, Within};
use super::fetches::{Names, fetches};
use super::loops::{positions, reach_number};
use super::mates::Mates;
use super::names::{hidden, own_name, read_name, write_name};
use super::sums::Split;
use super::types::{native_parameters, native_type, parameters};
use super::work::{Argument, LIFE, Typed, Work};
use crate::access::{Access, GroupOf, Uses, structs};
use crate::ast::{Function, FunctionKind, Role, Statement};
use crate::checked::checked_value;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// The numbers of the shapes of neighbourhoods that get a kernel of their own, see `xca_core::kernel`.
const SHAPES: std::ops::RangeInclusive<u8> = 1..=6;

/// An expression whose value is the kernel for one precision.
pub(super) fn row(function: &Function, uses: &Uses, real: &TokenStream) -> TokenStream {
    let span = function.name.span();
    let name = hidden(&format!("row_{real}"), span);
    let row = hidden("row", span);
    let over_cells = function.kind == FunctionKind::Cells;
    let mut arguments = Vec::new();
    let mut blocks = Blocks::default();
    for (number, access) in uses.accesses.iter().enumerate() {
        let type_ = native_type(access.group, &access.field, function, real);
        let cells = matches!(structs(function).nth(access.group.argument().0), Some(Role::Cell(_)));
        let memory = quote!(<#type_ as ::xca_core::kernel::KernelValue>::Memory);
        if reads(access) {
            let (argument, take) = match (cells, access.others) {
                (true, true) => (quote!(::xca_core::kernel::AroundRead<#LIFE, #type_>), quote!(read_around)),
                (true, false) => (quote!(::xca_core::kernel::CentreRead<#LIFE, #type_>), quote!(read_cells)),
                (false, true) => (quote!(&#LIFE [#memory]), quote!(read_items)),
                (false, false) => (quote!(&#LIFE [#memory]), quote!(read_own_items)),
            };
            arguments.push(Argument {
                name: read_name(access.group, &access.field),
                written: false,
                row: Typed { type_: argument, value: quote!(#row.#take::<#type_>(#number)) },
                block: None,
            });
        }
        if access.write {
            let of_cells = quote!(<#type_ as ::xca_core::kernel::KernelValue>);
            let (row, block) = if over_cells {
                let value = quote!(#row.write_cells::<#type_>(#number));
                let lanes = Typed { type_: quote!(#of_cells::Lanes<'_>), value: blocks.add(access, &type_) };
                (Typed { type_: quote!(#of_cells::Written<#LIFE>), value }, Some(lanes))
            } else {
                let value = quote!(#row.write_items::<#type_>(#number));
                (Typed { type_: quote!(&#LIFE mut [#memory]), value }, None)
            };
            arguments.push(Argument { name: write_name(&access.field), written: true, row, block });
        }
    }
    let mut take_parameters = TokenStream::new();
    for (name, type_) in parameters(function) {
        let native = native_parameters(type_, real);
        take_parameters.extend(
            quote!(let ::core::option::Option::Some(#name) = #row.parameters::<#native>() else { return; };),
        );
        let row = Typed { type_: quote!(&#LIFE #native), value: quote!(#name) };
        arguments.push(Argument { name: name.clone(), written: false, row, block: None });
    }
    let shape = hidden("SHAPE", span);
    let body = if over_cells {
        cells(function, uses, real, &shape)
    } else {
        items(function, uses, real, &arguments)
    };
    let checked_row = checked_value(&quote!(#row));
    let work = Work { function, arguments, blocks, body: quote!({ let #row = #checked_row; #body }) };
    let definition = work.definition();
    let any = work.call(&quote!({ ::xca_core::kernel::ANY_SHAPE }));
    let call = if over_cells && uses.neighbours {
        let arms = SHAPES.map(|shape| {
            let call = work.call(&quote!(#shape));
            quote!(#shape => #call,)
        });
        quote! {
            match #row.shape() {
                #(#arms)*
                _ => #any,
            }
        }
    } else {
        any
    };
    let constants = &function.constants;
    let names = constants.iter().map(|constant| &constant.ident);
    quote! {
        {
            #[allow(warnings, arithmetic_overflow, overflowing_literals, unconditional_panic, clippy::all)]
            fn #name<#(#constants),*>(#row: &::xca_core::kernel::Row<'_>) {
                #definition
                #take_parameters
                #call
            }
            #name::<#(#names),*>
        }
    }
}

/// Whether the old values are read through an argument of their own: not where they are only replaced in
/// place.
fn reads(access: &Access) -> bool {
    access.others || !access.write
}

fn space(real: &TokenStream, span: Span) -> TokenStream {
    let [row, space, draws] = ["row", "space", "draws"].map(|name| hidden(name, span));
    quote!(let #space = #row.space::<#real>(#draws);)
}

fn cells(function: &Function, uses: &Uses, real: &TokenStream, shape: &Ident) -> TokenStream {
    let span = function.name.span();
    let [row, x, column, columns, lane, place, offsets, length] =
        ["row", "x", "column", "columns", "lane", "place", "offsets", "length"]
            .map(|name| hidden(name, span));
    let space = space(real, span);
    let lanes = quote!(::xca_core::kernel::Lanes);
    let mut shorten = TokenStream::new();
    let mut load = TokenStream::new();
    let mut store = TokenStream::new();
    for access in uses.accesses.iter().filter(|access| access.group == GroupOf::SUBJECT) {
        let own = own_name(&access.field);
        let type_ = native_type(access.group, &access.field, function, real);
        let read = read_name(access.group, &access.field);
        if access.write {
            let write = write_name(&access.field);
            shorten.extend(quote!(let mut #write = #lanes::<#type_>::first(#write, #length);));
            let old = if access.others {
                quote!(#read.here(#column))
            } else {
                quote!(#lanes::<#type_>::get(&#write, #lane))
            };
            load.extend(quote!(let mut #own = #old;));
            store.extend(quote!(#lanes::<#type_>::set(&mut #write, #lane, #own);));
        } else if access.centre {
            load.extend(quote!(let #own = #read.here(#column);));
        }
    }
    let directions = uses.directions.then(|| {
        let directions = hidden("directions", span);
        quote!(let #directions = #row.directions::<#shape>();)
    });
    let mut writer = Writer::new(function, Some(uses), real.clone());
    let body = writer.block(&function.body);
    let names = Names {
        columns: columns.clone(),
        offsets: offsets.clone(),
        directions: hidden("directions", span),
        read: read_name,
    };
    let fetches = fetches(function, &names);
    // A copy is read before the loop, also where only some cells use it; without it the loop could not be
    // vectorised.
    let own_parameters = parameters(function).map(|(name, _)| quote!(let #name = &{ *#name };));
    quote! {
        #(#own_parameters)*
        #space
        let #offsets = #row.offsets::<#shape>();
        #directions
        let #length = #columns.numbers().len();
        #shorten
        #fetches
        let mut #place = #row.place();
        for #column in #columns {
            let (#x, #lane) = (#column.number(), #column.lane());
            #place.x = #x;
            #load
            'body: #body
            #store
        }
        #place.leave();
    }
}

fn items(function: &Function, uses: &Uses, real: &TokenStream, arguments: &[Argument]) -> TokenStream {
    let span = function.name.span();
    let [row, x, column, item, number, count, place, first, offsets, destinations, answer] = [
        "row",
        "x",
        "column",
        "item",
        "number",
        "count",
        "place",
        "first",
        "offsets",
        "destinations",
        "answer",
    ]
    .map(|name| hidden(name, span));
    let space = space(real, span);
    let mut shorten = TokenStream::new();
    let mut load = TokenStream::new();
    let mut store = TokenStream::new();
    for access in uses.accesses.iter().filter(|access| access.group == GroupOf::SUBJECT) {
        let own = own_name(&access.field);
        let type_ = native_type(access.group, &access.field, function, real);
        let read = read_name(access.group, &access.field);
        let index = if access.others { quote!(#item) } else { quote!(#number) };
        if !access.others && !access.write {
            shorten.extend(quote!(let #read = &#read[..#count];));
        }
        if access.write {
            let write = write_name(&access.field);
            shorten.extend(quote!(let #write = &mut #write[..#count];));
            let from = if access.others { &read } else { &write };
            load.extend(quote!(let mut #own = ::xca_core::kernel::load::<#type_>(#from[#index]);));
            store.extend(quote!(#write[#number] = ::xca_core::kernel::store::<#type_>(#own);));
        } else if access.centre {
            load.extend(quote!(let #own = ::xca_core::kernel::load::<#type_>(#read[#index]);));
        }
    }
    let mut writer = Writer::new(function, Some(uses), real.clone());
    let Split { sums, locals, rest, is_done } = Split::of(function, uses);
    for local in &locals {
        load.extend(local.load(&writer));
    }
    let rooms: Vec<_> = locals.iter().map(|local| local.room(&mut writer)).collect();
    let sums: Vec<_> = sums.iter().map(|sums| sums.code(&mut writer, arguments)).collect();
    let body = writer.statements(rest.iter().copied(), function.body.value.as_deref());
    let lists = writer.lists();
    let mates = std::mem::take(&mut writer.mates);
    let turns = turns(function, &rest, &mut writer, &mates);
    let mates = mates.iter().map(|mates| &mates.prepare);
    // An item may look at the neighbours of the cell that it stands in.
    let neighbourhood =
        uses.neighbours.then(|| quote!(let #offsets = #row.offsets::<{ ::xca_core::kernel::ANY_SHAPE }>();));
    let (take, run) = if function.kind == FunctionKind::Migration {
        (
            quote!(let #destinations = &mut #row.destinations()[..#count];),
            quote!(let #answer: u32 = 'body: #body; #destinations[#number] = #answer;),
        )
    } else {
        (TokenStream::new(), quote!('body: #body))
    };
    if is_done {
        return quote! {
            let (#first, #count) = (#row.first_item(), #row.own_items());
            #shorten
            #(#rooms)*
            #(#sums)*
        };
    }
    // Item after item, and not cell after cell: a loop over the few items of a cell is mostly its end.
    quote! {
        #space
        #neighbourhood
        #lists
        let (#first, #count) = (#row.first_item(), #row.own_items());
        #take
        #shorten
        #(#rooms)*
        #(#sums)*
        #(#mates)*
        let mut #place = #row.place();
        #turns {
            let #item = #first + #number;
            #place.item = ::core::option::Option::Some(#item);
            let #column = #row.column_of(#number);
            let #x = #column.number();
            #load
            #run
            #store
        }
        #place.leave();
    }
}

/// The head of the loop over the items: all, or those with company if all others do nothing.
fn turns(function: &Function, rest: &[&Statement], writer: &mut Writer<'_>, mates: &[Mates]) -> TokenStream {
    let [row, number, count, company] = ["row", "number", "count", "company"].map(|name| writer.name(name));
    let Some(Company { in_cell, within }) = Company::of(function, rest, writer) else {
        return quote!(for #number in 0..#count);
    };
    let mates = mates.iter().map(|mates| &mates.marks);
    let mates = quote!(&[#(&#mates.items),*]);
    let find = match within {
        None => quote!(#row.with_mates(#mates, &mut #company.items);),
        Some(Within { radius, reach }) => {
            let (reach, positions) = (reach_number(reach), positions());
            quote!(#row.with_company::<_, #reach>(#in_cell, #mates, #radius, #positions, &mut #company.items);)
        }
    };
    quote! {
        let mut #company = #row.found();
        #find
        for #number in #company.items.iter().map(|number| *number as usize)
    }
}
