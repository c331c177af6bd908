//! Differences that are planted into an engine are found where and when they were planted.

use crate::comparison;
use std::ops::Range;
use std::time::Duration;
use xca_compare::{CompareError, Comparison};
use xca_compare::{ComparisonReport, Contender, EngineResult, Subject, Verdict};
use xca_compare::{Kind, Place};
use xca_core::engine::{Execution, Interruption, Population, StepContext, SubstateId};
use xca_core::prelude::*;
use xca_core::reduction::{ReducedRows, Reduction};
use xca_core::{Engine, EngineFailure, Fault, Precision, StartError};
use xca_cpu::Cpu;
use xca_record::{Monitor, Observable, SetUp};

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[derive(Substates, Clone, Copy)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    age: u32,
}

#[elementary_process]
fn diffuse(cell: &mut Cell<Heat>) {
    let mut flux = 0.0;
    for n in 1..cell.neighbour_count() {
        flux += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature += 0.1 * flux;
}

#[elementary_process]
fn move_on(me: &mut Slot<Grain>) {
    me.position.x = me.position.x + 0.0625 * (3.5 - me.position.x);
    me.age += 1;
}

#[migration]
fn reassign(me: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

fn model() -> Model {
    let grain = |label: u32| Item {
        label,
        cell: [label as usize, 1, 0],
        state: Grain { position: Vector3::new(f64::from(label) + 0.5, 1.5, 0.5), age: label },
    };
    Model::builder("plate")
        .extents([7, 5, 3])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .boundary(Boundary::Toroidal)
        .substates::<Heat>()
        .population::<Grain>(8)
        .process(diffuse)
        .process(move_on)
        .process(reassign)
        .fill(|site| {
            let [x, y, _] = site.cell();
            Heat { temperature: (x * x + y) as f64 / 3.0, kind: 1 }
        })
        .initialise(move |state| Ok(state.set_items([5, 2, 0].map(grain).to_vec())?))
        .build()
        .unwrap()
}

/// What is done to a state.
#[derive(Debug, Clone, Copy)]
enum Harm {
    /// A low bit of a substate in a cell with this number is turned.
    Cell(SubstateId, usize),
    /// The lowest bit of a substate of an item with this label is turned.
    Item(SubstateId, u32),
    /// The engine fails.
    Failure,
}

/// The reference engine, but for one bit after one step.
#[derive(Debug)]
struct Harmed {
    harm: Harm,
    after: u64,
}

struct HarmedExecution {
    inner: Box<dyn Execution>,
    harm: Harm,
    after: u64,
}

impl Engine for Harmed {
    fn name(&self) -> &str {
        "harmed"
    }

    fn threads(&self) -> usize {
        1
    }

    fn note(&self) -> Option<String> {
        Some("one <bit> & no more".to_owned())
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        let inner = Reference.start(model, precision)?;
        Ok(Box::new(HarmedExecution { inner, harm: self.harm, after: self.after }))
    }
}

impl HarmedExecution {
    fn do_harm(&mut self) -> Result<(), Fault> {
        match self.harm {
            Harm::Cell(substate, cell) => {
                let mut value = self.inner.read_cells(substate, &[cell])?;
                // Of an f64 not the very lowest, which would be rounded away before the next check.
                let byte = value.len() / 4;
                value[byte] ^= 1;
                self.inner.write_cells(substate, &[cell], &value)?;
            }
            Harm::Item(substate, label) => {
                let mut items = self.inner.population(substate.group)?;
                let place = items.labels.iter().position(|known| *known == label).unwrap();
                let field = &mut items.fields[substate.field];
                let size = field.len() / items.labels.len();
                field[place * size] ^= 1;
                self.inner.set_population(substate.group, &items)?;
            }
            Harm::Failure => {
                return Err(
                    EngineFailure::Broken { engine: "harmed".into(), reason: "it is gone".into() }.into()
                );
            }
        }
        Ok(())
    }
}

impl Execution for HarmedExecution {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        self.inner.run(processes, context)
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        let before = self.after.saturating_sub(context.step);
        if before == 0 || before > steps {
            return self.inner.run_steps(steps, context);
        }
        self.inner.run_steps(before, context)?;
        self.do_harm().map_err(|fault| Interruption { done: before, fault })?;
        let context = StepContext { step: context.step + before, ..*context };
        self.inner.run_steps(steps - before, &context)
    }

    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        self.inner.read(substate)
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        self.inner.write(substate, values)
    }

    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure> {
        self.inner.read_cells(substate, cells)
    }

    fn write_cells(
        &mut self,
        substate: SubstateId,
        cells: &[usize],
        values: &[u8],
    ) -> Result<(), EngineFailure> {
        self.inner.write_cells(substate, cells, values)
    }

    fn population(&self, group: usize) -> Result<Population, EngineFailure> {
        self.inner.population(group)
    }

    fn set_population(&mut self, group: usize, population: &Population) -> Result<(), Fault> {
        self.inner.set_population(group, population)
    }

    fn items(&self, group: usize) -> usize {
        self.inner.items(group)
    }

    fn left(&self, group: usize) -> u64 {
        self.inner.left(group)
    }

    fn largest_occupancy(&self, group: usize) -> Result<u32, EngineFailure> {
        self.inner.largest_occupancy(group)
    }

    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure> {
        self.inner.reduce_rows(substate, reduction)
    }

    fn memory(&self) -> usize {
        self.inner.memory()
    }
}

