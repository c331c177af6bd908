//! The subcommand `sweep`.

mod values;

use super::arguments::steps;
use super::choice::Choice;
use super::definition::Definition;
use super::engine::with_engine;
use super::help::{with_help, with_model};
use super::outcome::{Ended, Unable};
use super::prepare::warn;
use super::voice::Voice;
use crate::engines::EngineChoice;
use crate::interrupt::Interrupt;
use crate::program::{Assignment, Given};
use crate::progress::Progress;
use clap::{Args, Command};
use serde::Serialize;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;
use values::{Values, ValuesError};
use xca_checkpoint::Identity;
use xca_core::Engine;
use xca_ensemble::{End, Ensemble, EnsembleError, EnsembleMonitor, Finished, MEMBERS, Member, SUMMARY};
use xca_io::atomic::write_atomically;
use xca_io::numbers::{counted, duration_text};
use xca_machine::{check_memory, cores};
use xca_record::record::LockedFolder;
use xca_record::{Failure, SetUp};
use xca_report::ensemble::{self, PAGE};

pub(super) const NAME: &str = "sweep";

const ABOUT: &str = "Run the model for many parameters and seeds, and write one table";

const FILES: &str = "\
--set takes several values: LOW..HIGH:COUNT for COUNT values at equal steps, or
A|B|C. The sweep runs all combinations, each with --seeds seeds.

members.csv has a row per run: parameters, seed, how it ended, final observables.
summary.csv has mean, standard deviation, minimum and maximum over the seeds;
summary.html plots them. Repeat the command to continue an interrupted sweep. It
also repeats failed runs.";

/// How many failed runs are told on the terminal.
const TOLD: usize = 5;

/// Which runs are done, and how.
#[derive(Args, Debug, Clone)]
pub(super) struct SweepArguments {
    /// Seeds per combination of parameters, counted from --seed
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    seeds: u64,

    /// Runs side by side [default: cores divided by --threads]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,

    /// Number of steps of each run [default: the model's]
    #[arg(long, value_name = "N", value_parser = steps)]
    steps: Option<u64>,

    /// Report the runs with the largest final value of an observable
    #[arg(long, value_name = "OBSERVABLE")]
    maximise: Option<String>,

    /// Output directory of the tables [default: out/NAME-sweep]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    #[command(flatten)]
    voice: Voice,
}

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let command = with_engine(with_model(Command::new(NAME), definition), definition.engines);
    let command = SweepArguments::augment_args(command).next_help_heading(None::<&str>);
    let examples = [
        format!("{name} sweep --seeds 10"),
        format!("{name} sweep --set NAME=0.1..0.5:20 --seeds 10 --jobs 4"),
        format!("{name} sweep --set 'NAME=0.1|0.2|0.5' --set OTHER=3 --maximise OBSERVABLE"),
    ];
    with_help(command, ABOUT, &examples).long_about(format!("{ABOUT}.\n\n{FILES}"))
}

/// What a sweep tells as JSON.
#[derive(Serialize)]
struct Told<'a> {
    folder: &'a Path,
    members: usize,
    done: usize,
    failed: usize,
    seconds: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    best: Option<&'a Best>,
}

/// What cannot be swept.
#[derive(Debug, thiserror::Error)]
enum SweepError {
    #[error(transparent)]
    Values(#[from] ValuesError),
    #[error("no run observes `{wanted}`; there are {known}")]
    NoObservable { wanted: String, known: String },
    #[error("{failed} of {all} runs failed; {} says why", table.display())]
    Failed { failed: usize, all: usize, table: PathBuf },
}

/// The line that shows how many runs are done, and Ctrl-C.
struct Terminal<'a> {
    line: Progress,
    done: u64,
    interrupt: &'a Interrupt,
}

