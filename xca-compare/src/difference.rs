//! The differences of two states: bits and magnitudes.

mod numbers;
mod pairs;
#[cfg(test)]
mod tests;

use super::verdict::Verdict;
use numbers::Numbers;
use pairs::Pairs;
use serde::Serialize;
use std::fmt;
use std::ops::Range;
use xca_checkpoint::components::{state_names, text};
use xca_core::engine::Population;
use xca_core::model::Group;
use xca_core::statistics::Squares;
use xca_core::{GroupSnapshot, Model, Precision, ScalarType, Snapshot, ValueType};

/// A state and its precision.
#[derive(Debug, Clone, Copy)]
pub struct Side<'a> {
    pub snapshot: &'a Snapshot,
    pub precision: Precision,
}

/// The differences of two states.
#[derive(Debug, Clone, Serialize)]
pub struct Differences {
    /// All substates, then the cells of the items of each population, then the parameters that differ.
    pub substates: Vec<Difference>,
    /// Other differences: the number of steps, items that have left.
    pub remarks: Vec<String>,
}

/// The kind of the values that are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Floating-point numbers. They may be rounded differently.
    Float,
    /// Integers. They must be equal.
    Whole,
    /// The cells of items.
    Cell,
}

/// The differences of the values of one substate. Values of different precision are compared in the lower
/// one.
#[derive(Debug, Clone, Serialize)]
pub struct Difference {
    /// The name, as `Struct.field`.
    pub substate: String,
    /// The kind of its values.
    pub kind: Kind,
    /// The number of compared scalars. A vector has several.
    pub values: usize,
    /// The number of scalars whose bits differ.
    pub different: usize,
    /// The number of items that only one state has.
    pub unmatched: usize,
    /// The largest absolute difference. Infinite (`null` in JSON) if one of two values is not finite.
    pub largest_absolute: f64,
    /// The largest difference relative to the larger of the two values.
    pub largest_relative: f64,
    /// The largest distance in representable values (ulp), for floating-point numbers only.
    pub largest_ulp: Option<u64>,
    /// The root mean square of all differences.
    pub rms: f64,
    /// The largest magnitude in the first state. Differences are relative to it.
    pub scale: f64,
    /// The value with the largest absolute difference.
    pub worst: Option<Worst>,
    /// The components that differ, for a vector or an array. Each is like a substate of its own
    /// (`Lava.outflow[3]`).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub components: Vec<Self>,
}

/// A value that differs between two states.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Worst {
    /// The place of the value.
    pub place: Place,
    /// The index of the component among the compared ones.
    #[serde(skip)]
    number: usize,
    /// The suffix of the component's name: `.x`, `[3]`. Empty for a scalar.
    pub component: String,
    /// The value on the first engine.
    pub first: f64,
    /// The value on the other engine.
    pub other: f64,
    /// The names of the two values, if they are states or `bool`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub states: Option<[String; 2]>,
}

impl Worst {
    fn new(place: Place, number: usize, [first, other]: [f64; 2]) -> Self {
        Self { place, number, component: String::new(), first, other, states: None }
    }
}

/// The place of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// The cell with these indices.
    Cell([usize; 3]),
    /// The item with this label.
    Item(u32),
    /// A parameter of the model.
    Parameter,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cell(indices) => write!(f, "cell {indices:?}"),
            Self::Item(label) => write!(f, "item {label}"),
            Self::Parameter => f.write_str("parameter"),
        }
    }
}

impl Difference {
    /// A substate without comparisons.
    fn none(substate: String, kind: Kind) -> Self {
        let largest_ulp = (kind == Kind::Float).then_some(0);
        Self {
            substate,
            kind,
            values: 0,
            different: 0,
            unmatched: 0,
            largest_absolute: 0.0,
            largest_relative: 0.0,
            largest_ulp,
            rms: 0.0,
            scale: 0.0,
            worst: None,
            components: Vec::new(),
        }
    }

    /// This difference, then those of its components.
    pub fn with_components(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(&self.components)
    }

    /// The share of identical bits, from 0 to 1.
    pub fn identical_share(&self) -> f64 {
        if self.values == 0 { 1.0 } else { 1.0 - self.different as f64 / self.values as f64 }
    }

    /// Whether all bits are the same.
    pub fn is_identical(&self) -> bool {
        self.different == 0 && self.unmatched == 0
    }

    /// The root mean square relative to the largest value.
    pub fn relative_rms(&self) -> f64 {
        if self.rms == 0.0 { 0.0 } else { self.rms / self.scale.max(f64::MIN_POSITIVE) }
    }

