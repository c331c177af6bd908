//! A cell of the initial state, as the functions that make it see it.

use xca_process::Geometry;
use xca_process::{Draw, Stream, uniform};
use xca_values::Vector3;

/// A cell whose initial state, or whose items, are about to be made: where it lies, and its random numbers.
///
/// [`crate::ModelBuilder::fill`] and [`crate::ModelBuilder::populate`] give one for each cell.
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
    /// All sites by linear index.
    pub(crate) fn iter(self) -> impl Iterator<Item = Site> + 'a {
        (0..self.geometry.cells()).map(move |linear| {
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
    /// So too with hexagons: this is the centre of the cell that [`crate::Space::cell_containing`] finds,
    /// without the shift of odd rows or columns.
    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// A random number in [0, 1): a function of the seed, the struct of substates, the cell and `draw`, the
    /// same on every engine. It is independent of what processes draw. It has 53 bits in every run; an `f32`
    /// run rounds what is made of it.
    ///
    /// The function [`crate::State::fill`] draws other numbers at other steps.
    pub fn random(&self, draw: usize) -> f64 {
        uniform(self.words(draw))
    }

    /// 32 random bits, as [`Self::random`], whose number is made of the same ones.
    pub fn random_bits(&self, draw: usize) -> u32 {
        self.words(draw)[0]
    }

    fn words(&self, draw: usize) -> [u32; 4] {
        let Self { stream, step, linear, seed, .. } = *self;
        Draw { stream, step, owner: linear, number: draw as u32 }.words(seed)
    }
}
