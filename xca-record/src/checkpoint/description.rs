//! What a checkpoint says of itself: whose it is, and what its data are.

use crate::components::{state_names, text};
use crate::numbers::Exact;
use crate::record::{Recorded, Recorder};
use crate::report::{self, Identity};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use xca_core::model::Group;
use xca_core::{
    Engine, Field, GroupSnapshot, Model, ParameterSet, Precision, Process, RunOptions, Snapshot,
    StoredScalar, StoredType,
};

/// The JSON part of a checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Description {
    pub run: Origin,
    /// The number of steps done.
    pub step: u64,
    /// Simulated time, in s where the model knows it.
    pub time: Exact,
    /// Why a steering operation has ended the run, if one has.
    pub stop: Option<String>,
    /// The present values of the parameters.
    pub parameters: Vec<Parameter>,
    pub groups: Vec<GroupShape>,
    /// The cells without ground.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) missing: Vec<Run>,
    pub recorded: Recorded,
}

/// Cells that follow each other by linear index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Run {
    first: usize,
    cells: usize,
}

impl Run {
    /// The cells of a mask.
    pub(super) fn all(mask: &[bool]) -> Vec<Self> {
        let mut first = 0;
        let mut runs = Vec::new();
        for chunk in mask.chunk_by(|one, other| one == other) {
            if chunk[0] {
                runs.push(Self { first, cells: chunk.len() });
            }
            first += chunk.len();
        }
        runs
    }
}

/// The run that a checkpoint belongs to: the same in all checkpoints of a run, whatever engine it was resumed on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// The version of the framework.
    pub xca: String,
    pub program: String,
    pub version: String,
    /// The command line, with what a configuration file added to it.
    pub command_line: Vec<String>,
    pub precision: Precision,
    pub seed: u64,
    pub steps_wanted: u64,
    pub every: u64,
    /// The shape of the model, as in `run.json`.
    pub model: Value,
    /// The CRC-32 of the text of the processes and of the helpers that they call.
    pub processes: u32,
    /// How floating numbers are rounded on the engine that it was begun on.
    pub rounding: String,
    /// The parameters before the first step.
    pub parameters: Vec<Parameter>,
}

/// A parameter with its value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    pub name: String,
    #[serde(rename = "type")]
    pub value_type: String,
    /// The names of the values of `bool` and states, by number.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub states: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    pub components: Vec<Exact>,
}

/// The substates of one struct.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GroupShape {
    pub name: String,
    #[serde(flatten)]
    pub kind: Kind,
    pub substates: Vec<SubstateShape>,
}

/// What the substates belong to, and how many there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "of", rename_all = "lowercase")]
pub enum Kind {
    Cells { cells: usize },
    Items { cells: usize, items: usize, left: u64 },
}

/// A substate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SubstateShape {
    pub name: String,
    /// As the model says it.
    #[serde(rename = "type")]
    pub value_type: String,
    /// The names of the values of `bool` and states, by number.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub states: Vec<String>,
    /// What follows its name for each of its components: `.x`, `[3]`.
    pub components: Vec<String>,
    /// As it is stored.
    #[serde(flatten)]
    pub stored: StoredType,
}

impl Description {
    pub fn new(run: Origin, recorder: &Recorder, snapshot: &Snapshot, recorded: Recorded) -> Self {
        let model = recorder.model();
        let groups = model.groups().iter().zip(&snapshot.groups);
        let components =
            snapshot.parameters.iter().map(|bits| bits.iter().copied().map(f64::from_bits).collect());
        Self {
            step: snapshot.step,
            time: Exact(recorder.time(snapshot.step)),
            stop: snapshot.stop.clone(),
            parameters: Parameter::with_values(model.parameters(), components),
            groups: groups
                .map(|(group, state)| GroupShape::new(group, state, model, run.precision))
                .collect(),
            missing: recorder.set_up().missing().map(Run::all).unwrap_or_default(),
            run,
            recorded,
        }
    }

    /// The cells along each axis.
    pub fn extents(&self) -> Option<[usize; 3]> {
        serde_json::from_value(self.run.model.get("cells")?.clone()).ok()
    }

    /// How many cells there are; nothing where that is no number of this machine.
    pub(super) fn cells(&self) -> Option<usize> {
        self.extents()?.into_iter().try_fold(1, usize::checked_mul)
    }

    /// Whether a run can have come to this, with so many bytes of data: the whole has a checksum, but anyone can
    /// forge that.
    pub(super) fn makes_sense(&self, data: u64) -> bool {
        let components = self.parameters.iter().flat_map(|parameter| &parameter.components);
        let mut substates = self.groups.iter().flat_map(|group| &group.substates);
        // Each cell has at least a byte.
        let has_mask = self.missing.is_empty() || self.cells().is_some_and(|cells| cells as u64 <= data);
        self.step <= self.run.steps_wanted
            && self.recorded.can_be_after(self.step)
            && components.into_iter().all(|component| !component.0.is_nan())
            && substates.all(SubstateShape::makes_sense)
            && has_mask
    }

