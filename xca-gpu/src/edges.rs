//! Communication between the parts of a space: the edges of planes that other parts see.
//!
//! All parts run the same processes. The same halos are stale in all parts, so each part knows the next
//! message of its neighbours. Edges go through the memory of the host: the device gathers them in one buffer,
//! which is read back and sent, and what arrives goes the same way.

use crate::device::{Binding, Buffer, Device, DeviceError, Landing, Recorder};
use crate::ferry::Ferry;
use crate::groups::Groups;
use crate::service::Services;
use crate::space::Space;
use std::collections::HashSet;
use std::ops::Range;
use xca_core::engine::{Border, EngineFailure, SubstateId};
use xca_core::{Face, Model};

/// What a region of seats is aligned to: what bindings are aligned to at most.
const ALIGNMENT: usize = 256;

/// The bytes before the seats where they land: those that tell whether a fault has stopped the device.
const HEAD: u64 = 16;
/// Where a word says so, in the buffer of faults.
const STOPPED: Range<usize> = 4..8;

/// The connection of a part to the others.
pub(crate) struct Edges {
    pub(crate) border: Box<dyn Border>,
    /// The axes with borders, in order.
    axes: Vec<Axis>,
    /// The substates that processes read at neighbours.
    looked_at: HashSet<SubstateId>,
    /// Those of which other parts have not yet sent what lies beyond borders.
    stale: HashSet<SubstateId>,
    seats: Buffer,
    landing: Landing,
}

/// The borders of a part along an axis.
struct Axis {
    /// Each with the seats of its cells.
    faces: Vec<(Face, Range<usize>)>,
    ferry: Ferry,
    /// The number of seats.
    count: usize,
}

impl Edges {
    /// For the part whose cells are stored, with these substates that processes read at neighbours, each with
    /// the bytes of its values.
    pub(crate) fn new(
        device: &Device,
        space: &Space,
        sizes: &[(SubstateId, usize)],
        border: Box<dyn Border>,
    ) -> Result<Self, DeviceError> {
        let borders = space.part().borders(space.geometry());
        let mut axes = Vec::new();
        for axis in (0..3).filter(|axis| space.reach()[*axis] > 0) {
            let (mut faces, mut own, mut beyond) = (Vec::new(), Vec::new(), Vec::new());
            for face in Face::ALONG[axis].into_iter().filter(|face| borders[*face]) {
                let [sent, received] = space.edges(face);
                faces.push((face, own.len()..own.len() + sent.len()));
                own.extend(sent);
                beyond.extend(received);
            }
            if !faces.is_empty() {
                let ferry = Ferry::new(device, space, &own, &beyond)?;
                axes.push(Axis { faces, ferry, count: own.len() });
            }
        }
        let bytes = |axis: &Axis| sizes.iter().map(|(_, size)| axis.region(*size)).sum::<usize>();
        let most = axes.iter().map(bytes).max().unwrap_or(0) as u64;
        let looked_at: HashSet<SubstateId> = sizes.iter().map(|(substate, _)| *substate).collect();
        Ok(Self {
            border,
            axes,
            stale: looked_at.clone(),
            looked_at,
            seats: device.buffer("edges of parts", most)?,
            landing: device.landing(HEAD + most)?,
        })
    }

    /// Notes that a substate has changed in all parts.
    pub(crate) fn changed(&mut self, substate: SubstateId) {
        if self.looked_at.contains(&substate) {
            self.stale.insert(substate);
        }
    }

    /// Notes that nothing is known of the other parts: they have stopped at different places.
    pub(crate) fn forget(&mut self) {
        self.stale.clone_from(&self.looked_at);
    }

    /// The substates that this process reads at neighbours and that are stale, in the order of the model.
    pub(crate) fn needed(&self, model: &Model, process: usize) -> Vec<SubstateId> {
        let mut needed = Vec::new();
        for used in model.plan().process(process).uses.iter().filter(|used| used.elsewhere) {
            if self.stale.contains(&used.substate) && !needed.contains(&used.substate) {
                needed.push(used.substate);
            }
        }
        needed
    }

