//! Divisions and square roots.
//!
//! A corrected result begins with the driver's own, which may be off by some units in the last place. Twice
//! the remainder, which is known exactly, improves it to one of the two numbers beside the true result; then
//! the exact remainder says which of them is nearer. All this needs `+ - *` alone to be rounded correctly.
//! Operands near the ends of the range are brought near 1 first, by powers of two, and the result back; where
//! it becomes subnormal and a tie, the remainder decides once more, as the result must be rounded only once.

use crate::device::rewrite::operation::Manner;
use std::fmt::Write as _;

/// The functions for floats of so many bytes. A corrected one divides and takes roots as the driver does.
pub(super) fn text(manner: Manner, width: u8) -> String {
    match manner {
        Manner::Corrected => corrected(width),
        Manner::Rough => rough(width),
    }
}

/// Off by more than any driver, upwards and downwards: so far that the last steps of a correction in f32 are
/// needed now and then.
fn rough(width: u8) -> String {
    let [t, up, down] = if width == 8 {
        ["f64", "1.0000000000004547lf", "0.9999999999995453lf"]
    } else {
        ["f32", "1.0002441f", "0.9997559f"]
    };
    format!(
        "fn rough_quotient_{t}(a: {t}, b: {t}) -> {t} {{
    return a * ({t}(1.0) / b * select({down}, {up}, abs(a) < abs(b)));
}}
fn rough_root_{t}(a: {t}) -> {t} {{
    return sqrt(a) * select({down}, {up}, a < {t}(1.5));
}}
"
    )
}

/// What the functions need to know of a float type.
struct Format {
    name: &'static str,
    /// After the digits of a literal.
    suffix: &'static str,
    /// The bits of a significand.
    bits: i32,
    /// The exponent of the least normal number, and of the largest.
    least: i32,
    largest: i32,
    /// The largest number.
    most: String,
    /// Between this power of two and its reciprocal nothing overflows or vanishes on the way.
    near: i32,
    /// A result that becomes subnormal is rounded by a product with this power of two.
    lift: i32,
}

impl Format {
    fn of(width: u8) -> Self {
        if width == 8 {
            let most = format!("{:?}lf", f64::MAX);
            Self {
                name: "f64",
                suffix: "lf",
                bits: 53,
                least: -1022,
                largest: 1023,
                most,
                near: 300,
                lift: 100,
            }
        } else {
            let most = format!("{:?}f", f32::MAX);
            Self { name: "f32", suffix: "f", bits: 24, least: -126, largest: 127, most, near: 40, lift: 31 }
        }
    }

    /// A power of two as a literal.
    fn power(&self, exponent: i32) -> String {
        format!("{:?}{}", 2.0_f64.powi(exponent), self.suffix)
    }

    /// The exponents of the powers of two by which any number is brought near 1, half as large each time.
    fn steps(&self) -> impl Iterator<Item = i32> + use<> {
        let first = (self.largest + 1) / 2;
        std::iter::successors(Some(first), |step| (*step > 1).then_some(step / 2))
    }

    /// Statements that bring `value` into `1 ..= 2` and count in `power`.
    fn normalising(&self) -> String {
        let first = self.steps().next();
        let mut text = String::new();
        // Subnormal numbers take the first step twice.
        for step in first.into_iter().chain(self.steps()) {
            let (below, up) = (self.power(1 - step), self.power(step));
            let _ = writeln!(text, "    if value < {below} {{ value *= {up}; power -= {step}; }}");
        }
        for step in self.steps() {
            let (above, down) = (self.power(step), self.power(-step));
            let _ = writeln!(text, "    if value >= {above} {{ value *= {down}; power += {step}; }}");
        }
        text
    }

    /// Statements that multiply `value` by two to the power of `exponent`.
    fn raising(&self) -> String {
        let mut text = String::new();
        for step in self.steps() {
            let (up, down) = (self.power(step), self.power(-step));
            let _ = writeln!(
                text,
                "    if (size & {step}u) != 0u {{ value *= select({up}, {down}, exponent < 0i); }}"
            );
        }
        text
    }
}

