//! Models that are quiet nearly everywhere: the CPU engine, which leaves out what cannot change, against
//! itself where it works on all cells.

use crate::dense::{life_from, soup};
use crate::timing::{Times, interleaved};
use std::error::Error;
use std::fmt;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_examples::models::debris::{self, Debris, Slope};
use xca_examples::models::lava::{self, Lava, Rate, Vent};
use xca_examples::models::wildfire::{self, Cover, Landscape, Weather};

/// A model, with the steps that make a round, and those that are done before.
pub(crate) struct Quiet {
    name: &'static str,
    model: Model,
    before: u64,
    steps: u64,
}

/// What a model costs.
pub(crate) struct Cost {
    name: &'static str,
    leaving_out: Times,
    whole: Times,
    /// Of all cells that which was worked on, in the steps of the rounds and before.
    share: f64,
}

const GLIDER: [[usize; 3]; 5] = [[1, 0, 0], [2, 1, 0], [0, 2, 0], [1, 2, 0], [2, 2, 0]];

impl Quiet {
    /// The models of the benchmark.
    pub(crate) fn all() -> Result<Vec<Self>, ModelError> {
        let model = |name, model, before, steps| Self { name, model, before, steps };
        Ok(vec![
            model(
                "life, a glider in 4096^2",
                life_from(4096, |cell| GLIDER.contains(&cell).into())?,
                10,
                100,
            ),
            model("life, a soup in 1024^2 after 5000 steps", life_from(1024, soup)?, 5000, 200),
            model("wildfire, 1024^2", fire(1024)?, 40, 20),
            model("lava, 512^2", eruption(512)?, 200, 50),
            model("debris, 400^2 hexagons", slide(400)?, 20, 20),
        ])
    }

    /// Runs both in turns.
    pub(crate) fn cost(&self, threads: usize, rounds: usize) -> Result<Cost, Box<dyn Error>> {
        let [mut leaving_out, mut whole] = [
            self.simulation(Cpu::with_threads(threads)?)?,
            self.simulation(Cpu::with_threads(threads)?.without_tiles())?,
        ];
        let mut failure = None;
        let mut other_failure = None;
        let times = interleaved(
            rounds,
            &mut [&mut || failure = leaving_out.run(self.steps).err().or(failure.take()), &mut || {
                other_failure = whole.run(self.steps).err().or(other_failure.take());
            }],
        );
        failure.or(other_failure).map_or(Ok(()), Err)?;
        if leaving_out.snapshot()? != whole.snapshot()? {
            return Err(format!("{}: what is left out changes the result", self.name).into());
        }
        let figures = leaving_out.figures();
        let share = figures.iter().find(|figure| figure.name == "share_of_cells_worked_on");
        let [leaving_out, whole] = <[Times; 2]>::try_from(times)
            .map_err(|_| "two contenders")?
            .map(|times| times.per(self.steps as usize));
        Ok(Cost { name: self.name, leaving_out, whole, share: share.map_or(1.0, |share| share.value) })
    }

    fn simulation(&self, engine: Cpu) -> Result<Simulation, Box<dyn Error>> {
        let mut simulation = Simulation::new(&self.model, &engine, RunOptions::default())?;
        simulation.run(self.before)?;
        Ok(simulation)
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = self.leaving_out.spread();
        let (whole_low, whole_high) = self.whole.spread();
        write!(
            f,
            "{}: {:.3} ms a step ({:.3} to {:.3}), all cells {:.3} ms ({:.3} to {:.3}), {:.1} times faster; {:.2} % of the cells worked on",
            self.name,
            self.leaving_out.median() * 1e3,
            low * 1e3,
            high * 1e3,
            self.whole.median() * 1e3,
            whole_low * 1e3,
            whole_high * 1e3,
            self.whole.median() / self.leaving_out.median(),
            self.share * 100.0,
        )
    }
}

/// A fire that begins in the middle of a wood on hills.
fn fire(size: usize) -> Result<Model, ModelError> {
    wildfire::model([size; 2], 10.0, Weather::default(), move |site| {
        let [x, y, _] = site.cell();
        let is_first = x.abs_diff(size / 2) < 3 && y.abs_diff(size / 2) < 3;
        let cover = if is_first { Cover::Burning } else { Cover::Whole };
        let altitude = 300.0 + 45.0 * (site.centre().x / 500.0).sin() * (site.centre().y / 700.0).cos();
        Landscape { cover, fuel: 0.9 + 0.1 * site.random(0), altitude }
    })
}

/// A vent beside the top of a cone.
fn eruption(size: usize) -> Result<Model, ModelError> {
    let vent = Vent { cell: [size / 2 + 9, size / 2, 0], rates: vec![Rate { from: 0.0, volume: 20.0 }] };
    let middle = size as f64 * 5.0;
    lava::model([size; 2], 10.0, Lava::default(), vec![vent], move |site| {
        let [x, y] = [site.centre().x - middle, site.centre().y - middle];
        Some(2000.0 - 0.3 * (x * x + y * y).sqrt() + 2.0 * site.random(0))
    })
}

/// Soil that breaks loose at the head of a slope.
fn slide(size: usize) -> Result<Model, ModelError> {
    debris::model([size; 2], 2.5, Debris::default(), move |site| {
        let [x, y, _] = site.cell();
        let altitude = 0.5 * site.centre().y + 0.3 * site.random(0);
        let breaks_loose = u32::from(x.abs_diff(size / 2) < 10 && y + 30 > size);
        Slope { altitude, soil: 0.5, breaks_loose, ..Slope::bare() }
    })
}
