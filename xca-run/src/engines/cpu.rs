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
        Ok(Box::new(engine(options.get(THREADS.name))?))
    }
}

/// The engine with the threads that are chosen.
pub(super) fn engine(chosen: Option<&str>) -> Result<Cpu, Failure> {
    Ok(match chosen {
        None => Cpu::new()?,
        Some(number) => Cpu::with_threads(threads(number)?)?,
    })
}

/// The threads of a part that runs on this engine, `cpu` or `cpu:2`, if they are chosen.
pub(super) fn threads_of_part(text: &str) -> Result<Option<String>, String> {
    let (engine, threads) = text.split_once(':').map_or((text, None), |(word, rest)| (word, Some(rest)));
    if engine != "cpu" {
        return Err(format!("a part runs on the cpu engine, not on `{engine}`"));
    }
    threads.map(|threads| (THREADS.check)(threads).map(|()| threads.to_owned())).transpose()
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
