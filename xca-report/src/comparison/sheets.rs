//! The tables and sentences that all forms of the report share.

use xca_compare::FirstDifference;
use xca_compare::Spread;
use xca_compare::{ComparisonReport, EngineResult};
use xca_compare::{Difference, Kind};
use xca_io::numbers::{counted, significant};

/// What has to be known where engines differ.
pub(super) const CHAOS: &str = "Where engines differ, how far they are apart says little about their quality: a system \
     of collisions is chaotic and makes a rounding difference some ten times larger with each collision, so that after fewer than \
     twenty of them only identical bits have stayed identical. What still must agree are the quantities of the whole, such as energies.";

/// A table.
#[derive(Debug)]
pub(super) struct Sheet {
    pub(super) title: &'static str,
    pub(super) header: Vec<String>,
    /// The columns that hold numbers.
    pub(super) right: Vec<usize>,
    pub(super) rows: Vec<Vec<String>>,
}

/// What a table shows where there is nothing to tell.
const DASH: &str = "–";

impl Sheet {
    /// The columns with these numbers, without those that tell nothing.
    fn columns(&self, columns: &[usize]) -> Self {
        let has_content = |column: &usize| self.rows.iter().any(|row| row[*column] != DASH);
        let columns: Vec<usize> = columns.iter().copied().filter(has_content).collect();
        let of = |row: &Vec<String>| columns.iter().map(|column| row[*column].clone()).collect();
        let is_right = |place: &usize| self.right.contains(&columns[*place]);
        Self {
            title: self.title,
            header: of(&self.header),
            right: (0..columns.len()).filter(is_right).collect(),
            rows: self.rows.iter().map(of).collect(),
        }
    }
}

fn words<const N: usize>(words: [&str; N]) -> Vec<String> {
    words.map(str::to_owned).to_vec()
}

pub(super) fn all(comparison: &ComparisonReport) -> Vec<Sheet> {
    let sheets = [engines(comparison), work(comparison), differences(comparison), observables(comparison)];
    sheets.into_iter().filter(|sheet| !sheet.rows.is_empty()).collect()
}

/// The tables for a terminal. The engines have two, as one would be too wide: times, and what else they take.
pub(super) fn narrow(comparison: &ComparisonReport) -> Vec<Sheet> {
    let mut sheets = all(comparison);
    if sheets.first().is_some_and(|sheet| sheet.title == TIMES) {
        let engines = sheets.remove(0);
        sheets.splice(0..0, [&[0, 1, 6, 7, 8, 9][..], &[0, 2, 3, 4, 5, 10]].map(|it| engines.columns(it)));
    }
    sheets
}

const TIMES: &str = "Times, speed-up and memory";

pub(super) fn headline(comparison: &ComparisonReport) -> String {
    let times = match comparison.repeats {
        1 => "once".to_owned(),
        repeats => format!("{repeats} times"),
    };
    format!(
        "{}: {} of {} {} on {}, timed {times}",
        comparison.subject.title,
        counted(comparison.steps, "step"),
        comparison.number,
        comparison.updated,
        counted(comparison.engines.len() as u64, "engine"),
    )
}

/// The unit in which a time is told, and how many of it a second has.
pub(super) fn unit_of(seconds: f64) -> (f64, &'static str) {
    match seconds {
        ..1e-3 => (1e6, "µs"),
        ..1.0 => (1e3, "ms"),
        _ => (1.0, "s"),
    }
}

/// A time for people.
pub(super) fn seconds(seconds: f64) -> String {
    let (factor, unit) = unit_of(seconds);
    format!("{} {unit}", significant(seconds * factor, 3))
}

fn spread(spread: Option<Spread>) -> [String; 2] {
    match spread {
        Some(Spread { median, least, largest }) => {
            [seconds(median), format!("{} – {}", seconds(least), seconds(largest))]
        }
        None => words([DASH, DASH]).try_into().unwrap_or_default(),
    }
}

fn bytes(bytes: usize) -> String {
    let (factor, unit) = match bytes {
        0..1000 => (1.0, "B"),
        1000..1_000_000 => (1e-3, "kB"),
        1_000_000..1_000_000_000 => (1e-6, "MB"),
        _ => (1e-9, "GB"),
    };
    format!("{} {unit}", significant(bytes as f64 * factor, 3))
}

