//! The proof of strict arithmetic: a battery of operands through every operation, on the device and on the
//! host.
//!
//! Vulkan promises correct rounding for `+`, `-` and `*` alone; `/` and `sqrt` may be off, small numbers may
//! be flushed to zero, and nothing but a decoration keeps a driver from contracting `a * b + c`. So an
//! adapter is believed when it has shown it. Where only `/`, `sqrt`, `trunc`, `floor` or `ceil` are wrong,
//! corrected ones take their place, and have to show the same.

use crate::device::{Access, Code, Corrections, Device, DeviceError};
use std::fmt::Write as _;
use xca_core::philox;

/// What is tried, as WGSL over `a`, `b` and `c`, and as the host does it.
const OPERATIONS: [(&str, &str); 14] = [
    ("a + b", "a + b"),
    ("a - b", "a - b"),
    ("a * b", "a * b"),
    ("a / b", "a / b"),
    ("-a", "-a"),
    ("abs(a)", "abs(a)"),
    ("trunc(a)", "trunc(a)"),
    ("floor(a)", "floor(a)"),
    ("ceil(a)", "ceil(a)"),
    ("sqrt(a)", "sqrt(abs(a))"),
    ("a * b + c", "a * b + c"),
    ("a * b - c * b", "a * b - c * b"),
    ("(a + b) - a", "(a + b) - a"),
    ("a * c / c", "a * c / c"),
];

/// How many sets of three operands.
const SETS: u32 = 4096;
/// The invocations of a workgroup.
const WORKGROUP: u32 = 64;

/// A float type of the battery.
trait Tried: bytemuck::Pod + std::fmt::LowerExp {
    const NAME: &'static str;
    /// Operands at the edges.
    fn edges() -> Vec<Self>;
    /// From random bits.
    fn random(words: [u32; 4]) -> Self;
    /// The host's results, in the order of [`OPERATIONS`].
    fn results(a: Self, b: Self, c: Self) -> [Self; 14];
    /// Whether two results are the same: bit by bit, where they are numbers.
    fn same(self, other: Self) -> bool;
}

macro_rules! tried {
    ($type:ident, $bits:ident, $random:expr) => {
        impl Tried for $type {
            const NAME: &'static str = stringify!($type);

            fn edges() -> Vec<Self> {
                let tiny = Self::from_bits(1);
                let (least, largest) = (Self::MIN_POSITIVE, Self::MAX);
                let around = [1.0 - Self::EPSILON / 2.0, 1.0, 1.0 + Self::EPSILON];
                let positive =
                    [0.0, tiny, 3.0 * tiny, least - tiny, least, 0.5, 3.0, 1e10, largest, Self::INFINITY];
                let all = positive.into_iter().chain(around);
                all.flat_map(|value| [value, -value]).chain([Self::NAN]).collect()
            }

            fn random(words: [u32; 4]) -> Self {
                let random: fn([u32; 4]) -> $bits = $random;
                let bits = random(words);
                // Most of them of like size, so that sums round: with the exponent of one.
                let fraction = (1 << (Self::MANTISSA_DIGITS - 1)) - 1;
                let near = Self::from_bits(bits & fraction | (1.0 as Self).to_bits());
                // Some of them from a sixteenth to beyond where all are whole.
                let exponent = (words[2] % (Self::MANTISSA_DIGITS + 8)) as i32 - 4;
                match words[3] % 8 {
                    0 => Self::from_bits(bits),
                    1 | 2 => -near,
                    3 => near * (2.0 as Self).powi(exponent),
                    4 => -near * (2.0 as Self).powi(exponent),
                    _ => near,
                }
            }

            fn results(a: Self, b: Self, c: Self) -> [Self; 14] {
                [
                    a + b,
                    a - b,
                    a * b,
                    a / b,
                    -a,
                    a.abs(),
                    a.trunc(),
                    a.floor(),
                    a.ceil(),
                    a.abs().sqrt(),
                    a * b + c,
                    a * b - c * b,
                    (a + b) - a,
                    a * c / c,
                ]
            }

            fn same(self, other: Self) -> bool {
                self.to_bits() == other.to_bits() || (self.is_nan() && other.is_nan())
            }
        }
    };
}

tried!(f32, u32, |words| words[0]);
tried!(f64, u64, |words| u64::from(words[0]) << 32 | u64::from(words[1]));

/// Proves that the device does float arithmetic like the host, to the last bit.
///
/// # Errors
/// Why it is not proved.
pub(crate) fn of_strictness(device: &Device) -> Result<Corrections, String> {
    if !device.adapter().may_be_strict {
        let interface = &device.adapter().interface;
        return Err(format!("its driver takes no SPIR-V as it is (interface: {interface}, wanted: vulkan)"));
    }
    let mut corrections = device.corrections();
    correct::<f32>(device, 0, &mut corrections)?;
    if device.adapter().has_f64 {
        correct::<f64>(device, 1, &mut corrections)?;
    }
    Ok(corrections)
}

/// Finds out what has to be corrected in a type, and proves that it is right then.
fn correct<T: Tried>(device: &Device, type_: usize, corrections: &mut Corrections) -> Result<(), String> {
    let operands = operands::<T>();
    let wrong = wrong::<T>(device, &operands, *corrections)?;
    if wrong.is_empty() {
        return Ok(());
    }
    for (operation, _) in &wrong {
        match OPERATIONS[*operation].0 {
            "a / b" | "a * c / c" => corrections.divisions[type_] = true,
            "sqrt(a)" => corrections.roots[type_] = true,
            "trunc(a)" | "floor(a)" | "ceil(a)" => corrections.roundings[type_] = true,
            // No other operation can be made of those that are right.
            _ => return Err(wrong[0].1.clone()),
        }
    }
    match self::wrong::<T>(device, &operands, *corrections)?.first() {
        None => Ok(()),
        Some((_, error)) => Err(format!("{error}, corrected")),
    }
}

