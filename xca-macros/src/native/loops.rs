//! Loops in one precision.

use super::body::Writer;
use super::labels::hidden_label;
use super::mates::{Condition, Mates};
use super::names::read_name;
use crate::access::GroupOf;
use crate::ast::{Block, Expression, Loop, LoopKind, Range, Reach};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

impl Writer<'_> {
    pub(super) fn loop_(&mut self, loop_: &Loop) -> TokenStream {
        self.loops += 1;
        let name = loop_.label.as_ref();
        let label = name.map(hidden_label).map(|label| quote!(#label:));
        let body = &loop_.body;
        match &loop_.kind {
            LoopKind::While(condition) => {
                let (condition, body) = (self.expression(condition), self.block(body));
                quote!(#label while #condition #body)
            }
            LoopKind::Forever => {
                let body = self.block(body);
                quote!(#label loop #body)
            }
            LoopKind::Range { variable, range } => self.range_loop(name, variable, range, body),
            LoopKind::Elements { variable, array } => {
                let (array, body) = (self.expression(array), self.block(body));
                quote!(#label for #variable in #array #body)
            }
            LoopKind::Others { variable, reach, radius } => {
                self.for_others(label.as_ref(), variable, *reach, radius.as_ref(), body)
            }
            LoopKind::Items { variable } => {
                let (row, column) = (self.name("row"), self.name("column"));
                let body = self.block(body);
                quote!(#label for #variable in #row.items(#column) #body)
            }
        }
    }

    pub(super) fn range(&mut self, range: &Range) -> TokenStream {
        let (from, to) = (self.expression(&range.from), self.expression(&range.to));
        let dots = if range.inclusive { quote!(..=) } else { quote!(..) };
        let reversed = range.reversed.then(|| quote!(.rev()));
        let step = range.step.as_ref().map(|step| {
            let step = self.expression(step);
            quote!(.step_by(#step))
        });
        match (&reversed, &step) {
            (None, None) => quote!(#from #dots #to),
            _ => quote!((#from #dots #to) #reversed #step),
        }
    }

    fn for_others(
        &mut self,
        label: Option<&TokenStream>,
        variable: &Ident,
        reach: Reach,
        radius: Option<&Expression>,
        body: &Block,
    ) -> TokenStream {
        let [row, column, item] = ["row", "column", "item"].map(|name| self.name(name));
        let number = reach_number(reach);
        if reach == Reach::Cell && radius.is_none() {
            let condition = Condition::of(variable, body).map(|Condition { expression, value }| {
                let expression = self.expression(expression);
                quote!((#expression) == #value)
            });
            let body = self.block(body);
            let turns = quote! {
                #label for #variable in #row.items(#column) {
                    if #variable == #item {
                        continue;
                    }
                    #body
                }
            };
            let Some(condition) = condition else { return turns };
            let (marks, number) = (self.name(&format!("mates_{}", self.mates.len())), self.name("number"));
            let guarded = quote!(if #marks.items[#number] != 0 { #turns });
            self.mates.push(Mates::new(marks, variable, &condition, &row));
            return guarded;
        }
        let list = self.list(self.searches);
        self.searches += 1;
        let search = match radius {
            None => quote!(#row.others::<#number>(#column, #item, &mut #list.items);),
            Some(radius) => {
                let radius = self.expression(radius);
                let positions = positions();
                quote!(#row.others_within::<_, #number>(#column, #item, #positions[#item], #radius, #positions, &mut #list.items);)
            }
        };
        let body = self.block(body);
        let index = self.name("index");
        quote! {
            #search
            #label for #index in 0..#list.items.len() {
                let #variable = #list.items[#index] as usize;
                #body
            }
        }
    }
}

/// The number of the searched cells, see `xca_core::kernel::reach`.
pub(super) fn reach_number(reach: Reach) -> TokenStream {
    match reach {
        Reach::Cell => quote!(0),
        Reach::Neighbours => quote!(1),
        Reach::All => quote!(2),
    }
}

/// The argument with the positions of all items.
pub(super) fn positions() -> Ident {
    read_name(GroupOf::Position, &Ident::new("position", Span::call_site()))
}
