//! The names of the states of an enum.

/// The name of an enum, and those of its states.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct StateNames {
    /// The name of the enum.
    pub name: &'static str,
    /// The names of the states. The number of a state is its index.
    pub states: &'static [&'static str],
}

impl StateNames {
    /// The largest number of a state.
    pub fn largest(&self) -> u8 {
        u8::try_from(self.states.len().saturating_sub(1)).unwrap_or(u8::MAX)
    }

    /// The number of the state with this name.
    pub fn number(&self, name: &str) -> Option<u8> {
        let place = self.states.iter().position(|state| *state == name)?;
        u8::try_from(place).ok()
    }
}
