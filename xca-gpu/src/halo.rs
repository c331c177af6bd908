//! The halo of dense substates: filled by the boundary rules after each process that writes them.

use crate::device::{Buffer, Device, DeviceError, Recorder};
use crate::ferry::{Ferry, filled};
use crate::plane::Plane;
use crate::service::{MIRROR, Services};
use crate::space::{HaloCell, Shown, Space};

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
    /// By a buffer that is filled from one section after the other, and emptied into one after the other.
    Ferry { ferry: Ferry, seats: Buffer },
}

impl Halo {
    /// For planes whose values have at most so many bytes.
    pub(crate) fn new(device: &Device, space: &Space, largest: usize) -> Result<Self, DeviceError> {
        let cells = space.halo();
        let pair = |cell: &HaloCell| match cell.shows {
            Shown::Cell(source) => Some((cell.number, source)),
            Shown::Outside(_) | Shown::Elsewhere => None,
        };
        let pairs: Vec<(usize, usize)> = cells.iter().filter_map(pair).collect();
        let way = if pairs.is_empty() || !space.halo_follows() {
            Way::Never
        } else if space.sections().len() == 1 {
            let numbers: Vec<[u32; 2]> =
                pairs.iter().map(|(cell, source)| [*cell as u32, *source as u32]).collect();
            Way::Mirror { pairs: filled(device, "halo", &numbers)?, count: pairs.len() }
        } else {
            let seats = device.buffer("halo on its way", (pairs.len() * largest) as u64)?;
            let (to, from): (Vec<usize>, Vec<usize>) = pairs.into_iter().unzip();
            Way::Ferry { ferry: Ferry::new(device, space, &from, &to)?, seats }
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
            Way::Ferry { ferry, seats } => [true, false].into_iter().try_for_each(|pick_up| {
                ferry.cross(device, recorder, services, (buffer, words), (&seats.into(), pick_up))
            }),
        }
    }

    /// The bytes that it takes.
    pub(crate) fn memory(&self) -> usize {
        let on_device = match &self.way {
            Way::Never => 0,
            Way::Mirror { pairs, .. } => pairs.size(),
            Way::Ferry { ferry, seats } => ferry.memory() + seats.size(),
        };
        on_device as usize
    }
}
