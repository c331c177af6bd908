//! `#[parameter(…)]` and `#[substate(…)]`: what is said of a field beside its type.

use proc_macro2::TokenStream;
use quote::quote;
use std::fmt;
use syn::meta::ParseNestedMeta;
use syn::{
    Attribute, Error, Expr, ExprLit, ExprRange, ExprUnary, Lit, LitStr, Meta, Path, RangeLimits, Result,
    Token, UnOp,
};

/// What a struct is derived for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// Substates.
    Substate,
    /// Parameters.
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
pub struct About {
    unit: Option<LitStr>,
    range: Option<(Path, Expr)>,
    positive: Option<Path>,
    low: Option<End>,
    high: Option<End>,
    computed: bool,
}

impl fmt::Debug for About {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("About").field("computed", &self.computed).finish_non_exhaustive()
    }
}

/// An end of a range.
struct End {
    number: TokenStream,
    included: bool,
}

impl About {
    /// Reads the attributes of a field.
    ///
    /// # Errors
    /// An attribute that is none of a field, or says something twice or nothing that makes sense.
    pub fn of(field: &syn::Field, wanted: Wanted) -> Result<Self> {
        let mut about = Self::default();
        for attribute in &field.attrs {
            if attribute.path().is_ident(wanted.attribute()) {
                attribute.parse_nested_meta(|meta| about.read(&meta, wanted))?;
            } else if attribute.path().is_ident("parameter") || attribute.path().is_ident("substate") {
                return Err(Error::new_spanned(attribute, wanted.usage()));
            }
        }
        about.limit()?;
        Ok(about)
    }

    /// What `range` and `positive` say together.
    fn limit(&mut self) -> Result<()> {
        if let Some((_, range)) = self.range.clone() {
            self.read_range(&range)?;
        }
        let Some(positive) = &self.positive else { return Ok(()) };
        if self.low.is_some() {
            let advice = "`positive` is a lower end: leave it out, or give the upper end alone: `positive, range = ..=1.0`";
            return Err(Error::new_spanned(positive, advice));
        }
        self.low = Some(End { number: quote!(0.0), included: false });
        Ok(())
    }

    fn read(&mut self, meta: &ParseNestedMeta<'_>, wanted: Wanted) -> Result<()> {
        if meta.path.is_ident("unit") {
            let text = meta.value()?.parse::<LitStr>();
            let text = text.map_err(|error| Error::new(error.span(), "a unit is a text: `unit = \"m\"`"))?;
            once(self.unit.replace(text).is_some(), meta)?;
        } else if wanted == Wanted::Parameter && meta.path.is_ident("range") {
            once(self.range.replace((meta.path.clone(), meta.value()?.parse()?)).is_some(), meta)?;
        } else if wanted == Wanted::Parameter && meta.path.is_ident("positive") {
            alone(meta)?;
            once(self.positive.replace(meta.path.clone()).is_some(), meta)?;
        } else if wanted == Wanted::Parameter && meta.path.is_ident("computed") {
            alone(meta)?;
            once(std::mem::replace(&mut self.computed, true), meta)?;
        } else {
            return Err(meta.error(wanted.usage()));
        }
        Ok(())
    }

    fn read_range(&mut self, range: &Expr) -> Result<()> {
        let Expr::Range(ExprRange { start, limits, end, .. }) = range else {
            return Err(Error::new_spanned(range, "a range is `0.0..`, `..=1.0`, `0.0..1.0` or `0.0..=1.0`"));
        };
        self.low = start.as_deref().map(|start| End { number: quote!(#start), included: true });
        let included = matches!(limits, RangeLimits::Closed(_));
        let numbers = (start.as_deref().and_then(number), end.as_deref().and_then(number));
        if let (Some(low), Some(high)) = numbers
            && (low > high || low == high && !included)
        {
            return Err(Error::new_spanned(range, "no number lies in this range"));
        }
        self.high = end.as_deref().map(|end| End { number: quote!(#end), included });
        Ok(())
    }

    /// The word that gives a range.
    pub fn limited_by(&self) -> Option<&Path> {
        self.positive.as_ref().or(self.range.as_ref().map(|(word, _)| word))
    }

    /// The fields of `xca_core::Field` that follow from it.
    pub fn tokens(&self) -> TokenStream {
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

/// Refuses a word that was said before.
fn once(again: bool, meta: &ParseNestedMeta<'_>) -> Result<()> {
    if again { Err(meta.error("this word is given twice; once is enough")) } else { Ok(()) }
}

/// Refuses a value of a word that has none.
fn alone(meta: &ParseNestedMeta<'_>) -> Result<()> {
    if meta.input.peek(Token![=]) {
        Err(meta.error("this word has no value; leave out what follows it"))
    } else {
        Ok(())
    }
}

/// The number that an end of a range is, where it is written as one.
fn number(end: &Expr) -> Option<f64> {
    match end {
        Expr::Lit(ExprLit { lit: Lit::Float(float), .. }) => float.base10_parse().ok(),
        Expr::Lit(ExprLit { lit: Lit::Int(integer), .. }) => integer.base10_parse().ok(),
        Expr::Unary(ExprUnary { op: UnOp::Neg(_), expr, .. }) => number(expr).map(|number| -number),
        _ => None,
    }
}

/// The lines of a documentation, joined.
pub fn documentation(attributes: &[Attribute]) -> String {
    let line = |attribute: &Attribute| match &attribute.meta {
        Meta::NameValue(meta) => match &meta.value {
            Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => Some(text.value().trim().to_owned()),
            _ => None,
        },
        _ => None,
    };
    attributes.iter().filter_map(line).collect::<Vec<_>>().join(" ")
}