fn contender(name: &str, engine: impl Engine + 'static, precision: Precision) -> Contender {
    Contender { name: name.to_owned(), engine: Box::new(engine), precision, making: Duration::ZERO }
}

/// Twenty steps, with a check every so many.
fn comparison(set_up: SetUp, every: u64, contenders: impl IntoIterator<Item = Contender>) -> Comparison {
    let [program, title] = ["plate", "A plate <1>"].map(str::to_owned);
    let subject = Subject {
        program,
        version: "0.1".to_owned(),
        title,
        command_line: vec!["plate".to_owned()],
        compiler: Some("rustc 1.95.0"),
        ..Subject::default()
    };
    let comparison = Comparison::new(set_up).unwrap().subject(subject).steps(20).check_every(every);
    contenders.into_iter().fold(comparison.repeats(2).tolerance(1e-9), Comparison::contender)
}

/// The reference engine with a harmed one and the CPU engine.
pub(super) fn with_harm(harm: SubstateOrFailure, after: u64, every: u64) -> ComparisonReport {
    let harm = match harm {
        SubstateOrFailure::Temperature(cell) => Harm::Cell(SubstateId { group: 0, field: 0 }, cell),
        SubstateOrFailure::Kind(cell) => Harm::Cell(SubstateId { group: 0, field: 1 }, cell),
        SubstateOrFailure::Position(label) => Harm::Item(SubstateId { group: 1, field: 0 }, label),
        SubstateOrFailure::Failure => Harm::Failure,
    };
    let contenders = [
        contender("reference", Reference, Precision::F64),
        contender("harmed", Harmed { harm, after }, Precision::F64),
        contender("cpu:2", Cpu::with_threads(2).unwrap(), Precision::F64),
    ];
    comparison(SetUp::new(model(), 1), every, contenders).run(&mut ()).unwrap()
}

/// What is harmed.
pub(super) enum SubstateOrFailure {
    Temperature(usize),
    Kind(usize),
    Position(u32),
    Failure,
}

#[test]
fn a_bit_of_a_cell_is_found_with_its_step() {
    // The steps of the checks, those beside them, and all between.
    for (after, every) in [(1, 7), (6, 7), (7, 7), (8, 7), (13, 20), (20, 20), (11, 1), (19, 6)] {
        let comparison = with_harm(SubstateOrFailure::Temperature(33), after, every);
        let [reference, harmed, cpu] = &comparison.engines[..] else { panic!("three engines") };
        let found = harmed.first_difference.as_ref().unwrap();
        assert_eq!((found.step, found.is_exact), (after, true), "{after} {every}");
        assert_eq!(found.substate.as_deref(), Some("Heat.temperature"));
        // 33 = 5 + 7 * (4 + 5 * 0)
        assert_eq!(found.worst.as_ref().unwrap().place, Place::Cell([5, 4, 0]));
        assert_eq!(harmed.verdict, Some(Verdict::Rounding));
        assert_eq!((reference.verdict, cpu.verdict), (None, Some(Verdict::Identical)));
        assert_eq!((&cpu.first_difference, comparison.verdict), (&None, Verdict::Rounding));
        let differences = harmed.differences.as_ref().unwrap();
        assert!(differences.substates[0].different > 0 && differences.substates[1].is_identical());
        assert_eq!(harmed.history.len() as u64, 1 + 20_u64.div_ceil(every));
        assert!(harmed.remarks.is_empty(), "{:?}", harmed.remarks);
    }
}

#[test]
fn a_whole_number_is_never_rounded() {
    let comparison = with_harm(SubstateOrFailure::Kind(0), 3, 5);
    let harmed = &comparison.engines[1];
    assert_eq!((harmed.verdict, comparison.verdict), (Some(Verdict::Different), Verdict::Different));
    let kind = &harmed.differences.as_ref().unwrap().substates[1];
    assert_eq!((kind.kind, kind.different, kind.values), (Kind::Whole, 1, 105));
    let worst = harmed.first_difference.as_ref().unwrap().worst.as_ref().unwrap();
    assert_eq!([worst.first, worst.other], [1.0, 0.0]);
}

#[test]
fn a_bit_of_an_item_is_found_by_its_label() {
    let comparison = with_harm(SubstateOrFailure::Position(2), 9, 20);
    let harmed = &comparison.engines[1];
    let found = harmed.first_difference.as_ref().unwrap();
    let worst = found.worst.as_ref().unwrap();
    assert_eq!((found.step, worst.place, worst.component.as_str()), (9, Place::Item(2), ".x"));
    assert_eq!(found.substate.as_deref(), Some("Grain.position"));
    let differences = &harmed.differences.as_ref().unwrap().substates;
    let names: Vec<&str> = differences.iter().map(|difference| difference.substate.as_str()).collect();
    assert_eq!(names, ["Heat.temperature", "Heat.kind", "Grain.position", "Grain.age", "cells of Grain"]);
    // One lane of three items with three lanes.
    assert_eq!((differences[2].different, differences[2].values), (1, 9));
    assert_eq!((comparison.updated, comparison.number), ("items", 3));
}

