//! Floats made whole: `trunc`, `floor` and `ceil`.
//!
//! From the power of two on above which all floats are whole, a sum of it and a smaller number is whole, too:
//! it is the number rounded to the nearest whole one, from which it is one step at most to the others. This
//! needs `+` and `-` alone to be rounded correctly. A result of zero keeps the sign of the number.

use crate::device::rewrite::operation::Manner;

/// The functions for a float type.
pub(super) fn text(manner: Manner, scalar: &str) -> String {
    let prefix = manner.prefix();
    let truncation = match manner {
        Manner::Corrected => corrected(scalar),
        Manner::Rough => rough(scalar),
    };
    format!(
        "{truncation}fn {prefix}floor_{scalar}(a: {scalar}) -> {scalar} {{
    let whole: {scalar} = {prefix}truncation_{scalar}(a);
    return select(whole, whole - {scalar}(1.0), whole > a);
}}
fn {prefix}ceiling_{scalar}(a: {scalar}) -> {scalar} {{
    let whole: {scalar} = {prefix}truncation_{scalar}(a);
    return select(whole, whole + {scalar}(1.0), whole < a);
}}
"
    )
}

fn corrected(t: &str) -> String {
    let whole = if t == "f64" {
        format!("{:?}lf", 2.0_f64.powi(f64::MANTISSA_DIGITS as i32 - 1))
    } else {
        format!("{:?}f", 2.0_f32.powi(f32::MANTISSA_DIGITS as i32 - 1))
    };
    format!(
        "fn corrected_truncation_{t}(a: {t}) -> {t} {{
    let size: {t} = abs(a);
    if !(size < {whole}) {{
        return a;
    }}
    let near: {t} = (size + {whole}) - {whole};
    let below: {t} = near - select({t}(0.0), {t}(1.0), near > size);
    return select(select(below, -below, a < {t}(0.0)), a * below, below == {t}(0.0));
}}
"
    )
}

/// Without the sign of a zero, and small numbers only.
fn rough(t: &str) -> String {
    format!(
        "fn rough_truncation_{t}(a: {t}) -> {t} {{
    return select(a, trunc(a) + {t}(0.0), abs(a) < {t}(4194304.0));
}}
"
    )
}
