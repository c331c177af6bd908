//! The minimisation of differences (Di Gregorio and Serra, Future Generation Computer Systems 16, 1999),
//! which lava, debris and landslides share.

use xca_core::prelude::*;

/// What goes to each place so that the heights of all that take part differ as little as possible.
///
/// Place 0 is the cell itself; its height is that of what cannot move. A place above the common level takes
/// no part.
#[helper]
pub fn shares<const N: usize>(heights: [Real; N], takes_part: [bool; N], mobile: Real) -> [Real; N] {
    let mut taking_part = takes_part;
    let mut level = 0.0;
    let mut is_settled = false;
    while !is_settled {
        let mut sum = mobile;
        let mut count = 0.0;
        for n in 0..N {
            if taking_part[n] {
                sum += heights[n];
                count += 1.0;
            }
        }
        level = sum / count;
        is_settled = true;
        for n in 0..N {
            if taking_part[n] && heights[n] > level {
                taking_part[n] = false;
                is_settled = false;
            }
        }
    }
    let mut shares = [0.0; N];
    for n in 0..N {
        if taking_part[n] {
            shares[n] = level - heights[n];
        }
    }
    shares
}

/// Refuses an initial state in which a thickness is below 0, as a grid of `--initial` can have it. Call it
/// with `Schedule::At(vec![0])`: `--initial` comes after all of `Schedule::Start`.
///
/// # Errors
/// With the first such cell.
pub fn check_thickness<S: Substates>(
    state: &State<'_>,
    thickness: Substate<S, f64>,
) -> Result<(), SteeringError> {
    let metres = state.read(thickness)?;
    let Some(cell) = metres.iter().position(|metres| *metres < 0.0) else { return Ok(()) };
    let [columns, _, _] = state.geometry().extents();
    let (x, y) = (cell % columns, cell / columns);
    Err(format!("a thickness of {} m in cell [{x}, {y}, 0]; it must be at least 0", metres[cell]).into())
}
