//! The host: presents the state of all parts to a simulation.

mod counts;

use crate::balance::{Balance, Balancer, Cost};
use crate::cells::CellsOfPart;
use crate::collected::numbers;
use crate::crew::Crew;
use crate::cut::Cut;
use crate::message::{Command, Moment, Reply};
use crate::rows::{Lengths, Rows};
use crate::shared::Shared;
use crate::transport::Transport;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use xca_core::engine::{
    EngineFailure, Execution, Fault, Figure, InputError, Interruption, LabelledItems, Part, Plane,
    Population, StepContext, SubstateId, check_cells, check_plane, check_population, check_substate,
    check_values, check_values_of_cells, check_values_of_rows,
};
use xca_core::model::GroupKind;
use xca_core::reduction::{Reduced, ReducedRows, Reduction};
use xca_core::{Engine, StartError};

/// A model in parts. The first part belongs to the host itself.
pub(crate) struct Host {
    shared: Shared,
    rows: Rows,
    crew: Mutex<Crew>,
    balancer: Balancer,
    /// Of each population, the items that left the space before the bounds of parts moved.
    left: Vec<u64>,
    /// Of each population, the items that were set. There are no more than these.
    items: Vec<usize>,
    /// Of each population, the numbers of items in the rows that are collected.
    collected: Vec<Vec<usize>>,
    /// The threads of other parts in this process. They end after the host.
    threads: Vec<JoinHandle<()>>,
}

impl Host {
    /// Starts the own part, and waits until the others have started.
    pub(crate) fn start(
        engine: Arc<dyn Engine>,
        shared: Shared,
        balance: Balance,
        transport: Box<dyn Transport>,
        threads: Vec<JoinHandle<()>>,
    ) -> Result<Self, StartError> {
        let crew = Mutex::new(Crew::start(engine, &shared, transport)?);
        let rows = Rows::new(shared.model.geometry(), &shared.cut);
        let balancer = Balancer::new(&shared.model, balance);
        let groups = shared.model.groups().len();
        let (left, items, collected) = (vec![0; groups], vec![0; groups], vec![Vec::new(); groups]);
        Ok(Self { shared, rows, crew, balancer, left, items, collected, threads })
    }

    fn crew(&self) -> MutexGuard<'_, Crew> {
        self.crew.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Gives all parts the same command.
    fn ask(&self, command: &Command) -> Result<Vec<Reply>, EngineFailure> {
        self.crew().ask(vec![command.clone(); self.shared.cut.count()])
    }

    /// Gives each part a command that changes its state.
    fn change(&self, commands: Vec<Command>) -> Result<(), EngineFailure> {
        self.crew().ask(commands).map(drop)
    }

    /// Lets all parts run processes. A fault includes the number of steps done before it.
    fn run_all(&self, command: &Command) -> Result<(), Interruption> {
        let interruption = |failure| Interruption { done: 0, fault: Fault::Engine(failure) };
        let replies = self.ask(command).map_err(interruption)?;
        let mut stopped = None;
        for reply in replies {
            match reply {
                Reply::Fault { done, fault } => {
                    return Err(Interruption { done, fault: fault.fault(&self.shared.model) });
                }
                Reply::Elsewhere { done } => stopped = Some(done),
                Reply::Done => {}
                _ => return Err(interruption(self.garbled())),
            }
        }
        stopped.map_or(Ok(()), |done| {
            let failure = self.crew().fail("a part has stopped, and none tells why".to_owned());
            Err(Interruption { done, fault: Fault::Engine(failure) })
        })
    }

    fn garbled(&self) -> EngineFailure {
        self.crew().fail("the parts answer what was not asked".to_owned())
    }

    /// The size of a substate in a cell, in bytes.
    fn size(&self, substate: SubstateId) -> usize {
        self.shared.model.stored(substate, self.shared.precision).size()
    }

    /// The sizes of the substates of a group in an item, in bytes.
    fn sizes(&self, group: usize) -> Vec<usize> {
        let group = self.shared.model.groups().get(group);
        group.map(|group| group.sizes(self.shared.precision)).unwrap_or_default()
    }

    fn is_population(&self, group: usize) -> bool {
        let group = self.shared.model.groups().get(group);
        group.is_some_and(|group| matches!(group.kind(), GroupKind::Population { .. }))
    }

