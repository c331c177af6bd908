//! Activity: skips cells in which a process would change nothing, because its inputs have not changed.
//!
//! A row is cut into tiles. A tile is due for a process if its inputs have changed since the process last ran
//! there. Inputs are what the process reads in the tile or within reach, and what it writes. In a tile that
//! is not due, the result is already there. A process that has requested a random number or the number of the
//! step stays due in the tile. A value counts as changed if its bits differ.
//!
//! Some substates have a second buffer. Consider a tile where no process that reads the substate elsewhere is
//! due. Both buffers are equal there: if one of these processes had changed the substate, it would be due
//! itself. Buffers can therefore be swapped although a tile was skipped.

use crate::choices::LeaveOut;
use crate::layout::Layout;
use crate::tiles::{BITS, Marks, Tiles, zeros};
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use xca_core::engine::{Figure, SubstateId};
use xca_core::{Model, ParameterSet, ProcessKind};
use xca_pace::{Pace, Step};

/// The number of cells in a tile. Few, because fronts are narrow, but enough to be worth the start of a
/// kernel.
const CELLS_PER_TILE: usize = 16;

/// The places where a model is active.
pub(crate) struct Activity {
    tiles: Tiles,
    layout: Layout,
    processes: Vec<Followed>,
    /// By group and field, for substates of cells only.
    substates: Vec<Vec<Changes>>,
    /// The parameters of the last pass, as bits.
    parameters: Vec<u64>,
    pace: Pace,
    /// The number of changes from outside and of passes that changed something.
    time: u64,
    work: Work,
    /// The work of earlier steps.
    past: Work,
    /// The updated cells of each row, in passes that skipped some. Each row belongs to one thread at a time.
    of_rows: Vec<AtomicU64>,
}

/// A process, and its due tiles.
struct Followed {
    scope: Scope,
    takes_parameters: bool,
    due: Marks,
}

/// The cells in which a process runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scope {
    /// The tiles that are due.
    Due,
    /// All cells, because the process also reads items.
    AllCells,
    /// Items only. The process writes no cells.
    Items,
}

