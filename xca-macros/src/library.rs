//! The path by which generated code names the library.
//!
//! Everywhere in this crate it is written `::xca_core`. A crate that depends on `xca` alone does not know
//! that name, and may have given another one to either: so the words are replaced by what its manifest says.

use proc_macro_crate::{FoundCrate, crate_name};
use proc_macro2::{Group, Ident, Punct, Spacing, Span, TokenStream, TokenTree};
use quote::quote_spanned;

/// The code with the path of the library as this crate knows it.
pub(crate) fn named(code: TokenStream) -> TokenStream {
    match (crate_name("xca-core"), crate_name("xca")) {
        (Ok(FoundCrate::Name(name)), _) if name != "xca_core" => renamed(code, &[&name]),
        (Ok(_), _) | (Err(_), Err(_)) => code,
        (Err(_), Ok(FoundCrate::Itself)) => renamed(code, &["xca", CORE]),
        (Err(_), Ok(FoundCrate::Name(name))) => renamed(code, &[&name, CORE]),
    }
}

/// What `xca` calls `xca-core`.
const CORE: &str = "__core";

/// The code with other names in place of `xca_core` in `::xca_core`.
fn renamed(code: TokenStream, names: &[&str]) -> TokenStream {
    let mut renamed = Vec::new();
    for token in code {
        match token {
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), self::renamed(group.stream(), names));
                inner.set_span(group.span());
                renamed.push(TokenTree::Group(inner));
            }
            TokenTree::Ident(word) if word == "xca_core" && ends_in_colons(&renamed) => {
                renamed.extend(path(names, word.span()));
            }
            other => renamed.push(other),
        }
    }
    renamed.into_iter().collect()
}

fn ends_in_colons(tokens: &[TokenTree]) -> bool {
    let is_colon = |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ':');
    matches!(tokens, [.., first, second] if is_colon(first) && is_colon(second))
}

fn path(names: &[&str], span: Span) -> TokenStream {
    let mut path = TokenStream::new();
    for (number, name) in names.iter().enumerate() {
        if number > 0 {
            path.extend(colons(span));
        }
        path.extend([TokenTree::Ident(Ident::new(name, span))]);
    }
    path
}

fn colons(span: Span) -> TokenStream {
    let mut first = Punct::new(':', Spacing::Joint);
    let mut second = Punct::new(':', Spacing::Alone);
    first.set_span(span);
    second.set_span(span);
    quote_spanned!(span=> #first #second)
}

#[cfg(test)]
mod tests {
    use super::renamed;
    use quote::quote;

    #[test]
    fn only_the_library_is_renamed() {
        let code =
            quote!(impl ::xca_core::States for A { fn f() { (::xca_core::kernel::STAY, xca_core, a::b) } });
        let expected = quote!(impl ::lib::__core::States for A { fn f() { (::lib::__core::kernel::STAY, xca_core, a::b) } });
        assert_eq!(renamed(code, &["lib", "__core"]).to_string(), expected.to_string());
    }
}