    /// The size of each row of a substate, in bytes.
    fn lengths<'a>(&self, substate: SubstateId, items: &'a Option<Vec<usize>>) -> Lengths<'a> {
        self.row_lengths(self.size(substate), items)
    }

    /// The size of each row of values of so many bytes. `items` are the numbers in the rows, of a population.
    fn row_lengths<'a>(&self, size: usize, items: &'a Option<Vec<usize>>) -> Lengths<'a> {
        match items {
            Some(items) => Lengths::Each(items, size),
            None => Lengths::Same(self.shared.model.geometry().extents()[0] * size),
        }
    }

    /// Moves the bounds of parts if that pays.
    fn balance(&mut self) -> Result<(), EngineFailure> {
        if self.shared.cut.count() == 1 {
            return Ok(());
        }
        let [width, height, depth] = self.shared.model.geometry().extents();
        let items = self.items.iter().map(|items| *items as u64).sum();
        let cost = Cost { cells: (width * height * depth) as u64, items };
        let mut cut = self.balancer.expect(&self.shared.model, &self.shared.cut, cost);
        if cut.is_none() && self.balancer.steps_left() == 0 {
            let work = self.work()?;
            cut = self.balancer.look(&self.shared.model, &self.shared.cut, &work, cost);
        }
        cut.map_or(Ok(()), |cut| self.move_bounds(cut))
    }

    /// Moves the bounds of parts. The parts give each other their rows, and start anew with these. An
    /// execution has no other memory, so nothing else changes.
    fn move_bounds(&mut self, cut: Cut) -> Result<(), EngineFailure> {
        for group in 0..self.left.len() {
            self.left[group] = self.census(group)?.left;
        }
        self.ask(&Command::Move { cut: cut.clone() })?;
        self.rows = Rows::new(self.shared.model.geometry(), &cut);
        self.shared.cut = cut;
        self.balancer.moved();
        Ok(())
    }

    /// Gives each part its items of a population.
    fn scatter_items(&self, group: usize, population: &Population) -> Result<(), EngineFailure> {
        let parts = self.rows.scatter_items(population, &self.sizes(group));
        let command = |population| Command::SetPopulation { group, population };
        self.change(parts.into_iter().map(command).collect())
    }

    fn values(&self, replies: Vec<Reply>) -> Result<Vec<Vec<u8>>, EngineFailure> {
        let values = |reply| match reply {
            Reply::Values { values } => Some(values),
            _ => None,
        };
        replies.into_iter().map(values).collect::<Option<_>>().ok_or_else(|| self.garbled())
    }
}

/// The bounds of a part, for reports.
fn bounds(number: usize, part: &Part) -> [(String, f64); 4] {
    let all =
        [("y_start", part.y.start), ("y_end", part.y.end), ("z_start", part.z.start), ("z_end", part.z.end)];
    all.map(|(name, bound)| (format!("part_{number}_{name}"), bound as f64))
}

