//! The engine that shares a space among several.

use super::cpu;
use super::kind::EngineKind;
use super::options::{EngineOption, EngineOptions};
use std::num::NonZeroUsize;
use std::sync::Arc;
use xca_core::Engine;
use xca_parts::Parts;
use xca_record::Failure;

/// Has a number of parts, and what runs each.
#[derive(Debug)]
pub(super) struct PartsKind;

const PARTS: EngineOption = EngineOption {
    name: "parts",
    value_name: "N[:cpu[:THREADS]]",
    about: "How many parts of the space the parts engine has, and the engine and threads of each; 2 unless it is given",
    check: |text| Share::new(text).map(drop),
};

impl EngineKind for PartsKind {
    fn name(&self) -> &'static str {
        "parts"
    }

    fn about(&self) -> &'static str {
        "Parts of the space, each on a cpu engine of its own"
    }

    fn options(&self) -> &'static [EngineOption] {
        &[PARTS, cpu::THREADS]
    }

    fn beside_others(&self) -> EngineOptions {
        EngineOptions::default().with(cpu::THREADS.name, "1")
    }

    fn make(&self, options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        let Share { parts, threads } = Share::new(options.get(PARTS.name).unwrap_or("2"))?;
        let threads = threads.or_else(|| options.get(cpu::THREADS.name).map(str::to_owned));
        let threads = threads.unwrap_or_else(|| {
            let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
            (cores / parts).max(1).to_string()
        });
        let engine = || Ok(Arc::new(cpu::engine(Some(&threads))?) as Arc<dyn Engine>);
        let engines = (0..parts.get()).map(|_| engine()).collect::<Result<_, Failure>>()?;
        Ok(Box::new(Parts::with_engines(engines)))
    }
}

/// How a space is shared.
#[derive(Debug, PartialEq, Eq)]
struct Share {
    parts: NonZeroUsize,
    /// The threads of each part, if they are chosen here.
    threads: Option<String>,
}

impl Share {
    fn new(text: &str) -> Result<Self, String> {
        // Each part is a thread.
        const MOST: usize = xca_cpu::Cpu::MOST_THREADS;
        let mut words = text.splitn(3, ':');
        let parts = words.next().and_then(|number| number.parse().ok());
        let parts = parts.filter(|parts: &NonZeroUsize| parts.get() <= MOST);
        let parts =
            parts.ok_or_else(|| format!("the number of parts must be a whole number from 1 to {MOST}"))?;
        match words.next() {
            None | Some("cpu") => {}
            Some(other) => return Err(format!("a part runs on the cpu engine, not on `{other}`")),
        }
        let threads = words.next().map(str::to_owned);
        if let Some(threads) = &threads {
            (cpu::THREADS.check)(threads)?;
        }
        Ok(Self { parts, threads })
    }
}

#[cfg(test)]
mod tests {
    use super::{PartsKind, Share};
    use crate::engines::{EngineKind, EngineOptions};

    #[test]
    fn parts_are_named_with_what_runs_them() {
        let share = |text: &str| Share::new(text).map(|Share { parts, threads }| (parts.get(), threads));
        assert_eq!(share("3"), Ok((3, None)));
        assert_eq!(share("7:cpu"), Ok((7, None)));
        assert_eq!(share("2:cpu:5"), Ok((2, Some("5".to_owned()))));
        for (text, words) in [
            ("", "whole number from 1 to 1024"),
            ("0", "whole number from 1 to 1024"),
            ("1025", "whole number from 1 to 1024"),
            ("2:gpu", "not on `gpu`"),
            ("2:cpu:0", "give at least 1"),
        ] {
            assert!(share(text).is_err_and(|error| error.contains(words)), "{text}");
        }
        let threads = |options: EngineOptions| PartsKind.make(&options).unwrap().threads();
        let options = EngineOptions::default().with("threads", "3");
        assert_eq!(threads(options.clone()), 2 * 3);
        assert_eq!(threads(options.with("parts", "4:cpu:2")), 4 * 2);
    }
}
