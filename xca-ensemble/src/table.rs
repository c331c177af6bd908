//! The table of an ensemble, and its mean and spread.

use super::member::{End, Finished, Member};
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use xca_core::statistics::mean_and_deviation;
use xca_io::atomic::{WriteError, write_atomically};
use xca_io::lines::LimitedRows;
use xca_io::regular_file;
use xca_record::Observable;

/// A table that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum TableError {
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error("cannot read the table {}", path.display())]
    Read { path: PathBuf, source: csv::Error },
    #[error("{}:{line}: this row does not belong to this ensemble", path.display())]
    Row { path: PathBuf, line: u64 },
}

/// The columns before the parameters.
const BEFORE: [&str; 2] = ["member", "seed"];
/// The columns between the parameters and the observables.
const BETWEEN: [&str; 3] = ["end", "reason", "steps"];

/// All members that have come to their end.
pub(super) struct Table {
    path: PathBuf,
    parameters: Vec<String>,
    finished: BTreeMap<usize, Finished>,
}

impl Table {
    /// The table of a file, or an empty one. Members that failed are left out, to be tried again.
    pub(super) fn open(path: &Path, members: &[Member]) -> Result<Self, TableError> {
        let parameters = members.first().map(|member| &member.parameters);
        let parameters = parameters.into_iter().flatten().map(|assigned| assigned.parameter.clone());
        let mut table =
            Self { path: path.to_owned(), parameters: parameters.collect(), finished: BTreeMap::new() };
        if path.is_file() {
            table.read(members)?;
        }
        Ok(table)
    }

    fn read(&mut self, members: &[Member]) -> Result<(), TableError> {
        let path = self.path.clone();
        let broken = |source| TableError::Read { path: path.clone(), source };
        let file = regular_file::open(&path).map_err(|error| broken(error.into()))?;
        let mut reader = csv::Reader::from_reader(LimitedRows::new(file));
        let header = reader.headers().map_err(broken)?.clone();
        let wanted = BEFORE.iter().copied().chain(self.parameters.iter().map(String::as_str)).chain(BETWEEN);
        if !wanted.eq(header.iter().take(self.width())) {
            return Err(TableError::Row { path, line: 1 });
        }
        let mut record = csv::StringRecord::new();
        loop {
            reader.get_mut().begin_row();
            if !reader.read_record(&mut record).map_err(broken)? {
                break;
            }
            let line = record.position().map_or(0, csv::Position::line);
            let row = self.row(&header, &record, members);
            let row = row.ok_or_else(|| TableError::Row { path: path.clone(), line })?;
            if !matches!(row.end, End::Failed(_)) {
                self.finished.insert(row.member.number, row);
            }
        }
        Ok(())
    }

    /// The number of columns before the observables.
    fn width(&self) -> usize {
        BEFORE.len() + self.parameters.len() + BETWEEN.len()
    }

    fn row(
        &self,
        header: &csv::StringRecord,
        record: &csv::StringRecord,
        members: &[Member],
    ) -> Option<Finished> {
        let member = members.get(record.get(0)?.parse::<usize>().ok()?)?.clone();
        let values = record.iter().skip(BEFORE.len());
        let same = values.clone().zip(&member.parameters).all(|(text, assigned)| text == assigned.value);
        let is_member = record.get(1)?.parse() == Ok(member.seed) && same;
        let at = BEFORE.len() + self.parameters.len();
        let reason = record.get(at + 1)?.to_owned();
        let end = match record.get(at)? {
            "done" => End::Done,
            "stopped" => End::Stopped(reason),
            "failed" => End::Failed(reason),
            _ => return None,
        };
        let steps = record.get(at + 2)?.parse().ok()?;
        let named = header.iter().zip(record).skip(self.width());
        let observables = match end {
            End::Failed(_) => Vec::new(),
            _ => {
                named.map(|(name, text)| Some(observable(name, text.parse().ok()?))).collect::<Option<_>>()?
            }
        };
        is_member.then_some(Finished { member, end, steps, observables })
    }

    pub(super) fn len(&self) -> usize {
        self.finished.len()
    }

    pub(super) fn has(&self, number: usize) -> bool {
        self.finished.contains_key(&number)
    }

    pub(super) fn finished(&self) -> &BTreeMap<usize, Finished> {
        &self.finished
    }

    pub(super) fn parameters(&self) -> &[String] {
        &self.parameters
    }

    /// Takes in a member. One that has observed other quantities than those before it has failed.
    pub(super) fn insert(&mut self, finished: Finished) {
        let of = |finished: &Finished| finished.observables.iter().map(header_of).collect::<Vec<_>>();
        let names = self.names();
        let is_other = !finished.observables.is_empty() && !names.is_empty() && of(&finished) != names;
        let finished = if is_other {
            let reason =
                format!("its observables are {}, not {}", of(&finished).join(", "), names.join(", "));
            Finished::failed(finished.member, finished.steps, reason)
        } else {
            finished
        };
        self.finished.insert(finished.member.number, finished);
    }

