//! Quantities that a run reports.

/// Any error. Its causes are shown below it, each on a line of its own.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

/// A quantity that a run reports: a number that the whole state has.
#[derive(Debug, Clone, PartialEq)]
pub struct Observable {
    /// Its name, such as `kinetic energy`.
    pub name: String,
    /// Its unit, such as `J`; empty for a number.
    pub unit: String,
    /// Its value.
    pub value: f64,
    /// Whether the model keeps it: then how far it drifts is told.
    pub is_conserved: bool,
}

impl Observable {
    /// A quantity with its unit.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), unit: unit.into(), value, is_conserved: false }
    }

    /// A number without a unit.
    pub fn number(name: impl Into<String>, value: f64) -> Self {
        Self::new(name, "", value)
    }

    /// The same quantity, which the model keeps: at the end of a run, and where engines are compared, its
    /// drift is told.
    #[must_use]
    pub fn conserved(self) -> Self {
        Self { is_conserved: true, ..self }
    }

    /// How far a conserved quantity has come from its first value, as a part of that; of one that was 0, as a
    /// number.
    pub fn drift(&self, last: f64) -> Option<f64> {
        let scale = if self.value == 0.0 { 1.0 } else { self.value.abs() };
        self.is_conserved.then(|| (last - self.value) / scale)
    }
}
