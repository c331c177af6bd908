//! A part of the space, which carries out the commands of the host.

use crate::border::{Link, PartBorder, broken};
use crate::collected::CollectedItems;
use crate::cut::Cut;
use crate::fault::FaultMessage;
use crate::greeting::Greeting;
use crate::message::{Census, Command, Moment, Reply, decode, encode};
use crate::relocation::Relocation;
use crate::rows::items_of_rows;
use crate::shared::Shared;
use crate::traffic::Traffic;
use crate::transport::{Tag, Transport, TransportError};
use serde_bytes::ByteBuf;
use std::any::Any;
use std::collections::BTreeMap;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use xca_core::engine::{
    EngineFailure, Execution, Fault, LabelledItems, Plane, Population, StepContext, SubstateId,
};
use xca_core::model::{Group, GroupKind};
use xca_core::{Engine, Model, ParameterSet, Precision, StartError};

/// A part of the space.
pub(crate) struct Worker {
    model: Model,
    precision: Precision,
    parameters: ParameterSet,
    engine: Arc<dyn Engine>,
    link: Link,
    cut: Cut,
    /// `None` after a start that has failed.
    execution: Option<Box<dyn Execution>>,
    /// Of each group, the items that are to replace those of the execution.
    collected: Vec<CollectedItems>,
    /// The items of populations by label, by their groups, until the state changes.
    by_label: BTreeMap<usize, LabelledItems>,
    traffic: Traffic,
}

impl Worker {
    pub(crate) fn start(engine: Arc<dyn Engine>, shared: &Shared, link: Link) -> Result<Self, StartError> {
        let Shared { model, precision, cut } = shared.clone();
        let (parameters, traffic) = (model.parameters().clone(), Traffic::default());
        let collected = Vec::new();
        let execution = None;
        let by_label = BTreeMap::new();
        let mut worker =
            Self { model, precision, parameters, engine, link, cut, execution, collected, by_label, traffic };
        worker.begin()?;
        Ok(worker)
    }

    /// Starts the part of this worker. The state begins anew.
    fn begin(&mut self) -> Result<(), StartError> {
        let part = self.cut.part(self.link.lock().number());
        let (link, traffic) = (self.link.clone(), self.traffic.clone());
        let border = PartBorder::new(link, self.model.geometry(), &self.cut, traffic);
        let start = || self.engine.start_part(&self.model, self.precision, &part, Box::new(border));
        let execution = catch_unwind(AssertUnwindSafe(start)).unwrap_or_else(|panic| {
            Err(StartError::Other { engine: self.engine.name().to_owned(), reason: text(&*panic) })
        })?;
        self.execution = Some(execution);
        Ok(())
    }

    /// The sizes of the substates of a group, in bytes.
    fn sizes(&self, group: usize) -> Vec<usize> {
        self.model.groups()[group].sizes(self.precision)
    }

    /// The own items of a population by label.
    fn by_label(&mut self, group: usize) -> Result<&LabelledItems, EngineFailure> {
        if !self.by_label.contains_key(&group) {
            let (geometry, part) = (self.model.geometry(), self.cut.part(self.link.lock().number()));
            let cell = |number: usize| geometry.linear(part.indices(geometry, number)) as u32;
            let population = self.execution()?.population(group)?;
            let items = LabelledItems::of(population, &self.sizes(group), cell);
            self.by_label.insert(group, items);
        }
        Ok(&self.by_label[&group])
    }