    /// Submits what is recorded, exchanges the edges of these substates, and records that what has arrived is
    /// set down. Gives nothing, and sends nothing, if a fault has stopped the device.
    pub(crate) fn exchange(
        &mut self,
        device: &Device,
        mut recorder: Recorder,
        services: &mut Services,
        groups: &Groups,
        substates: &[SubstateId],
    ) -> Result<Option<Recorder>, EngineFailure> {
        for Axis { faces, ferry, count } in &self.axes {
            let regions = regions(groups, substates, *count);
            let end = regions.last().map_or(0, |region| region.bytes.end) as u64;
            let cross = |recorder: &mut Recorder, services: &mut Services, pick_up: bool| {
                regions.iter().try_for_each(|region| {
                    let plane = (groups.plane(region.substate).now(), region.size / size_of::<u32>());
                    let seats = (&region.seats(&self.seats), pick_up);
                    ferry.cross(device, recorder, services, plane, seats)
                })
            };
            cross(&mut recorder, services, true)?;
            recorder.land_at(groups.faults(), &self.landing, 0..HEAD);
            recorder.land_at(&self.seats, &self.landing, HEAD..HEAD + end);
            device.submit(recorder)?;
            let landed = device.landed_before(&self.landing, HEAD + end)?;
            let (head, own) = landed.split_at(HEAD as usize);
            if head[STOPPED] != [0; 4] {
                return Ok(None);
            }
            let arrived = pass(&mut *self.border, faces, &regions, own)?;
            device.upload(&self.seats, 0, &arrived)?;
            recorder = device.recorder();
            cross(&mut recorder, services, false)?;
        }
        self.stale.retain(|substate| !substates.contains(substate));
        Ok(Some(recorder))
    }

    /// The bytes that it takes on the device.
    pub(crate) fn memory(&self) -> usize {
        let ferries = self.axes.iter().map(|axis| axis.ferry.memory());
        (ferries.sum::<u64>() + self.seats.size()) as usize
    }
}

impl Axis {
    /// The bytes for the values of a substate.
    fn region(&self, size: usize) -> usize {
        (self.count * size).next_multiple_of(ALIGNMENT)
    }
}

/// Where the values of a substate are while they travel.
struct Region {
    substate: SubstateId,
    /// The bytes of a value.
    size: usize,
    /// Those of all values.
    bytes: Range<usize>,
}

impl Region {
    fn seats(&self, seats: &Buffer) -> Binding {
        Binding::part(seats, self.bytes.start as u64, self.bytes.len() as u64)
    }

    /// Where the values of these seats are.
    fn of(&self, seats: &Range<usize>) -> Range<usize> {
        self.bytes.start + seats.start * self.size..self.bytes.start + seats.end * self.size
    }
}

/// One after the other, for so many values.
fn regions(groups: &Groups, substates: &[SubstateId], count: usize) -> Vec<Region> {
    let mut start = 0;
    let mut regions = Vec::new();
    for substate in substates {
        let size = groups.plane(*substate).size();
        let bytes = start..start + count * size;
        start = bytes.end.next_multiple_of(ALIGNMENT);
        regions.push(Region { substate: *substate, size, bytes });
    }
    regions
}

/// Sends the own edges across these faces, and gives what has come across them.
fn pass(
    border: &mut dyn Border,
    faces: &[(Face, Range<usize>)],
    regions: &[Region],
    own: &[u8],
) -> Result<Vec<u8>, EngineFailure> {
    for (face, seats) in faces {
        let values = regions.iter().flat_map(|region| &own[region.of(seats)]);
        border.send(*face, values.copied().collect())?;
    }
    let mut arrived = vec![0; own.len()];
    for (face, seats) in faces {
        let message = border.receive(*face)?;
        let mut rest = message.as_slice();
        for region in regions {
            let place = region.of(seats);
            let (values, others) = rest.split_at_checked(place.len()).ok_or_else(mismatch)?;
            arrived[place].copy_from_slice(values);
            rest = others;
        }
        if !rest.is_empty() {
            return Err(mismatch());
        }
    }
    Ok(arrived)
}

/// A message of unexpected length.
fn mismatch() -> EngineFailure {
    let reason = "another part of the space has sent an edge of another size".to_owned();
    EngineFailure::Broken { engine: "gpu".to_owned(), reason }
}
