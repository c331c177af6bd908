//! The run that a checkpoint belongs to, and its differences from another.

use crate::components::{state_names, text};
use crate::{Exact, Identity, InputFile, ModelReport, Outputs};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use xca_core::{Engine, Field, Model, ParameterSet, Precision, Process, RunOptions};

/// The run that a checkpoint belongs to. It is the same in all checkpoints of a run, even if the run resumes
/// on another engine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// The version of the framework.
    pub xca: String,
    /// The name of the program.
    pub program: String,
    /// The version of the program.
    pub version: String,
    /// The command line, including the options of a configuration file.
    pub command_line: Vec<String>,
    /// The working directory of the command line, the base of its relative paths.
    pub directory: String,
    /// The input files of the set-up.
    pub inputs: Vec<InputFile>,
    /// The precision of `Real`.
    pub precision: Precision,
    /// The seed of random numbers.
    pub seed: u64,
    /// The number of steps of the whole run.
    pub steps_wanted: u64,
    /// The steps after which states are written.
    pub every: Outputs,
    /// The shape of the model, as in `run.json`.
    pub model: Value,
    /// The CRC-32 of the code of the processes and of their helper functions.
    pub processes: u32,
    /// The rounding of floating-point numbers on the engine that began the run.
    pub rounding: String,
    /// The parameters before the first step.
    pub parameters: Vec<Parameter>,
}

/// A parameter with its value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// The type in the model.
    #[serde(rename = "type")]
    pub value_type: String,
    /// The names of the values of `bool` and states, by number.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub states: Vec<String>,
    /// Its unit, if it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Its value.
    pub components: Vec<Exact>,
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

    /// The parameters of a model before a run.
    fn all(parameters: &ParameterSet) -> Vec<Self> {
        Self::with_values(parameters, parameters.values().map(|value| value.components().to_vec()))
    }

    /// Parameters with their values in a run, by index.
    pub(super) fn with_values(
        parameters: &ParameterSet,
        values: impl Iterator<Item = Vec<f64>>,
    ) -> Vec<Self> {
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

/// A difference between a checkpoint and the program that resumes it.
#[derive(Debug, PartialEq, Eq)]
pub struct Difference {
    /// The name of the property.
    pub what: &'static str,
    /// The value in the checkpoint.
    pub found: String,
    /// The value in the program.
    pub wanted: String,
}

/// The first property that differs.
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

/// The first difference of two programs: the version of the framework, their names, their versions.
pub fn other_program(found: [&str; 3], wanted: [&str; 3]) -> Option<Difference> {
    let property = |what, index: usize| (what, found[index].to_owned(), wanted[index].to_owned());
    let framework = property("version of the framework", 0);
    first_difference([property("program", 1), framework, property("version of the program", 2)])
}

/// The first difference of two models, given in the form of `run.json`. The number of slots in a cell may
/// differ, because the states of a run do not depend on it.
pub fn other_model(found: &Value, wanted: &Value) -> Option<Difference> {
    first_difference(of_models(&without_slots(found), &without_slots(wanted)))
}

/// A model without the numbers of slots.
fn without_slots(model: &Value) -> Value {
    let mut model = model.clone();
    let groups = model.get_mut("groups").and_then(Value::as_array_mut);
    for group in groups.into_iter().flatten().filter_map(Value::as_object_mut) {
        group.remove("slots");
    }
    model
}

/// The name of the substates of a population, and its number of slots in a cell.
fn population_slots(group: &Value) -> Option<(&str, usize)> {
    let slots = usize::try_from(group.get("slots")?.as_u64()?).ok()?;
    Some((group.get("name")?.as_str()?, slots))
}

/// The first input file that has changed. Its path may differ.
fn other_inputs(found: &[InputFile], wanted: &[InputFile]) -> Option<Difference> {
    let number = |files: &[InputFile]| files.len().to_string();
    let numbers = [("number of input files", number(found), number(wanted))];
    let files = found.iter().zip(wanted).map(|(found, wanted)| {
        let text = |file: &InputFile| match file.crc32 {
            Some(sum) => format!("{} of the checksum {sum:08x}", wanted.path.display()),
            None => format!("{} unread", wanted.path.display()),
        };
        ("input file", text(found), text(wanted))
    });
    first_difference(numbers.into_iter().chain(files))
}

/// The CRC-32 of the intervals and the code of all processes. The code is that of the shaders, with all
/// helper functions. If a process cannot be a shader, the bodies count instead. They contain helper functions
/// as addresses, which are left out.
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

/// The processes as shaders, also if the program has no GPU engine.
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

/// The rounding of all engines except a GPU with relaxed arithmetic.
const EXACT: &str = "exact";

impl Origin {
    /// The run of a model with these input files and the options of the command line.
    pub fn new(
        identity: &Identity,
        model: &Model,
        inputs: &[InputFile],
        options: RunOptions,
        steps_wanted: u64,
        every: Outputs,
    ) -> Self {
        Self {
            xca: env!("CARGO_PKG_VERSION").to_owned(),
            program: identity.program.clone(),
            version: identity.version.clone(),
            command_line: identity.command_line.clone(),
            directory: identity.directory.clone(),
            inputs: inputs.to_vec(),
            precision: options.precision,
            seed: options.seed,
            steps_wanted,
            every,
            model: serde_json::to_value(ModelReport::new(model)).unwrap_or_default(),
            processes: of_processes(model),
            rounding: EXACT.to_owned(),
            parameters: Parameter::all(model.parameters()),
        }
    }

    /// The number of slots in a cell for each population, by the name of its substates.
    pub fn slots(&self) -> Vec<(&str, usize)> {
        let groups = self.model.get("groups").and_then(Value::as_array);
        groups.into_iter().flatten().filter_map(population_slots).collect()
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

    /// The difference in rounding between the engine that resumes the run and the one that began it.
    pub fn other_rounding(&self, own: &Self) -> Option<Difference> {
        first_difference([("rounding of floating numbers", self.rounding.clone(), own.rounding.clone())])
    }

    /// The first difference between the program that wrote this and the given identity. See
    /// [`Self::identity`].
    pub fn other_program(&self, identity: [&str; 3]) -> Option<Difference> {
        other_program(self.identity(), identity)
    }

    /// The first difference between this run and the run of the current command line. The number of steps may
    /// differ.
    pub fn mismatch(&self, own: &Self) -> Option<Difference> {
        let text = |number: u64| number.to_string();
        first_difference([
            ("precision", self.precision.to_string(), own.precision.to_string()),
            ("seed", text(self.seed), text(own.seed)),
            ("interval of outputs", self.every.to_string(), own.every.to_string()),
        ])
        .or_else(|| other_inputs(&self.inputs, &own.inputs))
        .or_else(|| other_model(&self.model, &own.model))
        .or_else(|| {
            let sum = |origin: &Self| format!("of the checksum {:08x}", origin.processes);
            first_difference([("code of the processes", sum(self), sum(own))])
        })
        .or_else(|| first_difference([("parameters", listed(&self.parameters), listed(&own.parameters))]))
    }
}
