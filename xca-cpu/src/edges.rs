//! Communication between the parts of a space: the edges of planes.
//!
//! All parts run the same stages. The same halos are stale in all parts, so each part knows the next message
//! of its neighbours. Nothing here waits on a thread of the engine, because parts that share threads would
//! block each other.
//!
//! A part sends its edges, runs the rows that see no other part, and only then waits for the edges of others.
//! Where items migrate, it runs the rows at its borders first, sends the items that leave, and runs the
//! other rows before it waits for those that arrive.

use crate::activity::Activity;
use crate::dense::Dense;
use crate::ghosts::{self, Visible, axes, faces, mismatch, rows_at_borders};
use crate::group::Group;
use crate::layout::Layout;
use crate::rows::searched;
use crate::threads::Threads;
use std::sync::Arc;
use xca_core::engine::{Border, EngineFailure, Part, SubstateId};
use xca_core::{Face, Faces, Model};

/// Room at the end of a message, for what a border appends to it.
const MARGIN: usize = 16;

/// A part of a space, and its connection to the others.
pub(crate) struct Edges {
    pub(crate) part: Part,
    pub(crate) border: Box<dyn Border>,
    /// Whether each row sees another part.
    pub(crate) at_border: Arc<[bool]>,
    /// The last message across each face, by group and field, while changes are followed. The halo does not
    /// show what has changed, because planes with a second buffer have two halos.
    received: Vec<Vec<Faces<Vec<u8>>>>,
    /// Messages that have been read, for the bytes of the next ones. New memory is expensive: the system
    /// clears it.
    read: Vec<Vec<u8>>,
}

/// An exchange under way: this part has sent its edges along the first axis.
pub(crate) struct Exchange {
    populations: Vec<Visible>,
    /// The planes whose halos are stale.
    planes: Vec<SubstateId>,
    /// The axes with borders.
    axes: Vec<usize>,
}

impl Edges {
    pub(crate) fn new(model: &Model, layout: &Layout, part: Part, border: Box<dyn Border>) -> Self {
        let fields = model.groups().iter().map(|group| group.schema().fields.len());
        let received = fields.map(|fields| vec![Faces::default(); fields]).collect();
        Self { part, border, at_border: rows_at_borders(layout).into(), received, read: Vec::new() }
    }

    /// Sends what other parts see along the first axis. The halo is then complete for rows that see no other
    /// part. `None` if processes need nothing of other parts.
    pub(crate) fn begin(
        &mut self,
        (model, processes): (&Model, &[usize]),
        layout: &Layout,
        threads: &Threads,
        groups: &mut [Group],
    ) -> Result<Option<Exchange>, EngineFailure> {
        let searched = searched(model, processes);
        let mut populations = Vec::new();
        for group in seen(model, processes) {
            if let Group::Population(population) = &mut groups[group] {
                population.slack_of_ghosts = 0.0;
                let is_searched = searched.contains(&group);
                let mut slack = || threads.run(|| population.slack(layout, model.geometry()));
                let slack = if is_searched { slack() } else { 0.0 };
                populations.push(Visible { group, fields: seen_fields(model, processes, group), slack });
            }
        }
        let planes = stale(model, groups, processes);
        if populations.is_empty() && planes.is_empty() {
            return Ok(None);
        }
        let exchange = Exchange { populations, planes, axes: axes(layout).collect() };
        // Each axis includes the halo of the earlier axes, so corners need no messages of their own.
        exchange.fill(groups, threads, |plane| plane.fill_rows(layout));
        if let Some(first) = exchange.axes.first() {
            self.send(&exchange, *first, layout, groups)?;
        }
        exchange.fill(groups, threads, |plane| plane.fill_layers(layout));
        Ok(Some(exchange))
    }

