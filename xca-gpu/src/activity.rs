//! Tiles of the space in which nothing can change, and in which processes need not run.
//!
//! A tile is the cells of a workgroup. Each process notes for each substate that it writes the tiles in which
//! it has changed a bit, by the number of its run. Before it runs again the device looks up the tiles in
//! which something has changed since that it reads there or within reach, or writes; only these are
//! dispatched. In the others its results would be what stands there already, in both buffers where there are
//! two. See `docs/architecture.md`.

use crate::device::{Binding, Bindings, Buffer, Device, DeviceError, Recorder};
use crate::error::NotOnDevice;
use crate::groups::Groups;
use crate::program::{Manner, Program, Texts, workgroup_size};
use crate::service::{SELECT, Services};
use crate::space::Space;
use xca_core::{Model, ProcessKind, Stream};
use xca_wgsl::{ACTIVITY_HEAD, Content};

/// Fewer tiles are dispatched at once in no more time than it takes to select some.
const FEW_TILES: usize = 64;
/// With a larger share of tiles selected it costs more than it saves.
const BUSY: f64 = 0.7;
/// The steps without a look after a busy time, and at most.
const REST: u64 = 64;
const LONGEST_REST: u64 = 4096;
/// After so many runs of processes all notes are forgotten, long before their numbers overflow.
const MOST_RUNS: u64 = 1 << 30;

/// The processes of a model that run in selected tiles.
#[derive(Debug)]
pub(crate) struct Activity {
    /// The number of the last run, the tiles selected so far (low and high word); then the region of each
    /// process.
    notes: Buffer,
    dispatches: Buffer,
    processes: Vec<Selected>,
    tiles: usize,
    constants: Vec<(&'static str, usize)>,
    /// The runs of processes since the notes were forgotten, and the tiles that they would have had together.
    runs: u64,
    /// What the device told last of the tiles selected.
    selected: u64,
    /// What is known of the time before the notes were forgotten: tiles selected, and all tiles.
    past: [u64; 2],
    /// The steps for which all tiles are dispatched, and how many they will be the next time.
    rest: u64,
    next_rest: u64,
}

/// A process that runs in selected tiles.
#[derive(Debug)]
struct Selected {
    program: Program,
    sources: Buffer,
    /// Where its region begins, in words.
    region: usize,
    count: usize,
}

/// The words of a region are a multiple of this: what bindings are aligned to at most.
const ALIGNMENT: usize = 64;

impl Activity {
    /// For a model whose processes over cells all can be selected for tiles; nothing for others.
    pub(crate) fn new(
        device: &Device,
        model: &Model,
        space: &Space,
        programs: &[Program],
        (manner, texts): (Manner, &Texts),
    ) -> Result<Option<Self>, NotOnDevice> {
        let size = workgroup_size(space.geometry().extents(), manner.workgroup);
        let [section] = space.sections() else { return Ok(None) };
        let along = section.workgroups(size).map(|count| count as usize);
        let tiles: usize = along.iter().product();
        let few = device.few_tiles().unwrap_or(FEW_TILES);
        if tiles < few || manner.strict.is_none() || !programs.iter().all(can_be_selected) {
            return Ok(None);
        }
        let mut end = ALIGNMENT;
        let regions: Vec<usize> = programs
            .iter()
            .map(|program| {
                let start = end;
                let rows = 2 + program.written(model).count();
                end += (ACTIVITY_HEAD as usize + rows * tiles).next_multiple_of(ALIGNMENT);
                start
            })
            .collect();
        let notes = device.buffer("activity", (end * size_of::<u32>()) as u64)?;
        if notes.size() > device.adapter().largest_binding {
            return Ok(None);
        }
        let mut processes = Vec::new();
        for (place, process) in model.processes().iter().enumerate() {
            let sources = sources(model, place, programs, (&regions, tiles));
            let list = device.buffer("sources", (sources.len() * size_of::<[u32; 2]>()) as u64)?;
            device.upload(&list, 0, bytemuck::cast_slice(&sources))?;
            let process = (*process, Stream::process(place));
            let mut program = Program::new(device, model, space, process, (manner, texts), true)?;
            let next = regions.get(place + 1).copied().unwrap_or(end);
            let bytes = |words: usize| (words * size_of::<u32>()) as u64;
            program.note_in(Binding::part(&notes, bytes(regions[place]), bytes(next - regions[place])));
            processes.push(Selected { program, sources: list, region: regions[place], count: sources.len() });
        }
        let [cells_x, cells_y, cells_z] = space.geometry().extents();
        let [reach_x, reach_y, reach_z] = space.reach();
        let [size_x, size_y, size_z] = size.map(|size| size as usize);
        let constants = vec![
            ("TILES", tiles),
            ("ALONG_X", along[0]),
            ("ALONG_Y", along[1]),
            ("SIZE_X", size_x),
            ("SIZE_Y", size_y),
            ("SIZE_Z", size_z),
            ("CELLS_X", cells_x),
            ("CELLS_Y", cells_y),
            ("CELLS_Z", cells_z),
            ("REACH_X", reach_x),
            ("REACH_Y", reach_y),
            ("REACH_Z", reach_z),
            ("MOST", device.most_workgroups() as usize),
        ];
        Ok(Some(Self {
            notes,
            dispatches: device.dispatches("dispatches", processes.len())?,
            processes,
            tiles,
            constants,
            runs: 0,
            selected: 0,
            past: [0; 2],
            rest: 0,
            next_rest: REST,
        }))
    }