    /// The mask of the cells without ground; none where all have ground.
    pub fn mask(&self) -> Option<Vec<bool>> {
        let mut mask =
            (!self.missing.is_empty()).then(|| self.cells()).flatten().map(|cells| vec![false; cells])?;
        for Run { first, cells } in &self.missing {
            mask.iter_mut().skip(*first).take(*cells).for_each(|is_missing| *is_missing = true);
        }
        Some(mask)
    }

    /// How many bytes the data are.
    pub(super) fn data_bytes(&self) -> usize {
        let number = size_of::<u32>();
        let of_group = |group: &GroupShape| {
            let size: usize = group.substates.iter().map(|substate| substate.stored.size()).sum();
            match group.kind {
                Kind::Cells { cells } => cells * size,
                Kind::Items { cells, items, .. } => cells * number + items * (number + size),
            }
        };
        self.groups.iter().map(of_group).sum()
    }
}

impl SubstateShape {
    /// Whether there is such a type.
    fn makes_sense(&self) -> bool {
        let Self { states, components, stored, .. } = self;
        (1..=4).contains(&stored.lanes)
            && stored.length > 0
            && components.len() == stored.components()
            && (states.is_empty() || stored.scalar == StoredScalar::U8)
    }
}

impl GroupShape {
    fn new(group: &Group, state: &GroupSnapshot, model: &Model, precision: Precision) -> Self {
        let cells = model.geometry().cells();
        let kind = match state {
            GroupSnapshot::Cells(_) => Kind::Cells { cells },
            GroupSnapshot::Population(population, left) => {
                Kind::Items { cells, items: population.labels.len(), left: *left }
            }
        };
        let substates = group.schema().fields.iter().map(|field| SubstateShape {
            name: field.name.to_owned(),
            value_type: field.value_type.to_string(),
            states: state_names(field.value_type.scalar),
            components: field.value_type.component_suffixes(),
            stored: field.value_type.stored(precision),
        });
        Self { name: group.schema().name.to_owned(), kind, substates: substates.collect() }
    }
}

impl Parameter {
    fn new(name: String, field: &Field, components: Vec<f64>) -> Self {
        Self {
            name,
            value_type: field.value_type.to_string(),
            states: state_names(field.value_type.scalar),
            unit: field.unit.map(str::to_owned),
            components: components.into_iter().map(Exact).collect(),
        }
    }

    /// The parameters of a model that has not been run.
    fn all(parameters: &ParameterSet) -> Vec<Self> {
        Self::with_values(parameters, parameters.values().map(|value| value.components().to_vec()))
    }

    /// Parameters with the values that a run has given them, in the order of their numbers.
    fn with_values(parameters: &ParameterSet, values: impl Iterator<Item = Vec<f64>>) -> Vec<Self> {
        let named = parameters.names().into_iter().zip(parameters.fields()).zip(values);
        named.map(|((name, field), components)| Self::new(name, field, components)).collect()
    }

    pub(super) fn bits(&self) -> Vec<u64> {
        self.components.iter().map(|component| component.0.to_bits()).collect()
    }
}

impl std::fmt::Display for Parameter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let components = self.components.iter().map(|component| text(&self.states, component.0));
        write!(f, "{} = {}", self.name, components.collect::<Vec<_>>().join(","))
    }
}

/// What is not the same in a checkpoint and in the program that is to go on from it.
#[derive(Debug, PartialEq, Eq)]
pub struct Difference {
    pub what: &'static str,
    pub found: String,
    pub wanted: String,
}

/// The first of some properties that differs.
fn first_difference(
    properties: impl IntoIterator<Item = (&'static str, String, String)>,
) -> Option<Difference> {
    let mut different = properties.into_iter().filter(|(_, found, wanted)| found != wanted);
    different.next().map(|(what, found, wanted)| Difference { what, found, wanted })
}

/// The properties of two models.
fn of_models<'a>(
    found: &'a Value,
    wanted: &'a Value,
) -> impl Iterator<Item = (&'static str, String, String)> {
    let keys = wanted.as_object().into_iter().flat_map(serde_json::Map::keys);
    let text = |key: &str, model: &Value| format!("{key} {}", model.get(key).unwrap_or(&Value::Null));
    keys.map(move |key| ("model", text(key, found), text(key, wanted)))
}

