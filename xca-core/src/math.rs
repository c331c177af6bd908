//! Mathematical functions with the same bits on every engine.
//!
//! They are made of + - * /, comparisons and whole numbers alone, which are the same everywhere; the platform's own `x.exp()` is not, and
//! a process cannot use it. In a process they compute in the precision of the run, in ordinary code in `f64`.
//!
//! ```
//! use xca_core::math::{atan2, exp};
//! use xca_core::prelude::*;
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Lava {
//!     temperature: Real,
//!     viscosity: Real,
//!     flow: Vector2<Real>,
//!     direction: Real,
//! }
//!
//! #[elementary_process]
//! fn stiffen(cell: &mut Cell<Lava>) {
//!     cell.viscosity = exp(20.0 - 0.013 * cell.temperature);
//!     cell.direction = atan2(cell.flow.y, cell.flow.x);
//! }
//!
//! assert_eq!(exp(0.0), 1.0);
//! ```
//!
//! The errors stated with each function are the largest that were found in hundreds of thousands of values of each precision, in units of the
//! last digit of the exact value (half a unit is a correctly rounded value). `docs/mathematics.md` in the repository says how they were measured, what
//! a call costs and what GPUs may do with denormal numbers.

mod exact;
mod exponential;
mod series;
mod trigonometry;

pub use exponential::{exp, log, pow, tanh};
pub use trigonometry::{atan, atan2, cos, sin, tan};
