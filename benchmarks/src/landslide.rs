//! A landslide on the CPU engine, which finds by itself which cells can change, against active cells by hand.

mod by_hand;

use crate::timing::{Times, interleaved};
use by_hand::ActiveCells;
use std::error::Error;
use std::fmt;
use std::path::Path;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_examples::models::landslide::{Debris, Slope, builder};
use xca_io::raster::Raster;

/// What a step of a landslide costs.
pub(crate) struct Cost {
    engine: Times,
    by_hand: Times,
    /// Of all cells those that the engine worked on.
    share: f64,
}

/// Ground and debris of a map.
pub(crate) fn map(dem: &Path, debris: &Path) -> Result<Model, Box<dyn Error>> {
    let [ground, thickness] = [Raster::read_heights(dem)?, Raster::read_thickness(debris)?];
    if thickness.extents() != ground.extents() {
        return Err("the debris has other extents than the ground".into());
    }
    let (extents, side) = (ground.extents(), ground.side());
    let state = move |site: Site| {
        let [x, y, _] = site.cell();
        let altitude = ground.value([x, y]);
        Slope {
            altitude: altitude.unwrap_or(0.0),
            thickness: thickness.value([x, y]).unwrap_or(0.0),
            is_ground: altitude.is_some(),
            ..Slope::bare()
        }
    };
    Ok(builder(extents, side, DEBRIS, state).build()?)
}

/// A rough slope of 600 x 500 cells with a slab of debris at its head.
pub(crate) fn slope() -> Result<Model, ModelError> {
    let state = |site: Site| {
        let [x, y, _] = site.cell();
        let is_slab = (270..330).contains(&x) && (430..490).contains(&y);
        let across = (x as f64 - 300.0) / 100.0;
        let altitude = 2.0 * y as f64 + 20.0 * across * across + 2.0 * site.random(0);
        Slope { altitude, thickness: if is_slab { 6.0 } else { 0.0 }, ..Slope::bare() }
    };
    builder([600, 500], 10.0, DEBRIS, state).build()
}

/// Those with which OpenCAL's authors measure SciddicaT.
const DEBRIS: Debris = Debris { adherence: 0.001, rate: 0.5 };

/// Runs both in turns, `steps` steps in each round. They must give the same bits.
pub(crate) fn cost(model: &Model, threads: usize, rounds: usize, steps: u64) -> Result<Cost, Box<dyn Error>> {
    let mut simulation = Simulation::new(model, &Cpu::with_threads(threads)?, RunOptions::default())?;
    let mut active = ActiveCells::new(&simulation.state(), DEBRIS)?;
    let mut failure = None;
    let times = interleaved(
        rounds,
        &mut [&mut || failure = simulation.run(steps).err().or(failure.take()), &mut || {
            (0..steps).for_each(|_| active.step());
        }],
    );
    failure.map_or(Ok(()), Err)?;
    let by_engine = simulation.state().read(Slope::THICKNESS)?;
    if by_engine.iter().zip(active.thickness()).any(|(one, other)| one.to_bits() != other.to_bits()) {
        return Err("the engine and the active cells by hand differ".into());
    }
    let figures = simulation.figures();
    let share = figures.iter().find(|figure| figure.name == "share_of_cells_worked_on");
    let [engine, by_hand] =
        <[Times; 2]>::try_from(times).map_err(|_| "two contenders")?.map(|times| times.per(steps as usize));
    Ok(Cost { engine, by_hand, share: share.map_or(1.0, |share| share.value) })
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [(low, high), (hand_low, hand_high)] = [&self.engine, &self.by_hand].map(Times::spread);
        write!(
            f,
            "landslide: {:.3} ms a step ({:.3} to {:.3}); active cells by hand, one thread, {:.3} ms ({:.3} to {:.3}); ratio {:.2}; {:.2} % of the cells worked on",
            self.engine.median() * 1e3,
            low * 1e3,
            high * 1e3,
            self.by_hand.median() * 1e3,
            hand_low * 1e3,
            hand_high * 1e3,
            self.engine.median() / self.by_hand.median(),
            self.share * 100.0,
        )
    }
}
