//! The host: a state in parts as a simulation sees it.

use crate::border::{Link, NAME, broken};
use crate::message::{Command, Moment, Reply, decode, encode};
use crate::transport::{Tag, Transport, TransportError};
use crate::worker::{Shared, Worker};
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use xca_core::engine::{
    EngineFailure, Execution, Fault, Figure, Interruption, Population, StepContext, SubstateId, check_cells,
    check_population, check_substate, check_values, check_values_of_cells,
};
use xca_core::reduction::{Reduced, ReducedRows, Reduction};
use xca_core::{Engine, StartError};

/// A model in parts. The first part belongs to the host itself.
pub(crate) struct Host {
    shared: Shared,
    state: Mutex<State>,
    /// The threads of other parts in this process. They end when the host has.
    threads: Vec<JoinHandle<()>>,
}

struct State {
    own: Worker,
    link: Link,
    /// Why no part goes on.
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
        let own = Worker::start(engine, &shared, link.clone())?;
        let mut state = State { own, link, failure: None };
        state
            .replies(Reply::Done)
            .map_err(|failure| StartError::Other { engine: NAME.to_owned(), reason: failure.to_string() })?;
        Ok(Self { shared, state: Mutex::new(state), threads })
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Has all parts do the same.
    fn ask(&self, command: &Command) -> Result<Vec<Reply>, EngineFailure> {
        self.state().ask(vec![command.clone(); self.shared.cut.count()])
    }

    /// Has all parts change something.
    fn change(&self, commands: Vec<Command>) -> Result<(), EngineFailure> {
        self.state().ask(commands).map(drop)
    }

    /// Has all parts run processes. A fault comes with the number of steps done before it.
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

    /// The runs of rows of each part, by the number of the part.
    fn runs(&self) -> impl Iterator<Item = (usize, Range<usize>)> + '_ {
        let (geometry, cut) = (self.shared.model.geometry(), self.shared.cut);
        (0..cut.count())
            .flat_map(move |number| cut.part(geometry, number).runs(geometry).map(move |rows| (number, rows)))
    }

    /// Puts together what the parts have of their rows: so many values a row.
    fn gather<T: Clone>(&self, parts: Vec<Vec<T>>, per_row: usize, none: T) -> Result<Vec<T>, EngineFailure> {
        let geometry = self.shared.model.geometry();
        let mut whole = vec![none; geometry.cells() / geometry.extents()[0] * per_row];
        let mut taken = vec![0; parts.len()];
        for (number, rows) in self.runs() {
            let length = rows.len() * per_row;
            let values = parts.get(number).and_then(|part| part.get(taken[number]..taken[number] + length));
            let values = values.ok_or_else(|| self.garbled())?;
            whole[rows.start * per_row..rows.end * per_row].clone_from_slice(values);
            taken[number] += length;
        }
        Ok(whole)
    }

    /// The values of each part's rows: so many bytes a row.
    fn scatter(&self, whole: &[u8], per_row: usize) -> Vec<Vec<u8>> {
        let mut parts = vec![Vec::new(); self.shared.cut.count()];
        for (number, rows) in self.runs() {
            parts[number].extend_from_slice(&whole[rows.start * per_row..rows.end * per_row]);
        }
        parts
    }

    /// The cells of each part, with their places in the list.
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

    /// The bytes of a substate in a cell.
    fn size(&self, substate: SubstateId) -> usize {
        self.shared.model.stored(substate, self.shared.precision).size()
    }

    fn values(&self, replies: Vec<Reply>) -> Result<Vec<Vec<u8>>, EngineFailure> {
        let values = |reply| match reply {
            Reply::Values { values } => Some(values),
            _ => None,
        };
        replies.into_iter().map(values).collect::<Option<_>>().ok_or_else(|| self.garbled())
    }
}

/// Those of some cells that belong to a part.
#[derive(Debug, Clone, Default)]
struct CellsOfPart {
    /// Their linear indices.
    cells: Vec<usize>,
    /// Where they stand among all.
    places: Vec<usize>,
}

impl State {
    /// No part goes on: all that wait for this one learn it.
    fn fail(&mut self, reason: String) -> EngineFailure {
        self.link.lock().end();
        self.failure.get_or_insert(broken(reason)).clone()
    }

    /// Gives each part its command, and the replies of all.
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

    /// The replies of all parts, the own one first. Where a part cannot go on, none does.
    fn replies(&mut self, own: Reply) -> Result<Vec<Reply>, EngineFailure> {
        if matches!(own, Reply::Failed { .. }) {
            // Other parts may wait for this one.
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
                // A part that says why is heard before one that has lost another.
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
        let parts = self.values(self.ask(&Command::Read { substate })?)?;
        self.gather(parts, self.shared.model.geometry().extents()[0] * self.size(substate), 0)
    }

    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure> {
        let Shared { model, precision, .. } = &self.shared;
        check_values(model, *precision, substate, 0, values)?;
        let parts = self.scatter(values, model.geometry().extents()[0] * self.size(substate));
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

    fn population(&self, _group: usize) -> Result<Population, EngineFailure> {
        Ok(Population::default())
    }

    fn set_population(&mut self, group: usize, population: &Population) -> Result<(), Fault> {
        check_population(&self.shared.model, self.shared.precision, group, population)
    }

    fn items(&self, _group: usize) -> usize {
        0
    }

    fn left(&self, _group: usize) -> u64 {
        0
    }

    fn largest_occupancy(&self, _group: usize) -> Result<u32, EngineFailure> {
        Ok(0)
    }

    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure> {
        check_substate(&self.shared.model, substate)?;
        let components = self.shared.model.stored(substate, self.shared.precision).components();
        let replies = self.ask(&Command::ReduceRows { substate, reduction: reduction.clone() })?;
        let rows = |reply| match reply {
            Reply::Rows { rows } => Some(rows.results),
            _ => None,
        };
        let parts = replies.into_iter().map(rows).collect::<Option<_>>().ok_or_else(|| self.garbled())?;
        Ok(ReducedRows { components, results: self.gather(parts, components, Reduced::Nothing)? })
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
            // A part that has panicked has told it by its end.
            let _ = thread.join();
        }
    }
}
