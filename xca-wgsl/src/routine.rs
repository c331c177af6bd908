//! Small functions that a shader brings along where its process needs them.

use crate::fault::FaultKind;
use crate::literal;
use crate::types::{self, Type};
use std::collections::BTreeMap;
use xca_core::ir::Operation;
use xca_core::{Precision, ScalarType};

/// The routines of a module, by name.
#[derive(Debug, Default)]
pub(crate) struct Routines {
    texts: BTreeMap<String, String>,
    /// A search, or the process itself, goes the shorter way round toroidal axes.
    pub(crate) nearest_image: bool,
    /// Positions are brought into the space.
    pub(crate) wrapped: bool,
    /// The index of a neighbour may lie beyond the neighbourhood.
    pub(crate) checked_neighbours: bool,
    /// It is asked whether a neighbour exists.
    pub(crate) neighbour_exists: bool,
    pub(crate) cell_containing: bool,
    /// Something in the process may stop it.
    pub(crate) checks: bool,
}

impl Routines {
    pub(crate) fn texts(&self) -> impl Iterator<Item = &String> {
        self.texts.values()
    }

    pub(crate) fn need(&mut self, name: String, text: impl FnOnce(&str) -> String) -> String {
        self.texts.entry(name.clone()).or_insert_with(|| text(&name));
        name
    }

    /// The struct of a tuple.
    pub(crate) fn need_tuple(&mut self, type_: &Type, parts: &[Type]) {
        self.need(type_.wgsl(), |name| {
            let fields: Vec<String> = parts
                .iter()
                .enumerate()
                .map(|(place, part)| format!("    part_{place}: {},\n", part.wgsl()))
                .collect();
            format!("struct {name} {{\n{}}}\n", fields.concat())
        });
    }

    /// The routines behind infinite numbers in the text, which WGSL cannot write down.
    pub(crate) fn need_infinities(&mut self, text: &str) {
        for scalar in ["f32", "f64"] {
            let name = format!("infinity_{scalar}");
            if text.contains(&name) {
                self.need(name, |_| literal::infinity_routine(scalar));
            }
        }
    }

    /// `minimum` or `maximum` of floats: `if b < a { b } else { a }`, so that NaN and signed zeros are the
    /// same everywhere.
    pub(crate) fn need_least(&mut self, word: &str, type_: &Type) -> String {
        let name = format!("{word}_{}", type_.word());
        let condition = if word == "minimum" { "b < a" } else { "a < b" };
        let type_ = type_.wgsl();
        self.need(name, |name| {
            format!(
                "fn {name}(a: {type_}, b: {type_}) -> {type_} {{\n    return select(a, b, {condition});\n}}\n"
            )
        })
    }

    /// The scalar product, added from the first lane to the last.
    pub(crate) fn need_dot(&mut self, type_: &Type) -> String {
        let lanes =
            &["a.x * b.x", "a.y * b.y", "a.z * b.z", "a.w * b.w"][..usize::from(type_.lanes().min(4))];
        let sum = masked(&lanes.join(" + "), type_);
        let scalar = type_.scalar().map_or("u32", types::scalar_name);
        let vector = type_.wgsl();
        self.need(format!("dot_{}", type_.word()), |name| {
            format!("fn {name}(a: {vector}, b: {vector}) -> {scalar} {{\n    return {sum};\n}}\n")
        })
    }

    fn need_length_squared(&mut self, type_: &Type) -> String {
        let dot = self.need_dot(type_);
        let scalar = type_.scalar().map_or("u32", types::scalar_name);
        let vector = type_.wgsl();
        self.need(format!("length_squared_{}", type_.word()), |name| {
            format!("fn {name}(a: {vector}) -> {scalar} {{\n    return {dot}(a, a);\n}}\n")
        })
    }

