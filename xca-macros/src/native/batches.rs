//! The code of loops that only add: many pairs at a time.

use super::body::Writer;
use super::local_sums::LocalSum;
use super::loops::{positions, reach_number};
use super::mates::Condition;
use super::names::{hidden, other_name, own_name, read_name, write_name};
use super::sums::Sums;
use super::types::{native_type, parameters};
use super::work::{Argument, LIFE};
use crate::access::{Access, GroupOf, Uses};
use crate::ast::{Expression, Place, PlaceRoot, Statement};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use syn::ext::IdentExt;
use syn::{BinOp, Lifetime};

impl Sums<'_> {
    /// The code that adds the numbers of all pairs of a row.
    pub(super) fn code(&self, writer: &mut Writer<'_>, arguments: &[Argument]) -> TokenStream {
        let [row, first, item, number, pairs] =
            ["row", "first", "item", "number", "pairs"].map(|name| writer.name(name));
        let (variable, reach, positions) = (self.variable, reach_number(self.reach), positions());
        let radius = writer.expression(self.radius);
        let own = loads(self.returns.iter().copied(), writer);
        let returns: Vec<_> = self.returns.iter().map(|condition| writer.expression(condition)).collect();
        let own_of_pair = loads(self.conditions.iter().map(|condition| condition.expression), writer);
        let conditions = self.conditions.iter().map(|Condition { expression, value }| {
            let expression = writer.expression(expression);
            quote!(((#expression) == #value))
        });
        let conditions: Vec<_> = conditions.collect();
        let work = self.work(writer, arguments);
        quote! {{
            let #pairs = #row.pairs::<_, #reach>(
                #radius,
                #positions,
                |#number: usize| {
                    let #item = #first + #number;
                    #own
                    true #(&& !(#returns))*
                },
                |#number: usize, #variable: usize| {
                    let #item = #first + #number;
                    #own_of_pair
                    true #(&& #conditions)*
                },
            );
            #work
        }}
    }

    /// The work on the pairs, as a type whose method the library compiles for several processors.
    fn work(&self, writer: &mut Writer<'_>, arguments: &[Argument]) -> TokenStream {
        let [row, sums, pairs, batch, group, lane, first, place, draws, space] =
            ["row", "Sums", "pairs", "batch", "group", "lane", "first", "place", "draws", "space"]
                .map(|name| writer.name(name));
        let real = writer.real.clone();
        let frame = Lifetime::new("'__xca_frame", Span::mixed_site());
        let locals: Vec<_> = self.locals.iter().filter(|local| self.adds_to(local.name)).collect();
        let of_locals: Vec<_> = locals.iter().map(|local| local.argument(&real)).collect();
        let arguments: Vec<_> = arguments.iter().chain(&of_locals).collect();
        let constants = &writer.function.constants;
        let given: Vec<_> = constants.iter().map(|constant| &constant.ident).collect();
        let names: Vec<_> = arguments.iter().map(|argument| &argument.name).collect();
        let types = arguments.iter().map(|argument| &argument.row.type_);
        let values = arguments.iter().map(|Argument { name, written, .. }| match written {
            true => quote!(&mut *#name),
            false => quote!(#name),
        });
        let parameters = parameters(writer.function).map(|(name, _)| name);
        let Batches { room, gather, lanes } = Batches::of(&self.turn, writer);
        let mut turns = Turns::default();
        writer.others_in_lanes = true;
        self.turn.iter().for_each(|statement| turns.add(statement, &locals, writer));
        writer.others_in_lanes = false;
        let Turns { prepare, turn, add } = turns;
        quote! {
            struct #sums<#LIFE, #frame, #(#constants),*> {
                #row: &#LIFE ::xca_core::kernel::Row<#frame>,
                #pairs: &#LIFE ::xca_core::kernel::Pairs<#frame>,
                #(#names: #types),*
            }

            impl<#LIFE, #frame, #(#constants),*> ::xca_core::kernel::Work for #sums<#LIFE, #frame, #(#given),*> {
                #[inline(always)]
                fn run(self) {
                    let Self { #row, #pairs, #(#names),* } = self;
                    // A copy is read before the loop, also where only some pairs use it.
                    #(let #parameters = &{ *#parameters };)*
                    let (#first, #draws) = (#row.first_item(), &#row.draws());
                    let #space = #row.space::<#real>(#draws);
                    #room
                    #prepare
                    for #batch in #pairs.batches() {
                        #gather
                        let mut #place = #row.place();
                        for #group in #batch.groups() {
                            for #lane in #group..#group + ::xca_core::kernel::GROUP {
                                #place.item = ::core::option::Option::Some(#first + #batch.owner(#lane));
                                #lanes
                                #turn
                            }
                        }
                        #place.leave();
                        #add
                    }
                    #row.has_drawn(#draws);
                }
            }

            if !#pairs.is_empty() {
                ::xca_core::kernel::run(#sums { #row, #pairs: &#pairs, #(#names: #values),* });
            }
        }
    }
}