/// The operations that the device does wrongly, by their places, each with what is wrong.
fn wrong<T: Tried>(
    device: &Device,
    operands: &[T],
    corrections: Corrections,
) -> Result<Vec<(usize, String)>, String> {
    let found = on_device::<T>(device, operands, corrections).map_err(|error| error.to_string())?;
    let mut wrong: Vec<(usize, String)> = Vec::new();
    for (operands, found) in operands.chunks_exact(3).zip(found.chunks_exact(OPERATIONS.len())) {
        let [a, b, c] = [operands[0], operands[1], operands[2]];
        let wanted = T::results(a, b, c);
        for (operation, ((found, wanted), (name, _))) in found.iter().zip(wanted).zip(OPERATIONS).enumerate()
        {
            if !wanted.same(*found) && wrong.iter().all(|(known, _)| *known != operation) {
                let text = format!(
                    "in {} {name} gives {found:e} instead of {wanted:e} for a = {a:e}, b = {b:e}, c = {c:e}",
                    T::NAME
                );
                wrong.push((operation, text));
            }
        }
    }
    Ok(wrong)
}

/// All pairs of edges, and random numbers.
fn operands<T: Tried>() -> Vec<T> {
    let edges = T::edges();
    let mut operands = Vec::new();
    for (number, a) in edges.iter().enumerate() {
        for (other, b) in edges.iter().enumerate() {
            operands.extend([*a, *b, edges[(number + 7 * other) % edges.len()]]);
        }
    }
    let mut draw = 0;
    while operands.len() < 3 * SETS as usize {
        operands.push(T::random(philox([draw, 0, 0, 0], [0x5eed, 0])));
        draw += 1;
    }
    operands
}

fn on_device<T: Tried>(
    device: &Device,
    operands: &[T],
    corrections: Corrections,
) -> Result<Vec<T>, DeviceError> {
    let code = Code {
        name: format!("the proof of arithmetic in {}", T::NAME),
        source: source(T::NAME),
        workgroup: [WORKGROUP, 1, 1],
        buffers: vec![Access::Read, Access::Write],
        strict: Some(corrections),
        watched: None,
    };
    let given = device.buffer("operands", size_of_val(operands) as u64)?;
    device.upload(&given, 0, bytemuck::cast_slice(operands))?;
    let sets = operands.len() / 3;
    let length = (sets * OPERATIONS.len() * size_of::<T>()) as u64;
    let results = device.buffer("results", length)?;
    let bindings = device.bind(&device.pipeline(&code)?, &[(&given).into(), (&results).into()])?;
    let mut recorder = device.recorder();
    recorder.run(&bindings, [(sets as u32).div_ceil(WORKGROUP), 1, 1]);
    device.submit(recorder)?;
    Ok(bytemuck::pod_collect_to_vec(&device.download(&results, 0..length)?))
}

fn source(scalar: &str) -> String {
    let count = OPERATIONS.len();
    let mut body = String::new();
    for (number, (_, operation)) in OPERATIONS.iter().enumerate() {
        let _ = writeln!(body, "    results[{count}u * id.x + {number}u] = {operation};");
    }
    format!(
        "@group(0) @binding(0) var<storage, read> operands: array<{scalar}>;
@group(0) @binding(1) var<storage, read_write> results: array<{scalar}>;

@compute @workgroup_size({WORKGROUP})
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if 3u * id.x + 2u >= arrayLength(&operands) {{
        return;
    }}
    let a = operands[3u * id.x];
    let b = operands[3u * id.x + 1u];
    let c = operands[3u * id.x + 2u];
{body}}}
"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shaders_are_valid() {
        for scalar in ["f32", "f64"] {
            let text = source(scalar);
            let module = naga::front::wgsl::parse_str(&text).unwrap();
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::all(),
            );
            validator.validate(&module).unwrap();
        }
    }

    #[test]
    fn the_battery_would_find_contraction_flushing_and_rounding() {
        let operands = operands::<f32>();
        assert!(operands.len() >= 3 * SETS as usize && operands.len().is_multiple_of(3));
        let sets = || operands.chunks_exact(3).map(|set| (set[0], set[1], set[2]));
        let contracted = |(a, b, c): (f32, f32, f32)| !a.mul_add(b, c).same(f32::results(a, b, c)[10]);
        assert!(sets().filter(|set| contracted(*set)).count() > 100);
        assert!(sets().any(|(a, b, _)| (a * b).is_subnormal()));
        let small = |(a, ..): (f32, f32, f32)| a < 0.0 && a.trunc() == 0.0;
        assert!(sets().filter(|set| small(*set)).count() > 10);
        let large = |(a, ..): (f32, f32, f32)| a.abs() > 65536.0 && a.trunc() != a;
        assert!(sets().filter(|set| large(*set)).count() > 10);
        let reciprocal = |(a, b, _): (f32, f32, f32)| !(a * (1.0 / b)).same(a / b);
        assert!(sets().filter(|set| reciprocal(*set)).count() > 100);
    }
}
