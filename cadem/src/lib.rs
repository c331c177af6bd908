//! CADEM.
pub mod contact;
pub mod initial;
mod material;
pub mod processes;
mod substates;
pub use material::Material;
pub use substates::*;
