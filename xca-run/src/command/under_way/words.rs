//! What a run says of itself at its start and at its end.

use super::UnderWay;
use crate::called;
use crate::progress::{self, Diagnostic};
use std::time::Duration;
use xca_core::Model;
use xca_io::numbers::{counted, duration_text, rate_text, significant};
use xca_record::report::Report;

impl UnderWay {
    /// The line at the start.
    pub(super) fn headline(&self) -> String {
        let Report { progress, resumed, .. } = self.recording.report();
        let resumed = (!resumed.is_empty())
            .then(|| format!(", resumed after step {}", self.recording.simulation().step_number()));
        let time_step = progress.time_step.map(|seconds| format!(" of {} s", significant(seconds, 4)));
        format!(
            "{}, {}, {}, {}{}{}{}",
            self.recording.recorder().set_up().title,
            cells(self.recording.recorder().model()),
            engine_words(self.recording.report()),
            if self.known_steps().is_none() { "at most " } else { "" },
            counted(progress.steps_wanted, "step"),
            time_step.unwrap_or_default(),
            resumed.unwrap_or_default(),
        )
    }

    /// What is left of a run that failed.
    pub(super) fn remains(&self) -> String {
        let folder = self.recording.folder().display();
        let done = match self.recording.simulation().step_number() {
            1 => "1 step is done".to_owned(),
            steps => format!("{steps} steps are done"),
        };
        format!("{done}; the output so far is in {folder}")
    }

    fn how_to_go_on(&self) -> String {
        let command = called::resume(&self.recording.report().program, self.recording.folder());
        format!("; continue with `{command}`")
    }

    /// The table of observables, how it ended, and where the files are.
    pub(super) fn summary(&self) -> String {
        let (frames, first, last) = self.recording.recorder().results();
        let pairs = first.iter().zip(last);
        let diagnostics: Vec<Diagnostic> = pairs
            .map(|(first, last)| Diagnostic {
                name: first.name.clone(),
                unit: first.unit.clone(),
                initial: Some(first.value),
                last: Some(last.value),
                drift: first.drift(last.value),
            })
            .collect();
        let progress = &self.recording.report().progress;
        let again = if self.recording.has_checkpoints() {
            self.how_to_go_on()
        } else {
            "; to be able to resume, run with --checkpoint-every".to_owned()
        };
        let end = match (progress.outcome, &progress.reason) {
            ("interrupted", _) => {
                format!("interrupted after {} of {}", progress.steps, counted(progress.steps_wanted, "step"))
            }
            (_, Some(reason)) => format!("{reason}: stopped after {}", counted(progress.steps, "step")),
            _ => counted(progress.steps, "step"),
        };
        let time = progress.time_step.map(|_| format!(", {} s simulated", significant(progress.time, 6)));
        let rate = progress.steps_per_second.map(|rate| format!(", {}", rate_text(rate)));
        let wall = duration_text(Duration::from_secs_f64(progress.wall_seconds));
        let plain =
            self.recording.report().files.iter().filter(|file| !file.contains('*')).map(String::as_str);
        let files: Vec<&str> = plain.chain(["run.json"]).collect();
        format!(
            "\n{}\n\n{end}{} in {wall}{}{}\n{}: {}; {}",
            progress::summary(&diagnostics),
            time.unwrap_or_default(),
            rate.unwrap_or_default(),
            if progress.outcome == "interrupted" { again } else { String::new() },
            self.recording.folder().display(),
            files.join(", "),
            counted(frames as u64, "frame"),
        )
    }
}

/// The engine of a run, and what it runs on.
pub(in crate::command) fn engine_words(report: &Report) -> String {
    let Report { engine, threads, device, precision, .. } = report;
    let fact = |name: &str| device.get(name).and_then(|fact| fact.as_str());
    let means = match (fact("adapter"), fact("arithmetic"), threads) {
        (Some(adapter), Some(arithmetic), _) => format!("on {adapter}, {arithmetic} arithmetic"),
        (.., threads) => format!("with {}", counted(*threads as u64, "thread")),
    };
    format!("{engine} engine {means}, {precision}")
}

/// The number of cells along each axis that has more than one.
fn cells(model: &Model) -> String {
    match model.geometry().extents() {
        [x, y, 1] => format!("{x} x {y} cells"),
        [x, y, z] => format!("{x} x {y} x {z} cells"),
    }
}
