//! Migration between the parts of a space: items that leave this part, and items that arrive.

use crate::edges::{Edges, Phase, Stopped};
use crate::ghosts::{faces, mismatch, number, pack_item, take, unpack_item};
use crate::layout::Layout;
use crate::migration::{Arrival, arrivals, check_slots, settle};
use crate::population::Population;
use crate::rows::Mover;
use crate::threads::Threads;
use xca_core::engine::{EngineFailure, Fault};
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

/// Moves items in this part. All other parts do the same at the same time.
pub(crate) fn migrate(
    migration: Migration<'_>,
    population: &mut Population,
    layout: &Layout,
    (edges, threads): (&mut Edges, &Threads),
    movers: &mut [Mover],
) -> Result<(), Stopped> {
    let Migration { geometry, process, number } = migration;
    let stopped = |phase: Phase, fault: Fault| Stopped::new(number, phase, cell(&fault, geometry), fault);
    let destinations = arrivals(population, geometry, process, movers);
    let (all, left) = destinations.map_err(|fault| stopped(Phase::Destinations, fault))?;
    let is_own = |arrival: &Arrival| edges.part.holds(geometry, arrival.cell as usize);
    let (mut own, leaving): (Vec<Arrival>, Vec<Arrival>) = all.into_iter().partition(is_own);
    let travellers = leaving.iter().map(|arrival| {
        let mut item = Vec::new();
        pack_item(population, arrival.item as usize, &mut item);
        Traveller { cell: arrival.cell, from: arrival.from, item }
    });
    own.extend(exchange(migration, population, layout, edges, travellers.collect())?);
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

/// Sends travellers along y, then along z. Returns those that arrive here. They are stored after all places.
fn exchange(
    Migration { geometry, .. }: Migration<'_>,
    population: &mut Population,
    layout: &Layout,
    edges: &mut Edges,
    mut travellers: Vec<Traveller>,
) -> Result<Vec<Arrival>, EngineFailure> {
    let mut arrived = Vec::new();
    for axis in [1, 2] {
        let faces = faces(layout, axis);
        for &face in &faces {
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
        for &face in &faces {
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
                    travellers.push(Traveller { cell, from, item });
                }
            }
        }
    }
    if travellers.is_empty() { Ok(arrived) } else { Err(mismatch()) }
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
