//! Observables of a simulation: named numbers of a whole state.
//!
//! ```
//! use xca_core::prelude::*;
//! use xca_observe::measure;
//!
//! #[derive(Substates, Clone)]
//! struct Plate {
//!     temperature: Real,
//! }
//!
//! let model = Model::builder("plate")
//!     .extents([3, 2, 1])
//!     .substates::<Plate>()
//!     .fill(|site| Plate { temperature: site.cell()[0] as f64 })
//!     .build()?;
//! let simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! let observables = measure(&simulation, None)?;
//! let named: Vec<_> = observables.iter().map(|one| (one.name.as_str(), one.value)).collect();
//! assert_eq!(named, [("temperature_min", 0.0), ("temperature_mean", 1.0), ("temperature_max", 2.0)]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod measure;
mod measured_field;
mod observable;

pub use measure::measure;
pub use observable::Observable;
