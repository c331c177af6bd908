//! What is checked of a model when it is built.

use super::{Group, GroupKind, ModelError};
use crate::parameter_set::ParameterSet;
use xca_process::kernel::NOWHERE;
use xca_process::{Boundary, Face, Geometry};
use xca_process::{Holds, Process};
use xca_process::{Neighbourhood, Parity};

const AXES: [char; 3] = ['x', 'y', 'z'];

pub(super) fn check_geometry(geometry: &Geometry) -> Result<(), ModelError> {
    let extents = geometry.extents();
    if let Some(axis) = extents.iter().position(|&extent| extent == 0) {
        return Err(ModelError::ZeroExtent { axis: AXES[axis], extents });
    }
    let limit = u64::from(NOWHERE);
    let cells = extents.iter().try_fold(1_u64, |cells, &extent| cells.checked_mul(extent as u64));
    if cells.is_none_or(|cells| cells >= limit) {
        return Err(ModelError::TooManyCells { extents, limit });
    }
    let side = geometry.side();
    if !(side.is_finite() && side > 0.0) {
        return Err(ModelError::CellSide { side });
    }
    let length = *extents.iter().max().unwrap_or(&0) as f64 * side;
    if !length.is_finite() {
        return Err(ModelError::Length { side, extents });
    }
    for [low, high] in Face::ALONG {
        let boundaries = geometry.boundaries();
        for (toroidal, other) in [(low, high), (high, low)] {
            if boundaries[toroidal] == Boundary::Toroidal && boundaries[other] != Boundary::Toroidal {
                return Err(ModelError::HalfTorus { toroidal, other, boundary: boundaries[other] });
            }
        }
    }
    let neighbourhood = geometry.neighbourhood();
    for (axis, reach) in neighbourhood.reach().into_iter().enumerate() {
        let (extent, toroidal) = (extents[axis], geometry.toroidal()[axis]);
        let fits = if toroidal { reach == 0 || 2 * reach < extent } else { reach <= extent };
        if !fits {
            let neighbourhood = neighbourhood.to_string();
            let boundary = geometry.boundaries()[Face::ALONG[axis][0]];
            return Err(ModelError::NeighbourhoodTooWide {
                neighbourhood,
                axis: AXES[axis],
                reach,
                extent,
                boundary,
            });
        }
    }
    let alternating = match neighbourhood.parity() {
        Parity::None => return Ok(()),
        Parity::Row => 1,
        Parity::Column => 0,
    };
    if Face::ALONG[alternating].iter().any(|face| geometry.boundaries()[*face] == Boundary::Reflecting) {
        return Err(ModelError::ReflectedHexagons { axis: AXES[alternating] });
    }
    if geometry.toroidal()[alternating] && extents[alternating] % 2 == 1 {
        return Err(ModelError::OddHexagonalTorus { axis: AXES[alternating], extent: extents[alternating] });
    }
    Ok(())
}

pub(super) fn check_group(group: &Group, geometry: &Geometry) -> Result<(), ModelError> {
    if let GroupKind::Population { .. } = group.kind
        && let Some(face) =
            Face::ALL.into_iter().find(|face| geometry.boundaries()[*face] == Boundary::Reflecting)
    {
        return Err(ModelError::ReflectedPopulation { substates: group.schema.name, face });
    }
    Ok(())
}

pub(super) fn check_process(
    process: &Process,
    groups: &[Group],
    parameters: &ParameterSet,
) -> Result<(), ModelError> {
    let name = process.name;
    for (number, argument) in process.substates.iter().enumerate() {
        let substates = argument.schema.name;
        let type_id = (argument.type_id)();
        let Some(group) = groups.iter().find(|group| group.type_id == type_id) else {
            return Err(ModelError::UnknownSubstates { process: name, substates });
        };
        match (&group.kind, argument.holds) {
            (GroupKind::Population { .. }, Holds::Cells) => {
                return Err(ModelError::CellsOfPopulation { process: name, substates });
            }
            (GroupKind::Cells { .. }, Holds::Items) => {
                return Err(ModelError::ItemsOfCells { process: name, substates });
            }
            _ => {}
        }
        if process.substates[..number].iter().any(|earlier| (earlier.type_id)() == type_id) {
            return Err(ModelError::ArgumentTwice { process: name, substates });
        }
    }
    for wanted in process.parameters {
        if parameters.struct_of_type((wanted.type_id)()).is_none() {
            let given = parameters.listed();
            return Err(ModelError::Parameters { process: name, wanted: wanted.schema.name, given });
        }
    }
    // A substate stands in two accesses only where one of them is the position for a search.
    for (number, access) in process.access.iter().enumerate() {
        let twice = process.access[..number]
            .iter()
            .find(|other| other.argument == access.argument && other.field == access.field);
        if let Some(other) = twice
            && (other.write || access.write)
        {
            let substate = process.subject().schema.fields[access.field].name;
            return Err(ModelError::SearchOfWritten { process: name, substate });
        }
    }
    Ok(())
}

pub(super) fn check_opposites(process: &Process, neighbourhood: &Neighbourhood) -> Result<(), ModelError> {
    match neighbourhood.without_opposite() {
        Some(displacement) if process.uses_opposite => Err(ModelError::NoOpposite {
            process: process.name,
            neighbourhood: neighbourhood.to_string(),
            displacement,
            missing: displacement.map(i32::wrapping_neg),
        }),
        _ => Ok(()),
    }
}