fn corrected(width: u8) -> String {
    let format = Format::of(width);
    let Format { name: t, most, bits, least, largest, lift, near, .. } = &format;
    let power = |exponent| format.power(exponent);
    // Two products of this and the operand split it into halves.
    let split = format!("({} + {})", power((bits + 1) / 2), power(0));
    let unit = power(-bits);
    // A little more than half a unit in the last place of any number.
    let beside = format!("({unit} + {})", power(1 - 2 * bits));
    let (low, high, half) = (power(-near), power(*near), power(-1));
    let (normalising, raising) = (format.normalising(), format.raising());
    let (safe, most_power) = (least + 2, largest - 3);
    let vanished = least - bits - 5;
    let (up, down) = (power(*lift), power(-lift));
    // Of the least subnormal number, lifted, a half; and the number itself as a product.
    let tie = power(least - bits + lift);
    let tiny = power(least - bits + 1 + lift);
    format!(
        "// What is missing from the rounded product of two numbers: exact.
fn corrected_error_{t}(a: {t}, b: {t}, product: {t}) -> {t} {{
    let a_wide: {t} = {split} * a;
    let a_high: {t} = a_wide - (a_wide - a);
    let a_low: {t} = a - a_high;
    let b_wide: {t} = {split} * b;
    let b_high: {t} = b_wide - (b_wide - b);
    let b_low: {t} = b - b_high;
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}}
// What is left of a number after so many times another.
fn corrected_rest_{t}(a: {t}, times: {t}, b: {t}) -> {t} {{
    let product: {t} = times * b;
    return (a - product) - corrected_error_{t}(times, b, product);
}}
fn corrected_near_quotient_{t}(a: {t}, b: {t}) -> {t} {{
    var quotient: {t} = a / b;
    quotient = quotient + corrected_rest_{t}(a, quotient, b) / b;
    quotient = quotient + corrected_rest_{t}(a, quotient, b) / b;
    let rest: {t} = corrected_rest_{t}(a, quotient, b);
    let step: {t} = quotient * {beside};
    let above: {t} = quotient + step;
    let below: {t} = quotient - step;
    if rest > (above - quotient) * {half} * b {{
        return above;
    }}
    if -rest > (quotient - below) * {half} * b {{
        return below;
    }}
    return quotient;
}}
fn corrected_near_root_{t}(a: {t}) -> {t} {{
    var root: {t} = sqrt(a);
    root = root + corrected_rest_{t}(a, root, root) / (root + root);
    root = root + corrected_rest_{t}(a, root, root) / (root + root);
    let rest: {t} = corrected_rest_{t}(a, root, root);
    let step: {t} = root * {beside};
    let above: {t} = root + step;
    let below: {t} = root - step;
    if rest > (above - root) * root {{
        return above;
    }}
    if -rest >= (root - below) * root {{
        return below;
    }}
    return root;
}}
struct CorrectedScaled_{t} {{
    value: {t},
    power: i32,
}}
fn corrected_scaled_{t}(a: {t}) -> CorrectedScaled_{t} {{
    var value: {t} = a;
    var power: i32 = 0i;
{normalising}    return CorrectedScaled_{t}(value, power);
}}
fn corrected_raised_{t}(a: {t}, exponent: i32) -> {t} {{
    var value: {t} = a;
    let size: u32 = u32(abs(exponent));
{raising}    return value;
}}
fn corrected_far_quotient_{t}(a: {t}, b: {t}) -> {t} {{
    let first: CorrectedScaled_{t} = corrected_scaled_{t}(a);
    let second: CorrectedScaled_{t} = corrected_scaled_{t}(b);
    let quotient: {t} = corrected_near_quotient_{t}(first.value, second.value);
    let power: i32 = first.power - second.power;
    if power >= {safe}i {{
        let most: i32 = min(power, {most_power}i);
        return corrected_raised_{t}(corrected_raised_{t}(quotient, most), min(power - most, 8i));
    }}
    let lifted: {t} = corrected_raised_{t}(quotient, max(power, {vanished}i) + {lift}i);
    let rounded: {t} = lifted * {down};
    let off: {t} = lifted - rounded * {up};
    let rest: {t} = corrected_rest_{t}(first.value, quotient, second.value);
    if off == {tie} && rest > {t}(0.0) {{
        return rounded + {tiny} * {down};
    }}
    if off == -{tie} && rest < {t}(0.0) {{
        return rounded - {tiny} * {down};
    }}
    return rounded;
}}
fn corrected_quotient_{t}(a: {t}, b: {t}) -> {t} {{
    let first: {t} = abs(a);
    let second: {t} = abs(b);
    let zero: {t} = {t}(0.0);
    if !(second > zero) || !(second <= {most}) || !(a == a) {{
        return a / b;
    }}
    if !(first > zero) || !(first <= {most}) {{
        return select(a, -a, b < zero);
    }}
    var quotient: {t};
    if first > {low} && first < {high} && second > {low} && second < {high} {{
        quotient = corrected_near_quotient_{t}(first, second);
    }} else {{
        quotient = corrected_far_quotient_{t}(first, second);
    }}
    return select(quotient, -quotient, (a < zero) != (b < zero));
}}
fn corrected_root_{t}(a: {t}) -> {t} {{
    if !(a > {t}(0.0)) || !(a <= {most}) {{
        return sqrt(a);
    }}
    if a > {low} && a < {high} {{
        return corrected_near_root_{t}(a);
    }}
    let scaled: CorrectedScaled_{t} = corrected_scaled_{t}(a);
    let odd: bool = (scaled.power & 1i) != 0i;
    let root: {t} = corrected_near_root_{t}(select(scaled.value, scaled.value * {t}(2.0), odd));
    return corrected_raised_{t}(root, (scaled.power - select(0i, 1i, odd)) / 2i);
}}
"
    )
}
