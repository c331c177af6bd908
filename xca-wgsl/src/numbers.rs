//! The routines behind operations of numbers that WGSL has not, or leaves to the driver.

use crate::routine::Routines;
use crate::types::Type;
use xca_core::ir::Operation;

impl Routines {
    /// An operation of one number, or of two, all of this type. A float is `wide` where it has 64 bits.
    pub(crate) fn need_number(&mut self, operation: Operation, type_: &Type, wide: bool) -> String {
        let name = type_.wgsl();
        let largest = if wide { format!("{:?}lf", f64::MAX) } else { format!("{:?}f", f32::MAX) };
        match operation {
            Operation::CopySign => {
                let negative = self.need_number(Operation::IsSignNegative, type_, wide);
                self.need_of_two(
                    "copysign",
                    type_,
                    &[&format!("return select(abs(a), -abs(a), {negative}(b));")],
                )
            }
            Operation::Signum => {
                let negative = self.need_number(Operation::IsSignNegative, type_, wide);
                let lines = [
                    "if !(a == a) {",
                    "    return a;",
                    "}",
                    &format!("return select({name}(1.0), {name}(-1.0), {negative}(a));"),
                ];
                self.need_of_one("signum", type_, &name, &lines)
            }
            Operation::Round => {
                let lines = [
                    &*format!("let whole: {name} = trunc(a);"),
                    &format!(
                        "let away: {name} = whole + select({name}(1.0), {name}(-1.0), a < {name}(0.0));"
                    ),
                    &format!("return select(whole, away, abs(a - whole) >= {name}(0.5));"),
                ];
                self.need_of_one("round", type_, &name, &lines)
            }
            Operation::Fraction => self.need_of_one("fraction", type_, &name, &["return a - trunc(a);"]),
            Operation::IsNan => self.need_of_one("is_nan", type_, "bool", &["return !(a == a);"]),
            Operation::IsFinite => {
                self.need_of_one("is_finite", type_, "bool", &[&format!("return abs(a) <= {largest};")])
            }
            Operation::IsInfinite => {
                self.need_of_one("is_infinite", type_, "bool", &[&format!("return abs(a) > {largest};")])
            }
            Operation::IsSignNegative => {
                let (zero, one) = (format!("{name}(0.0)"), format!("{name}(1.0)"));
                let line = format!("return a < {zero} || (a == {zero} && {one} / a < {zero});");
                self.need_of_one("is_negative", type_, "bool", &[&line])
            }
            Operation::DivideEuclid if type_.is_float() => {
                let remainder = self.need_remainder(type_, wide);
                let (zero, one) = (format!("{name}(0.0)"), format!("{name}(1.0)"));
                let lines = [
                    &*format!("let quotient: {name} = trunc(a / b);"),
                    &format!("let away: {name} = quotient - select({one}, -{one}, b < {zero});"),
                    &format!("return select(quotient, away, {remainder}(a, b) < {zero});"),
                ];
                self.need_of_two("div_euclid", type_, &lines)
            }
            _ => {
                let remainder = self.need_remainder(type_, wide);
                let lines = [
                    &*format!("let rest: {name} = {remainder}(a, b);"),
                    &format!("return select(rest, rest + abs(b), rest < {name}(0.0));"),
                ];
                self.need_of_two("rem_euclid", type_, &lines)
            }
        }
    }

    /// The quotient or remainder of signed integers, which may be checked as `/` and `%` are.
    pub(crate) fn need_euclidean(&mut self, remainder: bool, type_: &Type, checked: bool) -> String {
        let whole = format!("let whole: i32 = {};", self.division(false, type_, checked));
        let rest = format!("let rest: i32 = {};", self.division(true, type_, checked));
        let manner = if checked { "_checked" } else { "" };
        if remainder {
            let lines = [&*rest, "return select(rest, rest + abs(b), rest < 0i);"];
            self.need_of_two(&format!("rem_euclid{manner}"), type_, &lines)
        } else {
            let lines = [&*whole, &rest, "return select(whole, whole - select(1i, -1i, b < 0i), rest < 0i);"];
            self.need_of_two(&format!("div_euclid{manner}"), type_, &lines)
        }
    }

    /// `a / b` or `a % b`.
    fn division(&mut self, remainder: bool, type_: &Type, checked: bool) -> String {
        match (checked, remainder) {
            (true, _) => format!("{}(a, b)", self.need_quotient(remainder, type_)),
            (false, true) => "a % b".to_owned(),
            (false, false) => "a / b".to_owned(),
        }
    }

    /// `%` of floats: multiples of b are taken away, from the largest one that fits. All differences are
    /// exact.
    pub(crate) fn need_remainder(&mut self, type_: &Type, wide: bool) -> String {
        let negative = self.need_number(Operation::IsSignNegative, type_, wide);
        let (name, scalar) = (type_.wgsl(), if wide { "f64" } else { "f32" });
        let infinity = format!("infinity_{scalar}()");
        self.need_infinities(&infinity);
        let lines = [
            &*format!("let size: {name} = abs(b);"),
            &format!("var rest: {name} = abs(a);"),
            &format!("if !(rest < {infinity}) || !(size > {name}(0.0)) {{"),
            &format!("    return {infinity} - {infinity};"),
            "}",
            &format!("if !(size < {infinity}) {{"),
            "    return a;",
            "}",
            &format!("let half: {name} = {name}(0.5) * rest;"),
            &format!("var part: {name} = size;"),
            "while part <= half {",
            "    part = part + part;",
            "}",
            "while part >= size {",
            "    if rest >= part {",
            "        rest -= part;",
            "    }",
            &format!("    part = {name}(0.5) * part;"),
            "}",
            &format!("return select(rest, -rest, {negative}(a));"),
        ];
        self.need_of_two("remainder", type_, &lines)
    }

    fn need_of_one(&mut self, word: &str, type_: &Type, result: &str, lines: &[&str]) -> String {
        self.need(format!("{word}_{}", type_.word()), |name| {
            format!("fn {name}(a: {}) -> {result} {{\n    {}\n}}\n", type_.wgsl(), lines.join("\n    "))
        })
    }

    fn need_of_two(&mut self, word: &str, type_: &Type, lines: &[&str]) -> String {
        let type_name = type_.wgsl();
        self.need(format!("{word}_{}", type_.word()), |name| {
            let lines = lines.join("\n    ");
            format!("fn {name}(a: {type_name}, b: {type_name}) -> {type_name} {{\n    {lines}\n}}\n")
        })
    }
}
