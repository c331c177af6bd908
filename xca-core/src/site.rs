//! A cell of the initial state, as the functions that make it see it.

use std::ops::Range;
use xca_process::Geometry;
use xca_process::{Draw, Stream, uniform};
use xca_values::Vector3;

/// A cell whose initial state is being made: its place and its random numbers.
///
/// [`crate::ModelBuilder::fill`] and [`crate::ModelBuilder::populate`] pass one for each cell:
///
/// ```
/// # use xca_core::prelude::*;
/// # #[derive(Substates, Clone, Copy)]
/// # struct Hill { altitude: Real, wood: bool }
/// # let builder = Model::builder("hill").extents([9, 9, 1]).cell_side(10.0).substates::<Hill>();
/// let model = builder
///     .fill(|site| {
///         let from_centre = (site.centre() - Vector3::new(45.0, 45.0, 5.0)).length();
///         Hill { altitude: 100.0 - from_centre, wood: site.random(0) < 0.3 && site.cell()[1] > 4 }
///     })
///     .build()?;
/// # let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// # assert_eq!(simulation.state().get(Hill::ALTITUDE, [4, 4, 0])?, 100.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    cell: [usize; 3],
    linear: u32,
    centre: Vector3<f64>,
    stream: Stream,
    step: u64,
    seed: u64,
}

/// What all sites of a struct of substates share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sites<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) group: usize,
    pub(crate) step: u64,
    pub(crate) seed: u64,
}

impl<'a> Sites<'a> {
    /// The sites with these linear indices.
    pub(crate) fn within(self, cells: Range<usize>) -> impl Iterator<Item = Site> + 'a {
        cells.map(move |linear| {
            let cell = self.geometry.indices(linear);
            let [x, y, z] = self.geometry.centre(cell);
            Site {
                cell,
                linear: linear as u32,
                centre: Vector3::new(x, y, z),
                stream: Stream::initial(self.group),
                step: self.step,
                seed: self.seed,
            }
        })
    }
}

impl Site {
    /// The indices of the cell along x, y, z.
    pub fn cell(&self) -> [usize; 3] {
        self.cell
    }

    /// The centre of the cell in metres, from the corner of the space: `(index + 0.5) * side` along each
    /// axis.
    ///
    /// Hexagons have the same formula, without the shift of odd rows or columns.
    /// [`crate::Space::cell_containing`] finds the cell of this position.
    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// A random number in [0, 1): a function of seed, struct of substates, cell and `draw`. It is the same on
    /// every engine, and independent of the draws of processes.
    ///
    /// It has 53 bits in either precision. An `f32` run rounds the values made of it. [`crate::State::fill`]
    /// draws other numbers in other steps.
    pub fn random(&self, draw: usize) -> f64 {
        uniform(self.words(draw))
    }

    /// The 32 random bits of which [`Self::random`] makes its number.
    pub fn random_bits(&self, draw: usize) -> u32 {
        self.words(draw)[0]
    }

    fn words(&self, draw: usize) -> [u32; 4] {
        let Self { stream, step, linear, seed, .. } = *self;
        Draw { stream, step, owner: linear, number: draw as u32 }.words(seed)
    }
}