    /// Whether two numbers in memory differ in a bit. A NaN differs from itself.
    pub(crate) fn need_difference(&mut self, scalar: ScalarType, precision: Precision) -> String {
        let name = types::scalar_name(scalar);
        let condition = if types::is_f64(scalar, precision) {
            // There is no other way to the bits of 64; zeros differ by their signs.
            format!(
                "!(a == b) || (a == {name}(0.0) && (({name}(1.0) / a < {name}(0.0)) != ({name}(1.0) / b < {name}(0.0))))"
            )
        } else if types::is_float(scalar) {
            "bitcast<u32>(a) != bitcast<u32>(b)".to_owned()
        } else {
            "a != b".to_owned()
        };
        self.need(difference(scalar), |routine| {
            format!("fn {routine}(a: {name}, b: {name}) -> bool {{\n    return {condition};\n}}\n")
        })
    }

    /// The value itself. naga computes with constants while it reads a shader, and refuses what is not finite
    /// or loses bits; it does not look into functions.
    pub(crate) fn need_run_time(&mut self, type_: &Type) -> String {
        let type_name = type_.wgsl();
        self.need(format!("runtime_{}", type_.word()), |name| {
            format!("fn {name}(value: {type_name}) -> {type_name} {{\n    return value;\n}}\n")
        })
    }

    /// An array with one value in all places.
    pub(crate) fn need_repeat(&mut self, element: &Type, length: usize) -> String {
        let (word, element) = (element.word(), element.wgsl());
        let values = vec!["value"; length].join(", ");
        self.need(format!("repeat_{word}_{length}"), |name| {
            let array = format!("array<{element}, {length}>");
            format!("fn {name}(value: {element}) -> {array} {{\n    return {array}({values});\n}}\n")
        })
    }

