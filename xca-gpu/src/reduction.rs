//! Reductions on the device: each row of cells, or of their items, by one invocation in order; the rows'
//! results in order on the host.
//!
//! So the result has the bits of the reference engine wherever float sums have.

use crate::device::{Access, Binding, Buffer, Code, Corrections, Device, DeviceError};
use crate::service::workgroups;
use xca_core::reduction::{Reduced, Reduction};
use xca_core::{StoredScalar, StoredType};

/// The invocations of a workgroup.
const WORKGROUP: u32 = 64;

/// The rows of cells that are reduced: row `r` begins at `first + r % height * row + r / height * layer`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Rows {
    /// How many.
    pub(crate) rows: u32,
    /// The cells of each.
    pub(crate) width: u32,
    /// How many rows lie `row` apart.
    pub(crate) height: u32,
    /// The first cell.
    pub(crate) first: u32,
    /// From one to the next.
    pub(crate) row: u32,
    /// From one set of `height` rows to the next.
    pub(crate) layer: u32,
}

/// What is reduced.
pub(crate) enum Values<'a> {
    /// A value for each cell.
    OfCells(Binding),
    /// A value for each item, with the first item of each cell, and one past the last.
    OfItems(Binding, [&'a Buffer; 2]),
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

/// Whether the device can do it: float sums are made in 64 bits, and a row takes a loop.
pub(crate) fn is_possible(
    device: &Device,
    (reduction, stored): (&Reduction, StoredType),
    longest_row: usize,
) -> bool {
    let float = matches!(stored.scalar, StoredScalar::F32 | StoredScalar::F64);
    let sum = matches!(reduction, Reduction::Sum | Reduction::Product);
    (device.adapter().has_f64 || !(float && sum)) && device.finishes(stored.components() * (longest_row + 2))
}

/// Reduces rows of values, component by component: the results of all rows, in order.
pub(crate) fn reduce(
    device: &Device,
    strict: Option<Corrections>,
    (reduction, stored): (&Reduction, StoredType),
    values: Values<'_>,
    rows: Rows,
) -> Result<Vec<Reduced>, DeviceError> {
    let components = stored.components();
    let of_items = matches!(values, Values::OfItems(..));
    let (source, kind) = text(reduction, stored, of_items);
    let mut buffers = vec![Access::Uniform, Access::Read, Access::Read, Access::Write];
    if of_items {
        buffers.extend([Access::Read, Access::Read, Access::Write]);
    }
    let code = Code {
        name: format!("the reduction {reduction:?}"),
        source,
        workgroup: [WORKGROUP, 1, 1],
        buffers,
        strict,
        watched: None,
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
    let counts = device.buffer("counts", u64::from(rows.rows) * 4)?;
    let parts = match values {
        Values::OfCells(values) => vec![(&description).into(), values, (&wanted).into(), (&results).into()],
        Values::OfItems(values, [starts, ends]) => vec![
            (&description).into(),
            values,
            (&wanted).into(),
            (&results).into(),
            starts.into(),
            ends.into(),
            (&counts).into(),
        ],
    };
    let bindings = device.bind(&device.pipeline(&code)?, &parts)?;
    let mut recorder = device.recorder();
    recorder.run(&bindings, workgroups(device, (rows.rows as usize).div_ceil(WORKGROUP as usize)));
    device.submit(recorder)?;
    let bytes = device.download(&results, 0..length)?;
    let mut all: Vec<Reduced> = bytes.chunks_exact(size).map(|bytes| kind.number(bytes)).collect();
    if !of_items {
        return Ok(all);
    }
    let counts: Vec<u32> =
        bytemuck::pod_collect_to_vec(&device.download(&counts, 0..u64::from(rows.rows) * 4)?);
    let empty = all.chunks_exact_mut(components).zip(counts).filter(|(_, count)| *count == 0);
    empty.for_each(|(row, _)| row.fill(Reduced::Nothing));
    Ok(all)
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
fn text(reduction: &Reduction, stored: StoredType, of_items: bool) -> (String, RowResult) {
    let float = matches!(stored.scalar, StoredScalar::F32 | StoredScalar::F64);
    let (scalar, same) = match stored.scalar {
        // A driver may take for granted that floats are finite: their bits are looked at as integers.
        StoredScalar::F32 if *reduction == Reduction::CountNonFinite => ("u32", RowResult::Unsigned),
        StoredScalar::F64 if *reduction == Reduction::CountNonFinite => ("vec2<u32>", RowResult::Unsigned),
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
        // No number is taken in place of a NaN, the only value that does not equal itself.
        Reduction::Minimum if float => ("value", "select(all, one, one < all || !(one == one))", same),
        Reduction::Maximum if float => ("value", "select(all, one, all < one || !(one == one))", same),
        Reduction::Minimum => ("value", "min(all, one)", same),
        Reduction::Maximum => ("value", "max(all, one)", same),
        Reduction::CountEqual(_) => ("select(0u, 1u, value == wanted[0])", "all + one", RowResult::Unsigned),
        Reduction::CountNonFinite => (non_finite(stored.scalar), "all + one", RowResult::Unsigned),
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
    let (items, range) = if of_items { (ITEMS, RANGE_OF_ITEMS) } else { ("", RANGE_OF_CELLS) };
    let source = format!(
        "struct Rows {{
    rows: u32,
    width: u32,
    height: u32,
    first: u32,
    row: u32,
    layer: u32,
}}

@group(0) @binding(0) var<uniform> rows: Rows;
@group(0) @binding(1) var<storage, read> values: array<{scalar}>;
@group(0) @binding(2) var<storage, read> wanted: array<{scalar}>;
@group(0) @binding(3) var<storage, read_write> results: array<{result}>;
{items}
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
    let cell = rows.first + row % rows.height * rows.row + row / rows.height * rows.layer;
{range}    for (var component = 0u; component < {components}u; component += 1u) {{
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

/// 1 where the exponent has all its bits, which it has in NaN and infinities alone.
fn non_finite(scalar: StoredScalar) -> &'static str {
    match scalar {
        StoredScalar::F32 => "select(0u, 1u, (value & 0x7f800000u) == 0x7f800000u)",
        StoredScalar::F64 => "select(0u, 1u, (value.y & 0x7ff00000u) == 0x7ff00000u)",
        StoredScalar::U8 | StoredScalar::I32 | StoredScalar::U32 => "0u",
    }
}

/// The items of the cells of a row follow each other.
const ITEMS: &str = "@group(0) @binding(4) var<storage, read> item_starts: array<u32>;
@group(0) @binding(5) var<storage, read> item_ends: array<u32>;
@group(0) @binding(6) var<storage, read_write> counts: array<u32>;
";
const RANGE_OF_ITEMS: &str = "    let first = item_starts[cell];
    let end = item_ends[cell + rows.width - 1u];
    counts[row] = end - first;
    if first == end {
        return;
    }
";
const RANGE_OF_CELLS: &str = "    let first = cell;
    let end = first + rows.width;
";

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
                Reduction::CountNonFinite,
            ];
            if !matches!(scalar, StoredScalar::F32 | StoredScalar::F64) {
                reductions.extend([BitAnd, BitOr, BitXor]);
            }
            for reduction in reductions {
                for of_items in [false, true] {
                    let (source, _) = text(&reduction, stored, of_items);
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
}
