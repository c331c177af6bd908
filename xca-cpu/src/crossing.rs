//! Migration between the parts of a space: items that leave this part, and items that arrive.

use crate::edges::Edges;
use crate::ghosts::{axes, faces, mismatch, number, pack_item, take, unpack_item};
use crate::layout::Layout;
use crate::migration::{Arrival, arrivals, check_slots, settle};
use crate::population::Population;
use crate::rows::Mover;
use crate::threads::Threads;
use xca_core::engine::{EngineFailure, Fault, Phase, Stopped};
use xca_core::{Face, Geometry, Process};

/// A migration, as in all parts.
#[derive(Clone, Copy)]
pub(crate) struct Migration<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) process: &'a Process,
    /// The index of the process in the model.
    pub(crate) number: usize,
}

/// An item on its way to another part: its cells, its label and its fields.
struct Traveller {
    cell: u32,
    from: u32,
    item: Vec<u8>,
}

/// Items that are under way before all rows have run.
pub(crate) struct Departure {
    /// Those that have not been sent yet, because they cross another axis only.
    rest: Vec<Traveller>,
}

/// Sends the items that leave this part along the first axis. `movers` are those of the rows that see another
/// part; no others can leave. `None` if a mover has no valid destination.
pub(crate) fn depart(
    Migration { geometry, process, .. }: Migration<'_>,
    population: &Population,
    layout: &Layout,
    edges: &mut Edges,
    movers: &[Mover],
) -> Result<Option<Departure>, EngineFailure> {
    let Ok((mut leaving, _)) = arrivals(population, geometry, process, movers) else { return Ok(None) };
    leaving.retain(|arrival| !edges.part.holds(geometry, arrival.cell as usize));
    let travellers = travellers(population, &leaving);
    let first = axes(layout).next();
    let rest = first.map(|axis| send(axis, geometry, layout, edges, travellers)).transpose()?;
    Ok(rest.map(|rest| Departure { rest }))
}

/// Moves items in this part. All other parts do the same. `departure` has those that left before.
pub(crate) fn migrate(
    migration: Migration<'_>,
    population: &mut Population,
    layout: &Layout,
    (edges, threads): (&mut Edges, &Threads),
    movers: &mut [Mover],
    departure: Option<Departure>,
) -> Result<(), Stopped> {
    let Migration { geometry, process, number } = migration;
    let stopped = |phase: Phase, fault: Fault| Stopped::new(number, phase, cell(&fault, geometry), fault);
    let destinations = arrivals(population, geometry, process, movers);
    let (all, left) = destinations.map_err(|fault| stopped(Phase::Destinations, fault))?;
    let is_own = |arrival: &Arrival| edges.part.holds(geometry, arrival.cell as usize);
    let (mut own, leaving): (Vec<Arrival>, Vec<Arrival>) = all.into_iter().partition(is_own);
    let has_departed = departure.is_some();
    let mut under_way =
        departure.map_or_else(|| travellers(population, &leaving), |departure| departure.rest);
    for (place, axis) in axes(layout).enumerate() {
        if place > 0 || !has_departed {
            under_way = send(axis, geometry, layout, edges, under_way)?;
        }
        receive(axis, geometry, population, layout, edges, (&mut under_way, &mut own))?;
    }
    if !under_way.is_empty() {
        return Err(mismatch().into());
    }
    own.sort_unstable();
    let slots = check_slots(population, layout, geometry, process, movers, &own);
    slots.map_err(|fault| stopped(Phase::Slots, fault))?;
    population.left += left;
    if let Some(lists) = &mut population.lists {
        leaving.iter().for_each(|arrival| lists.left(population.items.numbers[arrival.item as usize]));
    }
    if !movers.is_empty() || !own.is_empty() {
        threads.run(|| settle(population, layout, geometry, movers, &own));
    }
    Ok(())
}

fn travellers(population: &Population, leaving: &[Arrival]) -> Vec<Traveller> {
    let traveller = |arrival: &Arrival| {
        let mut item = Vec::new();
        pack_item(population, arrival.item as usize, &mut item);
        Traveller { cell: arrival.cell, from: arrival.from, item }
    };
    leaving.iter().map(traveller).collect()
}

/// Sends travellers along an axis. Returns those that cross no face along it.
fn send(
    axis: usize,
    geometry: &Geometry,
    layout: &Layout,
    edges: &mut Edges,
    mut travellers: Vec<Traveller>,
) -> Result<Vec<Traveller>, EngineFailure> {
    for face in faces(layout, axis) {
        let goes = |one: &Traveller| beyond(edges, geometry, axis, one) == Some(face);
        let (going, staying): (Vec<_>, Vec<_>) = travellers.into_iter().partition(goes);
        travellers = staying;
        let mut bytes = Vec::new();
        for Traveller { cell, from, item } in going {
            bytes.extend_from_slice(&cell.to_ne_bytes());
            bytes.extend_from_slice(&from.to_ne_bytes());
            bytes.extend_from_slice(&item);
        }
        edges.border.send(face, bytes)?;
    }
    Ok(travellers)
}

/// Receives travellers along an axis. Those that stay here are stored after all places, and become arrivals.
/// The others travel on.
fn receive(
    axis: usize,
    geometry: &Geometry,
    population: &mut Population,
    layout: &Layout,
    edges: &mut Edges,
    (under_way, arrived): (&mut Vec<Traveller>, &mut Vec<Arrival>),
) -> Result<(), EngineFailure> {
    for face in faces(layout, axis) {
        let bytes = edges.border.receive(face)?;
        let mut rest = &bytes[..];
        while !rest.is_empty() {
            let (cell, from) = (number(&mut rest)?, number(&mut rest)?);
            if edges.part.holds(geometry, cell as usize) {
                let (item, label) = unpack_item(population, &mut rest)?;
                arrived.push(Arrival { cell, label, item, from });
            } else {
                let size = population.types.iter().map(|stored| stored.size()).sum::<usize>();
                let item = take(&mut rest, size_of::<u32>() + size)?.to_vec();
                under_way.push(Traveller { cell, from, item });
            }
        }
    }
    Ok(())
}

/// The face of the part that a traveller crosses along an axis. It moves no farther than the reach of the
/// neighbourhood.
fn beyond(edges: &Edges, geometry: &Geometry, axis: usize, traveller: &Traveller) -> Option<Face> {
    let at = |cell: u32| geometry.indices(cell as usize)[axis] as isize;
    let (from, to) = (at(traveller.from), at(traveller.cell));
    let reach = geometry.neighbourhood().reach()[axis] as isize;
    let extent = geometry.extents()[axis] as isize;
    // On a torus, the shorter way counts.
    let place = match to - from {
        step if step > reach => to - extent,
        step if step < -reach => to + extent,
        _ => to,
    };
    let own = if axis == 1 { &edges.part.y } else { &edges.part.z };
    let [low, high] = Face::ALONG[axis];
    if place < own.start as isize {
        Some(low)
    } else if place >= own.end as isize {
        Some(high)
    } else {
        None
    }
}

/// The linear index of the cell of a migration fault.
fn cell(fault: &Fault, geometry: &Geometry) -> u32 {
    match fault {
        Fault::Nowhere { cell, .. }
        | Fault::Left { cell, .. }
        | Fault::TooFar { from: cell, .. }
        | Fault::CellFull { cell, .. } => geometry.linear(*cell) as u32,
        _ => 0,
    }
}
