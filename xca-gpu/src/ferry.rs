//! Values of chosen cells, picked up from a buffer of the space into another one, and set down in it.

use crate::device::{Binding, Buffer, Device, DeviceError, Recorder};
use crate::service::{FERRY, Services};
use crate::space::{Section, Space};

/// The cells that values are picked up from, and as many in which they are set down.
#[derive(Debug)]
pub(crate) struct Ferry {
    /// Of each cell its number in its section, and its seat.
    crossings: Buffer,
    trips: Vec<Trip>,
}

/// Picks up the values of cells in one section, or sets them down.
#[derive(Debug)]
struct Trip {
    section: Section,
    first: usize,
    count: usize,
    pick_up: bool,
}

impl Ferry {
    /// Between the cells with these stored numbers: the value of the first in the one list goes to the first
    /// in the other.
    pub(crate) fn new(
        device: &Device,
        space: &Space,
        from: &[usize],
        to: &[usize],
    ) -> Result<Self, DeviceError> {
        let (mut crossings, mut trips) = (Vec::new(), Vec::new());
        add_trips(space, from, true, &mut crossings, &mut trips);
        add_trips(space, to, false, &mut crossings, &mut trips);
        Ok(Self { crossings: filled(device, "crossings", &crossings)?, trips })
    }

    /// Picks up values of so many words from a buffer of the space into seats, or sets them down.
    pub(crate) fn cross(
        &self,
        device: &Device,
        recorder: &mut Recorder,
        services: &mut Services,
        (buffer, words): (&Buffer, usize),
        (seats, pick_up): (&Binding, bool),
    ) -> Result<(), DeviceError> {
        self.trips.iter().filter(|trip| trip.pick_up == pick_up).try_for_each(|trip| {
            let constants = [
                ("WORDS", words),
                ("FIRST", trip.first),
                ("CROSSINGS", trip.count),
                ("PICK_UP", usize::from(pick_up)),
            ];
            let size = words * size_of::<u32>();
            let Section { base, stored, .. } = trip.section;
            let section = Binding::part(buffer, (base * size) as u64, (stored * size) as u64);
            let bound = (&constants[..], &[(&self.crossings).into(), section, seats.clone()][..]);
            services.run(device, recorder, FERRY, bound, trip.count * words)
        })
    }

    /// The bytes that it takes.
    pub(crate) fn memory(&self) -> u64 {
        self.crossings.size()
    }
}

/// For each section the cells that lie in it, each with its seat.
fn add_trips(
    space: &Space,
    cells: &[usize],
    pick_up: bool,
    crossings: &mut Vec<[u32; 2]>,
    trips: &mut Vec<Trip>,
) {
    let mut waiting: Vec<(usize, usize)> =
        cells.iter().enumerate().map(|(seat, cell)| (*cell, seat)).collect();
    for section in space.sections() {
        let first = crossings.len();
        // A cell may lie in several sections, and is taken in one.
        let taken = |(cell, _): &(usize, usize)| (section.base..section.base + section.stored).contains(cell);
        let here = waiting.iter().filter(|crossing| taken(crossing));
        crossings.extend(here.map(|(cell, seat)| [(cell - section.base) as u32, *seat as u32]));
        waiting.retain(|crossing| !taken(crossing));
        let count = crossings.len() - first;
        if count > 0 {
            trips.push(Trip { section: section.clone(), first, count, pick_up });
        }
    }
}

/// A buffer with these numbers.
pub(crate) fn filled(device: &Device, name: &str, numbers: &[[u32; 2]]) -> Result<Buffer, DeviceError> {
    let buffer = device.buffer(name, size_of_val(numbers) as u64)?;
    device.upload(&buffer, 0, bytemuck::cast_slice(numbers))?;
    Ok(buffer)
}
