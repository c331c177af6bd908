pub mod brute_force;
pub mod restitution;

/// The guide, whose programs are run as tests of the documentation.
#[doc = include_str!("../../docs/guide.md")]
pub mod guide {}
