//! CADEM: the discrete element method as an Extended Cellular Automaton.
//!
//! Equal spheres fall, collide with each other and with walls, and come to rest. Contacts are springs with
//! dashpots, along the normal only. The model is that of De Rango et al., *Structured Grid-based Parallel
//! Simulation of a Simple DEM Model on Heterogeneous Systems*: space is a grid of cubic cells, each with N
//! slots for particles; a particle feels those in the 27 cells around it, moves, and is handed over to the
//! cell that then contains it. It uses nothing but the public API of `xca_core`, and runs on every engine.
//!
//! # A tour
//! A [`Configuration`] says everything about a system but its particles. Start from a [`Case`] and change
//! what you need; all units are SI.
//!
//! ```
//! use cadem::{Case, Configuration, Diagnostics, Particle};
//! use xca_core::prelude::*;
//!
//! let configuration = Configuration { cells: [3, 3, 10], damping: 0.05, ..Case::Table1.configuration() };
//!
//! // One particle, 5 mm over the floor, between the walls of a shaft.
//! let particles = vec![Particle::at_rest(1, [0.003, 0.003, 0.005])];
//!
//! let model = cadem::model(&configuration, particles)?;
//! let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! let before = Diagnostics::of(&simulation.state(), configuration.walls)?;
//! assert_eq!((before.particles, before.kinetic_energy), (1, 0.0));
//!
//! // It falls for 400 steps of a tenth of sqrt(m / k_n).
//! simulation.run(400)?;
//! let time = 400.0 * configuration.material().time_step;
//! let [falling] = cadem::particles(&simulation.state())?[..] else { panic!("one particle") };
//! assert!((falling.velocity[2] + 9.81 * time).abs() < 1e-12);
//!
//! // It bounces off the floor and has lost energy to the dashpot.
//! simulation.run(3_100)?;
//! let after = Diagnostics::of(&simulation.state(), configuration.walls)?;
//! assert!(after.momentum[2] > 0.0 && after.total_energy() < 0.9 * before.total_energy());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | to | see |
//! |---|---|
//! | start as the authors did | [`Configuration::authors_particles`], [`initial`] |
//! | choose the time step and the integrator | [`TimeStep`], [`Integrator`] |
//! | choose how walls act, and open them | [`Walls`], [`Opening`] |
//! | change a parameter by name | [`Configuration::set`] |
//! | read the particles of a state, and measure it | [`particles()`], [`Diagnostics`] |
//! | put the model together in another way | [`processes`], [`contact`], [`Dem`] |
//!
//! # What a step does
//! The processes are in [`processes`], one for each sigma of the paper; the forces are in [`contact`]. In
//! each step a particle's force becomes its weight (sigma_1), contacts in its own cell (sigma_2) and in the
//! neighbours (sigma_3) add to it, velocity and position advance (sigma_4), and the particle is handed to the
//! cell that now contains it (sigma_5).
//!
//! Walls are BOUNDARY slots: items of the same population that stand in the outermost cells, one for each
//! domain face that a cell touches.
//!
//! # What stops a run
//! A cell that would hold more than N items; a particle that moves further than its radius in one step, so
//! that it could pass another unseen ([`processes::TOO_FAST`]); a velocity that is no number
//! ([`processes::NOT_A_NUMBER`]); a particle that leaves the domain where no [`Opening`] is
//! ([`processes::THROUGH_WALL`]). No particle is ever dropped. The error names step, cell and particle.
//!
//! # Slips in the paper
//! - The mass of 1e-4 kg and the radius of 0.0005 m make a density of 190,986 kg/m^3; 2000 kg/m^3 would be a
//!   mass of 1.047e-6 kg. It is kept, as it is the paper's case.
//! - Equation 4 prints x' = x + v dt, with which contacts gain energy; see [`Integrator::Explicit`].
//! - Equation 3 with N_t = 10 would be a time step of 3.512e-5 s. The runs have 1.118e-5 s (footnote 4); see
//!   [`TimeStep`].
//! - Section II.C says von Neumann once. The figure, sigma: Q^27 -> Q and the authors' program are Moore.
//! - The listing of sigma_1 reads with (x, y, z) and writes with (i, j, k).

mod boundary_slots;
mod case;
mod check;
mod configuration;
pub mod contact;
mod diagnostics;
mod error;
mod face;
pub mod initial;
mod material;
mod near;
mod particles;
pub mod processes;
mod substates;
mod system;
mod time_step;
mod walls;

pub use case::Case;
pub use configuration::Configuration;
pub use diagnostics::Diagnostics;
pub use error::CademError;
pub use face::Face;
pub use material::Material;
pub use particles::{Particle, ParticleError, particles};
pub use substates::{BOUNDARY, Dem, FIRST_BOUNDARY_LABEL, PARTICLE, VOID};
pub use system::model;
pub use time_step::{Integrator, TimeStep};
pub use walls::{Opening, Rectangle, Walls};