impl Execution for Host {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        let command = Command::Run { processes, moment: Moment::new(context) };
        self.run_all(&command).map_err(|interruption| interruption.fault)
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        let mut done = 0;
        while done < steps {
            let stopped = |failure| Interruption { done, fault: Fault::Engine(failure) };
            self.balance().map_err(stopped)?;
            // The work is looked at between batches of steps.
            let batch = self.balancer.steps_left().clamp(1, steps - done);
            let moment = Moment::new(&StepContext { step: context.step + done, ..*context });
            self.run_all(&Command::RunSteps { steps: batch, moment })
                .map_err(|stopped| Interruption { done: done + stopped.done, ..stopped })?;
            self.balancer.stepped(batch);
            done += batch;
        }
        Ok(())
    }

    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure> {
        check_substate(&self.shared.model, substate)?;
        let items = self.items_of_rows(substate.group)?;
        let parts = self.values(self.ask(&Command::Read { substate })?)?;
        let whole = self.rows.gather(&parts, self.lengths(substate, &items));
        whole.ok_or_else(|| self.garbled())
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        let Shared { model, precision, .. } = &self.shared;
        check_substate(model, substate)?;
        let items = self.items_of_rows(substate.group)?;
        let count = items.iter().flatten().sum();
        check_values(model, *precision, substate, count, values)?;
        let parts = self.rows.scatter(values, self.lengths(substate, &items));
        self.change(parts.into_iter().map(|values| Command::Write { substate, values }).collect())
    }

    fn write_rows(
        &mut self,
        substate: SubstateId,
        rows: Range<usize>,
        values: &[u8],
    ) -> Result<bool, EngineFailure> {
        let Shared { model, precision, .. } = &self.shared;
        check_values_of_rows(model, *precision, substate, rows.len(), values)?;
        let parts = self.rows.scatter_rows(rows.clone(), values, self.lengths(substate, &None));
        let command = |values| Command::WriteRows { substate, rows: rows.clone(), values };
        let written = |reply| matches!(reply, Reply::Written { is_possible: true });
        Ok(self.crew().ask(parts.into_iter().map(command).collect())?.into_iter().all(written))
    }

    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure> {
        check_cells(&self.shared.model, substate, cells)?;
        let parts = CellsOfPart::all(self.shared.model.geometry(), &self.shared.cut, cells);
        let command = |part: &CellsOfPart| Command::ReadCells { substate, cells: part.cells.clone() };
        let replies = self.crew().ask(parts.iter().map(command).collect())?;
        let size = self.size(substate);
        let mut all = vec![0; cells.len() * size];
        for (part, values) in parts.iter().zip(self.values(replies)?) {
            if values.len() != part.places.len() * size {
                return Err(self.garbled());
            }
            for (place, value) in part.places.iter().zip(values.chunks_exact(size)) {
                all[place * size..(place + 1) * size].copy_from_slice(value);
            }
        }
        Ok(all)
    }

    fn write_cells(
        &mut self,
        substate: SubstateId,
        cells: &[usize],
        values: &[u8],
    ) -> Result<(), EngineFailure> {
        check_values_of_cells(&self.shared.model, self.shared.precision, substate, cells, values)?;
        let size = self.size(substate);
        let command = |part: CellsOfPart| {
            let values = part.places.iter().flat_map(|place| &values[place * size..(place + 1) * size]);
            Command::WriteCells { substate, values: values.copied().collect(), cells: part.cells }
        };
        let parts = CellsOfPart::all(self.shared.model.geometry(), &self.shared.cut, cells);
        self.change(parts.into_iter().map(command).collect())
    }

    fn read_rows(&self, plane: Plane, rows: Range<usize>) -> Result<Option<Vec<u8>>, EngineFailure> {
        check_plane(&self.shared.model, plane)?;
        let (mut bytes, mut items) = (Vec::new(), Vec::new());
        for reply in self.ask(&Command::ReadRows { plane, rows: rows.clone() })? {
            let Reply::BytesOfRows { bytes: of_part, items: in_part } = reply else {
                return Err(self.garbled());
            };
            let Some(of_part) = of_part else { return Ok(None) };
            bytes.push(of_part.into_vec());
            items.push(in_part);
        }
        let size = match plane {
            Plane::Values(substate) => self.size(substate),
            Plane::Counts(_) | Plane::Labels(_) => size_of::<u32>(),
        };
        let items = if matches!(plane, Plane::Counts(_)) || !self.is_population(plane.group()) {
            None
        } else {
            let items = self.rows.gather_rows(rows.clone(), &items, Lengths::Same(1));
            Some(items.ok_or_else(|| self.garbled())?)
        };
        let whole = self.rows.gather_rows(rows, &bytes, self.row_lengths(size, &items));
        whole.map(Some).ok_or_else(|| self.garbled())
    }

    fn population(&self, group: usize) -> Result<Population, EngineFailure> {
        if !self.is_population(group) {
            return Ok(Population::default());
        }
        let population = |reply| match reply {
            Reply::Population { population } => Some(population),
            _ => None,
        };
        let replies = self.ask(&Command::Population { group })?;
        let parts: Option<Vec<Population>> = replies.into_iter().map(population).collect();
        let whole = parts.and_then(|parts| self.rows.gather_items(parts, &self.sizes(group)));
        whole.ok_or_else(|| self.garbled())
    }

    fn label_counts(&self, group: usize) -> Result<Option<Vec<u32>>, EngineFailure> {
        if !self.is_population(group) {
            return Ok(None);
        }
        let mut all = Vec::new();
        for reply in self.ask(&Command::LabelCounts { group })? {
            let Reply::LabelCounts { counts } = reply else { return Err(self.garbled()) };
            all.resize(counts.len(), 0);
            all.iter_mut().zip(counts).for_each(|(all, count)| *all += count);
        }
        Ok(Some(all))
    }

    fn labelled_items(&self, group: usize, labels: Range<u64>) -> Result<LabelledItems, EngineFailure> {
        let items = |reply| match reply {
            Reply::LabelledItems { items } => Some(items),
            _ => None,
        };
        let replies = self.ask(&Command::LabelledItems { group, labels })?;
        let lists: Option<Vec<LabelledItems>> = replies.into_iter().map(items).collect();
        lists.map(|lists| LabelledItems::merged(lists, &self.sizes(group))).ok_or_else(|| self.garbled())
    }

    fn set_population(&mut self, group: usize, population: &Population) -> Result<(), Fault> {
        check_population(&self.shared.model, self.shared.precision, group, population)?;
        self.items[group] = population.labels.len();
        self.balancer.set(group, &self.rows.items(&population.counts));
        Ok(self.scatter_items(group, population)?)
    }

    fn collect_items(
        &mut self,
        plane: Plane,
        rows: Range<usize>,
        bytes: &[u8],
    ) -> Result<bool, EngineFailure> {
        let group = plane.group();
        check_plane(&self.shared.model, plane)?;
        check_plane(&self.shared.model, Plane::Counts(group))?;
        if rows.is_empty() {
            return Ok(true);
        }
        let of_rows = &mut self.collected[group];
        let (size, items) = match plane {
            Plane::Counts(_) => {
                of_rows.truncate(rows.start);
                of_rows.extend(self.rows.items(&numbers(bytes)));
                (size_of::<u32>(), None)
            }
            Plane::Labels(_) => (size_of::<u32>(), Some(of_rows)),
            Plane::Values(substate) => {
                (self.shared.model.stored(substate, self.shared.precision).size(), Some(of_rows))
            }
        };
        let items = items.map(|items| items.get(rows.clone()).unwrap_or_default().to_vec());
        let lengths = self.row_lengths(size, &items);
        let (wanted, given) = (lengths.sum(rows.len()), bytes.len());
        if given != wanted {
            let substates = self.shared.model.groups()[group].schema().name;
            let reason = format!("the items of rows {rows:?} have {given} bytes, not {wanted}");
            return Err(EngineFailure::Input(InputError::Items { substates, reason }));
        }
        let begins = rows.start == 0;
        let parts = self.rows.scatter_rows(rows, bytes, lengths);
        let command = |bytes| Command::CollectItems { plane, begins, bytes };
        self.change(parts.into_iter().map(command).collect()).map(|()| true)
    }

    fn set_collected_items(&mut self, group: usize) -> Result<(), Fault> {
        let items = std::mem::take(&mut self.collected[group]);
        self.items[group] = items.iter().sum();
        self.balancer.set(group, &items);
        for reply in self.ask(&Command::SetCollectedItems { group })? {
            match reply {
                Reply::Done => {}
                Reply::Fault { fault, .. } => return Err(fault.fault(&self.shared.model)),
                Reply::Refused { reason } => {
                    let substates = self.shared.model.groups()[group].schema().name;
                    return Err(InputError::Items { substates, reason }.into());
                }
                _ => return Err(self.garbled().into()),
            }
        }
        Ok(())
    }

    fn items(&self, group: usize) -> usize {
        self.census(group).unwrap_or_default().items
    }

    fn left(&self, group: usize) -> u64 {
        self.census(group).unwrap_or_default().left
    }

    fn largest_occupancy(&self, group: usize) -> Result<u32, EngineFailure> {
        Ok(self.census(group)?.largest_occupancy)
    }

    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure> {
        check_substate(&self.shared.model, substate)?;
        let components = self.shared.model.stored(substate, self.shared.precision).components();
        let replies = self.ask(&Command::ReduceRows { substate, reduction: reduction.clone() })?;
        let rows = |reply| match reply {
            Reply::Rows { rows } => Some(rows.results),
            _ => None,
        };
        let parts: Option<Vec<Vec<Reduced>>> = replies.into_iter().map(rows).collect();
        let results = parts.and_then(|parts| self.rows.gather(&parts, Lengths::Same(components)));
        Ok(ReducedRows { components, results: results.ok_or_else(|| self.garbled())? })
    }

    fn memory(&self) -> usize {
        let bytes = |reply| if let Reply::Memory { bytes } = reply { bytes } else { 0 };
        self.ask(&Command::Memory).unwrap_or_default().into_iter().map(bytes).sum()
    }

    fn figures(&self) -> Vec<Figure> {
        let replies = self.ask(&Command::Figures).unwrap_or_default();
        let of_part = |(part, reply): (usize, Reply)| match reply {
            Reply::Figures { figures } => {
                let figure = |(name, value)| Figure { name: format!("part_{part}_{name}"), value };
                figures.into_iter().map(figure).collect()
            }
            _ => Vec::new(),
        };
        let mut figures: Vec<Figure> = replies.into_iter().enumerate().flat_map(of_part).collect();
        let figure = |(name, value)| Figure { name, value };
        let (geometry, cut) = (self.shared.model.geometry(), &self.shared.cut);
        figures.extend((0..cut.count()).flat_map(|part| bounds(part, &cut.part(part))).map(figure));
        let work = self.work().unwrap_or_default();
        figures.extend(self.balancer.figures(geometry, cut, &work).into_iter().map(figure));
        figures
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        self.crew().end();
        for thread in self.threads.drain(..) {
            // A part that panicked has reported this by its end.
            let _ = thread.join();
        }
    }
}
