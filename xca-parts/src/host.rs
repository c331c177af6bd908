//! The host: presents the state of all parts to a simulation.

use crate::border::{Link, NAME, broken};
use crate::greeting::Greeting;
use crate::message::{Census, Command, Moment, Reply, decode, encode};
use crate::rows::{Lengths, Rows};
use crate::shared::Shared;
use crate::transport::{Tag, Transport, TransportError};
use crate::worker::Worker;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use xca_core::engine::{
    EngineFailure, Execution, Fault, Figure, Interruption, Population, StepContext, SubstateId, check_cells,
    check_population, check_substate, check_values, check_values_of_cells,
};
use xca_core::model::GroupKind;
use xca_core::reduction::{Reduced, ReducedRows, Reduction};
use xca_core::{Engine, StartError};

/// A model in parts. The first part belongs to the host itself.
pub(crate) struct Host {
    shared: Shared,
    rows: Rows,
    state: Mutex<State>,
    /// The threads of other parts in this process. They end after the host.
    threads: Vec<JoinHandle<()>>,
}

struct State {
    own: Worker,
    link: Link,
    /// The failure that has stopped all parts.
    failure: Option<EngineFailure>,
}

impl Host {
    /// Starts the own part, and waits until the others have started.
    pub(crate) fn start(
        engine: &dyn Engine,
        shared: Shared,
        transport: Box<dyn Transport>,
        threads: Vec<JoinHandle<()>>,
    ) -> Result<Self, StartError> {
        let link = Link::new(transport);
        let other = |reason: String| StartError::Other { engine: NAME.to_owned(), reason };
        greet(&shared, &link).map_err(|reason| {
            link.lock().end();
            other(reason)
        })?;
        let own = Worker::start(engine, &shared, link.clone()).inspect_err(|_| link.lock().end())?;
        let mut state = State { own, link, failure: None };
        state.replies(Reply::Done).map_err(|failure| other(failure.to_string()))?;
        let rows = Rows::new(shared.model.geometry(), shared.cut);
        Ok(Self { shared, rows, state: Mutex::new(state), threads })
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Gives all parts the same command.
    fn ask(&self, command: &Command) -> Result<Vec<Reply>, EngineFailure> {
        self.state().ask(vec![command.clone(); self.shared.cut.count()])
    }

    /// Gives each part a command that changes its state.
    fn change(&self, commands: Vec<Command>) -> Result<(), EngineFailure> {
        self.state().ask(commands).map(drop)
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
            let failure = self.state().fail("a part has stopped, and none tells why".to_owned());
            Err(Interruption { done, fault: Fault::Engine(failure) })
        })
    }

    /// The cells of each part, with their indices in the list.
    fn cells_of_parts(&self, cells: &[usize]) -> Vec<CellsOfPart> {
        let (geometry, cut) = (self.shared.model.geometry(), self.shared.cut);
        let mut parts = vec![CellsOfPart::default(); cut.count()];
        for (place, cell) in cells.iter().enumerate() {
            let [_, y, z] = geometry.indices(*cell);
            let part = &mut parts[cut.part_of(geometry, [y, z])];
            part.cells.push(*cell);
            part.places.push(place);
        }
        parts
    }

    fn garbled(&self) -> EngineFailure {
        self.state().fail("the parts answer what was not asked".to_owned())
    }

    /// The size of a substate in a cell, in bytes.
    fn size(&self, substate: SubstateId) -> usize {
        self.shared.model.stored(substate, self.shared.precision).size()
    }

    /// The sizes of the substates of a group in an item, in bytes.
    fn sizes(&self, group: usize) -> Vec<usize> {
        let stored = self.shared.model.groups().get(group).map(|group| group.stored(self.shared.precision));
        stored.into_iter().flatten().map(xca_core::StoredType::size).collect()
    }

    fn is_population(&self, group: usize) -> bool {
        let group = self.shared.model.groups().get(group);
        group.is_some_and(|group| matches!(group.kind(), GroupKind::Population { .. }))
    }

    /// The number of items in each row. `None` for a group of cells.
    fn items_of_rows(&self, group: usize) -> Result<Option<Vec<usize>>, EngineFailure> {
        if !self.is_population(group) {
            return Ok(None);
        }
        let items = |reply| match reply {
            Reply::ItemsOfRows { items } => Some(items),
            _ => None,
        };
        let replies = self.ask(&Command::ItemsOfRows { group })?;
        let parts: Option<Vec<Vec<usize>>> = replies.into_iter().map(items).collect();
        let items = parts.and_then(|parts| self.rows.gather(&parts, Lengths::Same(1)));
        items.map(Some).ok_or_else(|| self.garbled())
    }

    /// The size of each row of a substate, in bytes.
    fn lengths<'a>(&self, substate: SubstateId, items: &'a Option<Vec<usize>>) -> Lengths<'a> {
        let size = self.size(substate);
        match items {
            Some(items) => Lengths::Each(items, size),
            None => Lengths::Same(self.shared.model.geometry().extents()[0] * size),
        }
    }

    /// The census of a population over all parts.
    fn census(&self, group: usize) -> Result<Census, EngineFailure> {
        if !self.is_population(group) {
            return Ok(Census::default());
        }
        let mut all = Census::default();
        for reply in self.ask(&Command::Census { group })? {
            let Reply::Census { census } = reply else { return Err(self.garbled()) };
            all.items += census.items;
            all.left += census.left;
            all.largest_occupancy = all.largest_occupancy.max(census.largest_occupancy);
        }
        Ok(all)
    }

    fn values(&self, replies: Vec<Reply>) -> Result<Vec<Vec<u8>>, EngineFailure> {
        let values = |reply| match reply {
            Reply::Values { values } => Some(values),
            _ => None,
        };
        replies.into_iter().map(values).collect::<Option<_>>().ok_or_else(|| self.garbled())
    }
}