    fn verdict(&self, tolerance: f64) -> Verdict {
        if self.is_identical() {
            Verdict::Identical
        } else if self.kind == Kind::Float
            && self.unmatched == 0
            && self.largest_absolute <= tolerance * self.scale
        {
            Verdict::Rounding
        } else {
            Verdict::Different
        }
    }

    /// Compares pairs of values. If there are several components, also compares each, and keeps those that
    /// differ.
    fn compare(
        &mut self,
        both: [&Numbers<'_>; 2],
        pairs: &Pairs,
        value_type: ValueType,
        place: &dyn Fn(usize) -> Place,
    ) {
        let suffixes = value_type.component_suffixes();
        self.compare_components(both, pairs, 0..suffixes.len(), place);
        let states = state_names(value_type.scalar);
        let name = |worst: Worst, first: usize| {
            let states = (!states.is_empty()).then(|| [worst.first, worst.other].map(|it| text(&states, it)));
            Worst { component: suffixes[first + worst.number].clone(), states, ..worst }
        };
        self.worst = self.worst.take().map(|worst| name(worst, 0));
        if suffixes.len() == 1 || self.different == 0 {
            return;
        }
        for (component, suffix) in suffixes.iter().enumerate() {
            let mut single = Self::none(format!("{}{suffix}", self.substate), self.kind);
            single.unmatched = self.unmatched;
            single.compare_components(both, pairs, component..component + 1, place);
            single.worst = single.worst.take().map(|worst| name(worst, component));
            if single.different > 0 {
                self.components.push(single);
            }
        }
    }

    fn compare_components(
        &mut self,
        [first, other]: [&Numbers<'_>; 2],
        pairs: &Pairs,
        components: Range<usize>,
        place: &dyn Fn(usize) -> Place,
    ) {
        let all = first.components();
        let (mut squares, mut largest) = (Squares::default(), -1.0);
        for (index, (a, b)) in pairs.iter().enumerate() {
            for (number, component) in components.clone().enumerate() {
                let pair = first.pair(a * all + component, other, b * all + component);
                self.values += 1;
                if pair.first.is_finite() {
                    self.scale = self.scale.max(pair.first.abs());
                }
                if pair.is_identical {
                    continue;
                }
                self.different += 1;
                let absolute = pair.absolute();
                squares.add(absolute);
                self.largest_relative = self.largest_relative.max(pair.relative());
                self.largest_ulp = self.largest_ulp.map(|ulp| ulp.max(pair.ulp));
                if absolute > largest {
                    largest = absolute;
                    self.largest_absolute = absolute;
                    self.worst = Some(Worst::new(place(index), number, [pair.first, pair.other]));
                }
            }
        }
        self.rms = squares.root(self.values.max(1) as f64);
    }
}

impl Differences {
    /// The differences of the second state from the first.
    pub fn between(model: &Model, first: Side<'_>, other: Side<'_>) -> Self {
        let mut differences = Self { substates: Vec::new(), remarks: Vec::new() };
        differences.remark("steps done", first.snapshot.step, other.snapshot.step);
        if first.snapshot.stop != other.snapshot.stop {
            let told = |stop: &Option<String>| stop.clone().unwrap_or_else(|| "goes on".to_owned());
            differences.remark("end of the run", told(&first.snapshot.stop), told(&other.snapshot.stop));
        }
        let mut cells = Vec::new();
        for (index, group) in model.groups().iter().enumerate() {
            match (&first.snapshot.groups[index], &other.snapshot.groups[index]) {
                (GroupSnapshot::Cells(a), GroupSnapshot::Cells(b)) => {
                    let pairs = Pairs::Same(model.geometry().cells());
                    let place = |index| Place::Cell(model.geometry().indices(index));
                    let fields = Fields { group, precisions: [first.precision, other.precision] };
                    differences.fields(&fields, [a, b], &pairs, 0, &place);
                }
                (GroupSnapshot::Population(a, left_a), GroupSnapshot::Population(b, left_b)) => {
                    let name = group.schema().name;
                    differences.remark(&format!("items of {name} that have left"), left_a, left_b);
                    let (pairs, unmatched) = pairs::by_label(a, b);
                    let place = |index: usize| Place::Item(a.labels[pairs.first(index)]);
                    let fields = Fields { group, precisions: [first.precision, other.precision] };
                    differences.fields(&fields, [&a.fields, &b.fields], &pairs, unmatched, &place);
                    cells.push(moved(name, a, b, &pairs));
                }
                _ => differences.remarks.push(format!("{} is of another kind", group.schema().name)),
            }
        }
        differences.substates.extend(cells);
        differences.parameters(model, first, other);
        differences
    }

    fn remark(&mut self, what: &str, first: impl fmt::Display, other: impl fmt::Display) {
        let (first, other) = (first.to_string(), other.to_string());
        if first != other {
            self.remarks.push(format!("{what}: {first} and {other}"));
        }
    }

    fn fields(
        &mut self,
        fields: &Fields<'_>,
        planes: [&Vec<Vec<u8>>; 2],
        pairs: &Pairs,
        unmatched: usize,
        place: &dyn Fn(usize) -> Place,
    ) {
        let schema = fields.group.schema();
        for (index, field) in schema.fields.iter().enumerate() {
            let [a, b] = [0, 1].map(|side| {
                Numbers::new(field.value_type.stored(fields.precisions[side]), &planes[side][index])
            });
            let kind = if a.is_float() { Kind::Float } else { Kind::Whole };
            let mut difference = Difference::none(format!("{}.{}", schema.name, field.name), kind);
            difference.unmatched = unmatched;
            difference.compare([&a, &b], pairs, field.value_type, place);
            self.substates.push(difference);
        }
    }

    /// Compares the parameters, which steering may have changed.
    fn parameters(&mut self, model: &Model, first: Side<'_>, other: Side<'_>) {
        let parameters = model.parameters();
        let values = first.snapshot.parameters.iter().zip(&other.snapshot.parameters);
        for ((field, name), (a, b)) in parameters.fields().zip(parameters.names()).zip(values) {
            if a == b {
                continue;
            }
            let stored = ValueType { scalar: ScalarType::F64, ..field.value_type }.stored(Precision::F64);
            let bytes = [a, b]
                .map(|numbers| numbers.iter().flat_map(|number| number.to_ne_bytes()).collect::<Vec<u8>>());
            let [a, b] = bytes.each_ref().map(|bytes| Numbers::new(stored, bytes));
            let mut difference = Difference::none(format!("parameter {name}"), Kind::Float);
            difference.compare([&a, &b], &Pairs::Same(1), field.value_type, &|_| Place::Parameter);
            self.substates.push(difference);
        }
    }

    /// Whether all bits of all substates are the same.
    pub fn is_identical(&self) -> bool {
        self.verdict(0.0) == Verdict::Identical
    }

    /// The verdict on the second state. Floating-point numbers may differ by `tolerance`, relative to the
    /// largest value of their substate.
    pub fn verdict(&self, tolerance: f64) -> Verdict {
        if !self.remarks.is_empty() {
            return Verdict::Different;
        }
        let of_values = self.substates.iter().filter(|difference| difference.kind != Kind::Cell);
        let of_values = of_values.map(|difference| difference.verdict(tolerance)).max();
        let of_values = of_values.unwrap_or(Verdict::Identical);
        let cells_differ = self
            .substates
            .iter()
            .any(|difference| difference.kind == Kind::Cell && !difference.is_identical());
        // Rounding can move an item near a side of its cell to the next cell. Without rounding, cells must
        // agree.
        if cells_differ && of_values == Verdict::Identical { Verdict::Different } else { of_values }
    }

    /// The gravest difference: the largest relative to the values of its substate.
    pub fn gravest(&self) -> Option<&Difference> {
        let measure = |difference: &Difference| match difference.kind {
            Kind::Cell => 0.0,
            _ => difference.largest_absolute / difference.scale.max(f64::MIN_POSITIVE),
        };
        let different = self.substates.iter().filter(|difference| !difference.is_identical());
        different.max_by(|a, b| measure(a).total_cmp(&measure(b)))
    }
}

/// A group with the precisions of two states.
struct Fields<'a> {
    group: &'a Group,
    precisions: [Precision; 2],
}

/// Compares the cells of the items.
fn moved(name: &str, first: &Population, other: &Population, pairs: &Pairs) -> Difference {
    let mut difference = Difference::none(format!("cells of {name}"), Kind::Cell);
    difference.values = pairs.len();
    if first.counts == other.counts && matches!(pairs, Pairs::Same(_)) {
        return difference;
    }
    let [of_first, of_other] = [first, other].map(cell_of_each);
    for (a, b) in pairs.iter().filter(|(a, b)| of_first[*a] != of_other[*b]) {
        difference.different += 1;
        let cells = [of_first[a] as f64, of_other[b] as f64];
        difference.worst.get_or_insert_with(|| Worst::new(Place::Item(first.labels[a]), 0, cells));
    }
    difference
}

/// The cell of each item.
fn cell_of_each(population: &Population) -> Vec<usize> {
    let counts = population.counts.iter().enumerate();
    counts.flat_map(|(cell, count)| std::iter::repeat_n(cell, *count as usize)).collect()
}
