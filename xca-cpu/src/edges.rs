//! Communication between the parts of a space: the edges of planes, and the first fault.
//!
//! All parts run the same stages at the same time. The same halos are stale in all parts, so each part knows
//! the next message of its neighbours. Nothing here waits on a thread of the engine, because parts that share
//! threads would block each other.

use crate::activity::Activity;
use crate::dense::Dense;
use crate::ghosts::{self, faces, mismatch};
use crate::group::Group;
use crate::layout::Layout;
use crate::rows::{FirstFault, searched};
use crate::threads::Threads;
use xca_core::engine::{Border, EngineFailure, Fault, Part, SubstateId};
use xca_core::{Face, Faces, Model};

/// No fault. The value is larger than that of any fault.
const NO_FAULT: u64 = u64::MAX;

/// A part of a space, and its connection to the others.
pub(crate) struct Edges {
    pub(crate) part: Part,
    pub(crate) border: Box<dyn Border>,
    /// The last message across each face, by group and field. The halo does not show what has changed,
    /// because planes with a second buffer have two halos.
    received: Vec<Vec<Faces<Vec<u8>>>>,
}

impl Edges {
    pub(crate) fn new(model: &Model, part: Part, border: Box<dyn Border>) -> Self {
        let fields = model.groups().iter().map(|group| group.schema().fields.len());
        let received = fields.map(|fields| vec![Faces::default(); fields]).collect();
        Self { part, border, received }
    }

    /// Fills the halos that processes read. Processes become due where the halo has changed. For populations,
    /// receives the items that are visible from here.
    pub(crate) fn exchange(
        &mut self,
        (model, processes): (&Model, &[usize]),
        layout: &Layout,
        threads: &Threads,
        groups: &mut [Group],
        activity: Option<&Activity>,
    ) -> Result<(), EngineFailure> {
        let searched = searched(model, processes);
        for group in seen(model, processes) {
            if let Group::Population(population) = &mut groups[group] {
                let slack = if searched.contains(&group) {
                    threads.run(|| population.slack(layout, model.geometry()))
                } else {
                    0.0
                };
                ghosts::exchange(population, layout, threads, &mut *self.border, slack)?;
            }
        }
        let stale = stale(model, groups, processes);
        if stale.is_empty() {
            return Ok(());
        }
        let each = |groups: &mut [Group], fill: fn(&mut Dense, &Layout)| {
            threads.run(|| {
                for substate in &stale {
                    if let Group::Cells(planes) = &mut groups[substate.group] {
                        fill(&mut planes[substate.field], layout);
                    }
                }
            });
        };
        // Each axis includes the halo of the earlier axes, so corners need no messages of their own.
        each(groups, Dense::fill_rows);
        self.exchange_along(1, layout, groups, &stale, activity)?;
        each(groups, Dense::fill_layers);
        self.exchange_along(2, layout, groups, &stale, activity)
    }

    fn exchange_along(
        &mut self,
        axis: usize,
        layout: &Layout,
        groups: &mut [Group],
        stale: &[SubstateId],
        activity: Option<&Activity>,
    ) -> Result<(), EngineFailure> {
        let faces = faces(layout, axis);
        for &face in &faces {
            let mut bytes = Vec::new();
            for substate in stale {
                if let Group::Cells(planes) = &groups[substate.group] {
                    planes[substate.field].pack(layout, face, &mut bytes);
                }
            }
            self.border.send(face, bytes)?;
        }
        for face in faces {
            let bytes = self.border.receive(face)?;
            let mut rest = &bytes[..];
            for substate in stale {
                if let Group::Cells(planes) = &mut groups[substate.group] {
                    let plane = &mut planes[substate.field];
                    let (edge, others) =
                        rest.split_at_checked(plane.edge(layout, face)).ok_or_else(mismatch)?;
                    rest = others;
                    plane.unpack(layout, face, edge);
                    let before = &mut self.received[substate.group][substate.field][face];
                    if let Some(activity) = activity
                        && before != edge
                    {
                        follow(activity, (*substate, plane), (layout, face), before, edge);
                    }
                    before.clear();
                    before.extend_from_slice(edge);
                }
            }
            if !rest.is_empty() {
                return Err(mismatch());
            }
        }
        Ok(())
    }

    /// Exchanges the results of a stage with all parts. Returns the common result.
    pub(crate) fn agree<T>(&mut self, result: Result<T, FirstFault>) -> Result<T, Fault> {
        let key = |first: &FirstFault| (first.process as u64) << 32 | u64::from(first.cell);
        let own = result.as_ref().err().map_or(NO_FAULT, key);
        let least = self.border.least(own)?;
        match result {
            Err(first) if own == least => Err(first.fault),
            Ok(value) if least == NO_FAULT => Ok(value),
            _ => Err(EngineFailure::Elsewhere.into()),
        }
    }
}

/// The groups that processes read elsewhere, sorted, each once.
pub(crate) fn seen(model: &Model, processes: &[usize]) -> Vec<usize> {
    let uses = processes.iter().flat_map(|&number| &model.plan().process(number).uses);
    let mut groups: Vec<usize> =
        uses.filter(|found| found.elsewhere).map(|found| found.substate.group).collect();
    groups.sort_unstable();
    groups.dedup();
    groups
}

/// The planes that processes read elsewhere and whose halos are stale. They are the same in all parts.
fn stale(model: &Model, groups: &[Group], processes: &[usize]) -> Vec<SubstateId> {
    let mut stale = Vec::new();
    for found in processes.iter().flat_map(|&number| &model.plan().process(number).uses) {
        let substate = found.substate;
        if found.elsewhere
            && let Group::Cells(planes) = &groups[substate.group]
            && planes[substate.field].is_stale()
            && !stale.contains(&substate)
        {
            stale.push(substate);
        }
    }
    stale
}

/// Makes processes due if they see a change in the halo.
fn follow(
    activity: &Activity,
    (substate, plane): (SubstateId, &Dense),
    (layout, face): (&Layout, Face),
    before: &[u8],
    now: &[u8],
) {
    let element = plane.stored.element_size();
    let (start, width) = (layout.reach()[0] * element, layout.width() * element);
    let lines: Vec<[isize; 2]> = layout.lines_at(face, true).collect();
    let length = layout.line([0; 2]).len() * element;
    for (number, (line, now)) in lines.iter().cycle().zip(now.chunks_exact(length)).enumerate() {
        let cells = &now[start..start + width];
        // The first message counts as changed everywhere.
        let before = before.get(number * length + start..number * length + start + width);
        if before == Some(cells) {
            continue;
        }
        activity.changed_beyond(substate, *line, |tile| {
            let bytes = tile.start * element..tile.end * element;
            before.is_none_or(|before| before[bytes.clone()] != cells[bytes])
        });
    }
}
