//! Ghosts: items of other parts that are visible from this part. During a stage their copies are stored after
//! all places of a population.

use crate::layout::Layout;
use crate::motion::largest;
use crate::population::Population;
use std::ops::Range;
use xca_core::Face;
use xca_core::engine::{Border, EngineFailure};

/// What other parts see of a population.
#[derive(Debug)]
pub(crate) struct Visible {
    /// The index of its group.
    pub(crate) group: usize,
    /// The fields that processes read from other items, sorted.
    pub(crate) fields: Vec<usize>,
    /// The largest distance in metres of an own item from its cell, along an axis.
    pub(crate) slack: f64,
}

/// Sends the items that are visible across the borders along an axis, and how far they are outside their
/// cells.
pub(crate) fn send(
    population: &Population,
    visible: &Visible,
    layout: &Layout,
    axis: usize,
    border: &mut dyn Border,
) -> Result<(), EngineFailure> {
    let pack = |face: Face| pack(population, visible, layout, face);
    faces(layout, axis).into_iter().try_for_each(|face| border.send(face, pack(face)))
}

/// Receives the items that are visible across the borders along an axis.
pub(crate) fn receive(
    population: &mut Population,
    visible: &Visible,
    layout: &Layout,
    axis: usize,
    border: &mut dyn Border,
) -> Result<(), EngineFailure> {
    for face in faces(layout, axis) {
        let bytes = border.receive(face)?;
        unpack(population, visible, layout, face, &bytes)?;
    }
    Ok(())
}

/// The faces across an axis beyond which this part sees another one.
pub(crate) fn faces(layout: &Layout, axis: usize) -> Vec<Face> {
    let borders = layout.borders();
    let seen = |face: &Face| borders[*face] && layout.reach()[axis] > 0;
    Face::ALONG[axis].into_iter().filter(seen).collect()
}

/// The axes across which this part sees others.
pub(crate) fn axes(layout: &Layout) -> impl Iterator<Item = usize> {
    [1, 2].into_iter().filter(|axis| !faces(layout, *axis).is_empty())
}

/// Whether each row sees another part of the space.
pub(crate) fn rows_at_borders(layout: &Layout) -> Vec<bool> {
    let mut at_border = vec![false; layout.rows()];
    let lines =
        axes(layout).flat_map(|axis| faces(layout, axis)).flat_map(|face| layout.lines_at(face, true));
    lines.flat_map(|line| layout.rows_that_see(line)).for_each(|row| at_border[row] = true);
    at_border
}

/// The message for another part: the slack, the number of items in each visible cell, the labels of all these
/// items, and each field of them.
fn pack(population: &Population, visible: &Visible, layout: &Layout, face: Face) -> Vec<u8> {
    // What is sent along z includes the ghosts along y, so corners need no messages of their own.
    let slack = largest(visible.slack, population.slack_of_ghosts);
    let mut bytes = slack.to_ne_bytes().to_vec();
    // The items of a row follow each other.
    let mut runs: Vec<Range<usize>> = Vec::new();
    for cell in layout.lines_at(face, false).flat_map(|line| layout.cells_of_line(line)) {
        let places = population.starts[cell] as usize..population.ends[cell] as usize;
        bytes.extend_from_slice(&(places.len() as u32).to_ne_bytes());
        match runs.last_mut() {
            _ if places.is_empty() => {}
            Some(run) if run.end == places.start => run.end = places.end,
            _ => runs.push(places),
        }
    }
    let labels: &[u8] = bytemuck::cast_slice(&population.items.labels);
    let fields = visible
        .fields
        .iter()
        .map(|field| (population.types[*field].size(), population.items.fields[*field].bytes()));
    for (size, values) in std::iter::once((size_of::<u32>(), labels)).chain(fields) {
        runs.iter().for_each(|run| bytes.extend_from_slice(&values[run.start * size..run.end * size]));
    }
    bytes
}

fn unpack(
    population: &mut Population,
    visible: &Visible,
    layout: &Layout,
    face: Face,
    bytes: &[u8],
) -> Result<(), EngineFailure> {
    let mut rest = bytes;
    let slack = bytemuck::pod_read_unaligned(take(&mut rest, size_of::<f64>())?);
    population.slack_of_ghosts = largest(population.slack_of_ghosts, slack);
    let first = population.items.labels.len() as u32;
    let mut place = first;
    for line in layout.lines_at(face, true) {
        for cell in layout.cells_of_line(line) {
            population.starts[cell] = place;
            place = place.checked_add(number(&mut rest)?).ok_or_else(mismatch)?;
            population.ends[cell] = place;
        }
        layout.fill_line(&mut population.starts, line);
        layout.fill_line(&mut population.ends, line);
    }
    let count = (place - first) as usize;
    let labels = take(&mut rest, count * size_of::<u32>())?;
    let mut fields = Vec::with_capacity(visible.fields.len());
    for field in &visible.fields {
        fields.push((*field, take(&mut rest, count * population.types[*field].size())?));
    }
    population.add_ghosts(labels, &fields);
    if rest.is_empty() { Ok(()) } else { Err(mismatch()) }
}

/// Removes the ghosts. Code that moves items never meets them.
pub(crate) fn clear(population: &mut Population, layout: &Layout) {
    population.truncate();
    for face in axes(layout).flat_map(|axis| faces(layout, axis)) {
        for line in layout.lines_at(face, true) {
            population.starts[layout.line(line)].fill(0);
            population.ends[layout.line(line)].fill(0);
        }
    }
    population.fill_layers(layout);
}

/// Appends the label and the fields of an item.
pub(crate) fn pack_item(population: &Population, place: usize, bytes: &mut Vec<u8>) {
    bytes.extend_from_slice(&population.items.labels[place].to_ne_bytes());
    for (field, stored) in population.items.fields.iter().zip(&population.types) {
        bytes.extend_from_slice(&field.bytes()[place * stored.size()..(place + 1) * stored.size()]);
    }
}

/// Adds an item after all places of a population. Returns its place and its label.
pub(crate) fn unpack_item(
    population: &mut Population,
    rest: &mut &[u8],
) -> Result<(u32, u32), EngineFailure> {
    let label = number(rest)?;
    let size = population.types.iter().map(|stored| stored.size()).sum();
    Ok((population.push(label, take(rest, size)?), label))
}

/// Takes a number from the front.
pub(crate) fn number(rest: &mut &[u8]) -> Result<u32, EngineFailure> {
    let bytes = take(rest, size_of::<u32>())?;
    Ok(bytemuck::pod_read_unaligned(bytes))
}

/// Takes `size` bytes from the front.
pub(crate) fn take<'a>(rest: &mut &'a [u8], size: usize) -> Result<&'a [u8], EngineFailure> {
    let (bytes, after) = rest.split_at_checked(size).ok_or_else(mismatch)?;
    *rest = after;
    Ok(bytes)
}

/// A message of unexpected length.
pub(crate) fn mismatch() -> EngineFailure {
    let reason = "another part of the space has sent an edge of another size".to_owned();
    EngineFailure::Broken { engine: "cpu".to_owned(), reason }
}
