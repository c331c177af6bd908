//! A model under way on a device.

mod memory;
mod part;
mod room;
mod steps;

pub(crate) use memory::least_memory;

use crate::activity::Activity;
use crate::cause::{Cause, Stop};
use crate::device::{Binding, Buffer, Device, DeviceError, Landing, Recorder};
use crate::edges::Edges;
use crate::error::NotOnDevice;
use crate::groups::{ENDED_EARLY, Groups, JOURNAL, JOURNAL_WORDS};
use crate::halo::Halo;
use crate::migration::Migration;
use crate::pace::Pace;
use crate::plane::size_on_device;
use crate::program::{Manner, Program, Texts};
use crate::service::{SEAL_AIM, SEAL_FULL, SEAL_REPORT, SORTING, Services};
use crate::space::Space;
use memory::{check_types, groups_of, looked_at, space_of};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use xca_core::engine::{Border, EngineFailure, Part, StepContext, SubstateId};
use xca_core::{Face, Faces, Model, ParameterValue, ProcessKind, Stream};

/// The bytes that activity is told by.
const ACTIVITY_TOLD: u64 = 16;

/// A model with its state on a device.
pub(crate) struct GpuExecution {
    pub(crate) model: Model,
    pub(crate) manner: Manner,
    pub(crate) device: Arc<Device>,
    pub(crate) space: Space,
    pub(crate) groups: Groups,
    pub(crate) halo: Halo,
    /// The connection to the other parts. `None` for the whole space.
    pub(crate) edges: Option<Edges>,
    pub(crate) services: Services,
    pub(crate) programs: Vec<Program>,
    /// Where it is looked for tiles in which something can change; and where what it tells lands.
    pub(crate) activity: Option<Activity>,
    activity_landing: Landing,
    pub(crate) migrations: Vec<Migration>,
    /// For each process, what its seals say: that it reported, that it aimed wrong, that it overfilled a
    /// cell.
    stamps: HashMap<(usize, Cause), Buffer>,
    /// The substates of cells that processes read at neighbours.
    looked_at: HashSet<SubstateId>,
    /// Where the journals land after each submission.
    landing: Landing,
    /// Where the note about loops that were ended early lands, if the device ends any.
    ended_early: Option<Landing>,
    pace: Pace,
    /// What the device was told last.
    parameters: Option<Vec<ParameterValue>>,
    seed: Option<u64>,
    step: Option<u64>,
    /// Whether a fault has stopped the device.
    stopped: bool,
}

impl GpuExecution {
    pub(crate) fn new(
        model: &Model,
        manner: Manner,
        device: Arc<Device>,
        texts: &Texts,
        shared: Option<(Part, Box<dyn Border>)>,
    ) -> Result<Self, NotOnDevice> {
        check_types(model, manner, &device)?;
        let (part, border) = shared.unzip();
        let space = space_of(model, part, manner)?;
        let mut programs = Vec::new();
        for (place, process) in model.processes().iter().enumerate() {
            let process = (*process, Stream::process(place));
            programs.push(Program::new(&device, model, &space, process, (manner, texts), false)?);
        }
        let activity = match border {
            // Nothing follows what other parts change.
            Some(_) => None,
            None => Activity::new(&device, model, &space, &programs, (manner, texts))?,
        };
        let doubled: HashSet<SubstateId> =
            programs.iter().flat_map(|program| program.doubled(model)).collect();
        let groups = groups_of(model, manner, &device, (&space, &programs, &doubled))?;
        let largest =
            (0..model.groups().len()).flat_map(|group| model.groups()[group].stored(manner.precision));
        let halo = Halo::new(&device, &space, largest.map(size_on_device).max().unwrap_or(4).max(4))?;
        let mut migrations = Vec::new();
        for group in groups.populations().collect::<Vec<_>>() {
            if let Some(population) = groups.population(group) {
                migrations.push(Migration::new(&device, &space, group, population)?);
            }
        }
        let mut stamps = HashMap::new();
        for (index, program) in programs.iter().enumerate() {
            for cause in Cause::of(program) {
                let words = [index as u32, cause as u32, 0, 0];
                stamps.insert((index, cause), device.uniform("stamp", bytemuck::cast_slice(&words))?);
            }
        }
        let looked_at = looked_at(model);
        let size = |substate: &SubstateId| (*substate, groups.plane(*substate).size());
        let sizes: Vec<(SubstateId, usize)> = looked_at.iter().map(size).collect();
        let edges = border.map(|border| Edges::new(&device, &space, &sizes, border)).transpose()?;
        let landing = device.landing(groups.journals().size())?;
        let activity_landing = device.landing(ACTIVITY_TOLD)?;
        let ended_early = groups.ended_early().map(|_| device.landing(ENDED_EARLY)).transpose()?;
        let execution = Self {
            model: model.clone(),
            manner,
            device,
            space,
            groups,
            halo,
            edges,
            services: Services::default(),
            programs,
            activity,
            activity_landing,
            migrations,
            stamps,
            looked_at,
            landing,
            ended_early,
            pace: Pace::new(),
            parameters: None,
            seed: None,
            step: None,
            stopped: false,
        };
        execution.write_outside()?;
        Ok(execution)
    }

