//! An engine that does everything several times on the serial one, and fails where that does not give the
//! same bits.

use std::ops::Range;
use xca::engine::{
    EngineFailure, Execution, Fault, Interruption, Population, StartError, StepContext, SubstateId,
};
use xca::prelude::*;
use xca::record::Failure;
use xca::reduction::{ReducedRows, Reduction};
use xca::run::{EngineKind, EngineOption, EngineOptions};
use xca::{Engine, Precision};

/// The kind, by which the command line knows it.
#[derive(Debug)]
pub(crate) struct Twins;

const COPIES: EngineOption = EngineOption {
    name: "copies",
    value_name: "N",
    about: "Number of times that the twins engine does everything [default: 2]",
    check: |text| copies(text).map(drop),
};

fn copies(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|copies| (1..=9).contains(copies));
    number.ok_or_else(|| "it must be a whole number from 1 to 9".to_owned())
}

impl EngineKind for Twins {
    fn name(&self) -> &'static str {
        "twins"
    }

    fn about(&self) -> &'static str {
        "Serial, and everything several times"
    }

    fn options(&self) -> &'static [EngineOption] {
        &[COPIES]
    }

    fn make(&self, options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        let copies = options.get(COPIES.name).map_or(Ok(2), copies)?;
        Ok(Box::new(TwinsEngine { copies }))
    }
}

#[derive(Debug)]
struct TwinsEngine {
    copies: usize,
}

impl Engine for TwinsEngine {
    fn name(&self) -> &str {
        "twins"
    }

    fn threads(&self) -> usize {
        1
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        vec![("copies", self.copies.to_string())]
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let copies = (0..self.copies).map(|_| Reference.start(model, precision));
        Ok(Box::new(State { copies: copies.collect::<Result<_, _>>()? }))
    }
}

struct State {
    copies: Vec<Box<dyn Execution>>,
}

impl State {
    /// Asks all, and tells what they agree on.
    fn agreed<T: PartialEq>(
        &self,
        ask: impl Fn(&dyn Execution) -> Result<T, EngineFailure>,
    ) -> Result<T, EngineFailure> {
        let mut answers = self.copies.iter().map(|copy| ask(&**copy));
        let first = answers.next().unwrap_or_else(|| Err(different()))?;
        for other in answers {
            if other? != first {
                return Err(different());
            }
        }
        Ok(first)
    }

    fn first(&self) -> &dyn Execution {
        &*self.copies[0]
    }
}

fn different() -> EngineFailure {
    EngineFailure::Broken { engine: "twins".to_owned(), reason: "the copies differ".to_owned() }
}

impl Execution for State {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        self.copies.iter_mut().try_for_each(|copy| copy.run(processes.clone(), context))
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        self.copies.iter_mut().try_for_each(|copy| copy.run_steps(steps, context))
    }

    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        self.agreed(|copy| copy.read(substate))
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        self.copies.iter_mut().try_for_each(|copy| copy.write(substate, values))
    }

    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure> {
        self.agreed(|copy| copy.read_cells(substate, cells))
    }

    fn write_cells(
        &mut self,
        substate: SubstateId,
        cells: &[usize],
        values: &[u8],
    ) -> Result<(), EngineFailure> {
        self.copies.iter_mut().try_for_each(|copy| copy.write_cells(substate, cells, values))
    }

    fn population(&self, group: usize) -> Result<Population, EngineFailure> {
        self.agreed(|copy| copy.population(group))
    }

    fn set_population(&mut self, group: usize, population: &Population) -> Result<(), Fault> {
        self.copies.iter_mut().try_for_each(|copy| copy.set_population(group, population))
    }

    fn items(&self, group: usize) -> usize {
        self.first().items(group)
    }

    fn left(&self, group: usize) -> u64 {
        self.first().left(group)
    }

    fn largest_occupancy(&self, group: usize) -> Result<u32, EngineFailure> {
        self.agreed(|copy| copy.largest_occupancy(group))
    }

    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure> {
        self.agreed(|copy| copy.reduce_rows(substate, reduction))
    }

    fn memory(&self) -> usize {
        self.copies.iter().map(|copy| copy.memory()).sum()
    }
}