#[test]
fn an_engine_that_fails_differs_and_the_others_go_on() {
    let comparison = with_harm(SubstateOrFailure::Failure, 4, 5);
    let [_, harmed, cpu] = &comparison.engines[..] else { panic!("three engines") };
    assert_eq!((harmed.verdict, cpu.verdict), (Some(Verdict::Different), Some(Verdict::Identical)));
    assert_eq!(harmed.failure.as_deref(), Some("step 5: the harmed engine failed: it is gone"));
    assert_eq!((harmed.step_seconds, cpu.step_seconds.is_some()), (None, true));
    assert!(
        comparison
            .observables
            .iter()
            .all(|observable| { observable.last[1].is_none() && observable.last[0] == observable.last[2] })
    );
}

#[test]
fn states_of_other_precision_are_compared_in_the_coarser_one() {
    let contenders = [
        contender("reference", Reference, Precision::F64),
        contender("single", Reference, Precision::F32),
        contender("again", Cpu::with_threads(1).unwrap(), Precision::F32),
    ];
    let comparison = comparison(SetUp::new(model(), 1), 1, contenders).tolerance(1e-5);
    let comparison = comparison.run(&mut ()).unwrap();
    let [_, single, again] = &comparison.engines[..] else { panic!("three engines") };
    // The initial states are the same once they are rounded.
    assert!(single.history[0].substates.iter().all(|(_, rms)| *rms == 0.0));
    assert!(single.first_difference.as_ref().is_some_and(|difference| difference.step > 0));
    assert_eq!(single.verdict, Some(Verdict::Rounding));
    let strip = |engine: &EngineResult| serde_json::to_value(&engine.differences).unwrap();
    assert_eq!(strip(single), strip(again));
}

/// Ends a comparison after so many steps of all engines.
struct Patience {
    done: u64,
    last: u64,
}

impl Monitor for Patience {
    fn at(&mut self, step: u64) {
        self.done = step;
    }

    fn is_interrupted(&self) -> bool {
        self.done > self.last
    }
}

#[test]
fn a_comparison_can_be_interrupted() {
    let contenders = [contender("reference", Reference, Precision::F64)];
    let comparison = comparison(SetUp::new(model(), 1), 4, contenders);
    for last in [0, 8, 25] {
        let result = comparison.run(&mut Patience { done: 0, last });
        assert!(matches!(result, Err(CompareError::Interrupted)), "{last}");
    }
    let mut patience = Patience { done: 0, last: u64::MAX };
    comparison.run(&mut patience).unwrap();
    assert_eq!(patience.done, comparison.work());
}

#[test]
fn the_drift_of_what_the_model_keeps_is_told() {
    let heat = |state: &State<'_>| state.sum(Heat::TEMPERATURE);
    let set_up = SetUp::new(model(), 1).observables(move |state| {
        let lost = Observable::number("lost", state.count_left::<Grain>()? as f64 + state.step() as f64);
        Ok(vec![
            Observable::number("heat", heat(state)?).conserved(),
            lost.conserved(),
            Observable::number("grown", -10.0 - state.step() as f64).conserved(),
            Observable::number("age", state.sum(Grain::AGE)? as f64),
        ])
    });
    let contenders = [
        contender("reference", Reference, Precision::F64),
        contender("single", Reference, Precision::F32),
        contender("harmed", Harmed { harm: Harm::Failure, after: 4 }, Precision::F64),
    ];
    let comparison = comparison(set_up, 5, contenders).run(&mut ()).unwrap();
    let [of_heat, of_lost, of_grown, of_age] = &comparison.observables[..] else {
        panic!("four observables")
    };
    // (x^2 + y) / 3 over 7 x 5 x 3 cells.
    assert!((of_heat.initial - 525.0).abs() < 1e-9, "{}", of_heat.initial);
    let drift = |engine: usize| of_heat.drift[engine].unwrap();
    assert_eq!(drift(0), (of_heat.last[0].unwrap() - of_heat.initial) / of_heat.initial);
    assert!(drift(0).abs() < 1e-14 && drift(1).abs() < 1e-5 && drift(1) != 0.0, "{} {}", drift(0), drift(1));
    // From 0 it is counted as it is; an engine that fails has none.
    assert_eq!(of_lost.drift, [Some(20.0), Some(20.0), None]);
    // From -10 to -30 it is twice as much, downwards.
    assert_eq!(of_grown.drift, [Some(-2.0), Some(-2.0), None]);
    assert!(of_age.drift.is_empty());
    let text = comparison::text(&comparison);
    let row = text.lines().find(|line| line.contains("lost: drift")).unwrap();
    assert_eq!(row.split_whitespace().collect::<Vec<_>>(), ["lost:", "drift", "20", "20", "–"]);
}