    /// The index itself where it lies in the array.
    pub(crate) fn need_index(&mut self) -> String {
        self.checks = true;
        let kind = FaultKind::BeyondArray as u32;
        self.need("checked_index".to_owned(), |name| {
            format!(
                "fn {name}(index: u32, length: u32) -> u32 {{
    if index >= length {{
        record_fault({kind}u, index, length, Real());
        return 0u;
    }}
    return index;
}}
"
            )
        })
    }

    /// The step of a range, unless it is 0.
    pub(crate) fn need_step(&mut self) -> String {
        self.checks = true;
        let kind = FaultKind::ZeroStep as u32;
        self.need("checked_step".to_owned(), |name| {
            format!(
                "fn {name}(step: u32) -> u32 {{
    if step == 0u {{
        record_fault({kind}u, 0u, 0u, Real());
        return 1u;
    }}
    return step;
}}
"
            )
        })
    }

    /// The quotient of integers, or the remainder where it is asked for; of vectors lane by lane.
    pub(crate) fn need_quotient(&mut self, remainder: bool, type_: &Type) -> String {
        self.checks = true;
        let word = if remainder { "remainder" } else { "quotient" };
        let scalar = Type::Scalar(type_.scalar().unwrap_or(ScalarType::U32));
        if type_.lanes() > 1 {
            let routine = self.need_quotient(remainder, &scalar);
            let lanes = &["x", "y", "z", "w"][..usize::from(type_.lanes().min(4))];
            let lanes: Vec<String> =
                lanes.iter().map(|lane| format!("{routine}(a.{lane}, b.{lane})")).collect();
            let (vector, lanes) = (type_.wgsl(), lanes.join(", "));
            return self.need(format!("checked_{word}_{}", type_.word()), |name| {
                format!(
                    "fn {name}(a: {vector}, b: {vector}) -> {vector} {{\n    return {vector}({lanes});\n}}\n"
                )
            });
        }
        let (sign, by_zero, overflow) = if remainder {
            ("%", FaultKind::RemainderByZero, FaultKind::RemainderOverflow)
        } else {
            ("/", FaultKind::DivisionByZero, FaultKind::DivisionOverflow)
        };
        let (by_zero, overflow) = (by_zero as u32, overflow as u32);
        let name = scalar.wgsl();
        let least = if scalar == Type::Scalar(ScalarType::I32) {
            format!(
                "    if a == i32(-2147483648) && b == -1i {{
        record_fault({overflow}u, 0u, 0u, Real());
        return 0i;
    }}
"
            )
        } else {
            String::new()
        };
        self.need(format!("checked_{word}_{}", scalar.word()), |routine| {
            format!(
                "fn {routine}(a: {name}, b: {name}) -> {name} {{
    if b == {name}() {{
        record_fault({by_zero}u, 0u, 0u, Real());
        return {name}();
    }}
{least}    return a {sign} b;
}}
"
            )
        })
    }

    /// An array of `bool` from how it lies in memory.
    pub(crate) fn need_truths(&mut self, length: usize) -> String {
        self.need(format!("truths_{length}"), |name| {
            format!(
                "fn {name}(words: array<u32, {length}>) -> array<bool, {length}> {{
    var given = words;
    var truths: array<bool, {length}>;
    for (var element: u32 = 0u; element < {length}u; element += 1u) {{
        truths[element] = given[element] != 0u;
    }}
    return truths;
}}
"
            )
        })
    }

    /// Whether two arrays are equal, element by element.
    pub(crate) fn need_equal(&mut self, type_: &Type) -> String {
        let Type::Array(element, length) = type_ else { return String::new() };
        let same = match &**element {
            Type::Array(..) => format!("{}(left[element], right[element])", self.need_equal(element)),
            Type::Vector(..) => "all(left[element] == right[element])".to_owned(),
            _ => "left[element] == right[element]".to_owned(),
        };
        let array = type_.wgsl();
        self.need(format!("equal_{}", type_.word()), |name| {
            format!(
                "fn {name}(a: {array}, b: {array}) -> bool {{
    var left = a;
    var right = b;
    for (var element: u32 = 0u; element < {length}u; element += 1u) {{
        if !({same}) {{
            return false;
        }}
    }}
    return true;
}}
"
            )
        })
    }

    /// An operation of vectors.
    pub(crate) fn need_vector(&mut self, operation: Operation, type_: &Type) -> String {
        match operation {
            Operation::Cross => self.need_cross(type_),
            Operation::LengthSquared => self.need_length_squared(type_),
            Operation::Length => self.need_length(type_),
            Operation::Distance => self.need_distance(type_),
            Operation::Normalize => self.need_normalize(type_),
            _ => self.need_dot(type_),
        }
    }

    fn need_distance(&mut self, type_: &Type) -> String {
        let length = self.need_length(type_);
        let (vector, scalar) = (type_.wgsl(), type_.scalar().map_or("f32", types::scalar_name));
        self.need(format!("distance_{}", type_.word()), |name| {
            format!("fn {name}(a: {vector}, b: {vector}) -> {scalar} {{\n    return {length}(a - b);\n}}\n")
        })
    }

    fn need_normalize(&mut self, type_: &Type) -> String {
        let length = self.need_length(type_);
        let vector = type_.wgsl();
        self.need(format!("normalize_{}", type_.word()), |name| {
            format!("fn {name}(a: {vector}) -> {vector} {{\n    return a / {length}(a);\n}}\n")
        })
    }

    fn need_cross(&mut self, type_: &Type) -> String {
        let lanes = ["a.y * b.z - a.z * b.y", "a.z * b.x - a.x * b.z", "a.x * b.y - a.y * b.x"];
        let lanes = lanes.map(|lane| masked(lane, type_)).join(", ");
        let vector = type_.wgsl();
        self.need(format!("cross_{}", type_.word()), |name| {
            format!("fn {name}(a: {vector}, b: {vector}) -> {vector} {{\n    return {vector}({lanes});\n}}\n")
        })
    }

    fn need_length(&mut self, type_: &Type) -> String {
        let dot = self.need_dot(type_);
        let scalar = type_.scalar().map_or("f32", types::scalar_name);
        let vector = type_.wgsl();
        self.need(format!("length_{}", type_.word()), |name| {
            format!("fn {name}(a: {vector}) -> {scalar} {{\n    return sqrt({dot}(a, a));\n}}\n")
        })
    }

    /// `as` from a float to an integer: the nearest number of the type, and 0 for NaN.
    pub(crate) fn need_saturation(&mut self, from: ScalarType, to: ScalarType) -> String {
        let (low, least, high, largest) = match to {
            ScalarType::I32 => ("-2147483648.0", "i32(-2147483648)", "2147483648.0", "2147483647i"),
            ScalarType::U8 => ("0.0", "0u", "256.0", "255u"),
            _ => ("0.0", "0u", "4294967296.0", "4294967295u"),
        };
        let (source, target) = (types::scalar_name(from), types::scalar_name(to));
        let word = if to == ScalarType::U8 { "u8" } else { target };
        self.need(format!("saturate_{word}_from_{}", source.to_lowercase()), |name| {
            format!(
                "fn {name}(value: {source}) -> {target} {{\n    \
                     let low: {source} = {source}({low});\n    \
                     let high: {source} = {source}({high});\n    \
                     if value > low && value < high {{\n        \
                         return {target}(value);\n    \
                     }} else if value >= high {{\n        \
                         return {largest};\n    \
                     }} else if value <= low {{\n        \
                         return {least};\n    \
                     }}\n    \
                     return {target}(0);\n}}\n"
            )
        })
    }
}

