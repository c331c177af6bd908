//! The engine that shares a space among several.

use super::kind::{EngineDetail, EngineKind};
use super::options::{EngineOption, EngineOptions};
use super::part;
use std::num::NonZeroUsize;
use std::sync::Arc;
use xca_core::Engine;
use xca_parts::{Grid, Parts};
use xca_record::Failure;

/// Has a number of parts, and what runs each.
#[derive(Debug)]
pub(super) struct PartsKind;

const PARTS: EngineOption = EngineOption {
    name: "parts",
    value_name: "N:cpu[:THREADS]|gpu[:NAME]",
    about: "Number of parts, and the engine of each, with its threads or its adapter",
    check: |text| Share::new(text).map(drop),
};

impl EngineKind for PartsKind {
    fn name(&self) -> &'static str {
        "parts"
    }

    fn about(&self) -> &'static str {
        "N parts of the space, each on an engine; 2x3: along y and z"
    }

    fn detail(&self) -> Option<EngineDetail> {
        Some(EngineDetail { option: PARTS, is_required: true })
    }

    fn refuses(&self, subcommand: &str) -> Option<&'static str> {
        (subcommand == "watch").then_some("each picture would gather the whole state from its parts")
    }

    fn make(&self, options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        let share = options.get(PARTS.name).ok_or("the number of parts is not given")?;
        let Share { count, grid, part } = Share::new(share)?;
        let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let engine = |number| Ok(Arc::from(part::engine(&part, number, (cores / count).max(1))?));
        let parts = Parts::with_engines((0..count).map(engine).collect::<Result<_, Failure>>()?);
        Ok(Box::new(parts.in_grid(grid)))
    }
}

/// How a space is shared.
#[derive(Debug, PartialEq, Eq)]
struct Share {
    /// The number of parts.
    count: usize,
    /// The parts along the axes, if they are chosen.
    grid: Option<Grid>,
    /// What runs each part.
    part: String,
}

impl Share {
    fn new(text: &str) -> Result<Self, String> {
        const MOST: usize = xca_cpu::Cpu::MOST_THREADS; // Each part is a thread.
        let (parts, rest) = text.split_once(':').map_or((text, None), |(parts, rest)| (parts, Some(rest)));
        let grid = Some(parts).filter(|parts| parts.contains('x')).map(str::parse::<Grid>).transpose();
        let grid = grid.map_err(|error| error.to_string())?;
        let count = grid.map_or_else(|| parts.parse().unwrap_or(0), Grid::count);
        if !(1..=MOST).contains(&count) {
            return Err(format!("the number of parts must be a whole number from 1 to {MOST}"));
        }
        let part = rest.ok_or_else(|| format!("say what runs each part: parts:{parts}:cpu"))?;
        part::parse(part).map(|_| Self { count, grid, part: part.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::{PartsKind, Share};
    use crate::engines::{EngineKind, EngineOptions};
    use xca_parts::Grid;

    #[test]
    fn parts_are_named_with_what_runs_them() {
        let share = Share::new;
        let of = |count, grid, part: &str| Ok(Share { count, grid, part: part.to_owned() });
        assert_eq!(share("7:cpu"), of(7, None, "cpu"));
        assert_eq!(share("2:cpu:5"), of(2, None, "cpu:5"));
        assert_eq!(share("2:gpu:llvm pipe"), of(2, None, "gpu:llvm pipe"));
        assert_eq!(share("2x3:gpu"), of(6, Some(Grid { y: 2, z: 3 }), "gpu"));
        for (text, words) in [
            ("", "whole number from 1 to 1024"),
            ("0:cpu", "whole number from 1 to 1024"),
            ("1025:cpu", "whole number from 1 to 1024"),
            ("64x17:cpu", "whole number from 1 to 1024"),
            ("99999999999x99999999999:cpu", "whole number from 1 to 1024"),
            ("2x:cpu", "`2x` is not a grid of parts"),
            ("2", "say what runs each part: parts:2:cpu"),
            ("2x3", "say what runs each part: parts:2x3:cpu"),
            ("2:mpi", "a part runs on the cpu or the gpu engine, not on `mpi`"),
            ("2:cpu:0", "must be at least 1"),
        ] {
            assert!(share(text).is_err_and(|error| error.contains(words)), "{text}");
        }
        let options = EngineOptions::default().with("parts", "4:cpu:2");
        assert_eq!(PartsKind.make(&options).unwrap().threads(), 4 * 2);
        let engine = PartsKind.make(&EngineOptions::default().with("parts", "3x2:cpu:1")).unwrap();
        assert!(engine.facts().contains(&("parts", "3x2".to_owned())));
    }
}