impl EnsembleMonitor for Terminal<'_> {
    fn begin(&mut self, done: usize, _: usize) {
        self.done = done as u64;
        self.line.begin_at(self.done);
    }

    fn ended(&mut self, _: &Finished) {
        self.done += 1;
        self.line.at(self.done);
    }

    fn is_interrupted(&self) -> bool {
        self.interrupt.is_raised()
    }
}

/// Runs a model many times.
pub(super) fn sweep(
    model: &Choice<'_>,
    mut on: EngineChoice,
    arguments: SweepArguments,
) -> Result<Ended, Unable> {
    let begin = Instant::now();
    let given = model.arguments.given(arguments.steps);
    let (swept, fixed) = sorted(&given).map_err(Unable::refused)?;
    let given = Given { parameters: fixed, ..given };
    let set_up = model.set_up(&given)?;
    check(&set_up, &swept)?;
    let engines = model.definition.engines;
    on.options = on.options.or(&engines.kind(&on.name).map_err(Unable::refused)?.beside_others());
    let engine = on.engine(model.definition)?;
    let jobs = arguments
        .jobs
        .map(usize::from)
        .unwrap_or_else(|| (cores().unwrap_or(1) / engine.threads().max(1)).max(1));
    let memory = engine.least_memory(&set_up.model, given.precision).saturating_mul(jobs as u128);
    check_memory(memory, &format!("{jobs} runs side by side")).map_err(Unable::refused)?;
    warn(&set_up);
    drop((engine, set_up));
    let definition = model.definition;
    let mut ensemble = Ensemble::new()
        .identity(Identity {
            program: definition.name.to_owned(),
            version: definition.version.to_owned(),
            command_line: Vec::new(),
            options: model.options.clone(),
            ..Identity::default()
        })
        .seeds(given.seed, arguments.seeds)
        .jobs(jobs)
        .precision(given.precision);
    if let Some(steps) = arguments.steps {
        ensemble = ensemble.steps(steps);
    }
    for Values { parameter, values } in swept {
        ensemble = ensemble.sweep(parameter, values);
    }
    let folder =
        arguments.out.unwrap_or_else(|| PathBuf::from("out").join(format!("{}-sweep", definition.name)));
    let all = ensemble.members().len();
    let interrupt = Interrupt::install().map_err(Unable::failed)?;
    let line = arguments.voice.count(all as u64, "runs");
    let mut terminal = Terminal { line, done: 0, interrupt: &interrupt };
    let make = || -> Result<Box<dyn Engine>, Failure> { Ok(engines.engine(&on.name, &on.options)?) };
    let mut set_up = |member: &Member| model.set_up(&with(&given, member)).map_err(Unable::into_failure);
    let result = ensemble.run(&folder, &make, &mut set_up, &mut terminal);
    terminal.line.finish();
    let finished = result.map_err(not_run)?;
    let failed: Vec<&Finished> =
        finished.iter().filter(|finished| matches!(finished.end, End::Failed(_))).collect();
    write_page(&folder, &format!("{}: a sweep", definition.name), &finished)?;
    let best = arguments.maximise.as_deref().map(|observable| best(&finished, observable));
    let best = best.transpose().map_err(Unable::failed)?.flatten();
    let seconds = begin.elapsed();
    let told = Told {
        folder: &folder,
        members: all,
        done: finished.len() - failed.len(),
        failed: failed.len(),
        seconds: seconds.as_secs_f64(),
        best: best.as_ref(),
    };
    arguments.voice.tell(&told, || {
        let mut text = failed.iter().take(TOLD).map(|failed| told_of(failed)).collect::<String>();
        let (done, wall) = (told.done, duration_text(seconds));
        text += &best.iter().map(Best::told).collect::<String>();
        text +=
            &format!("{done} of {all} runs in {wall}\n{}: {MEMBERS}, {SUMMARY}, {PAGE}", folder.display());
        text
    })?;
    if finished.len() < all {
        return Ok(Ended::Interrupted);
    }
    if failed.is_empty() {
        return Ok(Ended::Done);
    }
    Err(Unable::failed(SweepError::Failed { failed: failed.len(), all, table: folder.join(MEMBERS) }))
}