    /// Fills the halos with what other parts have sent. Processes become due where the halo has changed. For
    /// populations, receives the items that are visible from here.
    pub(crate) fn finish(
        &mut self,
        exchange: &Exchange,
        layout: &Layout,
        threads: &Threads,
        groups: &mut [Group],
        activity: Option<&Activity>,
    ) -> Result<(), EngineFailure> {
        for (place, axis) in exchange.axes.iter().enumerate() {
            if place > 0 {
                self.send(exchange, *axis, layout, groups)?;
            }
            self.receive(exchange, *axis, layout, groups, activity)?;
            if *axis == 1 {
                // Layers beyond the faces along z continue the lines that have arrived along y.
                exchange.fill(groups, threads, |plane| plane.fill_layers(layout));
                for visible in &exchange.populations {
                    if let Group::Population(population) = &mut groups[visible.group] {
                        threads.run(|| population.fill_layers(layout));
                    }
                }
            }
        }
        for substate in &exchange.planes {
            if let Group::Cells(planes) = &mut groups[substate.group] {
                planes[substate.field].complete();
            }
        }
        Ok(())
    }

    fn send(
        &mut self,
        exchange: &Exchange,
        axis: usize,
        layout: &Layout,
        groups: &[Group],
    ) -> Result<(), EngineFailure> {
        for visible in &exchange.populations {
            if let Group::Population(population) = &groups[visible.group] {
                ghosts::send(population, visible, layout, axis, &mut *self.border)?;
            }
        }
        if exchange.planes.is_empty() {
            return Ok(());
        }
        for face in faces(layout, axis) {
            let mut bytes = self.read.pop().unwrap_or_default();
            bytes.clear();
            bytes.reserve(exchange.edge(groups, layout, face) + MARGIN);
            for substate in &exchange.planes {
                if let Group::Cells(planes) = &groups[substate.group] {
                    planes[substate.field].pack(layout, face, &mut bytes);
                }
            }
            self.border.send(face, bytes)?;
        }
        Ok(())
    }

    fn receive(
        &mut self,
        exchange: &Exchange,
        axis: usize,
        layout: &Layout,
        groups: &mut [Group],
        activity: Option<&Activity>,
    ) -> Result<(), EngineFailure> {
        for visible in &exchange.populations {
            if let Group::Population(population) = &mut groups[visible.group] {
                ghosts::receive(population, visible, layout, axis, &mut *self.border)?;
            }
        }
        if exchange.planes.is_empty() {
            return Ok(());
        }
        for face in faces(layout, axis) {
            let bytes = self.border.receive(face)?;
            let mut rest = &bytes[..];
            for substate in &exchange.planes {
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
                    if activity.is_some() {
                        before.extend_from_slice(edge);
                    }
                }
            }
            if !rest.is_empty() {
                return Err(mismatch());
            }
            if self.read.len() < Face::ALL.len() {
                self.read.push(bytes);
            }
        }
        Ok(())
    }
}

impl Exchange {
    /// The size of the message of planes across a face, in bytes.
    fn edge(&self, groups: &[Group], layout: &Layout, face: Face) -> usize {
        let of_plane = |substate: &SubstateId| match &groups[substate.group] {
            Group::Cells(planes) => planes[substate.field].edge(layout, face),
            Group::Population(_) => 0,
        };
        self.planes.iter().map(of_plane).sum()
    }

    /// Changes all planes of the exchange, in parallel.
    fn fill(&self, groups: &mut [Group], threads: &Threads, change: impl Fn(&mut Dense) + Sync) {
        if self.planes.is_empty() {
            return;
        }
        threads.run(|| {
            for substate in &self.planes {
                if let Group::Cells(planes) = &mut groups[substate.group] {
                    change(&mut planes[substate.field]);
                }
            }
        });
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

/// The fields of a group that processes read elsewhere, sorted, each once.
fn seen_fields(model: &Model, processes: &[usize], group: usize) -> Vec<usize> {
    let uses = processes.iter().flat_map(|&number| &model.plan().process(number).uses);
    let of_group = uses.filter(|found| found.elsewhere && found.substate.group == group);
    let mut fields: Vec<usize> = of_group.map(|found| found.substate.field).collect();
    fields.sort_unstable();
    fields.dedup();
    fields
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
