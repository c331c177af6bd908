//! The engine whose parts are the processes of an MPI job. All that the command line knows of MPI is here,
//! also of a program that was built without it.

use super::kind::{EngineDetail, EngineKind, Helper};
use super::options::{EngineOption, EngineOptions};
use super::part;
use xca_core::Engine;
use xca_parts::Grid;
use xca_record::Failure;

/// Has what runs each part.
#[derive(Debug, Default)]
pub(super) struct MpiKind {
    job: built::OneJob,
}

const PART: EngineOption = EngineOption {
    name: "mpi",
    value_name: "cpu[:THREADS]|gpu[:NAME]",
    about: "Engine of each process, with its threads or its adapter",
    check: |text| Share::new(text).map(drop),
};

/// What runs each part, and the parts along the axes, if they are chosen.
struct Share {
    grid: Option<Grid>,
    part: String,
}

impl Share {
    fn new(text: &str) -> Result<Self, String> {
        // The name of an engine does not begin with a digit.
        let has_grid = text.starts_with(|first: char| first.is_ascii_digit());
        let (grid, part) = text.split_once(':').filter(|_| has_grid).unzip();
        let grid = grid.map(str::parse::<Grid>).transpose().map_err(|error| error.to_string())?;
        let part = part.unwrap_or(text);
        part::parse(part).map(|_| Self { grid, part: part.to_owned() })
    }
}

impl EngineKind for MpiKind {
    fn name(&self) -> &'static str {
        "mpi"
    }

    fn about(&self) -> &'static str {
        "One part of the space per process of `mpirun`; 2x3: along y and z"
    }

    fn detail(&self) -> Option<EngineDetail> {
        Some(EngineDetail { option: PART, is_required: true })
    }

    fn refuses(&self, subcommand: &str) -> Option<&'static str> {
        let is_for = ["run", "resume", "compare"].contains(&subcommand);
        (!is_for).then_some("only `run`, `resume` and `compare` share their work among processes")
    }

    fn spans_processes(&self) -> bool {
        true
    }

    fn helper(&self) -> Result<Option<Box<dyn Helper>>, Failure> {
        self.job.helper()
    }

    fn make(&self, options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        self.job.engine(&Share::new(options.get(PART.name).unwrap_or("cpu"))?)
    }
}

/// With MPI.
#[cfg(feature = "mpi")]
mod built {
    use super::{Share, part};
    use crate::engines::kind::Helper;
    use crate::interrupt::Interrupt;
    use crate::launcher;
    use std::sync::OnceLock;
    use xca_core::{Engine, Model, Precision};
    use xca_mpi::{Job, Library, Mpi, Place, Wire as _};
    use xca_record::Failure;

    /// The job of this process, from when it is first needed.
    #[derive(Debug, Default)]
    pub(super) struct OneJob(OnceLock<Result<Job, String>>);

    impl OneJob {
        fn job(&self) -> Result<Job, Failure> {
            Ok(self.0.get_or_init(begin).clone()?)
        }

        pub(super) fn helper(&self) -> Result<Option<Box<dyn Helper>>, Failure> {
            let job = self.job()?;
            Ok((job.rank() > 0).then(|| Box::new(Rank(job)) as Box<dyn Helper>))
        }

        pub(super) fn engine(&self, share: &Share) -> Result<Box<dyn Engine>, Failure> {
            Ok(Box::new(Mpi::new(self.job()?, &part, &share.part)?.in_grid(share.grid)))
        }
    }

    fn begin() -> Result<Job, String> {
        let library = Library::begin().map_err(|error| error.to_string())?;
        let (seen, started) = (library.size(), launcher::processes());
        if seen == 1 && started > 1 {
            return Err(format!(
                "the launcher has started {started} processes, but each is alone: launcher and program are of \
                 different MPI libraries; use the `mpirun` of the library that the program was built with"
            ));
        }
        Ok(Job::new(Box::new(library)))
    }

    fn part(word: &str, place: &Place) -> Result<Box<dyn Engine>, String> {
        part::engine(word, place.number, place.threads).map_err(|error| error.to_string())
    }

    /// A process that does what the host says.
    struct Rank(Job);

    impl Helper for Rank {
        fn help(&self, model: &mut dyn FnMut(Precision) -> Result<Model, Failure>) -> Result<(), Failure> {
            // The host ends the job; signals to this process do not.
            Interrupt::install()?;
            Ok(self.0.serve(&part, &mut |precision| model(precision).map_err(|error| error.to_string()))?)
        }
    }
}

/// Without MPI: what to do to have it.
#[cfg(not(feature = "mpi"))]
mod built {
    use super::Share;
    use crate::engines::kind::{Helper, MissingFeature};
    use xca_core::Engine;
    use xca_record::Failure;

    const MISSING: MissingFeature = MissingFeature { feature: "mpi" };

    #[derive(Debug, Default)]
    pub(super) struct OneJob;

    impl OneJob {
        pub(super) fn helper(&self) -> Result<Option<Box<dyn Helper>>, Failure> {
            Err(MISSING.into())
        }

        pub(super) fn engine(&self, share: &Share) -> Result<Box<dyn Engine>, Failure> {
            let Share { grid: _grid, part: _part } = share;
            Err(MISSING.into())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Grid, Share};

    #[test]
    fn parts_along_the_axes_stand_before_what_runs_them() {
        let share = |text: &str| Share::new(text).map(|Share { grid, part }| (grid, part));
        let of = |grid, part: &str| Ok((grid, part.to_owned()));
        assert_eq!(share("cpu"), of(None, "cpu"));
        assert_eq!(share("cpu:2"), of(None, "cpu:2"));
        assert_eq!(share("gpu:NVIDIA"), of(None, "gpu:NVIDIA"));
        let grid = Some(Grid { y: 2, z: 3 });
        assert_eq!(share("2x3:gpu"), of(grid, "gpu"));
        assert_eq!(share("2x3:cpu:4"), of(grid, "cpu:4"));
        for (text, words) in [
            ("2:cpu", "`2` is not a grid of parts; write two whole numbers from 1, such as 2x3"),
            ("0x3:cpu", "`0x3` is not a grid"),
            ("2x3:mpi", "a part runs on the cpu or the gpu engine, not on `mpi`"),
            ("2x3", "a part runs on the cpu or the gpu engine, not on `2x3`"),
        ] {
            assert!(share(text).is_err_and(|error| error.contains(words)), "{text}");
        }
    }
}
