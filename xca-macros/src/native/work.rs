//! A kernel's work on a row, as a type whose method the library compiles for several processors.

use super::blocks::Blocks;
use super::names::hidden;
use crate::ast::{Function, FunctionKind};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};
use syn::Lifetime;

/// The lifetime of what a kernel is handed.
pub(super) const LIFE: Life = Life;

/// See [`LIFE`].
#[derive(Clone, Copy)]
pub(super) struct Life;

impl ToTokens for Life {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        Lifetime::new("'__xca_row", Span::mixed_site()).to_tokens(tokens);
    }
}

/// What a kernel is handed: of a row, and of a block of it.
pub(super) struct Argument {
    pub(super) name: Ident,
    /// Whether it is written.
    pub(super) written: bool,
    pub(super) row: Typed,
    /// Another type and value where those of a block are not those of the row.
    pub(super) block: Option<Typed>,
}

/// A value and its type.
pub(super) struct Typed {
    pub(super) type_: TokenStream,
    pub(super) value: TokenStream,
}

/// A kernel's work on a row.
///
/// Each substate is an argument of its own of the inner function: that tells the compiler that what is
/// written is apart from what is read, without which it would not vectorise.
pub(super) struct Work<'a> {
    pub(super) function: &'a Function,
    pub(super) arguments: Vec<Argument>,
    pub(super) blocks: Blocks,
    /// For the cells of a block.
    pub(super) body: TokenStream,
}

impl Work<'_> {
    fn name(&self, name: &str) -> Ident {
        hidden(name, self.function.name.span())
    }

    /// The type and the function.
    pub(super) fn definition(&self) -> TokenStream {
        let Self { function, arguments, blocks, body } = self;
        let [work, inner, shape, row, columns, draws] =
            ["Work", "inner", "SHAPE", "row", "columns", "draws"].map(|name| self.name(name));
        let constants = &function.constants;
        let given = constants.iter().map(|constant| &constant.ident);
        let given = quote!(#shape, #(#given),*);
        let declared = quote!(const #shape: ::xca_core::kernel::ShapeNumber, #(#constants),*);
        let frame = Lifetime::new("'__xca_frame", Span::mixed_site());
        let names: Vec<_> = arguments.iter().map(|argument| &argument.name).collect();
        let of_row = arguments.iter().map(|argument| &argument.row.type_);
        let of_block =
            arguments.iter().map(|argument| &argument.block.as_ref().unwrap_or(&argument.row).type_);
        let handed = arguments.iter().map(|Argument { name, block, .. }| match block {
            Some(Typed { value, .. }) => value.clone(),
            None => quote!(#name),
        });
        let row_type = quote!(&#LIFE ::xca_core::kernel::Row<#frame>);
        let blocks =
            blocks.around(&quote!(#inner::<#given>(#row, &#draws, #columns, #(#handed),*)), &row, &columns);
        let inline = if self.over_cells() { quote!(always) } else { quote!(never) };
        quote! {
            struct #work<#LIFE, #frame, #declared> {
                #row: #row_type,
                #(#names: #of_row),*
            }

            impl<#LIFE, #frame, #declared> ::xca_core::kernel::Work for #work<#LIFE, #frame, #given> {
                #[inline(always)]
                fn run(self) {
                    let Self { #row, #(mut #names),* } = self;
                    let #draws = #row.draws();
                    #blocks
                    #row.has_drawn(&#draws);
                }
            }

            #[inline(#inline)]
            fn #inner<#LIFE, #frame, #declared>(
                #row: #row_type,
                #draws: &::xca_core::kernel::Draws,
                #columns: ::xca_core::kernel::Columns<#LIFE>,
                #(#names: #of_block),*
            ) #body
        }
    }

    /// The work on a row whose neighbourhood has this shape.
    pub(super) fn call(&self, shape: &TokenStream) -> TokenStream {
        let [work, row] = ["Work", "row"].map(|name| self.name(name));
        let given = self.function.constants.iter().map(|constant| &constant.ident);
        let fields = self
            .arguments
            .iter()
            .map(|Argument { name, row: Typed { value, .. }, .. }| quote!(#name: #value));
        let work = quote!(#work::<#shape, #(#given),*> { #row, #(#fields),* });
        if self.over_cells() {
            quote!(::xca_core::kernel::run(#work))
        } else {
            quote!(::xca_core::kernel::Work::run(#work))
        }
    }

    fn over_cells(&self) -> bool {
        self.function.kind == FunctionKind::Cells
    }
}
