//! Which cells are worked on: a process need not run where nothing has changed that its result follows from.
//!
//! A row is cut into tiles. For each process a tile is due if, since the process last ran there, something
//! has changed that it reads there or within reach, or something that it writes. Elsewhere its result is what
//! stands there already. A process that has asked for a random number or for the number of the step stays due
//! in the tile. Values count as changed where their bits have.
//!
//! A substate that goes to a second buffer has the same values in both, in each tile in which the processes
//! that read it elsewhere are not due: where one of them has changed it, it is due itself. So buffers can be
//! swapped though a tile was left out.

use crate::choices::LeaveOut;
use crate::layout::Layout;
use crate::pace::{Pace, Step};
use crate::tiles::{Marks, Tiles};
use std::ops::Range;
use std::time::Duration;
use xca_core::engine::{Figure, SubstateId};
use xca_core::{Model, ParameterSet, ProcessKind};

/// The cells of a tile: few, as a front is narrow, but enough for a kernel to be worth its start.
const CELLS_PER_TILE: usize = 32;

/// What is known of where a model is active.
pub(crate) struct Activity {
    tiles: Tiles,
    layout: Layout,
    processes: Vec<Followed>,
    /// By group and field; of substates of cells alone.
    substates: Vec<Vec<Changes>>,
    /// The parameters of the last pass, in bits.
    parameters: Vec<u64>,
    pace: Pace,
    /// Counts changes from outside and passes that changed something.
    time: u64,
    work: Work,
    /// That of the steps before.
    past: Work,
}

/// A process, and where it is due.
struct Followed {
    scope: Scope,
    takes_parameters: bool,
    due: Marks,
}

/// Where a process runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scope {
    /// In the tiles that are due.
    Due,
    /// In all cells, as it looks at items too.
    AllCells,
    /// For items: it writes no cells.
    Items,
}

/// Where a substate has changed in a pass.
struct Changes {
    users: Vec<User>,
    here: Marks,
    /// From where changes are seen along x.
    around: Marks,
    /// For each row when it last changed.
    last: Vec<u64>,
    /// When it last changed in all rows.
    replaced: u64,
}

/// A process that uses a substate.
#[derive(Debug, Clone, Copy)]
struct User {
    process: usize,
    reads: bool,
    elsewhere: bool,
    writes: bool,
}

/// How many cells were worked on, each counted once a process, and how many there were.
#[derive(Debug, Clone, Copy, Default)]
struct Work {
    done: u64,
    all: u64,
}

impl Activity {
    /// Everything is due. There is nothing to know of a model without processes over cells.
    pub(crate) fn new(model: &Model, layout: &Layout, leave_out: LeaveOut) -> Option<Self> {
        let (width, always) = match leave_out {
            LeaveOut::WhereItPays => (CELLS_PER_TILE, false),
            LeaveOut::Always(cells) => (cells, true),
            LeaveOut::Never => return None,
        };
        let tiles = Tiles::new(model.geometry(), layout, width);
        let rows = layout.rows();
        let processes: Vec<Followed> = model
            .processes()
            .iter()
            .map(|process| {
                let scope = match process.kind {
                    ProcessKind::Cells if process.population().is_none() => Scope::Due,
                    ProcessKind::Cells => Scope::AllCells,
                    ProcessKind::Items | ProcessKind::Migration => Scope::Items,
                };
                let marked = if scope == Scope::Due { rows } else { 0 };
                let takes_parameters = !process.parameters.is_empty();
                Followed { scope, takes_parameters, due: Marks::new(&tiles, marked) }
            })
            .collect();
        if processes.iter().all(|process| process.scope == Scope::Items) {
            return None;
        }
        let changes = |group: usize, field: usize| {
            let users = users(model, SubstateId { group, field });
            // What no one uses needs no marks.
            let rows = if users.is_empty() { 0 } else { rows };
            Changes {
                users,
                here: Marks::new(&tiles, rows),
                around: Marks::new(&tiles, rows),
                last: vec![0; rows],
                replaced: 0,
            }
        };
        let substates = model.groups().iter().enumerate().map(|(number, group)| {
            (0..group.schema().fields.len()).map(|field| changes(number, field)).collect()
        });
        let (substates, pace) = (substates.collect(), Pace::new(always));
        let parameters = Vec::new();
        let (work, past) = (Work::default(), Work::default());
        let layout = layout.clone();
        let mut activity =
            Self { tiles, layout, processes, substates, parameters, pace, time: 0, work, past };
        activity.wake();
        Some(activity)
    }

    pub(crate) fn tiles(&self) -> &Tiles {
        &self.tiles
    }

    /// Whether what is not due is left out, and changes are followed.
    pub(crate) fn is_on(&self) -> bool {
        self.pace.is_on()
    }

    /// How many steps will work on all cells before the next one that leaves some out.
    pub(crate) fn steps_without(&self) -> u64 {
        self.pace.pause()
    }

