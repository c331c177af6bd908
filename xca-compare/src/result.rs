//! The report of a comparison.

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
use xca_record::report::{self, Host};

/// The program that is compared.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Subject {
    /// The commit of the program, if it is known.
    pub commit: Option<&'static str>,
    /// The compiler of the program, if it is known.
    pub compiler: Option<&'static str>,
    /// Its name.
    pub program: String,
    /// Its version.
    pub version: String,
    /// The title of the run.
    pub title: String,
    /// The command line, if there was one.
    pub command_line: Vec<String>,
}

/// All results of a comparison.
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
    /// The end of the comparison, in UTC.
    pub ended: String,
    /// The seed of random numbers.
    pub seed: u64,
    /// The number of steps done.
    pub steps: u64,
    /// The number of steps between checks.
    pub check_every: u64,
    /// The number of timings of each engine.
    pub repeats: usize,
    /// The largest difference that counts as rounding, relative to the largest value of the substate.
    pub tolerance: f64,
    /// The kind of things that a step updates: `cells` or `items`.
    pub updated: &'static str,
    /// The number of these cells or items at the start.
    pub number: usize,
    /// The worst verdict on the engines.
    pub verdict: Verdict,
    /// The engines, in the order in which they were added.
    pub engines: Vec<EngineResult>,
    /// The observables.
    pub observables: Vec<ObservableResult>,
    /// The files beside this one.
    pub files: Vec<&'static str>,
}

/// The results of one engine.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct EngineResult {
    /// The name given when it was added.
    pub name: String,
    /// Its own name.
    pub engine: String,
    /// The number of its threads.
    pub threads: usize,
    /// The type that `Real` stands for.
    pub precision: Precision,
    /// Facts about its device.
    pub device: Map<String, Value>,
    /// A note that matters for its times or results.
    pub note: Option<String>,
    /// The time to create the engine and its simulation.
    pub set_up_seconds: f64,
    /// The time to set the state.
    pub state_in_seconds: Option<Spread>,
    /// The time to get the state.
    pub state_out_seconds: Option<Spread>,
    /// The time of one step.
    pub step_seconds: Option<Spread>,
    /// Updates of cells or items (see `updated`) per second.
    pub updates_per_second: Option<f64>,
    /// Speed relative to the first engine.
    pub speed_up: Option<f64>,
    /// The size of its state in bytes.
    pub state_bytes: usize,
    /// Figures about its work, such as the share of cells that it updated.
    pub engine_figures: BTreeMap<String, f64>,
    /// The agreement with the first engine. For the first engine, only set if it disagrees with itself.
    pub verdict: Option<Verdict>,
    /// The error that ended its run.
    pub failure: Option<String>,
    /// The first difference from the first engine.
    pub first_difference: Option<FirstDifference>,
    /// Other remarks.
    pub remarks: Vec<String>,
    /// The differences after the last step.
    pub differences: Option<Differences>,
    /// The distance from the first engine at each check.
    pub history: Vec<Check>,
}

/// A quantity at the start and, on each engine, at the end.
#[derive(Debug, Clone, Serialize)]
pub struct ObservableResult {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The value at the start.
    pub initial: f64,
    /// The value at the end. `None` if the engine did not reach the end.
    #[serde(rename = "final")]
    pub last: Vec<Option<f64>>,
    /// For a conserved quantity: its drift from the first value on each engine.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub drift: Vec<Option<f64>>,
}

impl EngineResult {
    /// A fact about its device.
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
            hardware: xca_machine::processor(),
            memory_bytes: xca_machine::memory(),
            peak_memory_bytes: xca_machine::peak_memory(),
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

    /// Whether an engine differed at any check.
    pub fn differs(&self) -> bool {
        self.verdict != Verdict::Identical
    }

    /// The name of the first engine, the reference of all others.
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

/// What a step updates: items if the model has any, otherwise cells.
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
