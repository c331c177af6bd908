//! Iterators: loops over elements with their indices, and chains that end in a value, such as
//! `(0..n).filter(|i| …).map(|i| …).sum::<Real>()`. A chain becomes a block with a loop.

use crate::spelled::{Spelled, hidden, strip};
use proc_macro2::TokenStream;
use quote::quote;
use syn::{
    Error, Expr, ExprClosure, ExprForLoop, ExprMethodCall, ExprRange, Ident, Pat, RangeLimits, Result,
    parse_quote,
};

const ENDS: [&str; 5] = ["any", "all", "count", "sum", "fold"];
const ITERATORS: [&str; 9] =
    ["iter", "into_iter", "rev", "step_by", "copied", "cloned", "enumerate", "map", "filter"];

/// Whether a call ends a chain.
pub(crate) fn is_chain(call: &ExprMethodCall) -> bool {
    let is_iterator = match strip(&call.receiver) {
        Expr::Range(_) => true,
        Expr::MethodCall(inner) => {
            let name = inner.method.to_string();
            ITERATORS.contains(&name.as_str()) || name.starts_with("others")
        }
        _ => false,
    };
    is_iterator && ENDS.iter().any(|end| call.method == end)
}

/// A turn of a loop, as far as it has been read.
#[derive(Default)]
struct Turn {
    /// The names of what the loop goes through.
    outer: Vec<Ident>,
    /// What the last `map` gives, before it has a name.
    mapped: Option<TokenStream>,
    /// The names of what comes next.
    names: Vec<Ident>,
    parts: Vec<Part>,
}

/// A part of a turn.
enum Part {
    Let(TokenStream),
    /// The rest of the turn is for those that pass.
    Filter(Expr),
}

