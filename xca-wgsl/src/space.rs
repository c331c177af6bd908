//! Where things are: cells, neighbours, positions.

use crate::fault::FaultKind;
use xca_core::kernel::{NOWHERE, OUTSIDE};
use xca_core::{Parity, Precision};

/// The number of a cell among the stored ones, from its indices.
pub(crate) const STORAGE_INDEX: &str = "fn storage_index(index: vec3<u32>) -> u32 {
    let number: u32 = (index.x + space.halo.x) + (index.y + space.halo.y) * space.row + (index.z + space.halo.z) * space.layer;
    return number - space.base;
}
";

/// The indices of a stored cell.
pub(crate) const CELL_INDEX: &str = "fn cell_index(number: u32) -> vec3<i32> {
    let rest = number % space.layer;
    let index = vec3<u32>(rest % space.row, rest / space.row, number / space.layer);
    return vec3<i32>(index) - vec3<i32>(space.halo);
}
";

/// The number of a cell among those of the space, by which random numbers and faults know it.
pub(crate) const LINEAR_INDEX: &str = "fn linear_index(index: vec3<i32>) -> u32 {
    let extents = vec3<u32>(space.extents);
    return (u32(index.z) * extents.y + u32(index.y)) * extents.x + u32(index.x);
}
";

/// The number of a neighbour among the stored cells.
pub(crate) fn neighbour_at(parity: Parity, neighbours: &str) -> String {
    let odd = match parity {
        Parity::None => String::new(),
        Parity::Row => format!(" + (u32(here_index.y) & 1u) * {neighbours}"),
        Parity::Column => format!(" + (u32(here_index.x) & 1u) * {neighbours}"),
    };
    format!(
        "fn neighbour_at(index: u32) -> u32 {{
    return u32(i32(here) + neighbour_offsets[index{odd}]);
}}
"
    )
}

/// The same where the index may be too large: a fault, and the cell itself is read.
pub(crate) fn checked_neighbour_at(neighbours: &str) -> String {
    let kind = FaultKind::BeyondNeighbourhood as u32;
    format!(
        "fn checked_neighbour_at(index: u32) -> u32 {{
    if index >= {neighbours} {{
        record_fault({kind}u, index, {neighbours}, Real());
        return here;
    }}
    return neighbour_at(index);
}}
"
    )
}

/// The separation by the shorter way round each toroidal axis.
pub(crate) fn nearest_image(toroidal: [bool; 3], precision: Precision) -> String {
    let half = match precision {
        Precision::F32 => "0.5f",
        Precision::F64 => "0.5lf",
    };
    let lanes = along_toroidal(toroidal, "separation", "shorter_way");
    format!(
        "fn shorter_way(separation: Real, extent: i32) -> Real {{
    let period: Real = Real(extent) * space.side;
    let half: Real = {half} * period;
    if separation > half {{
        return separation - period;
    }} else if separation < -half {{
        return separation + period;
    }}
    return separation;
}}

fn nearest_image(separation: vec3<Real>) -> vec3<Real> {{
    return {lanes};
}}
"
    )
}

/// A vector in whose lanes of toroidal axes a function is applied, together with the extent.
fn along_toroidal(toroidal: [bool; 3], vector: &str, function: &str) -> String {
    let lane = |(lane, toroidal): (&str, bool)| {
        if toroidal {
            format!("{function}({vector}.{lane}, space.extents.{lane})")
        } else {
            format!("{vector}.{lane}")
        }
    };
    let lanes: Vec<String> = ["x", "y", "z"].into_iter().zip(toroidal).map(lane).collect();
    format!("vec3<Real>({})", lanes.join(", "))
}

/// The position inside the space, as far as axes are toroidal.
pub(crate) fn wrapped(toroidal: [bool; 3]) -> String {
    let lanes = along_toroidal(toroidal, "position", "wrapped_along");
    format!(
        "fn wrapped_along(value: Real, extent: i32) -> Real {{
    let zero: Real = Real();
    let period: Real = Real(extent) * space.side;
    let quotient: Real = value / space.side;
    if !(abs(quotient) < Real(2147483648u)) {{
        return value;
    }}
    if quotient < zero {{
        let above: Real = value + period;
        if floor(above / space.side) < Real(extent) {{
            return above;
        }}
        return zero;
    }}
    if floor(quotient) >= Real(extent) {{
        let below: Real = value - period;
        if below < zero {{
            return zero;
        }}
        return below;
    }}
    return value;
}}

fn wrapped(position: vec3<Real>) -> vec3<Real> {{
    return {lanes};
}}
"
    )
}

/// Where a migration sends what is at a position.
pub(crate) fn cell_containing() -> String {
    format!(
        "fn cell_containing(position: vec3<Real>) -> Destination {{
    let zero = vec3<Real>();
    if !all((position <= zero) | (position > zero)) {{
        return {NOWHERE:#x}u;
    }}
    let number: vec3<Real> = floor(position / vec3<Real>(space.side));
    let limit = vec3<Real>(Real(2147483648u));
    if !(all(number > -limit) && all(number < limit)) {{
        return {OUTSIDE:#x}u;
    }}
    let index = vec3<i32>(number);
    if any(index < vec3<i32>(0)) || any(index >= space.extents) {{
        return {OUTSIDE:#x}u;
    }}
    return linear_index(index);
}}
"
    )
}
