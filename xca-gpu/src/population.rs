//! A population in the device's memory: its items one after the other, and where those of each cell lie.

use crate::device::{Binding, Buffer, Device, DeviceError};
use crate::plane::Plane;
use crate::space::{HaloCell, Section, Shown, Space};
use xca_core::engine::Population as Items;
use xca_core::{Field, StoredType};
use xca_wgsl::Content;

/// The items of a population.
#[derive(Debug)]
pub(crate) struct Population {
    pub(crate) slots: usize,
    pub(crate) may_leave: bool,
    /// How many items there are, and how many have left, as of the last submission.
    pub(crate) items: usize,
    pub(crate) left: u64,
    names: Vec<&'static str>,
    types: Vec<StoredType>,
    /// For each field, whether some process writes it while it reads that of others; or a migration moves it.
    doubled: Vec<bool>,
    moves: bool,
    pub(crate) fields: Vec<Plane>,
    pub(crate) labels: Plane,
    /// The stored number of each item's cell.
    pub(crate) cells: Plane,
    /// For each stored cell its first item, and one past its last.
    pub(crate) starts: Buffer,
    pub(crate) ends: Buffer,
    /// What a migration answers for each item.
    pub(crate) destinations: Buffer,
}

/// One number for each item.
const NUMBER: StoredType = StoredType { scalar: xca_core::StoredScalar::U32, lanes: 1, length: 1 };

impl Population {
    /// An empty one.
    pub(crate) fn new(
        device: &Device,
        space: &Space,
        fields: &[Field],
        types: Vec<StoredType>,
        (slots, may_leave): (usize, bool),
        (doubled, moves): (Vec<bool>, bool),
    ) -> Result<Self, DeviceError> {
        let ranges = || device.buffer("ranges of items", (space.stored() * size_of::<u32>()) as u64);
        let mut population = Self {
            slots,
            may_leave,
            items: 0,
            left: 0,
            names: fields.iter().map(|field| field.name).collect(),
            types,
            doubled,
            moves,
            fields: Vec::new(),
            labels: Plane::new(device, "labels", NUMBER, 0, moves)?,
            cells: Plane::new(device, "cells of items", NUMBER, 0, moves)?,
            starts: ranges()?,
            ends: ranges()?,
            destinations: device.buffer("destinations", 0)?,
        };
        population.make_room(device, 0)?;
        Ok(population)
    }

    /// Makes room for so many items.
    fn make_room(&mut self, device: &Device, items: usize) -> Result<(), DeviceError> {
        let doubled = self.doubled.iter().map(|doubled| *doubled || self.moves);
        let fields = self.names.iter().zip(&self.types).zip(doubled);
        let fields =
            fields.map(|((name, stored), doubled)| Plane::new(device, name, *stored, items, doubled));
        self.fields = fields.collect::<Result<_, _>>()?;
        self.labels = Plane::new(device, "labels", NUMBER, items, self.moves)?;
        self.cells = Plane::new(device, "cells of items", NUMBER, items, self.moves)?;
        self.destinations = device.buffer("destinations", (items * size_of::<u32>()) as u64)?;
        self.items = items;
        Ok(())
    }

    /// Replaces all items.
    pub(crate) fn set(
        &mut self,
        device: &Device,
        space: &Space,
        halo: &[HaloCell],
        items: &Items,
    ) -> Result<(), DeviceError> {
        self.make_room(device, items.labels.len())?;
        let (mut starts, mut ends) = (vec![0_u32; space.stored()], vec![0_u32; space.stored()]);
        let mut cells = Vec::with_capacity(items.labels.len());
        let mut first = 0;
        for (linear, &count) in items.counts.iter().enumerate() {
            let number = space.number(space.geometry().indices(linear));
            (starts[number], ends[number]) = (first, first + count);
            cells.extend((0..count).map(|_| number as u32));
            first += count;
        }
        for HaloCell { number, shows } in halo {
            (starts[*number], ends[*number]) = match shows {
                Shown::Cell(source) => (starts[*source], ends[*source]),
                // There are no other parts where there are items.
                Shown::Outside(_) | Shown::Elsewhere => (0, 0),
            };
        }
        device.upload(&self.starts, 0, bytemuck::cast_slice(&starts))?;
        device.upload(&self.ends, 0, bytemuck::cast_slice(&ends))?;
        self.labels.write_items(device, bytemuck::cast_slice(&items.labels))?;
        self.cells.write_items(device, bytemuck::cast_slice(&cells))?;
        self.fields
            .iter()
            .zip(&items.fields)
            .try_for_each(|(plane, values)| plane.write_items(device, values))
    }

    /// Makes the items as a migration has moved them the present ones.
    pub(crate) fn swap(&mut self) {
        self.fields.iter_mut().for_each(Plane::swap);
        self.labels.swap();
        self.cells.swap();
    }

    /// All items.
    pub(crate) fn get(&self, device: &Device, space: &Space) -> Result<Items, DeviceError> {
        let numbers = |plane: &Plane| -> Result<Vec<u32>, DeviceError> {
            Ok(bytemuck::pod_collect_to_vec(&plane.read_items(device, self.items)?))
        };
        let mut counts = vec![0; space.geometry().cells()];
        for number in numbers(&self.cells)? {
            // After a fault within a migration the numbers may be none of cells.
            let cell = space.geometry().linear(space.cell(number as usize));
            if let Some(count) = counts.get_mut(cell) {
                *count += 1;
            }
        }
        let fields = self.fields.iter().map(|plane| plane.read_items(device, self.items));
        Ok(Items { counts, labels: numbers(&self.labels)?, fields: fields.collect::<Result<_, _>>()? })
    }

    /// How many items each row has that has any.
    pub(crate) fn row_lengths(&self, device: &Device, space: &Space) -> Result<Vec<usize>, DeviceError> {
        let cells: Vec<u32> = bytemuck::pod_collect_to_vec(&self.cells.read_items(device, self.items)?);
        let row = |cell: u32| cell as usize / space.row();
        Ok(cells.chunk_by(|cell, next| row(*cell) == row(*next)).map(<[u32]>::len).collect())
    }

    /// The most items in a cell, counted on the host.
    pub(crate) fn largest_occupancy(&self, device: &Device) -> Result<u32, DeviceError> {
        let cells: Vec<u32> = bytemuck::pod_collect_to_vec(&self.cells.read_items(device, self.items)?);
        Ok(cells.chunk_by(u32::eq).map(|items| items.len() as u32).max().unwrap_or(0))
    }

    /// What a process is bound to.
    pub(crate) fn binding(&self, content: &Content, section: Option<&Section>) -> Option<Binding> {
        let ranges = |buffer: &Buffer| match section {
            Some(section) => {
                let size = size_of::<u32>();
                Binding::part(buffer, (section.base * size) as u64, (section.stored * size) as u64)
            }
            None => buffer.into(),
        };
        match content {
            Content::ItemStarts => Some(ranges(&self.starts)),
            Content::ItemEnds => Some(ranges(&self.ends)),
            Content::ItemLabels => Some(self.labels.now().into()),
            Content::ItemCells => Some(self.cells.now().into()),
            Content::Destinations => Some((&self.destinations).into()),
            _ => None,
        }
    }

    /// The bytes that it takes.
    pub(crate) fn memory(&self) -> usize {
        let planes = self.fields.iter().chain([&self.labels, &self.cells]).map(Plane::memory);
        let numbers = [&self.starts, &self.ends, &self.destinations].map(|buffer| buffer.size() as usize);
        planes.sum::<usize>() + numbers.iter().sum::<usize>()
    }
}