impl Turn {
    /// Gives names to what comes next.
    fn take(&mut self, names: Vec<Ident>) {
        if let Some(value) = self.mapped.take() {
            let name = &names[0];
            self.parts.push(Part::Let(quote!(let #name = #value;)));
        } else if self.outer.is_empty() {
            self.outer = names.clone();
        } else {
            for (before, name) in self.names.iter().zip(&names).filter(|(before, name)| before != name) {
                self.parts.push(Part::Let(quote!(let #name = #before;)));
            }
        }
        self.names = names;
    }

    /// The statements of the turn, the last ones given.
    fn around(&self, last: TokenStream) -> TokenStream {
        self.parts.iter().rev().fold(last, |rest, part| match part {
            Part::Let(let_) => quote!(#let_ #rest),
            Part::Filter(condition) => quote!(if #condition { #rest }),
        })
    }

    fn pattern(&self) -> TokenStream {
        let value = hidden("value");
        match &self.outer[..] {
            [index, value] => quote!((#index, #value)),
            outer => {
                let value = outer.first().unwrap_or(&value);
                quote!(#value)
            }
        }
    }
}

impl Spelled {
    /// A loop over elements with their indices, or over what a chain gives.
    pub(crate) fn for_loop(&mut self, for_: &ExprForLoop) -> Result<Expr> {
        let (stages, over) = stages(&for_.expr);
        let mut for_ = for_.clone();
        if !stages.is_empty() {
            let mut turn = self.stages(&stages, may_borrow(over))?;
            turn.take(self.names(&for_.pat, may_borrow(over)));
            let (body, pattern) = (&for_.body.stmts, turn.pattern());
            let body = turn.around(quote!(#(#body)*));
            let label = &for_.label;
            let loop_: ExprForLoop = parse_quote!(#label for #pattern in #over { #body });
            return self.for_loop(&loop_);
        }
        let (elements, numbered) = elements(over);
        if !numbered {
            *for_.pat = self.plain(&for_.pat, may_borrow(over));
            if let Some(elements) = elements {
                *for_.expr = elements.clone();
            }
            return Ok(Expr::ForLoop(for_));
        }
        let names = self.names(&for_.pat, true);
        let ([index, value], Some(array)) = (&names[..], elements) else {
            return Err(Error::new_spanned(
                &for_.pat,
                "`enumerate` numbers the elements of an array: `for (i, value) in values.iter().enumerate()`",
            ));
        };
        let copy = hidden("elements");
        *for_.pat = parse_quote!(#index);
        *for_.expr = parse_quote!(0..#copy.len());
        for_.body.stmts.insert(0, parse_quote!(let #value = #copy[#index];));
        Ok(parse_quote!({ let #copy = #array; #for_ }))
    }

    /// The block of a chain.
    pub(crate) fn chain(&mut self, call: &ExprMethodCall) -> Result<Expr> {
        let (stages, over) = stages(&call.receiver);
        let mut turn = self.stages(&stages, may_borrow(over))?;
        let (end, result) = (call.method.to_string(), hidden("result"));
        let (start, last) = match end.as_str() {
            "any" | "all" => {
                let [argument] = arguments(call, "any(|value| …)")?;
                let closure = closure(argument, 1)?;
                turn.take(self.names(&closure.inputs[0], may_borrow(over)));
                let value = &closure.body;
                let (start, operator) = if end == "any" { (false, quote!(||)) } else { (true, quote!(&&)) };
                (quote!(= #start), quote!(#result = #result #operator (#value);))
            }
            "fold" => {
                let [start, argument] = arguments(call, "fold(start, |result, value| …)")?;
                let closure = closure(argument, 2)?;
                let before = self.names(&closure.inputs[0], false);
                turn.take(self.names(&closure.inputs[1], may_borrow(over)));
                let value = &closure.body;
                (quote!(= #start), quote!(#(let #before = #result;)* #result = #value;))
            }
            _ => {
                let [] = arguments(call, &format!("{end}()"))?;
                number(call, &mut turn)?
            }
        };
        let body = turn.around(last);
        let is_filtered = turn.parts.iter().any(|part| matches!(part, Part::Filter(_)));
        // What is known is not asked again.
        let body = match end.as_str() {
            "any" if is_filtered => quote!(if !#result { #body }),
            "all" if is_filtered => quote!(if #result { #body }),
            _ => body,
        };
        let pattern = turn.pattern();
        let loop_: ExprForLoop = parse_quote!(for #pattern in #over { #body });
        let loop_ = self.for_loop(&loop_)?;
        Ok(parse_quote!({ let mut #result #start; #loop_ #result }))
    }

    /// Whether a range or an array contains a value.
    pub(crate) fn contains(&mut self, call: &ExprMethodCall) -> Result<Expr> {
        let [argument] = arguments(call, "contains(&value)")?;
        let wanted = if let Expr::Reference(inner) = strip(argument) { &inner.expr } else { argument };
        let (name, element, over) = (hidden("wanted"), hidden("element"), &call.receiver);
        let is_in = if let Expr::Range(ExprRange { start, limits, end, .. }) = strip(over) {
            let is_below = if matches!(limits, RangeLimits::HalfOpen(_)) { quote!(<) } else { quote!(<=) };
            let start = start.iter().map(|start| quote!(#start <= #name));
            let bounds = start.chain(end.iter().map(|end| quote!(#name #is_below #end)));
            quote!(#(#bounds)&&*)
        } else {
            let any = self.chain(&parse_quote!(#over.iter().any(|#element| #element == #name)))?;
            quote!(#any)
        };
        Ok(parse_quote!({ let #name = #wanted; #is_in }))
    }

    /// The turn after `map` and `filter`, of which the last one comes first.
    fn stages(&mut self, stages: &[&ExprMethodCall], borrowed: bool) -> Result<Turn> {
        let mut turn = Turn::default();
        for stage in stages.iter().rev() {
            let [argument] = arguments(stage, &format!("{}(|value| …)", stage.method))?;
            let ExprClosure { inputs, body, .. } = closure(argument, 1)?;
            let is_filter = stage.method == "filter";
            turn.take(self.names(&inputs[0], borrowed || is_filter));
            if is_filter {
                turn.parts.push(Part::Filter((**body).clone()));
            } else {
                turn.mapped = Some(quote!(#body));
            }
        }
        Ok(turn)
    }

    /// The names in a pattern.
    fn names(&mut self, pattern: &Pat, borrowed: bool) -> Vec<Ident> {
        match self.plain(pattern, borrowed) {
            Pat::Ident(name) => vec![name.ident],
            Pat::Tuple(pair) => pair.elems.iter().flat_map(|part| self.names(part, borrowed)).collect(),
            _ => vec![hidden("value")],
        }
    }

    /// A pattern without references and types; its name may be a reference.
    fn plain(&mut self, pattern: &Pat, borrowed: bool) -> Pat {
        match pattern {
            Pat::Paren(paren) => self.plain(&paren.pat, borrowed),
            Pat::Type(typed) => self.plain(&typed.pat, borrowed),
            Pat::Reference(inner) if inner.mutability.is_none() => self.plain(&inner.pat, borrowed),
            other => {
                if let (Pat::Ident(name), true) = (other, borrowed) {
                    self.references.push(name.ident.clone());
                }
                other.clone()
            }
        }
    }
}

/// `count` and `sum`: type and value at the start, and the statement of a turn.
fn number(call: &ExprMethodCall, turn: &mut Turn) -> Result<(TokenStream, TokenStream)> {
    let (method, result, value) = (&call.method, hidden("result"), hidden("value"));
    let mapped = turn.mapped.take();
    if method == "count" {
        turn.parts.extend(mapped.map(|mapped| Part::Let(quote!(let #value = #mapped;))));
        return Ok((quote!(: usize = 0), quote!(#result += 1;)));
    }
    let Some(type_) = call.turbofish.as_ref().and_then(|turbofish| turbofish.args.first()) else {
        return Err(Error::new_spanned(method, "give the type: `sum::<Real>()`"));
    };
    let value = mapped.unwrap_or_else(|| {
        let value = turn.names.last().unwrap_or(&value);
        quote!(#value)
    });
    let is_float = ["Real", "f32", "f64"].contains(&quote!(#type_).to_string().as_str());
    // As in Rust, the sum of nothing is -0: with 0 the sum of -0 alone would be 0.
    let start = if is_float { quote!(-0.0) } else { quote!(0) };
    Ok((quote!(: #type_ = #start), quote!(#result += #value;)))
}

/// Whether an iterator may give references: not a range.
fn may_borrow(over: &Expr) -> bool {
    matches!(strip(over), Expr::Reference(_)) || elements(over).0.is_some()
}

/// The `map` and `filter` of a chain, the last one first, and what it goes through.
fn stages(chain: &Expr) -> (Vec<&ExprMethodCall>, &Expr) {
    let (mut stages, mut over) = (Vec::new(), strip(chain));
    while let Expr::MethodCall(stage) = over
        && (stage.method == "map" || stage.method == "filter")
    {
        stages.push(stage);
        over = strip(&stage.receiver);
    }
    (stages, over)
}

/// The array behind `iter` and its kin, and whether its elements are numbered.
fn elements(over: &Expr) -> (Option<&Expr>, bool) {
    let Expr::MethodCall(call) = strip(over) else { return (None, false) };
    let (inner, numbered) = elements(&call.receiver);
    match call.method.to_string().as_str() {
        "iter" | "into_iter" | "copied" | "cloned" => (inner.or(Some(&call.receiver)), numbered),
        "enumerate" => (inner, true),
        _ => (None, false),
    }
}

fn arguments<'a, const N: usize>(call: &'a ExprMethodCall, usage: &str) -> Result<[&'a Expr; N]> {
    let arguments: Vec<&Expr> = call.args.iter().collect();
    arguments.try_into().map_err(|_| Error::new_spanned(&call.method, format!("write `{usage}`")))
}

/// A closure with so many arguments.
fn closure(argument: &Expr, count: usize) -> Result<&ExprClosure> {
    match argument {
        Expr::Closure(closure) if closure.inputs.len() == count && closure.asyncness.is_none() => Ok(closure),
        other => {
            let usage = if count == 1 { "`|value| …`" } else { "`|result, value| …`" };
            Err(Error::new_spanned(other, format!("write a closure here: {usage}")))
        }
    }
}
