//! How parts of a space find their first fault.
//!
//! A part that has stopped gives up: it tells its neighbours, which then give up too, and so on. All parts
//! meet at the next agreement and compare their faults. A part stops only because of its own fault, or of
//! faults of earlier phases. The first fault is therefore among those compared.

use super::{Border, EngineFailure, Fault, Interruption};

/// No fault. The value is larger than that of any fault.
const NO_FAULT: u64 = u64::MAX;

/// The number of steps after which the parts of a space compare their faults.
pub const STEPS_TO_AGREE: u64 = 16;

/// The reason why a part of a space has stopped before the next agreement.
#[derive(Debug)]
pub struct Stopped {
    process: usize,
    phase: Phase,
    /// The linear index of the cell.
    cell: u32,
    fault: Fault,
}

/// The phases of a process or stage, in the order of their faults.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Phase {
    /// The processes, row by row.
    Rows,
    /// The destinations of items.
    Destinations,
    /// The room for items in their new cells.
    Slots,
}

/// The place of the step in the key of a fault, then those of the process and of the phase. The cell comes
/// last.
const STEP: u32 = 56;
const PROCESS: u32 = 34;
const PHASE: u32 = 32;

impl Stopped {
    /// A fault of a process in the cell with this linear index.
    pub fn new(process: usize, phase: Phase, cell: u32, fault: Fault) -> Self {
        Self { process, phase, cell, fault }
    }

    /// Orders faults as they come first. `done` is the number of steps since the last agreement.
    fn key(&self, done: u64) -> u64 {
        if matches!(self.fault, Fault::Engine(_)) {
            return NO_FAULT;
        }
        done << STEP | (self.process as u64) << PROCESS | (self.phase as u64) << PHASE | u64::from(self.cell)
    }
}

/// A part without a fault of its own cannot go on.
impl From<EngineFailure> for Stopped {
    fn from(failure: EngineFailure) -> Self {
        Self { process: 0, phase: Phase::Rows, cell: 0, fault: failure.into() }
    }
}

/// Compares the faults of all parts since the last agreement. `stopped` is the reason why this part has
/// stopped before, and the number of steps since then. There are at most [`STEPS_TO_AGREE`] steps.
///
/// # Errors
/// Returns the first fault of all parts in the part that has it, and [`EngineFailure::Elsewhere`] in the
/// others. Returns the failure of the own engine at once.
pub fn agree(border: &mut dyn Border, stopped: Option<(u64, Stopped)>) -> Result<(), Interruption> {
    let lost = |failure: EngineFailure| Interruption { done: 0, fault: failure.into() };
    let own = match &stopped {
        None => NO_FAULT,
        Some((done, stopped)) => match &stopped.fault {
            Fault::Engine(failure) if *failure != EngineFailure::Elsewhere => {
                return Err(lost(failure.clone()));
            }
            _ => {
                border.give_up().map_err(lost)?;
                stopped.key(*done)
            }
        },
    };
    let least = border.least(own).map_err(lost)?;
    match stopped {
        None if least == NO_FAULT => Ok(()),
        Some((done, stopped)) if own == least => Err(Interruption { done, fault: stopped.fault }),
        _ => Err(Interruption { done: least >> STEP, ..lost(EngineFailure::Elsewhere) }),
    }
}

#[cfg(test)]
mod tests {
    use super::{NO_FAULT, Phase, Stopped, agree};
    use crate::engine::{Border, EngineFailure, Fault, Interruption};
    use xca_process::Face;

    /// The other parts, of whose faults the first has this key.
    struct Others {
        least: u64,
        gave_up: bool,
    }

    impl Border for Others {
        fn send(&mut self, _face: Face, _bytes: Vec<u8>) -> Result<(), EngineFailure> {
            Ok(())
        }

        fn receive(&mut self, _face: Face) -> Result<Vec<u8>, EngineFailure> {
            Ok(Vec::new())
        }

        fn give_up(&mut self) -> Result<(), EngineFailure> {
            self.gave_up = true;
            Ok(())
        }

        fn least(&mut self, number: u64) -> Result<u64, EngineFailure> {
            Ok(self.least.min(number))
        }
    }

    fn fault(cell: usize) -> Fault {
        Fault::Left { process: "roll", label: 7, cell: [cell, 0, 0] }
    }

    fn stopped(process: usize, phase: Phase, cell: u32) -> Stopped {
        Stopped::new(process, phase, cell, fault(cell as usize))
    }

    #[test]
    fn faults_are_ordered_by_step_process_phase_and_cell() {
        let keys = [
            stopped(0, Phase::Rows, u32::MAX - 1).key(0),
            stopped(1, Phase::Rows, 5).key(0),
            stopped(1, Phase::Rows, 6).key(0),
            stopped(1, Phase::Destinations, 0).key(0),
            stopped(1, Phase::Slots, 0).key(0),
            stopped(2, Phase::Rows, 0).key(0),
            stopped(0, Phase::Rows, 0).key(1),
            stopped(9, Phase::Slots, 9).key(15),
            NO_FAULT,
        ];
        assert!(keys.is_sorted_by(|one, next| one < next), "{keys:?}");
    }

    #[test]
    fn the_first_fault_is_that_of_the_part_that_has_it() {
        let mut none = Others { least: NO_FAULT, gave_up: false };
        assert_eq!(agree(&mut none, None), Ok(()));
        assert!(!none.gave_up);
        let own = Interruption { done: 3, fault: fault(4) };
        assert_eq!(agree(&mut none, Some((3, stopped(1, Phase::Rows, 4)))), Err(own));
        assert!(none.gave_up);
        let elsewhere = |done| Err(Interruption { done, fault: EngineFailure::Elsewhere.into() });
        let mut earlier = Others { least: stopped(1, Phase::Rows, 3).key(3), gave_up: false };
        assert_eq!(agree(&mut earlier, Some((3, stopped(1, Phase::Rows, 4)))), elsewhere(3));
        assert_eq!(agree(&mut earlier, None), elsewhere(3));
        assert_eq!(agree(&mut earlier, Some((2, EngineFailure::Elsewhere.into()))), elsewhere(3));
    }

    /// The other parts learn of it by the end of this one.
    #[test]
    fn a_failure_of_the_own_engine_is_told_at_once() {
        let broken = EngineFailure::Broken { engine: "cpu".to_owned(), reason: "no power".to_owned() };
        let mut others = Others { least: 0, gave_up: false };
        let result = agree(&mut others, Some((3, broken.clone().into())));
        assert_eq!(result, Err(Interruption { done: 0, fault: broken.into() }));
        assert!(!others.gave_up);
    }
}
