//! Reductions on the device: each row, or block of items, by one invocation in order; the rows' results in order on the host.
//!
//! So the result has the bits of the reference engine wherever float sums have.

use crate::device::{Access, Binding, Code, Device, DeviceError};
use crate::service::workgroups;
use xca_core::reduction::{Reduced, Reduction};
use xca_core::{StoredScalar, StoredType};

/// The invocations of a workgroup.
const WORKGROUP: u32 = 64;

/// The rows of values that are reduced: row `r` begins at `first + r % height * row + r / height * layer`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Rows {
    /// How many.
    pub(crate) rows: u32,
    /// The values of each.
    pub(crate) width: u32,
    /// The values of all: the last row may be shorter.
    pub(crate) values: u32,
    /// How many rows lie `row` apart.
    pub(crate) height: u32,
    /// The first value.
    pub(crate) first: u32,
    /// From one to the next.
    pub(crate) row: u32,
    /// From one set of `height` rows to the next.
    pub(crate) layer: u32,
    /// Nothing.
    pub(crate) unused: u32,
}

/// What a row is reduced to on the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RowResult {
    /// A 64-bit integer in two words.
    Long,
    /// A word without a sign.
    Unsigned,
    /// A word with a sign.
    Signed,
    /// Floats.
    Single,
    Double,
}

/// Whether the device can do it: float sums are made in 64 bits.
pub(crate) fn is_possible(device: &Device, reduction: &Reduction, stored: StoredType) -> bool {
    let float = matches!(stored.scalar, StoredScalar::F32 | StoredScalar::F64);
    let sum = matches!(reduction, Reduction::Sum | Reduction::Product);
    device.adapter().has_f64 || !(float && sum)
}

/// Reduces rows of values, component by component: the results of the rows in order.
pub(crate) fn reduce(
    device: &Device,
    strict: bool,
    (reduction, stored): (&Reduction, StoredType),
    values: Binding,
    rows: Rows,
) -> Result<Vec<Vec<Reduced>>, DeviceError> {
    let components = stored.components();
    let (source, kind) = text(reduction, stored);
    let code = Code {
        name: format!("the reduction {reduction:?}"),
        source,
        workgroup: [WORKGROUP, 1, 1],
        buffers: vec![Access::Uniform, Access::Read, Access::Read, Access::Write],
        strict,
    };
    let description = device.uniform("rows", bytemuck::bytes_of(&rows))?;
    let wanted = device.buffer("wanted", 8)?;
    if let Reduction::CountEqual(bytes) = reduction {
        let bytes = if bytes.len() == 1 { vec![bytes[0], 0, 0, 0] } else { bytes.clone() };
        device.upload(&wanted, 0, &bytes)?;
    }
    let size = match kind {
        RowResult::Long | RowResult::Double => 8,
        RowResult::Unsigned | RowResult::Signed | RowResult::Single => 4,
    };
    let length = (rows.rows as usize * components * size) as u64;
    let results = device.buffer("results", length)?;
    let parts = [(&description).into(), values, (&wanted).into(), (&results).into()];
    let bindings = device.bind(&device.pipeline(&code)?, &parts)?;
    let mut recorder = device.recorder();
    recorder.run(&bindings, workgroups(device, (rows.rows as usize).div_ceil(WORKGROUP as usize)));
    device.submit(recorder)?;
    let bytes = device.download(&results, 0..length)?;
    let numbers: Vec<Reduced> = bytes.chunks_exact(size).map(|bytes| kind.number(bytes)).collect();
    Ok(numbers.chunks_exact(components).map(<[Reduced]>::to_vec).collect())
}

impl RowResult {
    fn number(self, bytes: &[u8]) -> Reduced {
        match self {
            Self::Long => Reduced::Integer(bytemuck::pod_read_unaligned(bytes)),
            Self::Unsigned => Reduced::Integer(bytemuck::pod_read_unaligned::<u32>(bytes).into()),
            Self::Signed => Reduced::Integer(bytemuck::pod_read_unaligned::<i32>(bytes).into()),
            Self::Single => Reduced::Float(bytemuck::pod_read_unaligned::<f32>(bytes).into()),
            Self::Double => Reduced::Float(bytemuck::pod_read_unaligned(bytes)),
        }
    }
}

