//! The engines that a program can choose from: those of the framework, and those that the program adds.

mod cpu;
mod gpu;
mod kind;
mod mpi;
mod options;
mod part;
mod parts;
mod reference;
mod word;

pub use kind::{Devices, EngineDetail, EngineKind, Helper, MissingFeature};
pub use options::{EngineOption, EngineOptions};
pub(crate) use word::{EngineChoice, EngineWords};

use crate::launcher;
use cpu::CpuKind;
use gpu::GpuKind;
use mpi::MpiKind;
use parts::PartsKind;
use reference::ReferenceKind;
use xca_core::Engine;
use xca_record::Failure;

/// The kinds of engines that a program offers, by name. The first is the one that runs a model unless the
/// command line says otherwise.
#[derive(Debug)]
pub struct Engines {
    kinds: Vec<Box<dyn EngineKind>>,
}

impl Default for Engines {
    /// `cpu`, `gpu`, `mpi`, `parts` and `reference`. Without the features `gpu` and `mpi`, the second and the
    /// third can be named but not made.
    fn default() -> Self {
        Self {
            kinds: vec![
                Box::new(CpuKind),
                Box::new(GpuKind),
                Box::new(MpiKind::default()),
                Box::new(PartsKind),
                Box::new(ReferenceKind),
            ],
        }
    }
}

/// An engine that cannot be had.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// A name that no engine has.
    #[error("unknown engine `{name}`; there are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// Those that there are.
        known: String,
    },
    /// A choice that is none of the engine's.
    #[error("--{option} is {of}, not for the {engine} engine; remove it, or choose another engine")]
    NoOption {
        /// What was chosen.
        option: String,
        /// Whose choice it is.
        of: String,
        /// The engine.
        engine: &'static str,
    },
    /// A word that is none of those that name engines.
    #[error("engine `{word}`: {reason}")]
    Word {
        /// The word.
        word: String,
        /// Why.
        reason: String,
    },
    /// A choice that is made twice.
    #[error("--{option} is given twice, also after the colon of the {engine} engine; remove one")]
    Twice {
        /// The engine.
        engine: String,
        /// What was chosen.
        option: String,
    },
    /// A subcommand that the engine is not for.
    #[error("`{subcommand}` does not run on the {engine} engine: {reason}; choose another engine")]
    Subcommand {
        /// The engine.
        engine: &'static str,
        /// The subcommand.
        subcommand: String,
        /// Why.
        reason: &'static str,
    },
    /// Many processes that would all do the same.
    #[error(
        "a launcher started {processes} processes, and each would run the whole model; \
         share it with --engine mpi:cpu, or start one process"
    )]
    Launched {
        /// How many there are.
        processes: usize,
    },
    /// A value that makes no sense.
    #[error("--{option} {value}: {reason}")]
    Value {
        /// What was chosen.
        option: String,
        /// Its value.
        value: String,
        /// Why.
        reason: String,
    },
    /// The engine says why.
    #[error(transparent)]
    Made(Failure),
}

impl Engines {
    /// Adds a kind of engine. It takes the place of one with the same name.
    #[must_use]
    pub fn with(mut self, kind: impl EngineKind + 'static) -> Self {
        let same = self.kinds.iter_mut().find(|other| other.name() == kind.name());
        match same {
            Some(same) => *same = Box::new(kind),
            None => self.kinds.push(Box::new(kind)),
        }
        self
    }

    /// All kinds.
    pub fn kinds(&self) -> impl Iterator<Item = &dyn EngineKind> {
        self.kinds.iter().map(|kind| &**kind)
    }

    /// The kind with a name.
    ///
    /// # Errors
    /// Where there is none.
    pub fn kind(&self, name: &str) -> Result<&dyn EngineKind, EngineError> {
        let unknown = || {
            let known = self.kinds().map(EngineKind::name).collect::<Vec<_>>().join(", ");
            EngineError::Unknown { name: name.to_owned(), known }
        };
        self.kinds().find(|kind| kind.name() == name).ok_or_else(unknown)
    }

