//! Short loops written out.
//!
//! The compiler writes out a loop only up to a size that it chooses. A loop over the directions of a lattice
//! is beyond that, and what is left as a loop keeps its arrays in memory and the cells from being computed
//! side by side.
//!
//! Loops that count to the number of neighbours stay loops: there are kernels for many neighbourhoods, and
//! few of these are large.

use super::body::Writer;
use super::labels::{Unrolled, hidden_label, turn, turns};
use crate::ast::{Block, Expression, Range};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{BinOp, Lifetime};

/// The most turns that are written out: as many as Moore's neighbourhood has cells.
const MOST: usize = 27;

/// The largest number at which a loop that is written out begins: with the turns it stays within all types.
const LARGEST_START: usize = 100;

impl Writer<'_> {
    /// A loop over a range, written out where its ends are known to the compiler and near, and no loop stands
    /// in it.
    pub(super) fn range_loop(
        &mut self,
        label: Option<&Lifetime>,
        variable: &Ident,
        range: &Range,
        body: &Block,
    ) -> TokenStream {
        let known = self.loops;
        let (over, turns) = (self.range(range), self.block(body));
        let name = label.map(hidden_label).map(|label| quote!(#label:));
        let plain = quote!(#name for #variable in #over #turns);
        match start(range) {
            Some(start) if self.loops == known => self.turns(label, variable, start, range, body, &plain),
            _ => plain,
        }
    }

    fn turns(
        &mut self,
        label: Option<&Lifetime>,
        variable: &Ident,
        start: usize,
        range: &Range,
        body: &Block,
        plain: &TokenStream,
    ) -> TokenStream {
        let end = literal(&range.to).map(|end| end + usize::from(range.inclusive));
        if end.is_some_and(|end| end > start + MOST) {
            return plain.clone();
        }
        let outer = self.unrolled.replace(Unrolled { label: label.cloned() });
        let body = self.block(body);
        self.unrolled = outer;
        let (from, to) = (self.expression(&range.from), self.expression(&range.to));
        let compare = if range.inclusive { quote!(<=) } else { quote!(<) };
        let (all, one) = (turns(), turn());
        let count = end.map_or(MOST, |end| end.saturating_sub(start));
        let copies = (0..count).map(proc_macro2::Literal::usize_unsuffixed).map(|number| {
            quote! {
                let #variable = #from + #number;
                if #variable #compare #to {
                    #one: #body
                }
            }
        });
        let copies = quote!(#all: { #(#copies)* });
        if end.is_some() {
            return copies;
        }
        let most = proc_macro2::Literal::usize_unsuffixed(MOST);
        quote!(if #from + #most #compare #to { #plain } else { #copies })
    }
}

/// Where a range begins that may be written out.
fn start(range: &Range) -> Option<usize> {
    let plain = !range.reversed && range.step.is_none() && is_fixed(&range.to);
    literal(&range.from).filter(|start| plain && *start <= LARGEST_START)
}

fn literal(expression: &Expression) -> Option<usize> {
    match expression {
        Expression::Integer(value) => value.base10_parse().ok(),
        _ => None,
    }
}

/// Whether the compiler knows the value when it makes a kernel.
fn is_fixed(expression: &Expression) -> bool {
    match expression {
        Expression::Integer(_) | Expression::Constant(_) => true,
        Expression::Binary(BinOp::Add(_) | BinOp::Sub(_) | BinOp::Mul(_), left, right) => {
            is_fixed(left) && is_fixed(right)
        }
        _ => false,
    }
}