    /// What is observed, as the header says it.
    pub(super) fn names(&self) -> Vec<String> {
        let observed = self.finished.values().find(|finished| !finished.observables.is_empty());
        observed.into_iter().flat_map(|finished| &finished.observables).map(header_of).collect()
    }

    pub(super) fn into_finished(self) -> Vec<Finished> {
        self.finished.into_values().collect()
    }

    /// Writes the table, by member.
    pub(super) fn write(&self) -> Result<(), TableError> {
        let names = self.names();
        let header = BEFORE.iter().map(ToString::to_string).chain(self.parameters.iter().cloned());
        let header = header.chain(BETWEEN.map(str::to_owned)).chain(names.iter().cloned());
        let rows = self.finished.values().map(|finished| cells(finished, names.len()));
        Ok(write(&self.path, std::iter::once(header.collect()).chain(rows))?)
    }
}

/// The cells of a row, with as many observables.
fn cells(finished: &Finished, observables: usize) -> Vec<String> {
    let Finished { member, end, steps, .. } = finished;
    let (end, reason) = match end {
        End::Done => ("done", ""),
        End::Stopped(reason) => ("stopped", reason.as_str()),
        End::Failed(reason) => ("failed", reason.as_str()),
    };
    let mut cells = vec![member.number.to_string(), member.seed.to_string()];
    cells.extend(member.parameters.iter().map(|assigned| assigned.value.clone()));
    cells.extend([end.to_owned(), reason.to_owned(), steps.to_string()]);
    cells.extend(finished.observables.iter().map(|observable| observable.value.to_string()));
    cells.resize(cells.len() + observables - finished.observables.len().min(observables), String::new());
    cells
}

/// `volume (m^3)`.
fn header_of(observable: &Observable) -> String {
    match observable.unit.as_str() {
        "" => observable.name.clone(),
        unit => format!("{} ({unit})", observable.name),
    }
}

/// An observable as it was, but for what only its model knows.
fn observable(header: &str, value: f64) -> Observable {
    let parts = header.strip_suffix(')').and_then(|rest| rest.rsplit_once(" ("));
    let (name, unit) = parts.unwrap_or((header, ""));
    Observable::new(name, unit, value)
}

fn write(path: &Path, rows: impl Iterator<Item = Vec<String>>) -> Result<(), WriteError> {
    write_atomically(path, |file| {
        let mut writer = csv::Writer::from_writer(file);
        for row in rows {
            writer.write_record(row).map_err(io::Error::other)?;
        }
        writer.flush()
    })
}

/// Mean and spread of the observables over the seeds of each combination of parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Summary {
    pub(super) fn of(table: &Table) -> Self {
        let names = table.names();
        let mut header = table.parameters().to_vec();
        header.push("members".to_owned());
        for name in &names {
            let statistics = ["mean", "deviation", "least", "largest"];
            header.extend(statistics.map(|statistic| format!("{name} {statistic}")));
        }
        let row = |group: Vec<&Finished>| {
            let observed: Vec<&Finished> =
                group.iter().copied().filter(|row| !row.observables.is_empty()).collect();
            let mut cells: Vec<String> =
                group[0].member.parameters.iter().map(|assigned| assigned.value.clone()).collect();
            cells.push(observed.len().to_string());
            for number in 0..names.len() {
                let values: Vec<f64> = observed.iter().map(|row| row.observables[number].value).collect();
                cells.extend(statistics(&values));
            }
            cells
        };
        let rows = grouped(table.finished()).into_iter().map(row).collect();
        Self { header, rows }
    }

    pub(super) fn write(self, path: &Path) -> Result<(), WriteError> {
        write(path, std::iter::once(self.header).chain(self.rows))
    }
}

/// Mean, standard deviation of the sample, least and largest; nothing of no values, no deviation of one.
fn statistics(values: &[f64]) -> [String; 4] {
    if values.is_empty() {
        return Default::default();
    }
    let [mean, deviation] = mean_and_deviation(values);
    let deviation = if values.len() > 1 { deviation.to_string() } else { String::new() };
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [mean.to_string(), deviation, least.to_string(), largest.to_string()]
}

/// The rows of one combination of parameters.
pub(super) fn grouped(finished: &BTreeMap<usize, Finished>) -> Vec<Vec<&Finished>> {
    let mut groups: Vec<Vec<&Finished>> = Vec::new();
    for row in finished.values() {
        match groups.last_mut() {
            Some(group) if group[0].member.parameters == row.member.parameters => group.push(row),
            _ => groups.push(vec![row]),
        }
    }
    groups
}
