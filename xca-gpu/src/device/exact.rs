//! Code whose float operations the driver may not change: SPIR-V with `NoContraction` on each of them.
//!
//! WGSL lets a driver contract `a * b + c` to one rounding, and reorder sums. SPIR-V forbids both for
//! operations that are decorated so, which WGSL cannot say; hence this detour over naga's own SPIR-V.

use super::rewrite::Checked;
use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};

/// The number of the decoration, and of the instruction that puts one on a result.
const NO_CONTRACTION: u32 = 42;
const DECORATE: u32 = 71;
/// The words before the first instruction.
const HEADER: usize = 5;
/// The instructions that declare types: decorations stand before the first of them.
const TYPES: std::ops::RangeInclusive<u32> = 19..=33;
/// Float arithmetic: FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod, VectorTimesScalar.
const ARITHMETIC: [u32; 8] = [127, 129, 131, 133, 136, 140, 141, 142];

/// Translates a module.
pub(super) fn spirv(Checked { module, info }: &Checked) -> Result<Vec<u32>, String> {
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::empty(),
        // Buffers are indexed by the engine's own numbers, which lie in them, and by elements that the text
        // proves or checks. Arrays in variables are guarded here once more.
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            buffer: BoundsCheckPolicy::Unchecked,
            ..BoundsCheckPolicies::default()
        },
        // The engine's loops end, and those of a process end on the other engines.
        force_loop_bounding: false,
        ..spv::Options::default()
    };
    let words = spv::write_vec(module, info, &options, None).map_err(|error| error.to_string())?;
    Ok(without_contraction(&words))
}

/// Decorates all float arithmetic.
fn without_contraction(words: &[u32]) -> Vec<u32> {
    let mut results = Vec::new();
    let mut first_type = words.len();
    let mut at = HEADER;
    while let Some(&word) = words.get(at) {
        let (instruction, length) = (word & 0xffff, (word >> 16) as usize);
        if TYPES.contains(&instruction) {
            first_type = first_type.min(at);
        }
        if ARITHMETIC.contains(&instruction)
            && let Some(result) = words.get(at + 2)
        {
            results.push(*result);
        }
        at += length.max(1);
    }
    let mut decorated = words[..first_type].to_vec();
    for result in results {
        decorated.extend([DECORATE | 3 << 16, result, NO_CONTRACTION]);
    }
    decorated.extend(&words[first_type..]);
    decorated
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::rewrite;

    const SOURCE: &str = "@group(0) @binding(0) var<storage, read_write> x: array<f32>;
        @compute @workgroup_size(1) fn main() { x[0] = -x[0] * x[1] + x[2] / x[3] - x[4]; }";

    #[test]
    fn each_float_operation_is_decorated_once() {
        let words = spirv(&rewrite::read(SOURCE, &[], None).unwrap()).unwrap();
        let decorations = words
            .windows(3)
            .filter(|window| window[0] == (DECORATE | 3 << 16) && window[2] == NO_CONTRACTION);
        let mut decorated: Vec<u32> = decorations.map(|window| window[1]).collect();
        decorated.sort_unstable();
        decorated.dedup();
        // A negation, a product, a quotient, a sum, a difference.
        assert_eq!(decorated.len(), 5);
    }

    #[test]
    fn wrong_code_says_where() {
        let error = rewrite::read("fn main() { let x: f32 = 1u; }", &[], None).err().unwrap();
        assert!(error.contains("let x: f32 = 1u"), "{error}");
    }
}