/// The shader, and what it makes of a row.
fn text(reduction: &Reduction, stored: StoredType) -> (String, RowResult) {
    let float = matches!(stored.scalar, StoredScalar::F32 | StoredScalar::F64);
    let (scalar, same) = match stored.scalar {
        StoredScalar::U8 | StoredScalar::U32 => ("u32", RowResult::Unsigned),
        StoredScalar::I32 => ("i32", RowResult::Signed),
        StoredScalar::F32 => ("f32", RowResult::Single),
        StoredScalar::F64 => ("f64", RowResult::Double),
    };
    // Each value becomes `one`, and `all` of the values so far becomes `all` with it.
    let long = "vec2<u32>(u32(value), select(0u, 0xffffffffu, value < 0))";
    let (one, combine, kind) = match reduction {
        Reduction::Sum if float => ("f64(value)", "all + one", RowResult::Double),
        Reduction::Product if float => ("f64(value)", "all * one", RowResult::Double),
        Reduction::Sum => (long, "add(all, one)", RowResult::Long),
        Reduction::Product => (long, "multiply(all, one)", RowResult::Long),
        // NaN gives way to every number, and is the only value that does not equal itself.
        Reduction::Minimum if float => ("value", "select(all, one, one < all || !(all == all))", same),
        Reduction::Maximum if float => ("value", "select(all, one, all < one || !(all == all))", same),
        Reduction::Minimum => ("value", "min(all, one)", same),
        Reduction::Maximum => ("value", "max(all, one)", same),
        Reduction::CountEqual(_) => ("select(0u, 1u, value == wanted[0])", "all + one", RowResult::Unsigned),
        Reduction::LogicalAnd => (NON_ZERO, "all & one", RowResult::Unsigned),
        Reduction::LogicalOr => (NON_ZERO, "all | one", RowResult::Unsigned),
        Reduction::LogicalXor => (NON_ZERO, "all ^ one", RowResult::Unsigned),
        Reduction::BitAnd => ("value", "all & one", same),
        Reduction::BitOr => ("value", "all | one", same),
        Reduction::BitXor => ("value", "all ^ one", same),
    };
    let one = if kind == RowResult::Long && scalar == "u32" { "vec2<u32>(value, 0u)" } else { one };
    let result = match kind {
        RowResult::Long => "vec2<u32>",
        RowResult::Unsigned => "u32",
        RowResult::Signed => "i32",
        RowResult::Single => "f32",
        RowResult::Double => "f64",
    };
    let components = stored.components();
    let functions = if kind == RowResult::Long { LONG } else { "" };
    let source = format!(
        "struct Rows {{
    rows: u32,
    width: u32,
    values: u32,
    height: u32,
    first: u32,
    row: u32,
    layer: u32,
    unused: u32,
}}

@group(0) @binding(0) var<uniform> rows: Rows;
@group(0) @binding(1) var<storage, read> values: array<{scalar}>;
@group(0) @binding(2) var<storage, read> wanted: array<{scalar}>;
@group(0) @binding(3) var<storage, read_write> results: array<{result}>;

{functions}
fn one_of(value: {scalar}) -> {result} {{
    return {one};
}}

fn both(all: {result}, one: {result}) -> {result} {{
    return {combine};
}}

@compute @workgroup_size({WORKGROUP})
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {{
    let row = id.x + id.y * workgroups.x * {WORKGROUP}u;
    if row >= rows.rows {{
        return;
    }}
    let first = rows.first + row % rows.height * rows.row + row / rows.height * rows.layer;
    let end = first + min(rows.width, rows.values - row * rows.width);
    for (var component = 0u; component < {components}u; component += 1u) {{
        var all = one_of(values[first * {components}u + component]);
        for (var i = first + 1u; i < end; i += 1u) {{
            all = both(all, one_of(values[i * {components}u + component]));
        }}
        results[row * {components}u + component] = all;
    }}
}}
"
    );
    (source, kind)
}

/// Not by `!=`, which is false for NaN on some ways to the device.
const NON_ZERO: &str = "select(1u, 0u, value == 0)";

/// 64-bit integers in two words, which wrap around.
const LONG: &str = "fn add(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.x + b.x;
    return vec2<u32>(low, a.y + b.y + select(0u, 1u, low < a.x));
}

fn multiply(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.x & 0xffffu;
    let high = a.x >> 16u;
    let other_low = b.x & 0xffffu;
    let other_high = b.x >> 16u;
    let middle = high * other_low + ((low * other_low) >> 16u);
    let second = low * other_high + (middle & 0xffffu);
    let upper = high * other_high + (middle >> 16u) + (second >> 16u);
    return vec2<u32>(a.x * b.x, upper + a.x * b.y + a.y * b.x);
}
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_valid_wgsl() {
        use Reduction::{
            BitAnd, BitOr, BitXor, LogicalAnd, LogicalOr, LogicalXor, Maximum, Minimum, Product, Sum,
        };
        let scalars =
            [StoredScalar::U8, StoredScalar::I32, StoredScalar::U32, StoredScalar::F32, StoredScalar::F64];
        for scalar in scalars {
            let stored = StoredType { scalar, lanes: 3, length: 2 };
            let mut reductions = vec![
                Sum,
                Product,
                Minimum,
                Maximum,
                LogicalAnd,
                LogicalOr,
                LogicalXor,
                Reduction::CountEqual(Vec::new()),
            ];
            if !matches!(scalar, StoredScalar::F32 | StoredScalar::F64) {
                reductions.extend([BitAnd, BitOr, BitXor]);
            }
            for reduction in reductions {
                let (source, _) = text(&reduction, stored);
                let module = naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| {
                    panic!("{scalar:?} {reduction:?}: {}", error.emit_to_string(&source))
                });
                let mut validator = naga::valid::Validator::new(
                    naga::valid::ValidationFlags::all(),
                    naga::valid::Capabilities::all(),
                );
                validator
                    .validate(&module)
                    .unwrap_or_else(|error| panic!("{scalar:?} {reduction:?}: {error:?}"));
            }
        }
    }
}