    /// Refuses engines that a subcommand cannot use, and such that would do the same in each process of a
    /// launcher.
    pub(crate) fn check<'a>(
        &self,
        names: impl IntoIterator<Item = &'a str>,
        subcommand: &str,
    ) -> Result<(), EngineError> {
        let mut spans = false;
        for name in names {
            let kind = self.kind(name)?;
            spans |= kind.spans_processes();
            if let Some(reason) = kind.refuses(subcommand) {
                let subcommand = subcommand.to_owned();
                return Err(EngineError::Subcommand { engine: kind.name(), subcommand, reason });
            }
        }
        let processes = launcher::processes();
        if processes > 1 && !spans { Err(EngineError::Launched { processes }) } else { Ok(()) }
    }

    /// An engine.
    ///
    /// # Errors
    /// Where there is no such engine, it has nothing of what is chosen, or the machine does not give it.
    pub fn engine(&self, name: &str, options: &EngineOptions) -> Result<Box<dyn Engine>, EngineError> {
        let kind = self.kind(name)?;
        for (option, value) in options.iter() {
            let detail = kind.detail().map(|detail| detail.option);
            let mut own = kind.options().iter().copied().chain(detail);
            let own = own.find(|own| own.name == option).ok_or_else(|| self.no_option(option, kind))?;
            (own.check)(value).map_err(|reason| {
                let [option, value] = [option, value].map(str::to_owned);
                EngineError::Value { option, value, reason }
            })?;
        }
        kind.make(options).map_err(EngineError::Made)
    }

    fn no_option(&self, option: &str, kind: &dyn EngineKind) -> EngineError {
        let owners = self.kinds().filter(|kind| kind.options().iter().any(|own| own.name == option));
        let owners: Vec<String> = owners.map(|kind| format!("--engine {}", kind.name())).collect();
        let of =
            if owners.is_empty() { "no option".to_owned() } else { format!("for {}", owners.join(" and ")) };
        EngineError::NoOption { option: option.to_owned(), of, engine: kind.name() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn engines_know_what_can_be_chosen_of_them() {
        let engines = Engines::default();
        let of = |name: &str, options: &EngineOptions| engines.engine(name, options);
        let threads = |number: &str| EngineOptions::default().with("threads", number);
        assert_eq!(of("cpu", &threads("3")).unwrap().threads(), 3);
        assert_eq!(of("reference", &EngineOptions::default()).unwrap().threads(), 1);
        let said = |name: &str, options: &EngineOptions| of(name, options).unwrap_err().to_string();
        let wanted = "--threads is for --engine cpu, not for the reference engine";
        assert!(said("reference", &threads("2")).starts_with(wanted));
        assert_eq!(said("cpu", &threads("0")), "--threads 0: the number of threads must be at least 1");
        assert_eq!(
            said("cup", &threads("1")),
            "unknown engine `cup`; there are cpu, gpu, mpi, parts, reference"
        );
        let hands = EngineOptions::default().with("hands", "2");
        assert!(said("cpu", &hands).starts_with("--hands is no option, not for the cpu engine"));
    }

    #[test]
    fn adapters_are_for_the_gpu_engine() {
        let engines = Engines::default();
        let options = EngineOptions::default().with("adapter", "no such adapter");
        let error = engines.engine("cpu", &options).unwrap_err().to_string();
        assert!(error.starts_with("--adapter is for --engine gpu, not for the cpu engine"), "{error}");
        let error = engines.engine("gpu", &options).unwrap_err().to_string();
        let wanted = if cfg!(feature = "gpu") {
            "no adapter is `no such adapter`; this machine has 0: "
        } else {
            "built without the feature `gpu`; build it with `cargo run --release --features xca/gpu`"
        };
        assert!(error.contains(wanted), "{error}");
        let options = EngineOptions::default().with("arithmetic", "exact");
        let error = engines.engine("gpu", &options).unwrap_err().to_string();
        assert!(error.contains("unknown arithmetic `exact`; use best, strict or relaxed"), "{error}");
    }

    #[test]
    fn names_are_those_of_the_engines() {
        let engines = Engines::default();
        let is_there = |kind: &&dyn EngineKind| match kind.name() {
            "gpu" => cfg!(feature = "gpu"),
            // It begins MPI, which is for tests with a launcher.
            "mpi" => false,
            _ => true,
        };
        for kind in engines.kinds().filter(is_there) {
            let is_bare = kind.detail().is_none_or(|detail| !detail.is_required);
            let word = if is_bare { kind.name().to_owned() } else { format!("{}:2:cpu", kind.name()) };
            let choice = EngineWords::new(&engines).parse(&word).unwrap();
            let engine = engines.engine(&choice.name, &choice.options).unwrap();
            assert_eq!(engine.name(), kind.name());
        }
    }

    #[derive(Debug)]
    struct Other;

    impl EngineKind for Other {
        fn name(&self) -> &'static str {
            "cpu"
        }

        fn about(&self) -> &'static str {
            "another"
        }

        fn make(&self, _options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
            Ok(Box::new(xca_core::Reference))
        }
    }

    #[test]
    fn a_kind_takes_the_place_of_one_with_its_name() {
        let engines = Engines::default().with(Other);
        assert_eq!(
            engines.kinds().map(EngineKind::name).collect::<Vec<_>>(),
            ["cpu", "gpu", "mpi", "parts", "reference"]
        );
        assert_eq!(engines.kind("cpu").unwrap().about(), "another");
    }
}
