//! All reductions of a substate, in one number.

use super::lattice::{Terrain, mix};
use super::medium::Medium;
use super::walker::Walker;
use xca_core::prelude::*;
use xca_core::reduction::{Reduced, Reduction};
use xca_core::{HostValue, StateError};

/// Every kind of reduction, but for counts.
pub const EACH: [Reduction; 10] = [
    Reduction::Sum,
    Reduction::Product,
    Reduction::Minimum,
    Reduction::Maximum,
    Reduction::LogicalAnd,
    Reduction::LogicalOr,
    Reduction::LogicalXor,
    Reduction::BitAnd,
    Reduction::BitOr,
    Reduction::BitXor,
];

/// A number made of every bit of the results.
fn digest(results: &[Reduced]) -> u32 {
    results.iter().fold(0, |digest, result| match result {
        Reduced::Nothing => mix(digest, 1),
        Reduced::Integer(value) => mix(mix(digest, *value as u32), (*value >> 32) as u32),
        Reduced::Float(value) => {
            // What is no number has no bits of its own.
            let bits = if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() };
            mix(mix(digest, bits as u32), (bits >> 32) as u32)
        }
    })
}

/// All reductions of one substate.
fn of<S: Substates, V: HostValue>(state: &State<'_>, substate: Substate<S, V>) -> Result<u32, StateError> {
    EACH.iter().try_fold(0, |result, reduction| match state.reduce(substate, reduction) {
        Ok(results) => Ok(mix(result, digest(&results))),
        Err(StateError::BitsOfFloats(_)) => Ok(mix(result, 2)),
        Err(error) => Err(error),
    })
}

/// All reductions of the substate of cells that the number says.
///
/// # Errors
/// Where the model does not have it.
pub fn of_cells(state: &State<'_>, which: u32) -> Result<u32, StateError> {
    let result = match which % 15 {
        0 => of(state, Medium::LIFE),
        1 => of(state, Medium::CHARGE),
        2 => of(state, Medium::BITS),
        3 => of(state, Medium::HEAT),
        4 => of(state, Medium::ENERGY),
        5 => of(state, Medium::LEVEL),
        6 => of(state, Medium::FLOW),
        7 => of(state, Medium::PAIR),
        8 => of(state, Medium::BLEND),
        9 => of(state, Medium::TERRAIN),
        10 => of(state, Medium::WET),
        11 => of(state, Medium::FLOWS),
        12 => of(state, Medium::PATHS),
        13 => of(state, Medium::MARKS),
        _ => of(state, Medium::LONG),
    };
    let counts =
        mix(state.count(Medium::LIFE, 1)? as u32, state.count(Medium::TERRAIN, Terrain::Water)? as u32);
    Ok(mix(result?, mix(counts, state.count(Medium::WET, true)? as u32)))
}

/// All reductions of the substate of items that the number says.
///
/// # Errors
/// Where the model does not have it.
pub fn of_items(state: &State<'_>, which: u32) -> Result<u32, StateError> {
    let result = match which % 11 {
        0 => of(state, Walker::POSITION),
        1 => of(state, Walker::VELOCITY),
        2 => of(state, Walker::MASS),
        3 => of(state, Walker::WARMTH),
        4 => of(state, Walker::KIND),
        5 => of(state, Walker::SEEN),
        6 => of(state, Walker::LOAD),
        7 => of(state, Walker::MEMORY),
        8 => of(state, Walker::SPEEDS),
        9 => of(state, Walker::TERRAIN),
        _ => of(state, Walker::AWAKE),
    };
    let counts = mix(state.count(Walker::KIND, 2)? as u32, state.count_items::<Walker>()? as u32);
    let occupied = mix(state.largest_occupancy::<Walker>()?, state.count_left::<Walker>()? as u32);
    Ok(mix(result?, mix(counts, occupied)))
}
