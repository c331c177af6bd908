//! Mathematical functions with the same bits on every engine.
//!
//! They use only + - * /, comparisons and integers, which give the same bits everywhere. The platform's own
//! functions do not. In a process `x.exp()` is [`exp`] of this module, computed in the precision of the run.
//! In ordinary code these functions compute in `f64`.
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
//! The stated errors are the largest found in hundreds of thousands of values of each precision. They are in
//! units in the last place (ulp) of the exact value. Correct rounding has half a unit. `docs/mathematics.md`
//! in the repository describes the measurements, the cost of a call, and denormal numbers on GPUs.

mod exact;
mod exponential;
mod powers;
mod series;
mod trigonometry;

pub use exponential::{exp, log, pow, tanh};
pub use powers::{cbrt, cosh, exp_m1, exp2, hypot, log_1p, log2, log10, powi, sinh};
pub use trigonometry::{acos, asin, atan, atan2, cos, sin, tan, to_degrees, to_radians};