    /// Moves the bounds of the part: gives others the rows that become theirs, starts anew, and takes what
    /// others give.
    fn move_to(&mut self, cut: Cut) -> Result<(), EngineFailure> {
        let model = self.model.clone();
        let relocation = Relocation::new(self.link.clone(), model.geometry(), &self.cut, &cut);
        let width = model.geometry().extents()[0];
        let sizes: Vec<Vec<usize>> = (0..model.groups().len()).map(|group| self.sizes(group)).collect();
        let mut kept = Vec::with_capacity(sizes.len());
        for ((group, definition), sizes) in model.groups().iter().enumerate().zip(&sizes) {
            let execution = self.execution()?;
            kept.push(match definition.kind() {
                GroupKind::Population { .. } => {
                    Kept::Items(relocation.give_items(&execution.population(group)?, sizes)?)
                }
                GroupKind::Cells { .. } => {
                    let give = |(field, size): (usize, &usize)| {
                        relocation.give(&execution.read(SubstateId { group, field })?, width * size)
                    };
                    Kept::Cells(sizes.iter().enumerate().map(give).collect::<Result<_, _>>()?)
                }
            });
        }
        // There may not be memory for both states.
        self.execution = None;
        self.cut = cut;
        self.begin().map_err(|error| broken(error.to_string()))?;
        for ((group, kept), sizes) in kept.into_iter().enumerate().zip(&sizes) {
            let execution = self.execution_mut()?;
            match kept {
                Kept::Items(own) => {
                    let items = relocation.take_items(own, sizes)?;
                    let set = execution.set_population(group, &items);
                    set.map_err(|fault| broken(format!("its items do not fit: {fault}")))?;
                }
                Kept::Cells(fields) => {
                    for (field, (own, size)) in fields.into_iter().zip(sizes).enumerate() {
                        let values = relocation.take(own, width * size)?;
                        execution.write(SubstateId { group, field }, &values)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn execution(&self) -> Result<&dyn Execution, EngineFailure> {
        self.execution.as_deref().ok_or_else(no_state)
    }

    fn execution_mut(&mut self) -> Result<&mut (dyn Execution + 'static), EngineFailure> {
        self.execution.as_deref_mut().ok_or_else(no_state)
    }

    /// Carries out a command. A panic becomes a failure.
    pub(crate) fn perform(&mut self, command: Command) -> Reply {
        let work = AssertUnwindSafe(|| self.answer(command));
        match catch_unwind(work) {
            Ok(Ok(reply)) => reply,
            Ok(Err(EngineFailure::Elsewhere)) => Reply::Elsewhere { done: 0 },
            Ok(Err(failure)) => Reply::Failed { reason: failure.to_string() },
            Err(panic) => Reply::Failed { reason: text(&*panic) },
        }
    }

    fn answer(&mut self, command: Command) -> Result<Reply, EngineFailure> {
        if !command.is_question() {
            self.by_label.clear();
        }
        Ok(match command {
            Command::Run { processes, moment } => {
                let result = self.run(&moment, |execution, context| execution.run(processes, context))?;
                self.ended(result.map_err(|fault| (0, fault)))
            }
            Command::RunSteps { steps, moment } => {
                let result = self.run(&moment, |execution, context| execution.run_steps(steps, context))?;
                self.ended(result.map_err(|interruption| (interruption.done, interruption.fault)))
            }
            Command::Read { substate } => Reply::Values { values: self.execution()?.read(substate)? },
            Command::Write { substate, values } => {
                self.execution_mut()?.write(substate, &values)?;
                Reply::Done
            }
            Command::ReadCells { substate, cells } => {
                Reply::Values { values: self.execution()?.read_cells(substate, &cells)? }
            }
            Command::WriteCells { substate, cells, values } => {
                self.execution_mut()?.write_cells(substate, &cells, &values)?;
                Reply::Done
            }
            Command::ReduceRows { substate, reduction } => {
                Reply::Rows { rows: self.execution()?.reduce_rows(substate, &reduction)? }
            }
            Command::ReadRows { plane, rows } => self.read_rows(plane, rows)?,
            Command::WriteRows { substate, rows, values } => {
                Reply::Written { is_possible: self.execution_mut()?.write_rows(substate, rows, &values)? }
            }
            Command::Population { group } => {
                Reply::Population { population: self.execution()?.population(group)? }
            }
            Command::SetPopulation { group, population } => {
                let result = self.execution_mut()?.set_population(group, &population);
                self.ended(result.map_err(|fault| (0, fault)))
            }
            Command::CollectItems { plane, begins, bytes } => {
                let groups = self.model.groups().len();
                self.collected.resize_with(groups, CollectedItems::default);
                self.collected[plane.group()].add(plane, begins, &bytes);
                Reply::Done
            }
            Command::SetCollectedItems { group } => {
                let fields = self.model.groups()[group].schema().fields.len();
                let collected = self.collected.get_mut(group).map(std::mem::take).unwrap_or_default();
                match self.execution_mut()?.set_population(group, &collected.population(fields)) {
                    Err(Fault::Engine(EngineFailure::Input(error))) => {
                        Reply::Refused { reason: error.to_string() }
                    }
                    result => self.ended(result.map_err(|fault| (0, fault))),
                }
            }
            Command::LabelCounts { group } => Reply::LabelCounts { counts: self.by_label(group)?.counts() },
            Command::LabelledItems { group, labels } => {
                let sizes = self.sizes(group);
                Reply::LabelledItems { items: self.by_label(group)?.within(labels, &sizes) }
            }
            Command::ItemsOfRows { group } => {
                let counts = self.execution()?.population(group)?.counts;
                Reply::ItemsOfRows { items: items_of_rows(&counts, self.model.geometry().extents()[0]) }
            }
            Command::Census { group } => {
                let execution = self.execution()?;
                let (items, left) = (execution.items(group), execution.left(group));
                let largest_occupancy = execution.largest_occupancy(group)?;
                Reply::Census { census: Census { items, left, largest_occupancy } }
            }
            Command::Work => Reply::Work { work: self.execution()?.work() },
            Command::Move { cut } => {
                self.move_to(cut)?;
                Reply::Done
            }
            Command::Memory => Reply::Memory { bytes: self.execution()?.memory() },
            Command::Figures => {
                let figures = self.execution()?.figures().into_iter();
                let figures = figures.map(|figure| (figure.name, figure.value));
                Reply::Figures { figures: figures.chain(self.traffic.figures()).collect() }
            }
        })
    }

    /// The bytes of a plane in the own ones of these rows.
    fn read_rows(&self, plane: Plane, rows: Range<usize>) -> Result<Reply, EngineFailure> {
        let execution = self.execution()?;
        let bytes = execution.read_rows(plane, rows.clone())?.map(ByteBuf::from);
        let kind = self.model.groups().get(plane.group()).map(Group::kind);
        let of_items =
            matches!(kind, Some(GroupKind::Population { .. })) && !matches!(plane, Plane::Counts(_));
        let counts = match of_items {
            true => execution.read_rows(Plane::Counts(plane.group()), rows)?.unwrap_or_default(),
            false => Vec::new(),
        };
        let counts: Vec<u32> = counts.as_chunks().0.iter().map(|bytes| u32::from_ne_bytes(*bytes)).collect();
        Ok(Reply::BytesOfRows { bytes, items: items_of_rows(&counts, self.model.geometry().extents()[0]) })
    }

    /// Runs processes with the parameters of the host.
    fn run<T>(
        &mut self,
        moment: &Moment,
        work: impl FnOnce(&mut dyn Execution, &StepContext<'_>) -> T,
    ) -> Result<T, EngineFailure> {
        self.parameters.set_bits(&moment.parameters);
        let views = self.parameters.kernel_views(self.precision);
        let context = StepContext {
            step: moment.step,
            seed: moment.seed,
            parameters: &views,
            values: &self.parameters,
        };
        let execution = self.execution.as_deref_mut().ok_or_else(no_state)?;
        Ok(work(execution, &context))
    }

    fn ended(&self, result: Result<(), (u64, Fault)>) -> Reply {
        match result {
            Ok(()) => Reply::Done,
            Err((done, Fault::Engine(EngineFailure::Elsewhere))) => Reply::Elsewhere { done },
            Err((_, Fault::Engine(failure))) => Reply::Failed { reason: failure.to_string() },
            Err((done, fault)) => Reply::Fault { done, fault: FaultMessage::new(&self.model, fault) },
        }
    }
}

fn no_state() -> EngineFailure {
    broken("the part could not start again".to_owned())
}

/// The rows of a group that stay in a part whose bounds move.
enum Kept {
    /// The values of each field.
    Cells(Vec<Vec<u8>>),
    Items(Population),
}

/// The message of a panic.
fn text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    format!("it panicked: {}", text.unwrap_or_else(|| "without a message".to_owned()))
}

/// Runs the part with the transport's number on an engine, by the commands of the host. Ends after the host
/// or after a failure.
pub(crate) fn serve(engine: Arc<dyn Engine>, shared: &Shared, transport: Box<dyn Transport>) {
    let link = Link::new(transport);
    let answer = |reply: &Reply| {
        let bytes = encode(reply).or_else(|reason| encode(&Reply::Failed { reason })).unwrap_or_default();
        link.lock().send(0, Tag::Reply, bytes)
    };
    if link.lock().send(0, Tag::Reply, Greeting::new(shared, engine.name()).bytes()).is_err() {
        return;
    }
    let mut worker = match Worker::start(engine, shared, link.clone()) {
        Ok(worker) => worker,
        Err(error) => {
            // The host has ended, or receives this reply. Nothing is left to do here.
            let _ = answer(&Reply::Failed { reason: error.to_string() });
            return;
        }
    };
    let mut reply = Reply::Done;
    loop {
        let is_last = matches!(reply, Reply::Failed { .. });
        if answer(&reply).is_err() || is_last {
            return;
        }
        let received: Result<Vec<u8>, TransportError> = link.lock().receive(0, Tag::Command);
        let Ok(bytes) = received else { return };
        reply = match decode(&bytes) {
            Ok(command) => worker.perform(command),
            Err(reason) => Reply::Failed { reason },
        };
    }
}