    /// Writes what stands beyond flat faces.
    fn write_outside(&self) -> Result<(), DeviceError> {
        let cells = self.space.part().cells(self.space.geometry());
        for (number, group) in self.model.groups().iter().enumerate() {
            for (field, stored) in group.stored(self.manner.precision).iter().enumerate() {
                let substate = SubstateId { group: number, field };
                let Some(outside) = group.outside(field, self.manner.precision) else { continue };
                // The device's memory is full of zeros already.
                let is_zero = Face::ALL.iter().all(|face| outside[*face].iter().all(|byte| *byte == 0));
                if !is_zero && !self.halo.cells().is_empty() {
                    let zeros = vec![0; stored.size() * cells];
                    let plane = self.groups.plane(substate);
                    plane.write_space(&self.device, &self.space, self.halo.cells(), &outside, &zeros)?;
                }
            }
        }
        Ok(())
    }

    /// The stored bytes of a substate of cells beyond flat faces.
    pub(crate) fn outside(&self, substate: SubstateId) -> Faces<Vec<u8>> {
        let group = &self.model.groups()[substate.group];
        group.outside(substate.field, self.manner.precision).unwrap_or_default()
    }

    /// Tells the device what it does not know yet.
    fn prepare(&mut self, context: &StepContext<'_>) -> Result<(), DeviceError> {
        if self.stopped {
            self.revive()?;
        }
        let parameters: Vec<ParameterValue> = context.values.values().collect();
        let precision = self.manner.precision;
        if self.parameters.as_ref() != Some(&parameters) {
            for program in self.all_programs() {
                program.set_parameters(&self.device, context.values, precision)?;
            }
            self.forget_activity()?;
            self.parameters = Some(parameters);
        }
        if self.seed != Some(context.seed) {
            for program in self.all_programs() {
                program.set_space(&self.device, &self.space, context.seed, precision)?;
            }
            self.seed = Some(context.seed);
        }
        if self.step != Some(context.step) {
            let words = [context.step as u32, (context.step >> 32) as u32];
            for journal in 0..=self.model.groups().len() as u64 {
                self.device.upload(
                    self.groups.journals(),
                    journal * JOURNAL,
                    bytemuck::cast_slice(&words),
                )?;
            }
            self.step = Some(context.step);
        }
        Ok(())
    }

    fn all_programs(&self) -> impl Iterator<Item = &Program> {
        self.programs.iter().chain(self.activity.iter().flat_map(Activity::programs))
    }

    /// Has all processes run in all tiles: what they read was changed without a note.
    pub(crate) fn forget_activity(&mut self) -> Result<(), DeviceError> {
        self.activity.as_mut().map_or(Ok(()), |activity| activity.forget(&self.device))
    }

    /// Has the device go on after a fault, with a state that was put in place of the broken one.
    fn revive(&mut self) -> Result<(), DeviceError> {
        self.device.upload(self.groups.faults(), 0, bytemuck::cast_slice(&[u32::MAX, 0]))?;
        for migration in &self.migrations {
            migration.revive(&self.device)?;
        }
        self.forget_activity()?;
        for group in 0..=self.model.groups().len() as u64 {
            // Nobody is leaving; and nothing has stopped.
            self.device.upload(self.groups.journals(), group * JOURNAL + 12, &[0; 4])?;
            self.device.upload(self.groups.journals(), group * JOURNAL + 24, &[0; 4])?;
        }
        self.stopped = false;
        self.step = None;
        Ok(())
    }

    /// Records a process with all that follows from it. Says whether the device goes on.
    fn record(&mut self, recorder: &mut Recorder, index: usize) -> Result<bool, EngineFailure> {
        if !self.exchange(recorder, index)? {
            return Ok(false);
        }
        let program = &mut self.programs[index];
        let (device, model) = (&self.device, &self.model);
        let selecting = self.activity.as_mut().filter(|activity| activity.is_looking());
        let dispatches = if let Some(activity) = selecting {
            let known = (&self.space, &self.groups);
            let (bindings, dispatches, at) =
                activity.select((device, model), recorder, &mut self.services, known, index)?;
            recorder.run_as_told(&bindings, dispatches, at);
            // They are done already; what follows from them is not.
            vec![(bindings, [0; 3])]
        } else {
            program.dispatches(device, model, &self.space, &self.groups)?
        };
        for (bindings, workgroups) in dispatches {
            recorder.run(&bindings, workgroups);
            if self.stamps.contains_key(&(index, Cause::Reported)) {
                // After each section: so that it is the first section with a fault whose records are kept.
                seal(
                    device,
                    recorder,
                    &mut self.services,
                    (&self.groups, &self.stamps),
                    ((index, Cause::Reported), None),
                )?;
            }
        }
        let program = &self.programs[index];
        if program.process.kind == ProcessKind::Migration {
            let group = program.population(model);
            self.record_migration(recorder, index)?;
            if let Some(population) = group.and_then(|group| self.groups.population_mut(group)) {
                population.swap();
            }
            return Ok(true);
        }
        let doubled: Vec<SubstateId> = program.doubled(model).collect();
        let written: Vec<SubstateId> = program.written(model).collect();
        for substate in doubled {
            self.groups.plane_mut(substate).swap();
        }
        for substate in written {
            if self.looked_at.contains(&substate) {
                self.halo.fill(device, recorder, &mut self.services, self.groups.plane(substate))?;
            }
            if let Some(edges) = &mut self.edges {
                edges.changed(substate);
            }
        }
        Ok(true)
    }