    /// The programs, to be told of parameters and of the space.
    pub(crate) fn programs(&self) -> impl Iterator<Item = &Program> {
        self.processes.iter().map(|process| &process.program)
    }

    /// Whether it is looked for tiles now.
    pub(crate) fn is_looking(&self) -> bool {
        self.rest == 0
    }

    /// Records the selection of a process's tiles. Gives what is to be dispatched then, and where its size
    /// stands.
    pub(crate) fn select(
        &mut self,
        (device, model): (&Device, &Model),
        recorder: &mut Recorder,
        services: &mut Services,
        (space, groups): (&Space, &Groups),
        index: usize,
    ) -> Result<(Bindings, &Buffer, u64), DeviceError> {
        let process = &mut self.processes[index];
        let mut constants = self.constants.clone();
        constants.extend([("REGION", process.region), ("SOURCES", process.count), ("PLACE", index)]);
        let parts = [(&process.sources).into(), (&self.notes).into(), (&self.dispatches).into()];
        services.run(device, recorder, SELECT, (&constants, &parts), 1)?;
        self.runs += 1;
        let bindings = process.program.bound(device, model, space, groups)?;
        Ok((bindings, &self.dispatches, (index * 3 * size_of::<u32>()) as u64))
    }

    /// Forgets all notes: something was changed by the host, or without a note.
    pub(crate) fn forget(&mut self, device: &Device) -> Result<(), DeviceError> {
        if self.runs > 0 {
            self.past = self.work();
            (self.runs, self.selected) = (0, 0);
            device.upload(&self.notes, 0, &vec![0; self.notes.size() as usize])?;
        }
        Ok(())
    }

    /// What the device has to tell.
    pub(crate) fn head(&self) -> &Buffer {
        &self.notes
    }

    /// Learns from what the device tells after so many steps.
    pub(crate) fn learn(&mut self, device: &Device, words: &[u32], steps: u64) -> Result<(), DeviceError> {
        if !self.is_looking() {
            self.rest = self.rest.saturating_sub(steps);
            return Ok(());
        }
        let runs = u64::from(words[0]);
        self.selected = u64::from(words[2]) << 32 | u64::from(words[1]);
        // In the first runs all tiles are new.
        let processes = self.processes.len() as u64;
        if runs > 4 * processes {
            let all = (runs - processes) * self.tiles as u64;
            let later = self.selected.saturating_sub(processes * self.tiles as u64);
            if later as f64 > BUSY * all as f64 {
                self.forget(device)?;
                self.rest = self.next_rest;
                self.next_rest = LONGEST_REST.min(2 * self.next_rest);
            }
        }
        if runs > MOST_RUNS { self.forget(device) } else { Ok(()) }
    }

    /// The tiles selected so far, and all tiles, of the runs with a selection.
    fn work(&self) -> [u64; 2] {
        [self.past[0] + self.selected, self.past[1] + self.runs * self.tiles as u64]
    }

    /// The share of tiles that were worked on, of the runs with a selection.
    pub(crate) fn share(&self) -> Option<f64> {
        let [selected, all] = self.work();
        (all > 0).then(|| selected as f64 / all as f64)
    }

    /// The bytes that it takes.
    pub(crate) fn memory(&self) -> usize {
        (self.notes.size() + self.dispatches.size()) as usize
    }
}

/// Whether the result of a process follows from the substates of cells and the parameters alone: it draws no
/// random numbers, and has nothing to do with items.
fn can_be_selected(program: &Program) -> bool {
    let of_step_or_items = |content: &Content| {
        matches!(
            content,
            Content::Moment(_)
                | Content::ItemStarts
                | Content::ItemEnds
                | Content::ItemLabels
                | Content::ItemCells
                | Content::Destinations
        )
    };
    let mut bindings = program.shader.bindings.iter();
    program.process.kind == ProcessKind::Cells && !bindings.any(|binding| of_step_or_items(&binding.content))
}

/// For each substate that a process uses and each process that writes it: where that notes its changes, in
/// words, and whether the substate is read at neighbours.
fn sources(
    model: &Model,
    place: usize,
    programs: &[Program],
    (regions, tiles): (&[usize], usize),
) -> Vec<[u32; 2]> {
    let mut sources = Vec::new();
    for found in &model.plan().process(place).uses {
        for (program, region) in programs.iter().zip(regions) {
            let row = program.written(model).position(|written| written == found.substate);
            sources.extend(row.map(|row| {
                let start = region + ACTIVITY_HEAD as usize + (2 + row) * tiles;
                [start as u32, u32::from(found.elsewhere)]
            }));
        }
    }
    sources
}