fn or_dash(value: Option<String>) -> String {
    value.unwrap_or_else(|| DASH.to_owned())
}

fn engines(comparison: &ComparisonReport) -> Sheet {
    let row = |engine: &EngineResult| {
        let [step, range] = spread(engine.step_seconds);
        let transfer = engine.state_in_seconds.zip(engine.state_out_seconds);
        vec![
            engine.name.clone(),
            engine.threads.to_string(),
            or_dash(engine.fact("adapter").map(str::to_owned)),
            engine.precision.to_string(),
            seconds(engine.set_up_seconds),
            or_dash(transfer.map(|(put, get)| format!("{} / {}", seconds(put.median), seconds(get.median)))),
            step,
            range,
            or_dash(engine.updates_per_second.map(|rate| format!("{rate:.3e}"))),
            or_dash(engine.speed_up.map(|speed_up| significant(speed_up, 3))),
            bytes(engine.state_bytes),
        ]
    };
    let mut header = words([
        "engine",
        "threads",
        "adapter",
        "precision",
        "set-up",
        "state in / out",
        "time a step",
        "least – largest",
        "",
        "speed-up",
        "state",
    ]);
    header[8] = format!("{}/s", comparison.updated);
    let rows = comparison.engines.iter().map(row).collect();
    Sheet { title: TIMES, header, right: vec![1, 4, 5, 6, 7, 8, 9, 10], rows }
}

/// What engines tell of their work.
fn work(comparison: &ComparisonReport) -> Sheet {
    let rows = comparison.engines.iter().flat_map(|engine| {
        let figures = engine.engine_figures.iter();
        figures.map(|(name, value)| vec![engine.name.clone(), name.replace('_', " "), number(*value)])
    });
    let header = words(["engine", "of its work", ""]);
    Sheet { title: "Work of the engines", header, right: vec![2], rows: rows.collect() }
}

/// A share, which is 100 % only if nothing is missing.
fn share(share: f64) -> String {
    if share == 1.0 { "100 %".to_owned() } else { format!("{:.4} %", (share * 100.0).min(99.9999)) }
}

fn number(value: f64) -> String {
    significant(value, 3)
}

fn differences(comparison: &ComparisonReport) -> Sheet {
    let row = |engine: &EngineResult, difference: &Difference| {
        let of_numbers =
            |value: f64| if difference.kind == Kind::Cell { DASH.to_owned() } else { number(value) };
        let mut place = or_dash(difference.worst.as_ref().map(|worst| worst.place.to_string()));
        if difference.unmatched > 0 {
            place = format!("{} in one state only", counted(difference.unmatched as u64, "item"));
        }
        vec![
            engine.name.clone(),
            difference.substate.clone(),
            share(difference.identical_share()),
            of_numbers(difference.largest_absolute),
            of_numbers(difference.largest_relative),
            or_dash(difference.largest_ulp.map(|ulp| ulp.to_string())),
            of_numbers(difference.rms),
            place,
        ]
    };
    let rows = comparison.engines.iter().flat_map(|engine| {
        let differences = engine.differences.iter().flat_map(|differences| &differences.substates);
        let all = differences.flat_map(Difference::with_components);
        all.map(|difference| row(engine, difference)).collect::<Vec<_>>()
    });
    Sheet {
        title: "Differences from the first engine after the last step",
        header: words([
            "engine",
            "substate",
            "identical bits",
            "largest absolute",
            "relative",
            "ulp",
            "RMS",
            "worst in",
        ]),
        right: vec![2, 3, 4, 5, 6],
        rows: rows.collect(),
    }
}

fn observables(comparison: &ComparisonReport) -> Sheet {
    let names = comparison.engines.iter().map(|engine| format!("end on {}", engine.name));
    let rows = comparison.observables.iter().flat_map(|observable| {
        let name = match observable.unit.as_str() {
            "" => observable.name.clone(),
            unit => format!("{} [{unit}]", observable.name),
        };
        let numbers = |of: &[Option<f64>], digits: usize| -> Vec<String> {
            of.iter().map(|number| or_dash(number.map(|number| significant(number, digits)))).collect()
        };
        let values =
            [vec![name, significant(observable.initial, 10)], numbers(&observable.last, 10)].concat();
        let drift =
            [vec![format!("{}: drift", observable.name), String::new()], numbers(&observable.drift, 2)];
        let drift = (!observable.drift.is_empty()).then(|| drift.concat());
        [values].into_iter().chain(drift)
    });
    Sheet {
        title: "Observables at the start and at the end",
        header: words(["observable", "start"]).into_iter().chain(names).collect(),
        right: (1..2 + comparison.engines.len()).collect(),
        rows: rows.collect(),
    }
}