    /// Records a migration. Afterwards its population has to be swapped.
    fn record_migration(&mut self, recorder: &mut Recorder, index: usize) -> Result<(), DeviceError> {
        let group = self.programs[index].population(&self.model);
        let device = &self.device;
        let Some(migration) = self.migrations.iter().find(|migration| Some(migration.group()) == group)
        else {
            return Ok(());
        };
        let services = &mut self.services;
        migration.aim(device, recorder, services, &self.groups)?;
        seal(device, recorder, services, (&self.groups, &self.stamps), ((index, Cause::Aimed), group))?;
        migration.arrange(device, recorder, services, (&self.groups, &self.space))?;
        seal(device, recorder, services, (&self.groups, &self.stamps), ((index, Cause::Full), group))?;
        migration.settle(device, recorder, services, (&self.groups, &self.halo))
    }

    /// Submits what was recorded, waits for it, and reads the journals. Tells what stopped the run.
    fn finish(&mut self, mut recorder: Recorder, steps: u64) -> Result<Option<Stop>, DeviceError> {
        recorder.land(self.groups.journals(), 0, &self.landing);
        if let (Some(note), Some(landing)) = (self.groups.ended_early(), &self.ended_early) {
            recorder.land(note, 0, landing);
        }
        if let Some(activity) = &self.activity {
            recorder.land(activity.head(), 0, &self.activity_landing);
        }
        self.device.submit(recorder)?;
        self.look_for_early_ends()?;
        if let Some(activity) = &mut self.activity {
            let words: Vec<u32> = bytemuck::pod_collect_to_vec(&self.device.landed(&self.activity_landing)?);
            activity.learn(&self.device, &words, steps)?;
        }
        let bytes = self.device.landed(&self.landing)?;
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
        let journals: Vec<&[u32]> =
            words.chunks((JOURNAL / 4) as usize).map(|words| &words[..JOURNAL_WORDS]).collect();
        for group in 0..self.model.groups().len() {
            if let Some(population) = self.groups.population_mut(group) {
                let journal = journals[group + 1];
                population.items = journal[2] as usize;
                population.left = long(journal[4], journal[5]);
            }
        }
        let journal = journals[0];
        if journal[6] == 0 {
            return Ok(None);
        }
        self.stopped = true;
        let process = (journal[6] - 1) as usize;
        let details = [journal[11], journal[12], journal[13], journal[14]];
        let fault = self.fault(process, journal[7], journal[10], details)?;
        Ok(Some(Stop { step: long(journal[8], journal[9]), process, at: journal[10], fault }))
    }

    /// An error where the device has ended a loop early.
    fn look_for_early_ends(&self) -> Result<(), DeviceError> {
        let (Some(landing), Some(turns)) = (&self.ended_early, self.device.turns()) else { return Ok(()) };
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(&self.device.landed(landing)?);
        let number = words.first().copied().unwrap_or(0);
        if number == 0 {
            return Ok(());
        }
        let program = self.programs.get(number as usize - 1).filter(|_| number != SORTING.get());
        let what = program.map(|program| format!("the process `{}`", program.process.name));
        let what = what.unwrap_or_else(|| "the sort of the items of a cell".to_owned());
        Err(DeviceError::EndedEarly { what, turns })
    }
}

/// Records a look for faults.
fn seal(
    device: &Device,
    recorder: &mut Recorder,
    services: &mut Services,
    (groups, stamps): (&Groups, &HashMap<(usize, Cause), Buffer>),
    (stamp, moved): ((usize, Cause), Option<usize>),
) -> Result<(), DeviceError> {
    let (index, cause) = stamp;
    let Some(stamp) = stamps.get(&(index, cause)) else { return Ok(()) };
    let mut parts = vec![stamp.into(), groups.journal(None), groups.faults().into()];
    let service = match (cause, moved.and_then(|group| groups.population(group))) {
        (Cause::Aimed, Some(population)) => {
            let items = [population.labels.now(), population.cells.now(), &population.destinations];
            parts.extend(items.map(Binding::from));
            SEAL_AIM
        }
        (Cause::Full, Some(population)) => {
            parts.extend([&population.starts, &population.ends].map(Binding::from));
            SEAL_FULL
        }
        _ => SEAL_REPORT,
    };
    services.run(device, recorder, service, (&[], &parts), 1)
}

fn long(low: u32, high: u32) -> u64 {
    u64::from(high) << 32 | u64::from(low)
}
