//! The functions of `xca_core::math`, which have the names of functions of WGSL and must not be taken for
//! them.

use crate::common::{accepted, function, written, written_with};
use xca_core::Precision;
use xca_core::math::{atan, atan2, cos, exp, log, pow, sin, tan, tanh};
use xca_core::prelude::*;
use xca_wgsl::Options;

#[derive(Substates, Clone, Copy)]
struct State {
    x: Real,
    y: Real,
}

#[elementary_process]
fn all_functions(cell: &mut Cell<State>) {
    let x = exp(cell.x) + log(cell.x) + pow(cell.x, cell.y);
    let y = sin(cell.y) + cos(cell.y) + tan(cell.y);
    cell.x = atan(x) + atan2(x, y);
    cell.y = tanh(y);
}

/// The functions of WGSL that a driver may compute in its own way.
const BUILTIN: [&str; 14] = [
    "exp", "exp2", "log", "log2", "pow", "sin", "cos", "tan", "atan", "atan2", "tanh", "fma", "ldexp",
    "frexp",
];

#[test]
fn functions_are_brought_along() {
    accepted::<all_functions>();
    for precision in [Precision::F32, Precision::F64] {
        let shader = written::<all_functions>(precision);
        let calls = function(&shader, "all_functions");
        assert!(calls.contains("atan_2(x) + atan2_2(x, y)"), "{calls}");
        let words = |line: &str| -> Vec<String> {
            line.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_owned).collect()
        };
        for line in shader.source.lines().filter(|line| !line.trim_start().starts_with("//")) {
            let called =
                words(line).into_iter().find(|word| BUILTIN.iter().any(|name| *word == format!("{name}(")));
            assert_eq!(called, None, "{line}");
        }
        assert_eq!(shader.needs_f64, precision == Precision::F64);
        assert_eq!(shader.source.contains("f64"), precision == Precision::F64);
    }
}

/// The question for the precision is a comparison of two constants, also where zeros are read from memory.
#[test]
fn the_precision_is_known_before_the_run() {
    for (precision, constant) in [(Precision::F32, "1.0f"), (Precision::F64, "1.0000000009313226lf")] {
        let shader =
            written_with::<all_functions>(&Options { precision, opaque_zero: true, ..Options::default() });
        let one = if precision == Precision::F32 { "1.0f" } else { "1.0lf" };
        assert!(function(&shader, "is_single").contains(&format!("return ALMOST_1 == {one};")));
        assert!(shader.source.contains(&format!("const ALMOST_1: Real = {constant};")));
    }
}

#[elementary_process]
fn comparisons(cell: &mut Cell<State>) {
    let low = cell.x.min(cell.y);
    let high = cell.x.max(cell.y);
    cell.y = low.clamp(-1.0, 1.0);
    cell.x = high.abs().sqrt().floor() + high.ceil() - low.trunc();
}

/// `min` and `max` of WGSL leave NaN and signed zeros to the driver: they are not used for floats.
#[test]
fn minima_are_comparisons() {
    accepted::<comparisons>();
    let shader = written::<comparisons>(Precision::F64);
    let minimum = function(&shader, "minimum_real");
    let maximum = function(&shader, "maximum_real");
    assert!(minimum.contains("return select(a, b, b < a);"), "{minimum}");
    assert!(maximum.contains("return select(a, b, a < b);"), "{maximum}");
    for builtin in ["min(", "max(", "clamp("] {
        let called = shader.source.match_indices(builtin).any(|(place, _)| {
            !shader.source[..place].ends_with(|before: char| before.is_alphanumeric() || before == '_')
        });
        assert!(!called, "{builtin}");
    }
}

mod own {
    use xca_core::prelude::*;

    #[helper]
    pub(super) fn sin(x: Real) -> Real {
        x - x * x * x / 6.0
    }

    #[helper]
    pub(super) fn mix(x: Real, y: Real) -> Real {
        0.5 * (x + y)
    }

    #[helper]
    pub(super) fn fma(x: Real, y: Real) -> Real {
        x * y + 1.0
    }
}

#[elementary_process]
fn two_sines(cell: &mut Cell<State>) {
    let exp = own::sin(cell.x);
    cell.x = own::mix(sin(cell.x), exp);
    cell.y = own::fma(exp, cell.y);
}

/// Two functions of one name stay apart, and both from that of WGSL.
#[test]
fn names_of_wgsl_are_not_hidden() {
    accepted::<two_sines>();
    let shader = written::<two_sines>(Precision::F32);
    let calls = function(&shader, "two_sines");
    assert!(calls.contains("= sin_2(cell.x)"), "{calls}");
    assert!(calls.contains("mix_2(sin_3(cell.x), "), "{calls}");
    assert!(calls.contains("fma_2("), "{calls}");
}
