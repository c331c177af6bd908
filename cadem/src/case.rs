//! Ready-made systems.

use crate::configuration::Configuration;
use crate::error::CademError;
use crate::time_step::{Integrator, TimeStep};
use crate::walls::Walls;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A system with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Case {
    /// The authors' small system, about that of the paper's Fig. 3: 2,602 particles in 20^3 cells, for 0.1 s.
    #[default]
    Illustration,
    /// The paper's benchmark (section IV, Table I): 315,979 particles in 100^3 cells, for 0.1 s.
    Table1,
    /// The run whose files the authors published: 2,602 particles in 20^3 cells, soft ones, with the wall law
    /// of their program. It ends with 0.011240501 J of kinetic and potential energy.
    Published,
}

impl Case {
    /// All cases.
    pub const ALL: [Self; 3] = [Self::Illustration, Self::Table1, Self::Published];

    /// The name, as on a command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Illustration => "illustration",
            Self::Table1 => "table1",
            Self::Published => "published",
        }
    }

    /// The system.
    ///
    /// The mass and the radius are the paper's. They make a density of 190,986 kg/m^3, where 2,000 kg/m^3
    /// would be a mass of 1.047e-6 kg.
    pub fn configuration(self) -> Configuration {
        let illustration = Configuration {
            cells: [20; 3],
            cell_side: 0.002,
            stiffness: 8000.0,
            damping: 0.0015,
            mass: 1e-4,
            radius: 0.0005,
            gravity: 9.81,
            steps: 8945,
            walls: Walls::Single,
            integrator: Integrator::SemiImplicit,
            slots: None,
            seed: 1,
            allow_overlaps: false,
            time_step: TimeStep::Fraction(0.1),
            openings: Vec::new(),
        };
        match self {
            Self::Illustration => illustration,
            Self::Table1 => Configuration { cells: [100; 3], ..illustration },
            Self::Published => Configuration {
                stiffness: 100.0,
                time_step: TimeStep::Seconds(1e-4),
                walls: Walls::PerSlot,
                steps: 749,
                ..illustration
            },
        }
    }
}

impl Default for Configuration {
    /// [`Case::Illustration`].
    fn default() -> Self {
        Case::Illustration.configuration()
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Case {
    type Err = CademError;

    fn from_str(name: &str) -> Result<Self, CademError> {
        Self::ALL
            .into_iter()
            .find(|case| case.name() == name)
            .ok_or_else(|| CademError::UnknownCase { name: name.to_owned() })
    }
}

#[cfg(test)]
mod tests;
