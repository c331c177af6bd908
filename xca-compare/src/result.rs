//! What a comparison has found.

use super::difference::Differences;
use super::lane::{Check, FirstDifference, Lane, Times};
use super::plan::Plan;
use super::timing::Spread;
use super::verdict::Verdict;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use xca_checkpoint::ModelReport;
use xca_core::model::GroupKind;
use xca_core::{GroupSnapshot, Model, Precision, Snapshot};
use xca_record::machine;
use xca_record::report::{self, Host};

/// What is compared.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Subject {
    /// The commit and the compiler that the program was built of, where they are known.
    pub commit: Option<&'static str>,
    /// As `commit`.
    pub compiler: Option<&'static str>,
    /// The name of the program.
    pub program: String,
    /// Its version.
    pub version: String,
    /// What the run is called.
    pub title: String,
    /// The command line, if there was one.
    pub command_line: Vec<String>,
}

/// Everything that a comparison has found.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct ComparisonReport {
    /// The version of the framework.
    pub xca: &'static str,
    /// The program.
    #[serde(flatten)]
    pub subject: Subject,
    /// The shape of the model.
    pub model: ModelReport,
    /// Its parameters.
    pub parameters: Map<String, Value>,
    /// The machine.
    pub host: Host,
    /// Its processor.
    pub hardware: Option<String>,
    /// Its memory.
    pub memory_bytes: Option<u64>,
    /// The most memory that the process has taken.
    pub peak_memory_bytes: Option<u64>,
    /// When the comparison ended, in UTC.
    pub ended: String,
    /// The seed of random numbers.
    pub seed: u64,
    /// The number of steps done.
    pub steps: u64,
    /// How many steps from check to check.
    pub check_every: u64,
    /// How often each engine was timed.
    pub repeats: usize,
    /// How far rounded numbers may be apart, in relation to the largest value of their substate.
    pub tolerance: f64,
    /// What is updated in a step, `cells` or `items`, and how many there are at the start.
    pub updated: &'static str,
    /// As `updated` says.
    pub number: usize,
    /// The worst of the engines'.
    pub verdict: Verdict,
    /// In the order in which they were added.
    pub engines: Vec<EngineResult>,
    /// What was observed.
    pub observables: Vec<ObservableResult>,
    /// What is written beside this.
    pub files: Vec<&'static str>,
}

/// What was found of an engine.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct EngineResult {
    /// What it was called when it was added.
    pub name: String,
    /// Its own name.
    pub engine: String,
    /// How many threads it uses.
    pub threads: usize,
    /// What `Real` was.
    pub precision: Precision,
    /// What it says of its device.
    pub device: Map<String, Value>,
    /// What has to be known to judge its times or results.
    pub note: Option<String>,
    /// Making it and starting the model on it.
    pub set_up_seconds: f64,
    /// Giving it a state.
    pub state_in_seconds: Option<Spread>,
    /// Taking the state from it.
    pub state_out_seconds: Option<Spread>,
    /// Of one step.
    pub step_seconds: Option<Spread>,
    /// Cells or items, as `updated` says.
    pub updates_per_second: Option<f64>,
    /// How many times as fast as the first engine.
    pub speed_up: Option<f64>,
    /// The bytes that its state takes.
    pub state_bytes: usize,
    /// What it tells of its work, such as the share of cells that it has worked on.
    pub engine_figures: BTreeMap<String, f64>,
    /// In relation to the first engine; of that itself only where it does not even agree with itself.
    pub verdict: Option<Verdict>,
    /// Why it did not come to the end.
    pub failure: Option<String>,
    /// Where it leaves the first engine.
    pub first_difference: Option<FirstDifference>,
    /// What else there is to tell.
    pub remarks: Vec<String>,
    /// After the last step.
    pub differences: Option<Differences>,
    /// How far it is from the first engine at each check.
    pub history: Vec<Check>,
}

/// A quantity at the start and, on each engine, at the end.
#[derive(Debug, Clone, Serialize)]
pub struct ObservableResult {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// At the start.
    pub initial: f64,
    /// Nothing where an engine did not come to the end.
    #[serde(rename = "final")]
    pub last: Vec<Option<f64>>,
    /// Of a quantity that the model keeps: how far each engine has come from its first value.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub drift: Vec<Option<f64>>,
}

impl EngineResult {
    /// A fact of its device.
    pub fn fact(&self, name: &str) -> Option<&str> {
        self.device.get(name)?.as_str()
    }
}

