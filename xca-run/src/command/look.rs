//! The options that say what is looked at, in pictures and on the terminal.

use crate::options::number_in;
use clap::Args;
#[cfg(feature = "terminal")]
use xca_record::record::Look;

/// What is looked at.
#[derive(Args, Debug, Clone)]
pub(super) struct LookArguments {
    /// Substate to draw, or one component: outflow, outflow.3, velocity.x. A whole vector is drawn as its
    /// length, a whole array as its sum
    #[arg(long, value_name = "NAME")]
    substate: Option<String>,

    /// Slice views: the axis normal to the slice
    #[arg(long, value_name = "x|y|z", value_parser = axis)]
    axis: Option<usize>,

    /// Slice views: the layer, from 0 [default: the middle one]
    #[arg(long, value_name = "N")]
    layer: Option<usize>,

    /// Ends of the colour scale [default: smallest and largest value drawn]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range)]
    range: Option<[f64; 2]>,
}

#[cfg(feature = "terminal")]
impl LookArguments {
    pub(super) fn look(&self) -> Look {
        let Self { substate, axis, layer, range } = self.clone();
        Look { substate, axis, layer, range, ..Look::default() }
    }
}

pub(super) fn axis(text: &str) -> Result<usize, &'static str> {
    ["x", "y", "z"].iter().position(|name| *name == text).ok_or("it must be x, y or z")
}

pub(super) fn range(text: &str) -> Result<[f64; 2], &'static str> {
    const WANTED: &str = "it must be two numbers, the lower one first, such as 0,20";
    let (low, high) = text.split_once(',').ok_or(WANTED)?;
    match [low, high].map(number_in(..)) {
        [Ok(low), Ok(high)] if low < high => Ok([low, high]),
        _ => Err(WANTED),
    }
}