/// How two programs are not the same: the version of the framework, their names, and their versions.
pub fn other_program(found: [&str; 3], wanted: [&str; 3]) -> Option<Difference> {
    let property = |what, index: usize| (what, found[index].to_owned(), wanted[index].to_owned());
    let framework = property("version of the framework", 0);
    first_difference([property("program", 1), framework, property("version of the program", 2)])
}

/// How two models, as `run.json` tells their shapes, are not the same.
pub fn other_model(found: &Value, wanted: &Value) -> Option<Difference> {
    first_difference(of_models(found, wanted))
}

/// The CRC-32 of the steps in which the processes are run, and of all processes with the helpers that they call, as shaders; of those that
/// cannot be written as shaders, of the bodies alone, in which helpers are told by their addresses, and these are left out.
fn of_processes(model: &Model) -> u32 {
    let mut sum = crc32fast::Hasher::new();
    for process in model.processes() {
        sum.update(&process.every.to_le_bytes());
    }
    if let Ok(texts) = shaders(model) {
        sum.update(texts.join("\n").as_bytes());
        return sum.finalize();
    }
    for process in model.processes() {
        let body = format!("{:?}", (process.body)());
        for (number, part) in body.split("0x").enumerate() {
            let is_address = |character: char| number > 0 && character.is_ascii_hexdigit();
            sum.update(part.trim_start_matches(is_address).as_bytes());
        }
    }
    sum.finalize()
}

/// The processes as shaders, whether or not the program has the engine that runs them.
fn shaders(model: &Model) -> Result<Vec<String>, xca_wgsl::Error> {
    let geometry = model.geometry();
    let options = xca_wgsl::Options {
        neighbourhood_size: u32::try_from(geometry.neighbourhood().size()).ok(),
        boundaries: geometry.boundaries(),
        parity: geometry.neighbourhood().parity(),
        ..xca_wgsl::Options::default()
    };
    let shader = |process: &Process| xca_wgsl::shader(&(process.body)(), &options);
    model.processes().iter().map(|process| shader(process).map(|shader| shader.source)).collect()
}

fn listed(parameters: &[Parameter]) -> String {
    parameters.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// The rounding of all engines but a GPU whose arithmetic is relaxed.
const EXACT: &str = "exact";

impl Origin {
    /// The run of a model, with what the command line chose for it.
    pub fn new(
        identity: &Identity,
        model: &Model,
        options: RunOptions,
        [steps_wanted, every]: [u64; 2],
    ) -> Self {
        Self {
            xca: env!("CARGO_PKG_VERSION").to_owned(),
            program: identity.program.clone(),
            version: identity.version.clone(),
            command_line: identity.command_line.clone(),
            precision: options.precision,
            seed: options.seed,
            steps_wanted,
            every,
            model: serde_json::to_value(report::of_model(model)).unwrap_or_default(),
            processes: of_processes(model),
            rounding: EXACT.to_owned(),
            parameters: Parameter::all(model.parameters()),
        }
    }

    /// The version of the framework, the name of the program, and its version.
    pub fn identity(&self) -> [&str; 3] {
        [&self.xca, &self.program, &self.version]
    }

    /// The same run on this engine.
    pub fn on(self, engine: &dyn Engine) -> Self {
        let facts = engine.facts();
        let fact = |name: &str| facts.iter().find(|(fact, _)| *fact == name).map_or("", |(_, which)| which);
        let is_relaxed = fact("arithmetic") == "relaxed";
        let relaxed = || format!("relaxed on {} ({})", fact("adapter"), fact("driver"));
        Self { rounding: if is_relaxed { relaxed() } else { EXACT.to_owned() }, ..self }
    }

    /// How the engine that goes on rounds otherwise than the one that the run was begun on.
    pub fn other_rounding(&self, own: &Self) -> Option<Difference> {
        first_difference([("rounding of floating numbers", self.rounding.clone(), own.rounding.clone())])
    }

    /// How the program that wrote this is not the one with this name and these versions.
    pub fn other_program(&self, identity: [&str; 3]) -> Option<Difference> {
        other_program(self.identity(), identity)
    }

    /// How this run is not the one that the program would do with its command line.
    pub fn mismatch(&self, own: &Self) -> Option<Difference> {
        let text = |number: u64| number.to_string();
        first_difference([
            ("precision", self.precision.to_string(), own.precision.to_string()),
            ("seed", text(self.seed), text(own.seed)),
            ("number of steps", text(self.steps_wanted), text(own.steps_wanted)),
            ("interval of outputs", text(self.every), text(own.every)),
        ])
        .or_else(|| other_model(&self.model, &own.model))
        .or_else(|| {
            let sum = |origin: &Self| format!("of the checksum {:08x}", origin.processes);
            first_difference([("code of the processes", sum(self), sum(own))])
        })
        .or_else(|| first_difference([("parameters", listed(&self.parameters), listed(&own.parameters))]))
    }
}