impl ComparisonReport {
    pub(super) fn new(
        subject: Subject,
        plan: &Plan,
        steps: u64,
        model: &Model,
        lanes: Vec<Lane<'_>>,
    ) -> Self {
        let (updated, number) = lanes.first().map_or(("cells", 0), |first| updated(model, &first.initial));
        let observables = observables(&lanes);
        let base = lanes.first().and_then(|first| Spread::of(&first.times.step));
        let engines: Vec<EngineResult> = lanes
            .into_iter()
            .enumerate()
            .map(|(index, lane)| {
                let mut result = engine(lane, index == 0);
                let step = result.step_seconds.map(|step| step.median).filter(|&step| step > 0.0);
                result.updates_per_second = step.map(|step| number as f64 / step);
                result.speed_up = base.zip(step).map(|(base, step)| base.median / step);
                result
            })
            .collect();
        let verdict = engines.iter().filter_map(|engine| engine.verdict).max().unwrap_or(Verdict::Identical);
        Self {
            xca: env!("CARGO_PKG_VERSION"),
            subject,
            model: ModelReport::new(model),
            parameters: report::of_parameters(model.parameters()),
            host: report::of_host(),
            hardware: machine::processor(),
            memory_bytes: machine::memory(),
            peak_memory_bytes: machine::peak_memory(),
            ended: report::now(),
            seed: plan.seed,
            steps,
            check_every: plan.every,
            repeats: plan.repeats,
            tolerance: plan.tolerance,
            updated,
            number,
            verdict,
            engines,
            observables,
            files: Vec::new(),
        }
    }

    /// Whether an engine ever differed.
    pub fn differs(&self) -> bool {
        self.verdict != Verdict::Identical
    }

    /// The first engine, which the others are compared with.
    pub fn first_name(&self) -> &str {
        self.engines.first().map_or("", |engine| &engine.name)
    }
}

fn engine(lane: Lane<'_>, is_first: bool) -> EngineResult {
    let Lane { contender, simulation, set_up, findings, times, .. } = lane;
    let engine = &*contender.engine;
    let has_come = findings.failure.is_none() && findings.remarks.is_empty();
    let verdict = if has_come { findings.verdict } else { Verdict::Different };
    let Times { step, put, get } = times;
    EngineResult {
        name: contender.name.clone(),
        engine: engine.name().to_owned(),
        threads: engine.threads(),
        precision: contender.precision,
        device: engine.facts().into_iter().map(|(fact, which)| (fact.to_owned(), which.into())).collect(),
        note: engine.note(),
        set_up_seconds: set_up.as_secs_f64(),
        state_in_seconds: Spread::of(&put),
        state_out_seconds: Spread::of(&get),
        step_seconds: Spread::of(&step),
        updates_per_second: None,
        speed_up: None,
        state_bytes: simulation.memory(),
        engine_figures: simulation.figures().into_iter().map(|figure| (figure.name, figure.value)).collect(),
        // The first engine can differ from itself.
        verdict: (!is_first || !has_come).then_some(verdict),
        failure: findings.failure,
        first_difference: findings.first_difference,
        remarks: findings.remarks,
        differences: findings.last,
        history: findings.history,
    }
}

/// What a step updates: items where the model has any, else cells.
fn updated(model: &Model, snapshot: &Snapshot) -> (&'static str, usize) {
    let items = snapshot.groups.iter().map(|group| match group {
        GroupSnapshot::Population(population, _) => population.labels.len(),
        GroupSnapshot::Cells(_) => 0,
    });
    if model.groups().iter().any(|group| matches!(group.kind(), GroupKind::Population { .. })) {
        ("items", items.sum())
    } else {
        ("cells", model.geometry().cells())
    }
}

fn observables(lanes: &[Lane<'_>]) -> Vec<ObservableResult> {
    let Some(first) = lanes.first() else { return Vec::new() };
    let of_end = |lane: &Lane<'_>, index: usize| lane.findings.observables[1].get(index).map(|end| end.value);
    let drift =
        |lane: &Lane<'_>, index: usize| lane.findings.observables[0].get(index)?.drift(of_end(lane, index)?);
    let initial = first.findings.observables[0].iter().enumerate();
    initial
        .map(|(index, observable)| ObservableResult {
            name: observable.name.clone(),
            unit: observable.unit.clone(),
            initial: observable.value,
            last: lanes.iter().map(|lane| of_end(lane, index)).collect(),
            drift: if observable.is_conserved {
                lanes.iter().map(|lane| drift(lane, index)).collect()
            } else {
                Vec::new()
            },
        })
        .collect()
}
