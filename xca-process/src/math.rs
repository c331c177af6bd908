//! Mathematical functions with the same bits on every engine.
//!
//! They are made of + - * /, comparisons and whole numbers alone, which are the same everywhere; the
//! platform's own functions are not. In a process `x.exp()` is [`exp`] here, computed in the precision of the
//! run. In ordinary code these functions compute in `f64`.
//!
//! ```
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
//!     cell.viscosity = (20.0 - 0.013 * cell.temperature).exp();
//!     cell.direction = cell.flow.y.atan2(cell.flow.x);
//! }
//!
//! assert_eq!(xca_core::math::exp(0.0), 1.0);
//! ```
//!
//! The errors stated with each function are the largest that were found in hundreds of thousands of values of
//! each precision, in units of the last digit of the exact value (half a unit is a correctly rounded value).
//! `docs/mathematics.md` in the repository says how they were measured, what a call costs and what GPUs may
//! do with denormal numbers.

mod exact;
mod exponential;
mod powers;
mod series;
mod trigonometry;

pub use exponential::{exp, log, pow, tanh};
pub use powers::{cbrt, cosh, exp_m1, exp2, hypot, log_1p, log2, log10, powi, sinh};
pub use trigonometry::{acos, asin, atan, atan2, cos, sin, tan, to_degrees, to_radians};