    /// The present time.
    pub(crate) fn time(&self) -> u64 {
        self.time
    }

    /// When a substate last changed in a row, as far as changes are followed.
    pub(crate) fn last_change(&self, substate: SubstateId, row: usize) -> u64 {
        let changes = &self.substates[substate.group][substate.field];
        changes.last.get(row).map_or(changes.replaced, |last| changes.replaced.max(*last))
    }

    /// Everything may have changed, and is due.
    pub(crate) fn wake(&mut self) {
        self.time += 1;
        self.substates.iter_mut().flatten().for_each(|changes| changes.replaced = self.time);
        for process in &mut self.processes {
            process.due.fill(&self.tiles);
        }
    }

    /// Steps follow with these parameters.
    pub(crate) fn take_parameters(&mut self, parameters: &ParameterSet) {
        let values = parameters.values();
        let bits =
            values.flat_map(|value| value.components().iter().map(|one| one.to_bits()).collect::<Vec<_>>());
        let bits: Vec<u64> = bits.collect();
        if bits != self.parameters {
            self.parameters = bits;
            for process in self.processes.iter_mut().filter(|process| process.takes_parameters) {
                process.due.fill(&self.tiles);
            }
        }
    }

    /// So many steps have ended, after so much time.
    pub(crate) fn end_steps(&mut self, steps: u64, time: Duration) {
        let work = std::mem::take(&mut self.work);
        self.past.done += work.done;
        self.past.all += work.all;
        let step = Step { cells: work.all / steps.max(1), time: time.div_f64(steps.max(1) as f64) };
        for _ in 0..steps {
            if work.all > 0 && self.pace.ended(step) {
                self.pace.judge_share(self.due_share());
            }
        }
        // No one has seen what changed in a pause.
        if self.pace.is_first() {
            self.wake();
        }
    }

    /// Of the tiles of all processes over cells those that are due.
    fn due_share(&self) -> f64 {
        let rows = self.layout.rows();
        let over_cells = self.processes.iter().filter(|process| process.scope != Scope::Items);
        let (mut due, mut all) = (0, 0);
        for process in over_cells {
            let tiles = rows * self.tiles.count();
            all += tiles;
            due += match process.scope {
                Scope::Due => process.due.count(),
                Scope::AllCells | Scope::Items => tiles,
            };
        }
        due as f64 / all.max(1) as f64
    }

    /// Processes have worked on so many cells, each counted once a process.
    pub(crate) fn worked(&mut self, processes: &[usize], done: u64) {
        self.work.done += done;
        self.work.all += self.cells(processes);
    }

    /// Processes have worked on all cells.
    pub(crate) fn worked_on_all(&mut self, processes: &[usize]) {
        self.worked(processes, self.cells(processes));
    }

    fn cells(&self, processes: &[usize]) -> u64 {
        let cells = (self.layout.rows() * self.layout.width()) as u64;
        let is_over_cells = |number: &&usize| self.processes[**number].scope != Scope::Items;
        cells * processes.iter().filter(is_over_cells).count() as u64
    }

    /// For a pass the rows in which something is due, each with the number of tiles; nothing where a process
    /// needs all rows.
    pub(crate) fn rows(&self, processes: &[usize]) -> Option<Vec<DueRow>> {
        if processes.iter().any(|process| self.processes[*process].scope != Scope::Due) {
            return None;
        }
        let mut tiles = vec![0; self.layout.rows()];
        processes.iter().for_each(|process| self.processes[*process].due.count_rows(&mut tiles));
        let rows = tiles.into_iter().enumerate().map(|(row, tiles)| DueRow { row, tiles });
        Some(rows.filter(|row| row.tiles > 0).collect())
    }

    /// The tiles of a row in which a process is due; it is no longer.
    pub(crate) fn take(&self, process: usize, row: usize, due: &mut Vec<u64>) {
        match self.processes[process].scope {
            Scope::Due => self.processes[process].due.take(row, due),
            Scope::AllCells | Scope::Items => {
                due.clear();
                due.extend((0..self.tiles.words()).map(|word| self.tiles.full(word)));
            }
        }
    }

    /// A process stays due in a tile of a row.
    pub(crate) fn keep(&self, process: usize, row: usize, tile: usize) {
        if self.processes[process].scope == Scope::Due {
            self.processes[process].due.add_tile(row, tile);
        }
    }

    /// A process has changed a substate in these tiles of a row; `around` are those from which it is seen
    /// along x. Of the processes that follow in the pass, those that use it are due in the row.
    pub(crate) fn change(
        &self,
        substate: SubstateId,
        row: usize,
        [here, around]: [&[u64]; 2],
        following: impl Iterator<Item = usize>,
    ) {
        let changes = &self.substates[substate.group][substate.field];
        changes.here.add(row, here.iter().copied());
        changes.around.add(row, around.iter().copied());
        for process in following {
            if self.processes[process].scope == Scope::Due
                && changes.users.iter().any(|user| user.process == process)
            {
                self.processes[process].due.add(row, here.iter().copied());
            }
        }
    }

