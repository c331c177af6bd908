//! Faults in messages to the host.

use serde::{Deserialize, Serialize};
use xca_core::{EngineFailure, Fault, Model};

/// A fault of a process. The message holds the number of the process, not its name.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct FaultMessage {
    process: Option<usize>,
    #[serde(with = "NamelessFault")]
    fault: Fault,
}

/// A [`Fault`] without the name of its process.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Fault")]
enum NamelessFault {
    Reported {
        #[serde(skip)]
        process: &'static str,
        cell: [usize; 3],
        label: Option<u32>,
        code: u32,
        value: f64,
    },
    BeyondNeighbourhood {
        #[serde(skip)]
        process: &'static str,
        cell: [usize; 3],
        index: u32,
        size: usize,
    },
    SearchTooFar {
        #[serde(skip)]
        process: &'static str,
        cell: [usize; 3],
        label: Option<u32>,
        radius: f64,
        covered: f64,
    },
    InvalidRadius {
        #[serde(skip)]
        process: &'static str,
        cell: [usize; 3],
        label: Option<u32>,
        radius: f64,
    },
    CellFull {
        #[serde(skip)]
        process: Option<&'static str>,
        cell: [usize; 3],
        items: usize,
        slots: usize,
    },
    TooFar {
        #[serde(skip)]
        process: &'static str,
        label: u32,
        from: [usize; 3],
        to: [usize; 3],
    },
    Nowhere {
        #[serde(skip)]
        process: &'static str,
        label: u32,
        cell: [usize; 3],
    },
    Left {
        #[serde(skip)]
        process: &'static str,
        label: u32,
        cell: [usize; 3],
    },
    NotFinite {
        substate: String,
        cell: [usize; 3],
        label: Option<u32>,
        value: f64,
    },
    Panicked {
        #[serde(skip)]
        process: &'static str,
        cell: [usize; 3],
        label: Option<u32>,
        message: String,
    },
    /// The last variant, because readers do not count skipped variants. Failures of an engine use another
    /// message.
    #[serde(skip)]
    Engine(EngineFailure),
}

impl FaultMessage {
    pub(crate) fn new(model: &Model, mut fault: Fault) -> Self {
        let name = process(&mut fault).copied();
        let number = |name: &str| model.processes().iter().position(|process| process.name == name);
        Self { process: name.and_then(number), fault }
    }

    /// Adds the name of the process to the fault.
    pub(crate) fn fault(self, model: &Model) -> Fault {
        let mut fault = self.fault;
        if let Some(definition) = self.process.and_then(|number| model.processes().get(number)) {
            if let Fault::CellFull { process, .. } = &mut fault {
                *process = Some(definition.name);
            } else if let Some(name) = process(&mut fault) {
                *name = definition.name;
            }
        }
        fault
    }
}

/// The field with the name of the process.
fn process(fault: &mut Fault) -> Option<&mut &'static str> {
    match fault {
        Fault::Engine(_) | Fault::NotFinite { .. } => None,
        Fault::CellFull { process, .. } => process.as_mut(),
        Fault::Reported { process, .. }
        | Fault::BeyondNeighbourhood { process, .. }
        | Fault::SearchTooFar { process, .. }
        | Fault::InvalidRadius { process, .. }
        | Fault::TooFar { process, .. }
        | Fault::Nowhere { process, .. }
        | Fault::Left { process, .. }
        | Fault::Panicked { process, .. } => Some(process),
    }
}
