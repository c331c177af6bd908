//! The halo of dense substates: filled by the boundary rules after each process that writes them.

use crate::device::{Binding, Buffer, Device, DeviceError, Recorder};
use crate::plane::Plane;
use crate::service::{FERRY, MIRROR, Services};
use crate::space::{HaloCell, Part, Shown, Space};

/// The halo of a space on the device.
#[derive(Debug)]
pub(crate) struct Halo {
    cells: Vec<HaloCell>,
    way: Way,
}

/// How the halo is filled.
#[derive(Debug)]
enum Way {
    /// Nothing follows: beyond flat faces the same value stands for ever.
    Never,
    /// Cell by cell.
    Mirror { pairs: Buffer, count: usize },
    /// By a buffer that is filled from one part after the other, and emptied into one after the other.
    Ferry { crossings: Buffer, ferry: Buffer, trips: Vec<Trip> },
}

/// Picks up the values of cells in one part, or sets them down.
#[derive(Debug)]
struct Trip {
    part: Part,
    first: usize,
    count: usize,
    pick_up: bool,
}

impl Halo {
    /// For planes whose values have at most so many bytes.
    pub(crate) fn new(device: &Device, space: &Space, largest: usize) -> Result<Self, DeviceError> {
        let cells = space.halo();
        let pair = |cell: &HaloCell| match cell.shows {
            Shown::Cell(source) => Some((cell.number, source)),
            Shown::Outside(_) => None,
        };
        let pairs: Vec<(usize, usize)> = cells.iter().filter_map(pair).collect();
        let way = if pairs.is_empty() || !space.halo_follows() {
            Way::Never
        } else if space.parts().len() == 1 {
            let numbers: Vec<[u32; 2]> =
                pairs.iter().map(|(cell, source)| [*cell as u32, *source as u32]).collect();
            Way::Mirror { pairs: filled(device, "halo", &numbers)?, count: pairs.len() }
        } else {
            let (crossings, trips) = trips(space, &pairs);
            let ferry = device.buffer("halo on its way", (pairs.len() * largest) as u64)?;
            Way::Ferry { crossings: filled(device, "halo", &crossings)?, ferry, trips }
        };
        Ok(Self { cells, way })
    }

    /// All cells of the halo.
    pub(crate) fn cells(&self) -> &[HaloCell] {
        &self.cells
    }

    /// Fills the halo of a plane's present values.
    pub(crate) fn fill(
        &self,
        device: &Device,
        recorder: &mut Recorder,
        services: &mut Services,
        plane: &Plane,
    ) -> Result<(), DeviceError> {
        self.fill_words(device, recorder, services, plane.now(), plane.size() / size_of::<u32>())
    }

    /// Fills the halo of a buffer with so many words for each cell.
    pub(crate) fn fill_words(
        &self,
        device: &Device,
        recorder: &mut Recorder,
        services: &mut Services,
        buffer: &Buffer,
        words: usize,
    ) -> Result<(), DeviceError> {
        match &self.way {
            Way::Never => Ok(()),
            Way::Mirror { pairs, count } => {
                let constants = [("WORDS", words), ("PAIRS", *count)];
                let bound = (&constants[..], &[pairs.into(), buffer.into()][..]);
                services.run(device, recorder, MIRROR, bound, count * words)
            }
            Way::Ferry { crossings, ferry, trips } => trips.iter().try_for_each(|trip| {
                let constants = [
                    ("WORDS", words),
                    ("FIRST", trip.first),
                    ("CROSSINGS", trip.count),
                    ("PICK_UP", usize::from(trip.pick_up)),
                ];
                let size = words * size_of::<u32>();
                let part =
                    Binding::part(buffer, (trip.part.base * size) as u64, (trip.part.stored * size) as u64);
                let bound = (&constants[..], &[crossings.into(), part, ferry.into()][..]);
                services.run(device, recorder, FERRY, bound, trip.count * words)
            }),
        }
    }

    /// The bytes that it takes.
    pub(crate) fn memory(&self) -> usize {
        let on_device = match &self.way {
            Way::Never => 0,
            Way::Mirror { pairs, .. } => pairs.size(),
            Way::Ferry { crossings, ferry, .. } => crossings.size() + ferry.size(),
        };
        on_device as usize
    }
}

/// For each part the cells to pick up, then for each part those to set down: each a number in the part and a
/// seat in the ferry.
fn trips(space: &Space, pairs: &[(usize, usize)]) -> (Vec<[u32; 2]>, Vec<Trip>) {
    let mut crossings = Vec::new();
    let mut trips = Vec::new();
    let holds = |part: &Part, cell: usize| (part.base..part.base + part.stored).contains(&cell);
    for pick_up in [true, false] {
        let mut waiting: Vec<(usize, usize)> = pairs
            .iter()
            .enumerate()
            .map(|(seat, (target, source))| (if pick_up { *source } else { *target }, seat))
            .collect();
        for part in space.parts() {
            let first = crossings.len();
            // A cell to be picked up lies in several parts, and is taken in one; one to be set down lies in
            // several as well.
            let taken = |(cell, _): &(usize, usize)| holds(part, *cell);
            crossings.extend(
                waiting
                    .iter()
                    .filter(|crossing| taken(crossing))
                    .map(|(cell, seat)| [(cell - part.base) as u32, *seat as u32]),
            );
            waiting.retain(|crossing| !taken(crossing));
            let count = crossings.len() - first;
            if count > 0 {
                trips.push(Trip { part: part.clone(), first, count, pick_up });
            }
        }
    }
    (crossings, trips)
}

/// A buffer with these numbers.
fn filled(device: &Device, name: &str, numbers: &[[u32; 2]]) -> Result<Buffer, DeviceError> {
    let buffer = device.buffer(name, size_of_val(numbers) as u64)?;
    device.upload(&buffer, 0, bytemuck::cast_slice(numbers))?;
    Ok(buffer)
}
