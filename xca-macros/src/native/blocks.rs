//! The blocks of cells through which a kernel goes.

use super::names::{hidden, write_name};
use crate::access::Access;
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::ext::IdentExt;

/// What is done around the blocks for the substates that are written.
#[derive(Default)]
pub(super) struct Blocks {
    prepare: TokenStream,
    before: TokenStream,
    after: TokenStream,
    types: Vec<TokenStream>,
}

impl Blocks {
    /// Adds a substate of cells that is written, and says what of it is handed to the kernel.
    pub(super) fn add(&mut self, access: &Access, type_: &TokenStream) -> TokenStream {
        let written = write_name(&access.field);
        let span = written.span();
        let stage = hidden(&format!("stage_{}", access.field.unraw()), span);
        let numbers = hidden("numbers", span);
        let trait_ = quote!(::xca_core::kernel::Written::<'_, #type_>);
        self.prepare.extend(quote! {
            let mut #stage = <<#type_ as ::xca_core::kernel::KernelValue>::Written<'_> as #trait_>::stage();
        });
        if !access.others {
            self.before.extend(quote!(#trait_::load(&#written, &mut #stage, &#numbers);));
        }
        self.after.extend(quote!(#trait_::store(&mut #written, &#stage, &#numbers);));
        self.types.push(type_.clone());
        quote!(#trait_::lanes(&mut #written, &mut #stage, &#numbers))
    }

    /// The loop over the blocks.
    pub(super) fn around(&self, call: &TokenStream, row: &Ident, columns: &Ident) -> TokenStream {
        let Self { prepare, before, after, types } = self;
        let numbers = hidden("numbers", row.span());
        let most = types.iter().map(|type_| quote!(<#type_ as ::xca_core::kernel::KernelValue>::BLOCK));
        quote! {
            #prepare
            for #columns in #row.blocks(::xca_core::kernel::block(&[#(#most),*])) {
                let #numbers = #columns.numbers();
                #before
                #call;
                #after
            }
        }
    }
}
