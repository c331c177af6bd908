//! Where things are: cells, neighbours, positions.

use crate::fault::FaultKind;
use xca_core::kernel::{NOWHERE, OUTSIDE};
use xca_core::{Boundary, Face, Faces, Parity, Precision};

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

/// What leads from an index to its place in a table that has a second part for odd rows or columns.
fn odd_part(parity: Parity, neighbours: &str) -> String {
    match parity {
        Parity::None => String::new(),
        Parity::Row => format!(" + (u32(here_index.y) & 1u) * {neighbours}"),
        Parity::Column => format!(" + (u32(here_index.x) & 1u) * {neighbours}"),
    }
}

/// The number of a neighbour among the stored cells.
pub(crate) fn neighbour_at(parity: Parity, neighbours: &str) -> String {
    let odd = odd_part(parity, neighbours);
    format!(
        "fn neighbour_at(index: u32) -> u32 {{
    return u32(i32(here) + neighbour_offsets[index{odd}]);
}}
"
    )
}

/// An index that may be too large: that is a fault, and the cell itself takes the place of the neighbour.
pub(crate) fn valid_neighbour(neighbours: &str) -> String {
    let kind = FaultKind::BeyondNeighbourhood as u32;
    format!(
        "fn valid_neighbour(index: u32) -> u32 {{
    if index >= {neighbours} {{
        record_fault({kind}u, index, {neighbours}, Real());
        return 0u;
    }}
    return index;
}}
"
    )
}

/// The displacement to a neighbour and, in the last lane, the index of its opposite.
pub(crate) fn neighbour_direction(parity: Parity, neighbours: &str) -> String {
    let odd = odd_part(parity, neighbours);
    format!(
        "fn neighbour_direction(index: u32) -> vec4<i32> {{
    return neighbour_directions[index{odd}];
}}
"
    )
}

/// Whether a neighbour is a cell of the space.
pub(crate) fn neighbour_exists(boundaries: &Faces<Boundary>) -> String {
    let mut inside = Vec::new();
    for (lane, [low, high]) in ["x", "y", "z"].into_iter().zip(Face::ALONG) {
        if boundaries[low] == Boundary::Flat {
            inside.push(format!("there.{lane} >= 0"));
        }
        if boundaries[high] == Boundary::Flat {
            inside.push(format!("there.{lane} < space.extents.{lane}"));
        }
    }
    let result = if inside.is_empty() { "true".to_owned() } else { inside.join(" && ") };
    format!(
        "fn neighbour_exists(index: u32) -> bool {{
    let there: vec3<i32> = here_index + neighbour_direction(index).xyz;
    return {result};
}}
"
    )
}

/// The separation by the shorter way round each toroidal axis.
pub(crate) fn nearest_image(boundaries: &Faces<Boundary>, precision: Precision) -> String {
    let half = match precision {
        Precision::F32 => "0.5f",
        Precision::F64 => "0.5lf",
    };
    let lanes = along_toroidal(boundaries, "separation", "shorter_way");
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
fn along_toroidal(boundaries: &Faces<Boundary>, vector: &str, function: &str) -> String {
    let lane = |(lane, [low, _]): (&str, [Face; 2])| {
        if boundaries[low] == Boundary::Toroidal {
            format!("{function}({vector}.{lane}, space.extents.{lane})")
        } else {
            format!("{vector}.{lane}")
        }
    };
    let lanes: Vec<String> = ["x", "y", "z"].into_iter().zip(Face::ALONG).map(lane).collect();
    format!("vec3<Real>({})", lanes.join(", "))
}

/// The position inside the space, as far as axes are toroidal.
pub(crate) fn wrapped(boundaries: &Faces<Boundary>) -> String {
    let lanes = along_toroidal(boundaries, "position", "wrapped_along");
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
