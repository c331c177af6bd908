//! The functions that make the initial state.

use super::ModelBuilder;
use super::filling_check::Filling;
use crate::site::Site;
use xca_process::Parameters;
use xca_process::Substates;

impl ModelBuilder {
    /// Makes the initial state of each cell.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Forest { tree: u8, height: Real }
    /// # let builder = Model::builder("forest").extents([9, 9, 1]).substates::<Forest>();
    /// builder.fill(|site| Forest { tree: u8::from(site.random(0) < 0.6), height: 20.0 * site.random(1) })
    /// # .build().unwrap();
    /// ```
    pub fn fill<S: Substates>(mut self, state: impl Fn(Site) -> S + Send + Sync + 'static) -> Self {
        self.fillings.push(Filling::cells::<S>());
        self.initialise(move |space| Ok(space.fill(&state)?))
    }

    /// Makes the initial state of each cell from the parameters with which the run begins.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Heat { temperature: Real }
    /// # #[derive(Parameters, Clone, Debug)]
    /// # struct Copper { initial: Real }
    /// let mut model = Model::builder("heat")
    ///     .extents([9, 9, 9])
    ///     .substates::<Heat>()
    ///     .parameters(Copper { initial: 100.0 })
    ///     .fill_with(|_, copper: &Copper| Heat { temperature: copper.initial })
    ///     .build()?;
    /// model.set_parameter("initial", "50")?;
    /// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// assert_eq!(simulation.state().maximum(Heat::TEMPERATURE)?, Some(50.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fill_with<S: Substates, P: Parameters>(
        mut self,
        state: impl Fn(Site, &P) -> S + Send + Sync + 'static,
    ) -> Self {
        self.fillings.push(Filling::cells::<S>().with::<P>());
        self.initialise(move |space| Ok(space.fill_with(&state)?))
    }

    /// Makes the initial items of each cell. The function returns anything iterable: an `Option`, a `Vec`, an
    /// iterator.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Molecule { position: Vector3<Real> }
    /// # let builder = Model::builder("gas").extents([9, 9, 9]).population::<Molecule>(4);
    /// // Two molecules in each cell, anywhere in it.
    /// builder.populate(|site| {
    ///     (0..2).map(move |number| {
    ///         let offset = Vector3::new(0, 1, 2).map(|axis| site.random(3 * number + axis) - 0.5);
    ///         Molecule { position: site.centre() + offset }
    ///     })
    /// })
    /// # .build().unwrap();
    /// ```
    ///
    /// Labels count from 0, cell by cell (x fastest), in the order of the items within a cell.
    pub fn populate<S: Substates, I: IntoIterator<Item = S>>(
        mut self,
        items: impl Fn(Site) -> I + Send + Sync + 'static,
    ) -> Self {
        self.fillings.push(Filling::items::<S>());
        self.initialise(move |space| Ok(space.populate(&items)?))
    }

    /// As [`Self::populate`], with the parameters with which the run begins.
    pub fn populate_with<S: Substates, P: Parameters, I: IntoIterator<Item = S>>(
        mut self,
        items: impl Fn(Site, &P) -> I + Send + Sync + 'static,
    ) -> Self {
        self.fillings.push(Filling::items::<S>().with::<P>());
        self.initialise(move |space| Ok(space.populate_with(&items)?))
    }
}
