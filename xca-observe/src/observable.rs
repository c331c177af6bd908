//! Quantities that a run reports.

/// A quantity of the whole state, as `observables.csv` and the report show it.
///
/// ```
/// use xca_observe::Observable;
///
/// let energy = Observable::new("kinetic energy", "J", 2.0).conserved();
/// assert_eq!(energy.drift(2.5), Some(0.25));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Observable {
    /// Its name, such as `kinetic energy`.
    pub name: String,
    /// Its unit, such as `J`; empty for a pure number.
    pub unit: String,
    /// Its value.
    pub value: f64,
    /// Whether the model conserves it. The report then shows its drift.
    pub is_conserved: bool,
}

impl Observable {
    /// A quantity with a unit.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), unit: unit.into(), value, is_conserved: false }
    }

    /// A pure number.
    pub fn number(name: impl Into<String>, value: f64) -> Self {
        Self::new(name, "", value)
    }

    /// Marks the quantity as conserved. The end of a run and comparisons of engines then show its drift.
    #[must_use]
    pub fn conserved(self) -> Self {
        Self { is_conserved: true, ..self }
    }

    /// The relative change of a conserved quantity from this value to `last`; the absolute change if this
    /// value is 0.
    pub fn drift(&self, last: f64) -> Option<f64> {
        let scale = if self.value == 0.0 { 1.0 } else { self.value.abs() };
        self.is_conserved.then(|| (last - self.value) / scale)
    }
}