/// The routine that compares two numbers of a type bit by bit.
pub(crate) fn difference(scalar: ScalarType) -> String {
    format!("differs_{}", types::scalar_name(scalar).to_lowercase())
}

fn masked(text: &str, type_: &Type) -> String {
    if type_.is_u8() { format!("({text}) & 0xffu") } else { text.to_owned() }
}

/// Philox 4x32-10 and what is made of its words. `owner` is the counter's first word; [`xca_core::Draw`] has
/// the layout of the others.
pub(crate) fn random(owner: &str, precision: Precision) -> String {
    let uniform = match precision {
        Precision::F32 => "f32(words.x >> 8u) * 5.9604645e-8f".to_owned(),
        Precision::F64 => {
            "(f64(words.x >> 5u) * 67108864.0lf + f64(words.y >> 6u)) * 1.1102230246251565e-16lf".to_owned()
        }
    };
    format!(
        "// The upper half of a product of 64 bits.
fn multiply_high(a: u32, b: u32) -> u32 {{
    let low = a & 0xffffu;
    let high = a >> 16u;
    let middle = high * (b & 0xffffu) + ((low * (b & 0xffffu)) >> 16u);
    let carry = low * (b >> 16u) + (middle & 0xffffu);
    return high * (b >> 16u) + (middle >> 16u) + (carry >> 16u);
}}

// Philox 4x32-10 (Salmon and others, SC11).
fn philox(counter: vec4<u32>, key: vec2<u32>) -> vec4<u32> {{
    var words = counter;
    var round_key = key;
    for (var round_number: u32 = 0u; round_number < 10u; round_number += 1u) {{
        let first_high = multiply_high(0xd2511f53u, words.x);
        let second_high = multiply_high(0xcd9e8d57u, words.z);
        words = vec4<u32>(
            second_high ^ words.y ^ round_key.x,
            0xcd9e8d57u * words.z,
            first_high ^ words.w ^ round_key.y,
            0xd2511f53u * words.x,
        );
        round_key += vec2<u32>(0x9e3779b9u, 0xbb67ae85u);
    }}
    return words;
}}

fn random_words(draw: u32) -> vec4<u32> {{
    let high = (moment.step.y & 0xffffu) | (space.stream << 16u);
    return philox(vec4<u32>({owner}, moment.step.x, high, draw), space.seed);
}}

fn random_bits(draw: u32) -> u32 {{
    return random_words(draw).x;
}}

fn random_real(draw: u32) -> Real {{
    let words = random_words(draw);
    return {uniform};
}}
"
    )
}