/// The run with the largest value of an observable.
#[derive(Serialize)]
struct Best {
    observable: String,
    value: f64,
    member: Member,
    /// How many runs have it.
    runs: usize,
}

impl Best {
    fn told(&self) -> String {
        let Self { observable, value, member, runs } = self;
        let parameters = member.parameters.iter();
        let parameters: String = parameters.map(|own| format!("{}={}, ", own.parameter, own.value)).collect();
        let others = if *runs > 1 { format!(" (the first of {runs})") } else { String::new() };
        format!("largest {observable}: {value} with {parameters}seed {}{others}\n", member.seed)
    }
}

/// The first of the runs with the largest value; none where no run has a number.
fn best(finished: &[Finished], observable: &str) -> Result<Option<Best>, SweepError> {
    let observed = finished.iter().find(|row| !row.observables.is_empty());
    let names: Vec<&str> =
        observed.iter().flat_map(|row| &row.observables).map(|known| known.name.as_str()).collect();
    let Some(number) = names.iter().position(|name| *name == observable) else {
        let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        return Err(SweepError::NoObservable { wanted: observable.to_owned(), known });
    };
    let value = |row: &Finished| row.observables.get(number).map(|it| it.value).filter(|it| it.is_finite());
    let Some(largest) = finished.iter().filter_map(value).reduce(f64::max) else { return Ok(None) };
    let mut with_it = finished.iter().filter(|row| value(row) == Some(largest));
    let first = with_it.next();
    Ok(first.map(|first| Best {
        observable: observable.to_owned(),
        value: largest,
        member: first.member.clone(),
        runs: 1 + with_it.count(),
    }))
}

/// Draws mean and spread, where a parameter was swept.
fn write_page(folder: &Path, title: &str, finished: &[Finished]) -> Result<(), Unable> {
    let Some(page) = ensemble::page(title, finished).map_err(Unable::Failed)? else { return Ok(()) };
    let folder = LockedFolder::again(folder).map_err(Unable::failed)?;
    write_atomically(&folder.top.file(PAGE), |file| file.write_all(page.as_bytes())).map_err(Unable::failed)
}

/// The parameters that take many values, and those that take one.
fn sorted(given: &Given) -> Result<(Vec<Values>, Vec<Assignment>), SweepError> {
    let (mut swept, mut fixed) = (Vec::new(), Vec::new());
    for assignment in &given.parameters {
        match Values::of(assignment)? {
            Some(values) => swept.push(values),
            None => fixed.push(assignment.clone()),
        }
    }
    Ok((swept, fixed))
}

/// Refuses values that the model does not take before anything is run.
fn check(set_up: &SetUp, swept: &[Values]) -> Result<(), Unable> {
    for Values { parameter, values } in swept {
        let mut model = set_up.model.clone();
        for value in values {
            model.set_parameter(parameter, value).map_err(Unable::refused)?;
        }
    }
    Ok(())
}

/// What is given for a member.
fn with(given: &Given, member: &Member) -> Given {
    let mut given = Given { seed: member.seed, ..given.clone() };
    let own = member.parameters.iter().cloned();
    given.parameters.extend(own.map(|own| Assignment { name: own.parameter, value: own.value }));
    given
}

fn told_of(failed: &Finished) -> String {
    let End::Failed(reason) = &failed.end else { return String::new() };
    let parameters = failed.member.parameters.iter();
    let parameters: String = parameters.map(|own| format!("{}={}, ", own.parameter, own.value)).collect();
    let steps = counted(failed.steps, "step");
    format!("failed after {steps}: {parameters}seed {}: {reason}\n", failed.member.seed)
}

fn not_run(error: EnsembleError) -> Unable {
    match error {
        EnsembleError::Write(_) => Unable::failed(error),
        other => Unable::refused(other),
    }
}
