//! Where things are: cells, neighbours, positions.

use xca_core::kernel::{BEYOND_NEIGHBOURHOOD, NOWHERE, OUTSIDE};
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
    format!(
        "fn checked_neighbour_at(index: u32) -> u32 {{
    if index >= {neighbours} {{
        report_fault({BEYOND_NEIGHBOURHOOD:#x}u, Real(index));
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
    let lanes = ["x", "y", "z"];
    let lanes: Vec<String> = lanes
        .iter()
        .zip(toroidal)
        .map(|(lane, toroidal)| {
            if toroidal {
                format!("shorter_way(separation.{lane}, space.extents.{lane})")
            } else {
                format!("separation.{lane}")
            }
        })
        .collect();
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
    return vec3<Real>({});
}}
",
        lanes.join(", ")
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
