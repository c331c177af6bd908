//! What was found, as text.

use super::findings::{Findings, Inside};
use super::state::{Place, Spread, Statistics};
use serde_json::Value;
use std::fmt;
use xca_checkpoint::Exact;
use xca_io::numbers::significant;
use xca_report::table::table;

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts: Vec<String> = self.run.iter().map(of_run).collect();
        let kept = self.checkpoints.iter().map(|listed| {
            let problem = listed.problem.as_ref().map(|problem| format!(" (cannot be used: {problem})"));
            format!("  {}{}", listed.path.display(), problem.unwrap_or_default())
        });
        if !self.checkpoints.is_empty() {
            parts.push(format!("checkpoints\n{}", kept.collect::<Vec<_>>().join("\n")));
        }
        parts.extend(self.state.iter().map(ToString::to_string));
        f.write_str(&parts.join("\n\n"))
    }
}

/// What `run.json` says.
fn of_run(report: &Value) -> String {
    let text = |pointer: &str| match report.pointer(pointer) {
        Some(Value::String(text)) => text.clone(),
        Some(value) => value.to_string(),
        None => "?".to_owned(),
    };
    let outcome = match text("/progress/outcome").as_str() {
        "running" => "running, or killed".to_owned(),
        other => other.to_owned(),
    };
    let words = report.pointer("/command_line").and_then(Value::as_array);
    let words = words.into_iter().flatten().filter_map(Value::as_str).collect::<Vec<_>>();
    let resumed = report.pointer("/resumed").and_then(Value::as_array).map_or(0, Vec::len);
    let resumed = match resumed {
        0 => String::new(),
        1 => ", resumed once".to_owned(),
        times => format!(", resumed {times} times"),
    };
    format!(
        "{} {}: {outcome}{resumed}, {} of {} steps, {} frames\n  {}\n  {} engine, threads {}, {}, seed {}, started {}",
        text("/program"),
        text("/version"),
        text("/progress/steps"),
        text("/progress/steps_wanted"),
        text("/progress/frames"),
        words.join(" "),
        text("/engine"),
        text("/threads"),
        text("/precision"),
        text("/seed"),
        text("/started"),
    )
}

impl fmt::Display for Inside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, program, version, step, time, steps_wanted, parameters, substates, places } = self;
        let time = significant(time.0, 6);
        let path = path.display();
        write!(f, "{path}: {program} {version} after {step} of {steps_wanted} steps, time {time}")?;
        for parameter in parameters {
            let unit = parameter.unit.as_ref().map(|unit| format!(" {unit}"));
            write!(f, "\n  {parameter}{}", unit.unwrap_or_default())?;
        }
        write!(f, "\n\n{}", of_substates(substates))?;
        for place in places {
            write!(f, "\n\n{place}")?;
        }
        Ok(())
    }
}

fn of_substates(substates: &[Statistics]) -> String {
    let tables = [of_numbers(substates), of_states(substates)];
    tables.into_iter().flatten().collect::<Vec<_>>().join("\n\n")
}

fn of_numbers(substates: &[Statistics]) -> Option<String> {
    let number = |value: &Option<Exact>| {
        value.as_ref().map_or_else(|| "-".to_owned(), |value| significant(value.0, 6))
    };
    let row = |substate: &Statistics| match &substate.values {
        Spread::Numbers { least, mean, largest, not_numbers } => Some([
            substate.name.clone(),
            substate.value_type.clone(),
            substate.count.to_string(),
            number(least),
            number(mean),
            number(largest),
            if *not_numbers > 0 { not_numbers.to_string() } else { String::new() },
        ]),
        Spread::States { .. } => None,
    };
    let rows: Vec<_> = substates.iter().filter_map(row).collect();
    let last = if rows.iter().any(|row| !row[6].is_empty()) { "NaN" } else { "" };
    let header = ["substate", "type", "count", "least", "mean", "largest", last];
    (!rows.is_empty()).then(|| table(header, rows, &[2, 3, 4, 5, 6]))
}

fn of_states(substates: &[Statistics]) -> Option<String> {
    let mut rows = Vec::new();
    for Statistics { name, value_type, count, values } in substates {
        let Spread::States { states } = values else { continue };
        for (number, state) in states.iter().enumerate() {
            let share = 100.0 * state.count as f64 / (*count).max(1) as f64;
            let [name, value_type] =
                [name, value_type].map(|text| if number == 0 { text.clone() } else { String::new() });
            let share = format!("{} %", significant(share, 4));
            rows.push([name, value_type, state.state.clone(), state.count.to_string(), share]);
        }
    }
    (!rows.is_empty()).then(|| table(["substate", "type", "state", "count", "share"], rows, &[3, 4]))
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { of, cell, label, values } = self;
        f.write_str(of)?;
        if let Some(label) = label {
            write!(f, " {label}")?;
        }
        if let Some([x, y, z]) = cell {
            write!(f, " in cell {x},{y},{z}")?;
        }
        for value in values {
            // All digits: to look at one value is to want to know it.
            let components: Vec<String> = value.components.iter().map(ToString::to_string).collect();
            write!(f, "\n  {} = {}", value.name, components.join(", "))?;
        }
        Ok(())
    }
}