/// The changes of a substate.
struct Changes {
    users: Vec<User>,
    /// The tiles along x that see the changes of a pass. Only for the process of the pass that reads the
    /// substate elsewhere. Its due tiles cannot be marked before all rows have taken theirs.
    around: Marks,
    /// The time of the last change of each row.
    last: Vec<AtomicU64>,
    /// The time of the last change of all rows.
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

impl User {
    /// Whether the process sees its own changes only after the pass.
    fn is_late(&self) -> bool {
        self.elsewhere && self.writes
    }
}

/// The number of updated cells, counted for each process, and the number of all cells.
#[derive(Debug, Clone, Copy, Default)]
struct Work {
    done: u64,
    all: u64,
}

impl Activity {
    /// Starts with everything due. Returns `None` for a model without processes over cells.
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
            // An unused substate needs no marks.
            let [marked, followed] =
                [users.iter().any(User::is_late), !users.is_empty()].map(|is| if is { rows } else { 0 });
            Changes { users, around: Marks::new(&tiles, marked), last: zeros(followed), replaced: 0 }
        };
        let substates = model.groups().iter().enumerate().map(|(number, group)| {
            (0..group.schema().fields.len()).map(|field| changes(number, field)).collect()
        });
        let (substates, pace) = (substates.collect(), Pace::new(always));
        let parameters = Vec::new();
        let (work, past) = (Work::default(), Work::default());
        let layout = layout.clone();
        let of_rows = zeros(rows);
        let mut activity =
            Self { tiles, layout, processes, substates, parameters, pace, time: 0, work, past, of_rows };
        activity.wake();
        Some(activity)
    }

    pub(crate) fn tiles(&self) -> &Tiles {
        &self.tiles
    }

    /// Whether tiles are skipped and changes are tracked.
    pub(crate) fn is_on(&self) -> bool {
        self.pace.is_on()
    }

    /// The number of steps on all cells before the next step that skips tiles.
    pub(crate) fn steps_without(&self) -> u64 {
        self.pace.pause()
    }

    /// The current time.
    pub(crate) fn time(&self) -> u64 {
        self.time
    }

    /// The time of the last change of a substate in a row, as far as changes are tracked.
    pub(crate) fn last_change(&self, substate: SubstateId, row: usize) -> u64 {
        let changes = &self.substates[substate.group][substate.field];
        let last = changes.last.get(row).map_or(0, |last| last.load(Ordering::Relaxed));
        changes.replaced.max(last)
    }

    /// Makes everything due, because everything may have changed.
    pub(crate) fn wake(&mut self) {
        self.time += 1;
        self.substates.iter_mut().flatten().for_each(|changes| changes.replaced = self.time);
        for process in &mut self.processes {
            process.due.fill(&self.tiles);
        }
    }

    /// Sets the parameters of the following steps.
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

    /// Ends `steps` steps that took `time`.
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
        // Changes were not tracked during a pause.
        if self.pace.is_first() {
            self.wake();
        }
    }

    /// The share of due tiles, over all processes over cells.
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

    /// Counts the updated cells of processes. `done` counts a cell once for each process.
    pub(crate) fn worked(&mut self, processes: &[usize], done: u64) {
        self.work.done += done;
        self.work.all += self.cells(processes);
    }

    /// Counts all cells as updated by the processes.
    pub(crate) fn worked_on_all(&mut self, processes: &[usize]) {
        self.worked(processes, self.cells(processes));
    }

    /// Counts updated cells of a row, in a pass that skips some.
    pub(crate) fn worked_in(&self, row: usize, cells: usize) {
        let of_row = &self.of_rows[row];
        of_row.store(of_row.load(Ordering::Relaxed) + cells as u64, Ordering::Relaxed);
    }

    /// The updated cells of each row since the start, counted for each process, in passes that skip some.
    pub(crate) fn work_of_rows(&self) -> impl Iterator<Item = u64> + '_ {
        self.of_rows.iter().map(|of_row| of_row.load(Ordering::Relaxed))
    }

    fn cells(&self, processes: &[usize]) -> u64 {
        let cells = (self.layout.rows() * self.layout.width()) as u64;
        let is_over_cells = |number: &&usize| self.processes[**number].scope != Scope::Items;
        cells * processes.iter().filter(is_over_cells).count() as u64
    }

    /// The rows of a pass in which something is due, with their numbers of due tiles. `None` if a process
    /// needs all rows.
    pub(crate) fn rows(&self, processes: &[usize]) -> Option<Vec<DueRow>> {
        if processes.iter().any(|process| self.processes[*process].scope != Scope::Due) {
            return None;
        }
        let marks = || processes.iter().map(|process| &self.processes[*process].due);
        let mut rows = Vec::new();
        for number in 0..self.layout.rows().div_ceil(BITS) {
            let mut left = marks().fold(0, |all, due| all | due.rows(number));
            while left != 0 {
                let row = BITS * number + left.trailing_zeros() as usize;
                left &= left - 1;
                let tiles = marks().map(|due| due.count_row(row)).sum();
                if tiles > 0 {
                    rows.push(DueRow { row, tiles });
                }
            }
        }
        Some(rows)
    }

    /// Takes the due tiles of a process in a row. They are not due any more.
    pub(crate) fn take(&self, process: usize, row: usize, due: &mut Vec<u64>) {
        match self.processes[process].scope {
            Scope::Due => self.processes[process].due.take(row, due),
            Scope::AllCells | Scope::Items => {
                due.clear();
                due.extend((0..self.tiles.words()).map(|word| self.tiles.full(word)));
            }
        }
    }

    /// Keeps a process due in a tile of a row.
    pub(crate) fn keep(&self, process: usize, row: usize, tile: usize) {
        if self.processes[process].scope == Scope::Due {
            self.processes[process].due.add_tile(row, tile);
        }
    }

    /// Records the tiles of a row in which a substate has changed. `around` are the tiles along x that see
    /// the change. Processes become due. `writer` is the process that has changed it, if one has, by its
    /// index in the list of processes of the pass.
    pub(crate) fn change(
        &self,
        substate: SubstateId,
        row: usize,
        [here, around]: [&[u64]; 2],
        (processes, writer): (&[usize], Option<usize>),
    ) {
        let changes = &self.substates[substate.group][substate.field];
        changes.last[row].store(self.time + 1, Ordering::Relaxed);
        for user in &changes.users {
            let Followed { scope: Scope::Due, due, .. } = &self.processes[user.process] else { continue };
            let place = processes.iter().position(|process| *process == user.process);
            match (place, user.elsewhere) {
                // No row takes the due tiles of this process in this pass.
                (None, true) => self.layout.rows_around(row).for_each(|row| due.add_shared(row, around)),
                (None, false) => due.add_shared(row, here),
                (Some(place), true) if Some(place) == writer => {
                    changes.around.add(row, around.iter().copied());
                }
                // The process has made the change without reading the old value.
                (Some(place), false) if Some(place) == writer && !user.reads => {}
                // The other processes of the pass run before or after this one in the row.
                (Some(_), _) => due.add(row, here.iter().copied()),
            }
        }
    }

    /// Ends a pass over these rows.
    pub(crate) fn end_pass(&mut self, processes: &[usize], rows: impl Iterator<Item = usize> + Clone) {
        self.time += 1;
        for Changes { users, around, .. } in self.substates.iter().flatten() {
            for user in users.iter().filter(|user| user.is_late() && processes.contains(&user.process)) {
                let due = &self.processes[user.process].due;
                for row in rows.clone().filter(|row| around.is_marked(*row)) {
                    self.layout.rows_around(row).for_each(|beside| due.add_row(beside, (around, row)));
                    around.clear(row);
                }
            }
        }
    }

    /// Records that a substate was replaced in all cells.
    pub(crate) fn replaced(&mut self, substate: SubstateId) {
        self.time += 1;
        let changes = &mut self.substates[substate.group][substate.field];
        changes.replaced = self.time;
        for user in &changes.users {
            self.processes[user.process].due.fill(&self.tiles);
        }
    }

    /// Records that a substate was replaced in the cells with these linear indices.
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
            self.change(substate, layout.row_of(*cell), [&here, &around], (&[], None));
        }
        self.time += 1;
    }

    /// Records a change of a substate in a line of the halo that another part has sent. `differs` tells which
    /// tiles have changed.
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

    /// The share of updated cells, over all steps and processes.
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
    /// The number of due tiles, over all processes.
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
