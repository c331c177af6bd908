//! Migration on the device: counts the arrivals of each cell, adds them up to ranges, puts the items there
//! and sorts them by label.
//!
//! Which item reaches a range first depends on the device; but in the end each range is sorted by label, so
//! that nothing of that stays, and the items lie as on every other engine.

use crate::device::{Binding, Buffer, Device, DeviceError, Recorder};
use crate::groups::Groups;
use crate::halo::Halo;
use crate::population::Population;
use crate::service::{AIM, BLOCK, DEPART, GATHER, PLACE, SORT, SPREAD_BLOCKS, SUM_BLOCKS, Services};
use crate::space::Space;
use xca_core::Parity;

/// The buffers of the migrations of a population.
#[derive(Debug)]
pub(crate) struct Migration {
    group: usize,
    /// The space as the engine's shaders know it.
    space: Buffer,
    displacements: Buffer,
    /// For each item the stored number of the cell where it goes.
    targets: Buffer,
    /// For each stored cell how many come.
    arrivals: Buffer,
    /// For each new place the item that comes there.
    order: Buffer,
    /// The sums of blocks, of blocks of blocks and so on, and the sums before each.
    sums: Vec<[Buffer; 2]>,
    zero: Buffer,
}

/// What a shader is bound to beside constants.
type Parts<'a> = &'a [Binding];

impl Migration {
    pub(crate) fn new(
        device: &Device,
        space: &Space,
        group: usize,
        population: &Population,
    ) -> Result<Self, DeviceError> {
        let displacements: Vec<[i32; 4]> = {
            let neighbourhood = space.geometry().neighbourhood();
            let of = |cell| neighbourhood.displacements(cell).iter().map(|[x, y, z]| [*x, *y, *z, 0]);
            of([0, 0, 0]).chain(of([1, 1, 0])).collect()
        };
        let list = device.buffer("displacements", size_of_val(&*displacements) as u64)?;
        device.upload(&list, 0, bytemuck::cast_slice(&displacements))?;
        let mut sums = Vec::new();
        let mut blocks = space.stored().div_ceil(BLOCK);
        while blocks > 1 {
            let numbers = || device.buffer("sums", (blocks * size_of::<u32>()) as u64);
            sums.push([numbers()?, numbers()?]);
            blocks = blocks.div_ceil(BLOCK);
        }
        let numbers = |name: &str, count: usize| device.buffer(name, (count * size_of::<u32>()) as u64);
        Ok(Self {
            group,
            space: device.uniform("space", bytemuck::cast_slice(&description(space, population)))?,
            displacements: list,
            targets: numbers("targets", population.items)?,
            arrivals: numbers("arrivals", space.stored())?,
            order: numbers("order", population.items)?,
            sums,
            zero: numbers("zero", 1)?,
        })
    }

    /// Makes room for as many items as the population has now.
    pub(crate) fn make_room(&mut self, device: &Device, items: usize) -> Result<(), DeviceError> {
        let numbers = |name: &str| device.buffer(name, (items * size_of::<u32>()) as u64);
        (self.targets, self.order) = (numbers("targets")?, numbers("order")?);
        Ok(())
    }

    /// Forgets a migration that was stopped on its way.
    pub(crate) fn revive(&self, device: &Device) -> Result<(), DeviceError> {
        device.upload(&self.arrivals, 0, &vec![0; self.arrivals.size() as usize])
    }

    /// The population that it moves.
    pub(crate) fn group(&self) -> usize {
        self.group
    }

