//! The CPU engine behind borders that are late, fail or panic.

use std::time::Duration;
use xca_core::engine::{Border, EngineFailure, Execution, Part, StartError};
use xca_core::{Engine, Face, Model, Precision};
use xca_cpu::Cpu;

/// What a border does to what passes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Manner {
    /// It waits a little while, each time another one.
    Late,
    /// That of the part that begins with this row fails when it is used so many times.
    Fails { y: usize, uses: u32 },
    /// It panics.
    Panics { y: usize, uses: u32 },
}

/// The CPU engine with such a border around each part.
#[derive(Debug, Clone)]
pub(crate) struct Behind {
    pub(crate) engine: Cpu,
    pub(crate) manner: Manner,
}

impl Engine for Behind {
    fn name(&self) -> &str {
        "behind"
    }

    fn threads(&self) -> usize {
        self.engine.threads()
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        self.engine.start(model, precision)
    }

    fn start_part(
        &self,
        model: &Model,
        precision: Precision,
        part: &Part,
        border: Box<dyn Border>,
    ) -> Result<Box<dyn Execution>, StartError> {
        let border = Unreliable { border, manner: self.manner, y: part.y.start, uses: 0 };
        self.engine.start_part(model, precision, part, Box::new(border))
    }
}

struct Unreliable {
    border: Box<dyn Border>,
    manner: Manner,
    /// The first row of the part.
    y: usize,
    uses: u32,
}

impl Unreliable {
    fn pass(&mut self) -> Result<(), EngineFailure> {
        self.uses += 1;
        match self.manner {
            Manner::Late => {
                let mixed = (self.uses + 31 * self.y as u32).wrapping_mul(0x9e37_79b1) >> 8;
                std::thread::sleep(Duration::from_micros(u64::from(mixed % 400)));
                Ok(())
            }
            Manner::Fails { y, uses } if (y, uses) == (self.y, self.uses) => {
                Err(EngineFailure::Broken { engine: "behind".to_owned(), reason: "as planned".to_owned() })
            }
            Manner::Panics { y, uses } if (y, uses) == (self.y, self.uses) => panic!("as it was planned"),
            Manner::Fails { .. } | Manner::Panics { .. } => Ok(()),
        }
    }
}

impl Border for Unreliable {
    fn send(&mut self, face: Face, bytes: Vec<u8>) -> Result<(), EngineFailure> {
        self.pass()?;
        self.border.send(face, bytes)
    }

    fn receive(&mut self, face: Face) -> Result<Vec<u8>, EngineFailure> {
        self.pass()?;
        self.border.receive(face)
    }

    fn give_up(&mut self) -> Result<(), EngineFailure> {
        self.border.give_up()
    }

    fn least(&mut self, number: u64) -> Result<u64, EngineFailure> {
        self.pass()?;
        self.border.least(number)
    }
}