/// What has to be known of engines.
pub(super) fn notes(comparison: &ComparisonReport) -> Vec<String> {
    let notes = comparison.engines.iter();
    notes.filter_map(|engine| Some(format!("{}: {}", engine.name, engine.note.as_ref()?))).collect()
}

/// A sentence for each engine that is compared.
pub(super) fn findings(comparison: &ComparisonReport) -> Vec<String> {
    let first = comparison.first_name();
    let engines = comparison.engines.iter();
    engines
        .filter_map(|engine| {
            Some(format!("{} is {}: {}", engine.name, engine.verdict?, finding(engine, first)))
        })
        .collect()
}

/// What follows an engine's verdict.
pub(super) fn finding(engine: &EngineResult, first: &str) -> String {
    let mut parts = Vec::new();
    if let Some(failure) = &engine.failure {
        parts.push(format!("it failed: {failure}"));
    }
    parts.extend(engine.first_difference.as_ref().map(|difference| parting(difference, first)));
    parts.extend(engine.remarks.iter().cloned());
    parts.extend(engine.differences.iter().flat_map(|differences| differences.remarks.iter().cloned()));
    if parts.is_empty() {
        let checks = engine.history.len();
        parts.push(format!("the same bits as {first} in all of {checks} states"));
    }
    parts.join("; ")
}

fn parting(difference: &FirstDifference, first: &str) -> String {
    let step = match (difference.step, difference.is_exact) {
        (0, _) => format!("it differs from {first} before the first step"),
        (step, true) => format!("it differs from {first} from step {step} on"),
        (step, false) => {
            format!("it was seen to differ from {first} after step {step}, but not when it was run again")
        }
    };
    let component = difference.worst.as_ref().map_or("", |worst| &worst.component);
    let substate = difference.substate.as_ref().map(|substate| format!(", most in {substate}{component}"));
    let worst = difference.worst.as_ref().map(|worst| {
        let numbers = || [worst.first, worst.other].map(|number| format!("{number:?}"));
        let [first, other] = worst.states.clone().unwrap_or_else(numbers);
        format!(" of {} ({first} and {other})", worst.place)
    });
    [Some(step), substate, worst].into_iter().flatten().collect()
}

/// What was compared, where and when.
pub(super) fn circumstances(comparison: &ComparisonReport) -> Vec<(&'static str, String)> {
    let ComparisonReport { subject, .. } = comparison;
    let known = |name: &'static str, value: Option<String>| value.map(|value| (name, value));
    let memory = |bytes: u64| bytes_of_machine(bytes);
    let drivers = comparison.engines.iter().filter_map(|engine| {
        Some(format!(
            "{} ({}, {})",
            engine.fact("adapter")?,
            engine.fact("driver")?,
            engine.fact("interface")?
        ))
    });
    let mut drivers: Vec<String> = drivers.collect();
    drivers.dedup();
    let facts = [
        known("program", Some(format!("{} {}, xca {}", subject.program, subject.version, comparison.xca))),
        known("steps", Some(format!("{}, compared every {}", comparison.steps, comparison.check_every))),
        known("rounding", Some(format!("at most {:e} of the largest value", comparison.tolerance))),
        known("processor", comparison.hardware.clone()),
        known("cores", comparison.host.cores.map(|cores| cores.to_string())),
        known("memory", comparison.memory_bytes.map(memory)),
        known("most memory used", comparison.peak_memory_bytes.map(memory)),
        known("adapter", (!drivers.is_empty()).then(|| drivers.join("; "))),
        known("system", Some(format!("{} on {}", comparison.host.system, comparison.host.processor))),
        known("compiler", comparison.subject.compiler.map(str::to_owned)),
        known("commit", comparison.subject.commit.map(str::to_owned)),
        known("command line", Some(subject.command_line.join(" "))),
        known("ended", Some(comparison.ended.clone())),
    ];
    facts.into_iter().flatten().collect()
}

fn bytes_of_machine(number: u64) -> String {
    bytes(usize::try_from(number).unwrap_or(usize::MAX))
}
