//! The engine as a program chooses it.

use crate::device::{Adapter, AdapterChoice, AdapterKind, Corrections, Device, DeviceError, Handicap};
use crate::error::{GpuError, NotOnDevice};
use crate::execution::{GpuExecution, least_memory};
use crate::program::{Manner, Texts, shader_of};
use crate::proof;
use crate::turns;
use std::fmt;
use std::sync::Arc;
use xca_core::engine::{Border, Engine, Execution, Part, StartError};
use xca_core::model::{Group, GroupKind};
use xca_core::{Model, Precision};
use xca_wgsl::Numbering;

/// How float arithmetic is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Arithmetic {
    /// Strict where the adapter proves it, else relaxed.
    #[default]
    Best,
    /// With the bits of the reference engine; refused where the adapter cannot prove it.
    Strict,
    /// As the driver likes: it may contract and reorder.
    Relaxed,
}

impl std::str::FromStr for Arithmetic {
    type Err = UnknownArithmetic;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "best" => Ok(Self::Best),
            "strict" => Ok(Self::Strict),
            "relaxed" => Ok(Self::Relaxed),
            other => Err(UnknownArithmetic(other.to_owned())),
        }
    }
}

/// A word that names no arithmetic.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no arithmetic; use best, strict or relaxed")]
pub struct UnknownArithmetic(String);

/// All processes of a model as the engine compiles them for strict arithmetic; only that loops over
/// neighbours stand as loops here, where the engine writes them out for the space at hand.
///
/// # Errors
/// Where a process cannot be written in WGSL.
pub fn wgsl(model: &Model, precision: Precision) -> Result<String, xca_wgsl::Error> {
    let manner = Manner { precision, strict: Some(Corrections::default()), workgroup: 64, reach: u64::MAX };
    let known = Texts::default();
    let of = |process| {
        shader_of(&known, model, process, manner, (None, Numbering::Axes)).map(|shader| shader.source)
    };
    let texts = model.processes().iter().map(of);
    Ok(texts.collect::<Result<Vec<_>, _>>()?.join("\n"))
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Best => "best",
            Self::Strict => "strict",
            Self::Relaxed => "relaxed",
        })
    }
}

/// What is asked of the engine.
#[derive(Debug, Clone, Default)]
pub struct GpuOptions {
    /// Which adapter.
    pub adapter: AdapterChoice,
    /// How float arithmetic is done.
    pub arithmetic: Arithmetic,
    /// Limits below those of the adapter, for tests.
    pub handicap: Handicap,
}

/// The GPU engine: an open adapter.
#[derive(Debug, Clone)]
pub struct Gpu {
    device: Arc<Device>,
    texts: Arc<Texts>,
    /// How arithmetic is strict, or why it is relaxed.
    strict: Result<Corrections, String>,
}

impl Gpu {
    /// Opens an adapter, and has it prove strict arithmetic.
    ///
    /// # Errors
    /// Where no adapter is found or none is meant, where it cannot be opened, or cannot do what is asked.
    pub fn new(options: &GpuOptions) -> Result<Self, GpuError> {
        let mut device = Device::open(&options.adapter, options.handicap)?;
        let turns = turns::limit(&device).map_err(|error| GpuError::CannotOpen {
            adapter: device.adapter().to_string(),
            reason: error.to_string(),
        })?;
        device.set_turns(turns);
        let strict = match options.arithmetic {
            Arithmetic::Relaxed => Err("it was asked for".to_owned()),
            Arithmetic::Best | Arithmetic::Strict => proof::of_strictness(&device),
        };
        device.narrow();
        match (&strict, options.arithmetic) {
            (Err(reason), Arithmetic::Strict) => {
                Err(GpuError::NotStrict { adapter: device.adapter().to_string(), reason: reason.clone() })
            }
            _ => Ok(Self { device: Arc::new(device), texts: Arc::default(), strict }),
        }
    }

    /// The adapter.
    pub fn adapter(&self) -> &Adapter {
        self.device.adapter()
    }

    /// Whether float arithmetic has the bits of the reference engine.
    pub fn is_strict(&self) -> bool {
        self.strict.is_ok()
    }

    /// Why arithmetic is relaxed, where it is.
    pub fn why_relaxed(&self) -> Option<&str> {
        self.strict.as_ref().err().map(String::as_str)
    }

    /// The operations that the driver does wrongly and that are corrected, such as `division in f32`: they
    /// take longer.
    pub fn corrected(&self) -> Vec<String> {
        let Ok(Corrections { divisions, roots, roundings }) = self.strict else { return Vec::new() };
        let words = |word: &'static str, of: [bool; 2]| {
            let types = ["f32", "f64"].into_iter().zip(of).filter(|(_, corrected)| *corrected);
            types.map(move |(type_, _)| format!("{word} in {type_}"))
        };
        let of_two = words("division", divisions).chain(words("square root", roots));
        of_two.chain(words("rounding to whole numbers", roundings)).collect()
    }

    /// How many turns the loops of a cell or item may take together, where the adapter ends them early
    /// (Mesa's lavapipe does). A process that needs more stops the run with an error.
    pub fn turns(&self) -> Option<u32> {
        self.device.turns()
    }
}

