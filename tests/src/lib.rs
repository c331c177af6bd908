//! What the tests of the whole system share: a plain particle code, and what is known of collisions.

pub mod brute_force;
pub mod mathematics;
pub mod restitution;
pub mod suite;

/// The guide, whose programs are run as tests of the documentation.
#[doc = include_str!("../../docs/guide.md")]
pub mod guide {}

/// The page on mathematical functions, whose program is compiled as a test of the documentation.
#[doc = include_str!("../../docs/mathematics.md")]
pub mod mathematics_page {}

/// The page on recording and ensembles, whose programs are compiled as tests of the documentation.
#[doc = include_str!("../../docs/recording.md")]
pub mod recording_page {}

/// The page on comparisons.
#[doc = include_str!("../../docs/comparing.md")]
pub mod comparing_page {}

/// The page on maps.
#[doc = include_str!("../../docs/maps.md")]
pub mod maps_page {}

/// The page for those who come from OpenCAL.
#[doc = include_str!("../../docs/opencal.md")]
pub mod opencal_page {}

/// The recipes for models and steering.
#[doc = include_str!("../../docs/cookbook.md")]
pub mod cookbook_page {}

/// The README of the crate `xca`, whose program is run as a test of the documentation.
#[doc = include_str!("../../xca/README.md")]
pub mod xca_readme {}

/// The recipes for maps, files, runs and engines.
#[doc = include_str!("../../docs/cookbook-runs.md")]
pub mod cookbook_runs_page {}
