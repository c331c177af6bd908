//! The tables of a comparison with all digits, for other programs.

use super::error::ReportError;
use csv::Writer;
use xca_compare::ComparisonReport;
use xca_compare::Difference;
use xca_compare::Spread;

/// The files.
pub(super) const NAMES: [&str; 4] = ["engines.csv", "differences.csv", "divergence.csv", "observables.csv"];

type Rows = Vec<Vec<String>>;

/// All files with what they hold.
pub(super) fn all(comparison: &ComparisonReport) -> Result<Vec<(&'static str, Vec<u8>)>, ReportError> {
    let tables =
        [engines(comparison), differences(comparison), divergence(comparison), observables(comparison)];
    NAMES.into_iter().zip(tables).map(|(name, rows)| Ok((name, written(rows)?))).collect()
}

fn written(rows: Rows) -> Result<Vec<u8>, ReportError> {
    let mut writer = Writer::from_writer(Vec::new());
    for row in rows {
        writer.write_record(row)?;
    }
    writer.into_inner().map_err(|error| ReportError::Csv(error.into_error().into()))
}

fn header(names: &str) -> Vec<String> {
    names.split(',').map(str::to_owned).collect()
}

fn text(value: Option<impl ToString>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

fn engines(comparison: &ComparisonReport) -> Rows {
    let mut rows = vec![header(
        "engine,threads,adapter,precision,set_up_s,state_in_s,state_out_s,step_s,step_s_least,step_s_largest,\
         updates_per_s,speed_up,state_bytes,verdict,first_different_step",
    )];
    let median = |spread: Option<Spread>| text(spread.map(|spread| spread.median));
    rows.extend(comparison.engines.iter().map(|engine| {
        vec![
            engine.name.clone(),
            engine.threads.to_string(),
            text(engine.fact("adapter")),
            engine.precision.to_string(),
            engine.set_up_seconds.to_string(),
            median(engine.state_in_seconds),
            median(engine.state_out_seconds),
            median(engine.step_seconds),
            text(engine.step_seconds.map(|step| step.least)),
            text(engine.step_seconds.map(|step| step.largest)),
            text(engine.updates_per_second),
            text(engine.speed_up),
            engine.state_bytes.to_string(),
            text(engine.verdict),
            text(engine.first_difference.as_ref().map(|difference| difference.step)),
        ]
    }));
    rows
}

fn differences(comparison: &ComparisonReport) -> Rows {
    let mut rows = vec![header(
        "engine,substate,values,different,unmatched,largest_absolute,largest_relative,largest_ulp,rms,scale,worst_in,\
         worst_first,worst_other",
    )];
    for engine in &comparison.engines {
        let substates = engine.differences.iter().flat_map(|differences| &differences.substates);
        rows.extend(substates.flat_map(Difference::with_components).map(|difference| {
            let worst = difference.worst.as_ref();
            vec![
                engine.name.clone(),
                difference.substate.clone(),
                difference.values.to_string(),
                difference.different.to_string(),
                difference.unmatched.to_string(),
                difference.largest_absolute.to_string(),
                difference.largest_relative.to_string(),
                text(difference.largest_ulp),
                difference.rms.to_string(),
                difference.scale.to_string(),
                text(worst.map(|worst| worst.place)),
                text(worst.map(|worst| worst.first)),
                text(worst.map(|worst| worst.other)),
            ]
        }));
    }
    rows
}

fn divergence(comparison: &ComparisonReport) -> Rows {
    let mut rows = vec![header("engine,step,substate,relative_rms")];
    for engine in &comparison.engines {
        for check in &engine.history {
            let row = |(substate, rms): &(String, f64)| {
                vec![engine.name.clone(), check.step.to_string(), substate.clone(), rms.to_string()]
            };
            rows.extend(check.substates.iter().map(row));
        }
    }
    rows
}

fn observables(comparison: &ComparisonReport) -> Rows {
    let mut rows = vec![header("engine,observable,unit,start,end,drift")];
    for (index, engine) in comparison.engines.iter().enumerate() {
        rows.extend(comparison.observables.iter().map(|observable| {
            let (name, unit) = (observable.name.clone(), observable.unit.clone());
            vec![
                engine.name.clone(),
                name,
                unit,
                observable.initial.to_string(),
                text(observable.last[index]),
                text(observable.drift.get(index).copied().flatten()),
            ]
        }));
    }
    rows
}