/// The index of an item's value in what it is read from: all items, or those of the row.
fn index(access: &Access, writer: &Writer<'_>) -> Ident {
    let is_among_all = writer.access(access.group, &access.field).is_some_and(|access| access.others);
    writer.name(if is_among_all { "item" } else { "number" })
}

/// Loads the values of the item that expressions read.
fn loads<'a>(expressions: impl Iterator<Item = &'a Expression>, writer: &Writer<'_>) -> TokenStream {
    let uses = Uses::of_expressions(expressions);
    let own = uses.accesses.iter().filter(|access| access.centre);
    own.map(|access| {
        let (group, field) = (access.group, &access.field);
        let type_ = native_type(group, field, writer.function, &writer.real);
        let (own, read, index) = (own_name(field), read_name(group, field), index(access, writer));
        quote!(let #own = ::xca_core::kernel::load::<#type_>(#read[#index]);)
    })
    .collect()
}

/// The values of both items of each pair.
#[derive(Default)]
struct Batches {
    /// Makes room for those of a batch.
    room: TokenStream,
    /// Reads those of a batch.
    gather: TokenStream,
    /// Takes those of a lane.
    lanes: TokenStream,
}

impl Batches {
    fn of(statements: &[&Statement], writer: &Writer<'_>) -> Self {
        let mut batches = Self::default();
        let [batch, lane, first] = ["batch", "lane", "first"].map(|name| writer.name(name));
        for access in &Uses::of_statements(statements).accesses {
            let (group, field) = (access.group, &access.field);
            let type_ = native_type(group, field, writer.function, &writer.real);
            let read = read_name(group, field);
            let mut add = |name: Ident, method: TokenStream, from: TokenStream| {
                let several = hidden(&format!("several_{name}"), field.span());
                batches.room.extend(quote!(let mut #several = ::xca_core::kernel::empty_batch::<#type_>();));
                batches.gather.extend(quote!(#batch.#method(#from #read, &mut #several);));
                batches.lanes.extend(quote! {
                    let #name = <#type_ as ::xca_core::kernel::KernelValue>::lane(&#several, #lane);
                });
            };
            if access.centre && !access.write {
                let from =
                    if index(access, writer) == writer.name("item") { quote!(#first) } else { quote!(0) };
                add(own_name(field), quote!(read_owners::<#type_>), quote!(#from,));
            }
            if access.others {
                add(other_name(group, field), quote!(read_others::<#type_>), TokenStream::new());
            }
        }
        batches
    }
}

/// The turns of a loop.
#[derive(Default)]
struct Turns {
    /// Makes room for the numbers of a batch.
    prepare: TokenStream,
    /// Computes those of a lane.
    turn: TokenStream,
    /// Adds those of a batch.
    add: TokenStream,
}

impl Turns {
    fn add(&mut self, statement: &Statement, locals: &[&LocalSum<'_>], writer: &mut Writer<'_>) {
        let [row, batch, lane] = ["row", "batch", "lane"].map(|name| writer.name(name));
        let Statement::Assign { place: Place { root, .. }, operator, value, .. } = statement else {
            return self.turn.extend(writer.statement(statement));
        };
        let (sum, type_, write) = match root {
            PlaceRoot::Own(field) => {
                let type_ = native_type(GroupOf::SUBJECT, field, writer.function, &writer.real);
                (field, type_, write_name(field))
            }
            PlaceRoot::Local(name) => match locals.iter().find(|local| local.name == name) {
                Some(local) => (name, local.native_type(&writer.real), local.values()),
                None => return self.turn.extend(writer.statement(statement)),
            },
        };
        let numbers = hidden(&format!("numbers_{}", write.unraw()), sum.span());
        let value = writer.expression(value);
        let method = if matches!(operator, Some(BinOp::Sub(_))) { quote!(subtract) } else { quote!(add) };
        let of_value = quote!(<#type_ as ::xca_core::kernel::KernelValue>);
        self.prepare.extend(quote!(let mut #numbers = ::xca_core::kernel::empty_batch::<#type_>();));
        self.turn.extend(quote!(#of_value::set_lane(&mut #numbers, #lane, #value);));
        self.add.extend(quote!(#batch.#method::<#type_>(#row, &#numbers, #write);));
    }
}