    /// After a pass over rows, in which processes have written a substate: what follows from that for other
    /// rows and processes.
    pub(crate) fn spread(
        &mut self,
        substate: SubstateId,
        processes: &[usize],
        rows: impl Iterator<Item = usize>,
    ) {
        self.time += 1;
        let changes = &mut self.substates[substate.group][substate.field];
        let place = |process: usize| processes.iter().position(|one| *one == process);
        let writers = changes.users.iter().filter(|user| user.writes).filter_map(|user| place(user.process));
        let writers: Vec<usize> = writers.collect();
        let last = writers.iter().copied().max();
        let wakes = |user: &User| match place(user.process) {
            // It has seen the change already, or made it, without a look at what was there.
            Some(number) if Some(number) > last => false,
            Some(number) if writers == [number] => user.reads,
            _ => true,
        };
        let woken: Vec<&User> = changes
            .users
            .iter()
            .filter(|user| self.processes[user.process].scope == Scope::Due && wakes(user))
            .collect();
        let mut beside = Vec::new();
        let [mut here, mut around] = [Vec::new(), Vec::new()];
        for row in rows {
            changes.here.take(row, &mut here);
            changes.around.take(row, &mut around);
            if here.iter().all(|word| *word == 0) {
                continue;
            }
            changes.last[row] = self.time;
            beside.clear();
            beside.extend(self.layout.rows_around(row));
            for user in &woken {
                let due = &self.processes[user.process].due;
                if user.elsewhere {
                    beside.iter().for_each(|beside| due.add(*beside, around.iter().copied()));
                } else {
                    due.add(row, here.iter().copied());
                }
            }
        }
    }

    /// A substate has been replaced in all cells.
    pub(crate) fn replaced(&mut self, substate: SubstateId) {
        self.time += 1;
        let changes = &mut self.substates[substate.group][substate.field];
        changes.replaced = self.time;
        for user in &changes.users {
            self.processes[user.process].due.fill(&self.tiles);
        }
    }

    /// A substate has been replaced in the cells with these linear indices.
    pub(crate) fn replaced_in(&mut self, substate: SubstateId, cells: &[usize]) {
        let is_used = !self.substates[substate.group][substate.field].users.is_empty();
        let are_few = cells.len() < self.layout.rows() * self.tiles.count();
        if !is_used || !are_few {
            self.replaced(substate);
            return;
        }
        let (width, layout) = (self.layout.width(), self.layout.clone());
        let [mut here, mut around] = [vec![0; self.tiles.words()], vec![0; self.tiles.words()]];
        for cell in cells {
            here.fill(0);
            around.fill(0);
            let x = cell % width;
            self.tiles.mark_cell(&mut here, x);
            self.tiles.mark_around(&mut around, &Range { start: x, end: x + 1 });
            self.change(substate, layout.row_of(*cell), [&here, &around], std::iter::empty());
        }
        self.spread(substate, &[], cells.iter().map(|cell| layout.row_of(*cell)));
    }

    /// A substate has changed in a line of the halo that another part has sent, in those of its tiles that
    /// differ.
    pub(crate) fn changed_beyond(
        &self,
        substate: SubstateId,
        line: [isize; 2],
        differs: impl Fn(Range<usize>) -> bool,
    ) {
        let mut around = vec![0; self.tiles.words()];
        for tile in 0..self.tiles.count() {
            let cells = self.tiles.cells(&(tile..tile + 1));
            if differs(cells.clone()) {
                self.tiles.mark_around(&mut around, &cells);
            }
        }
        let users = &self.substates[substate.group][substate.field].users;
        for user in users.iter().filter(|user| user.elsewhere) {
            let process = &self.processes[user.process];
            if process.scope == Scope::Due {
                self.layout.rows_that_see(line).for_each(|row| process.due.add(row, around.iter().copied()));
            }
        }
    }

    /// Of all cells of all steps, each counted once a process, the share that was worked on.
    pub(crate) fn figure(&self) -> Option<Figure> {
        let all = Work { done: self.past.done + self.work.done, all: self.past.all + self.work.all };
        let share = || all.done as f64 / all.all as f64;
        (all.all > 0).then(|| Figure { name: "share_of_cells_worked_on".to_owned(), value: share() })
    }
}

/// A row in which processes are due.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct DueRow {
    pub(crate) row: usize,
    /// In so many tiles, those of all processes.
    pub(crate) tiles: usize,
}

fn users(model: &Model, substate: SubstateId) -> Vec<User> {
    let over_cells =
        model.processes().iter().enumerate().filter(|(_, process)| process.kind == ProcessKind::Cells);
    let uses = over_cells.filter_map(|(process, _)| {
        let found = model.plan().process(process).use_of(substate)?;
        Some(User { process, reads: found.read, elsewhere: found.elsewhere, writes: found.written })
    });
    uses.collect()
}