/// Receives the greetings of the other parts. They start in the meantime.
fn greet(shared: &Shared, link: &Link) -> Result<(), String> {
    let own = Greeting::new(shared);
    let count = link.lock().count();
    (1..count).try_for_each(|part| {
        let said = link.lock().receive(part, Tag::Reply).map_err(|error| error.to_string())?;
        own.check(part, &said)
    })
}

/// The cells of one part, out of a list.
#[derive(Debug, Clone, Default)]
struct CellsOfPart {
    /// Their linear indices.
    cells: Vec<usize>,
    /// Their indices in the list.
    places: Vec<usize>,
}

impl State {
    /// Stops all parts. Parts that wait for this one get an error.
    fn fail(&mut self, reason: String) -> EngineFailure {
        self.link.lock().end();
        self.failure.get_or_insert(broken(reason)).clone()
    }

    /// Sends each part its command, and returns the replies of all.
    fn ask(&mut self, commands: Vec<Command>) -> Result<Vec<Reply>, EngineFailure> {
        if let Some(failure) = &self.failure {
            return Err(failure.clone());
        }
        let mut commands = commands.into_iter().enumerate();
        let Some((_, own)) = commands.next() else { return Ok(Vec::new()) };
        for (part, command) in commands {
            let sent = encode(&command).and_then(|bytes| {
                self.link.lock().send(part, Tag::Command, bytes).map_err(|error| error.to_string())
            });
            if let Err(reason) = sent {
                return Err(self.fail(reason));
            }
        }
        let own = self.own.perform(own);
        self.replies(own)
    }

    /// Returns the replies of all parts, the own one first. If one part has failed, all stop.
    fn replies(&mut self, own: Reply) -> Result<Vec<Reply>, EngineFailure> {
        if matches!(own, Reply::Failed { .. }) {
            // Other parts may be waiting for this one.
            self.link.lock().end();
        }
        let count = self.link.lock().count();
        let mut replies = vec![own];
        let mut lost = None;
        for part in 1..count {
            let received: Result<Vec<u8>, TransportError> = self.link.lock().receive(part, Tag::Reply);
            let reply = received.map_err(|error| error.to_string()).and_then(|bytes| decode(&bytes));
            match reply {
                Ok(reply) => replies.push(reply),
                // A part that reports a reason takes precedence over a part that lost the connection.
                Err(reason) => {
                    lost.get_or_insert(reason);
                    replies.push(Reply::Elsewhere { done: 0 });
                }
            }
        }
        let failed = replies.iter().enumerate().find_map(|(part, reply)| match reply {
            Reply::Failed { reason } => Some(format!("part {part}: {reason}")),
            _ => None,
        });
        match failed.or(lost) {
            Some(reason) => Err(self.fail(reason)),
            None => Ok(replies),
        }
    }
}

impl Execution for Host {
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault> {
        let command = Command::Run { processes, moment: Moment::new(context) };
        self.run_all(&command).map_err(|interruption| interruption.fault)
    }

    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        self.run_all(&Command::RunSteps { steps, moment: Moment::new(context) })
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

    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure> {
        check_cells(&self.shared.model, substate, cells)?;
        let parts = self.cells_of_parts(cells);
        let command = |part: &CellsOfPart| Command::ReadCells { substate, cells: part.cells.clone() };
        let replies = self.state().ask(parts.iter().map(command).collect())?;
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
        self.change(self.cells_of_parts(cells).into_iter().map(command).collect())
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

    fn set_population(&mut self, group: usize, population: &Population) -> Result<(), Fault> {
        check_population(&self.shared.model, self.shared.precision, group, population)?;
        let parts = self.rows.scatter_items(population, &self.sizes(group));
        let command = |population| Command::SetPopulation { group, population };
        Ok(self.change(parts.into_iter().map(command).collect())?)
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
        replies.into_iter().enumerate().flat_map(of_part).collect()
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        self.state().link.lock().end();
        for thread in self.threads.drain(..) {
            // A part that panicked has reported this by its end.
            let _ = thread.join();
        }
    }
}