impl Gpu {
    /// A model, or a part of it.
    fn execution(
        &self,
        model: &Model,
        precision: Precision,
        shared: Option<(Part, Box<dyn Border>)>,
    ) -> Result<Box<dyn Execution>, StartError> {
        let strict = self.strict.as_ref().ok().copied();
        let (workgroup, reach) = (self.device.workgroup(), self.device.reach());
        let manner = Manner { precision, strict, workgroup, reach };
        match GpuExecution::new(model, manner, Arc::clone(&self.device), &self.texts, shared) {
            Ok(execution) => Ok(Box::new(execution)),
            Err(error) => Err(self.cannot_start(error)),
        }
    }

    fn cannot_start(&self, error: NotOnDevice) -> StartError {
        let engine = "gpu".to_owned();
        let too_large = |what: String, wanted: u128, limit: u64| StartError::TooLarge {
            engine: engine.clone(),
            what: format!("the bytes of {what}"),
            wanted,
            limit: limit.into(),
        };
        match error {
            NotOnDevice::TooLarge { what, wanted, most } => too_large(what, wanted, most),
            NotOnDevice::Device(DeviceError::TooLarge { what, wanted, most }) => {
                too_large(what, wanted.into(), most)
            }
            other => StartError::Other { engine, reason: format!("{other} (adapter: {})", self.adapter()) },
        }
    }
}

impl Engine for Gpu {
    fn name(&self) -> &str {
        "gpu"
    }

    fn threads(&self) -> usize {
        1
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        let Adapter { name, driver, interface, kind, .. } = self.adapter().clone();
        let mut facts = vec![
            ("adapter", name),
            ("driver", driver),
            ("interface", interface),
            ("kind", kind.to_string()),
            ("arithmetic", if self.is_strict() { "strict" } else { "relaxed" }.to_owned()),
        ];
        let corrected = self.corrected();
        facts.extend((!corrected.is_empty()).then(|| ("corrected", corrected.join(", "))));
        facts.extend(self.why_relaxed().map(|reason| ("relaxed_because", reason.to_owned())));
        facts
    }

    fn note(&self) -> Option<String> {
        let processor = (self.adapter().kind == AdapterKind::Processor).then(|| {
            format!("{} is no GPU: the processor plays one, and times are its own", self.adapter().name)
        });
        let relaxed = self.why_relaxed().map(|reason| {
            format!(
                "float arithmetic is relaxed, results may differ from those of the other engines ({reason})"
            )
        });
        let notes: Vec<String> = processor.into_iter().chain(relaxed).collect();
        (!notes.is_empty()).then(|| notes.join("; "))
    }

    fn least_memory(&self, model: &Model, precision: Precision) -> u128 {
        // Only the memory of the host is compared with this, and only where the processor plays the GPU is it
        // the device's.
        if self.adapter().kind == AdapterKind::Processor { least_memory(model, precision) } else { 0 }
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        self.execution(model, precision, None)
    }

    fn start_part(
        &self,
        model: &Model,
        precision: Precision,
        part: &Part,
        border: Box<dyn Border>,
    ) -> Result<Box<dyn Execution>, StartError> {
        part.check(model.geometry())?;
        if *part == Part::whole(model.geometry()) {
            return self.start(model, precision);
        }
        let is_population = |group: &&Group| matches!(group.kind(), GroupKind::Population { .. });
        if let Some(population) = model.groups().iter().find(is_population) {
            let reason = format!(
                "the model has the population `{}`, and parts on GPUs hold cells only; take parts on the cpu engine, \
                 or one GPU (--engine gpu)",
                population.schema().name
            );
            return Err(StartError::NoParts { engine: self.name().to_owned(), reason });
        }
        self.execution(model, precision, Some((part.clone(), border)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use xca_core::{
        Cell, EngineFailure, Fault, RunError, RunOptions, Simulation, Substates, elementary_process,
    };

    #[derive(Substates, Clone, Copy)]
    struct Counter {
        count: u32,
    }

    #[elementary_process]
    fn count(cell: &mut Cell<Counter>) {
        cell.count += 1;
    }

    fn model() -> Model {
        Model::builder("counters").extents([4, 3, 2]).substates::<Counter>().process(count).build().unwrap()
    }

    /// Whatever is asked of a lost device, the answer is an error that says so.
    #[test]
    fn a_lost_device_is_an_error() {
        let gpu = Gpu::new(&GpuOptions::default()).unwrap();
        let mut simulation = Simulation::new(&model(), &gpu, RunOptions::default()).unwrap();
        simulation.run(5).unwrap();
        assert_eq!(simulation.state().get(Counter::COUNT, [3, 2, 1]).unwrap(), 5);
        gpu.device.lose();
        let error = simulation.snapshot().unwrap_err();
        assert!(
            matches!(&error, RunError::Engine(EngineFailure::Broken { engine, .. }) if engine == "gpu"),
            "{error:?}"
        );
        assert!(error.to_string().contains("the device was lost"), "{error}");
        assert!(simulation.state().sum(Counter::COUNT).is_err());
        assert!(simulation.state().set(Counter::COUNT, [0, 0, 0], 1).is_err());
        let error = simulation.run(3).unwrap_err();
        assert!(matches!(&error, RunError::Fault { step: 6, fault: Fault::Engine(_), .. }), "{error:?}");
        assert!(Simulation::new(&model(), &gpu, RunOptions::default()).is_err());
    }

    #[test]
    fn words_of_arithmetic() {
        for arithmetic in [Arithmetic::Best, Arithmetic::Strict, Arithmetic::Relaxed] {
            assert_eq!(arithmetic.to_string().parse(), Ok(arithmetic));
        }
        assert!("exact".parse::<Arithmetic>().is_err());
    }
}
