//! `#[parameter(…)]` and `#[substate(…)]`: what is said of a field beside its type.

use proc_macro2::TokenStream;
use quote::quote;
use syn::meta::ParseNestedMeta;
use syn::{Attribute, Error, Expr, ExprLit, ExprRange, Lit, LitStr, Meta, RangeLimits, Result};

/// What a struct is derived for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    Substate,
    Parameter,
}

impl Wanted {
    fn attribute(self) -> &'static str {
        match self {
            Self::Substate => "substate",
            Self::Parameter => "parameter",
        }
    }

    fn usage(self) -> &'static str {
        match self {
            Self::Substate => "a substate has a unit: `#[substate(unit = \"K\")]`",
            Self::Parameter => {
                "a parameter has a unit, a range, or is computed: `#[parameter(unit = \"m/s\", range = 0.0..=1.0)]`, \
                 `#[parameter(positive)]`, `#[parameter(computed)]`"
            }
        }
    }
}

/// What is said of a field.
#[derive(Default)]
pub(super) struct About {
    unit: Option<LitStr>,
    low: Option<End>,
    high: Option<End>,
    computed: bool,
}

/// An end of a range.
struct End {
    number: TokenStream,
    included: bool,
}

impl About {
    pub(super) fn of(field: &syn::Field, wanted: Wanted) -> Result<Self> {
        let mut about = Self::default();
        for attribute in &field.attrs {
            if attribute.path().is_ident(wanted.attribute()) {
                attribute.parse_nested_meta(|meta| about.read(&meta, wanted))?;
            } else if attribute.path().is_ident("parameter") || attribute.path().is_ident("substate") {
                return Err(Error::new_spanned(attribute, wanted.usage()));
            }
        }
        Ok(about)
    }

    fn read(&mut self, meta: &ParseNestedMeta<'_>, wanted: Wanted) -> Result<()> {
        if meta.path.is_ident("unit") {
            self.unit = Some(meta.value()?.parse()?);
        } else if wanted == Wanted::Parameter && meta.path.is_ident("range") {
            let range: Expr = meta.value()?.parse()?;
            self.range(&range)?;
        } else if wanted == Wanted::Parameter && meta.path.is_ident("positive") {
            self.low = Some(End { number: quote!(0.0), included: false });
        } else if wanted == Wanted::Parameter && meta.path.is_ident("computed") {
            self.computed = true;
        } else {
            return Err(meta.error(wanted.usage()));
        }
        Ok(())
    }

    fn range(&mut self, range: &Expr) -> Result<()> {
        let Expr::Range(ExprRange { start, limits, end, .. }) = range else {
            return Err(Error::new_spanned(range, "a range is `0.0..`, `..=1.0`, `0.0..1.0` or `0.0..=1.0`"));
        };
        self.low = start.as_deref().map(|start| End { number: quote!(#start), included: true });
        let included = matches!(limits, RangeLimits::Closed(_));
        self.high = end.as_deref().map(|end| End { number: quote!(#end), included });
        Ok(())
    }

    /// The fields of `xca_core::Field` that follow from it.
    pub(super) fn tokens(&self) -> TokenStream {
        let unit = match &self.unit {
            Some(unit) => quote!(::core::option::Option::Some(#unit)),
            None => quote!(::core::option::Option::None),
        };
        let [low, high] = [&self.low, &self.high].map(|end| match end {
            Some(End { number, included }) => quote! {
                ::core::option::Option::Some(::xca_core::End { number: (#number) as f64, included: #included })
            },
            None => quote!(::core::option::Option::None),
        });
        let computed = self.computed;
        quote! {
            unit: #unit,
            range: ::xca_core::Interval { low: #low, high: #high },
            computed: #computed,
        }
    }
}

/// The lines of a documentation, joined.
pub(super) fn documentation(attributes: &[Attribute]) -> String {
    let line = |attribute: &Attribute| match &attribute.meta {
        Meta::NameValue(meta) => match &meta.value {
            Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => Some(text.value().trim().to_owned()),
            _ => None,
        },
        _ => None,
    };
    attributes.iter().filter_map(line).collect::<Vec<_>>().join(" ")
}
