//! The engine for all cores.

use super::kind::EngineKind;
use super::options::{EngineOption, EngineOptions};
use xca_core::Engine;
use xca_cpu::Cpu;
use xca_record::Failure;

/// Has a number of threads.
#[derive(Debug)]
pub(super) struct CpuKind;

pub(super) const THREADS: EngineOption = EngineOption {
    name: "threads",
    value_name: "N",
    about: "Threads of the cpu engine [default: one per core]",
    check: |text| threads(text).map(drop),
};

impl EngineKind for CpuKind {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn about(&self) -> &'static str {
        "All cores, or N threads"
    }

    fn options(&self) -> &'static [EngineOption] {
        &[THREADS]
    }

    fn beside_others(&self) -> EngineOptions {
        EngineOptions::default().with(THREADS.name, "1")
    }

    fn make(&self, options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        let threads = options.get(THREADS.name).map(threads).transpose()?;
        Ok(Box::new(threads.map_or_else(Cpu::new, Cpu::with_threads)?))
    }
}

fn threads(text: &str) -> Result<usize, String> {
    // Many more than cores only cost memory.
    const MOST: usize = Cpu::MOST_THREADS;
    match text.parse() {
        Ok(0) => Err("the number of threads must be at least 1".to_owned()),
        Ok(number) if number <= MOST => Ok(number),
        Ok(number) => Err(format!("{number} threads are too many; the maximum is {MOST}")),
        Err(_) => Err(format!("it must be a whole number from 1 to {MOST}")),
    }
}