    /// Records the first half: where items go. Afterwards a fault has to be looked for.
    pub(crate) fn aim(
        &self,
        device: &Device,
        recorder: &mut Recorder,
        services: &mut Services,
        groups: &Groups,
    ) -> Result<(), DeviceError> {
        let Some(population) = groups.population(self.group) else { return Ok(()) };
        let parts: Parts<'_> = &[
            (&self.space).into(),
            groups.journal(Some(self.group)),
            groups.faults().into(),
            (&self.displacements).into(),
            (&population.destinations).into(),
            population.cells.now().into(),
            (&self.targets).into(),
            (&self.arrivals).into(),
        ];
        services.run(device, recorder, AIM, (&[], parts), population.items)
    }

    /// Records the ranges of cells and the order of items. Afterwards a fault has to be looked for: a cell
    /// may be full.
    pub(crate) fn arrange(
        &self,
        device: &Device,
        recorder: &mut Recorder,
        services: &mut Services,
        (groups, space): (&Groups, &Space),
    ) -> Result<(), DeviceError> {
        let Some(population) = groups.population(self.group) else { return Ok(()) };
        let journal = || groups.journal(Some(self.group));
        let levels = self.sums.len();
        let values = |level: usize| if level == 0 { &self.arrivals } else { &self.sums[level - 1][0] };
        let blocks = |level: usize| space.stored().div_ceil(BLOCK.pow(level as u32 + 1));
        for level in 0..levels {
            let parts: Parts<'_> = &[values(level).into(), (&self.sums[level][0]).into()];
            services.run(device, recorder, SUM_BLOCKS, (&[], parts), blocks(level) * 64)?;
        }
        for level in (0..=levels).rev() {
            let before = self.sums.get(level).map_or(&self.zero, |[_, before]| before);
            let results = if level == 0 { &population.starts } else { &self.sums[level - 1][1] };
            let parts: Parts<'_> = &[values(level).into(), before.into(), results.into()];
            services.run(device, recorder, SPREAD_BLOCKS, (&[], parts), blocks(level) * 64)?;
        }
        let parts: Parts<'_> = &[
            journal(),
            groups.faults().into(),
            (&self.targets).into(),
            (&population.starts).into(),
            (&self.arrivals).into(),
            (&self.order).into(),
        ];
        services.run(device, recorder, PLACE, (&[], parts), population.items)?;
        let mut parts: Vec<Binding> = vec![
            (&self.space).into(),
            journal(),
            groups.faults().into(),
            (&population.starts).into(),
            (&population.ends).into(),
            population.labels.now().into(),
            (&self.order).into(),
        ];
        parts.extend(groups.ended_early().map(Binding::from));
        services.run(device, recorder, SORT, (&[], &parts), space.stored())
    }

    /// Records the moves themselves. Afterwards the population has to be swapped.
    pub(crate) fn settle(
        &self,
        device: &Device,
        recorder: &mut Recorder,
        services: &mut Services,
        (groups, halo): (&Groups, &Halo),
    ) -> Result<(), DeviceError> {
        let journal = groups.journal(Some(self.group));
        let faults = Binding::from(groups.faults());
        let Some(population) = groups.population(self.group) else { return Ok(()) };
        let items = population.items;
        let fields = population.fields.iter();
        let moves = fields
            .chain([&population.labels])
            .map(|plane| (plane.now(), plane.next(), plane.size() / size_of::<u32>()))
            .chain([(&self.targets, population.cells.next(), 1)]);
        for (before, after, words) in moves {
            let parts: Parts<'_> =
                &[journal.clone(), faults.clone(), (&self.order).into(), before.into(), after.into()];
            services.run(device, recorder, GATHER, (&[("WORDS", words)], parts), items * words)?;
        }
        services.run(device, recorder, DEPART, (&[], &[journal, faults]), 1)?;
        [&population.starts, &population.ends]
            .into_iter()
            .try_for_each(|ranges| halo.fill_words(device, recorder, services, ranges, 1))
    }

    /// The bytes that it takes.
    pub(crate) fn memory(&self) -> usize {
        let numbers = [&self.displacements, &self.targets, &self.arrivals, &self.order];
        let sums = self.sums.iter().flatten().map(Buffer::size);
        (numbers.map(Buffer::size).iter().sum::<u64>() + sums.sum::<u64>()) as usize
    }
}

/// The space as `shaders/common.wgsl` lays it out.
pub(crate) fn description(space: &Space, population: &Population) -> [u32; 16] {
    let geometry = space.geometry();
    let [width, height, depth] = geometry.extents().map(|extent| extent as u32);
    let [x, y, z] = space.reach().map(|reach| reach as u32);
    let [along_x, along_y, along_z] = geometry.toroidal().map(u32::from);
    let parity = match geometry.neighbourhood().parity() {
        Parity::None => 0,
        Parity::Row => 1,
        Parity::Column => 2,
    };
    let (cells, row, layer) = (space.stored() as u32, space.row() as u32, space.layer() as u32);
    let neighbours = geometry.neighbourhood().size() as u32;
    let slots = u32::try_from(population.slots).unwrap_or(u32::MAX);
    [
        width,
        height,
        depth,
        cells,
        x,
        y,
        z,
        row,
        along_x,
        along_y,
        along_z,
        layer,
        neighbours,
        parity,
        slots,
        population.may_leave.into(),
    ]
}
