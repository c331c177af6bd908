// What the engine's own shaders know of the space and of the run.

struct Space {
    extents: vec3<u32>,
    // Stored cells, with the halo.
    cells: u32,
    halo: vec3<u32>,
    row: u32,
    // Of each axis: 1 if it is toroidal, else 0. Where there are items, no face is reflecting.
    toroidal: vec3<u32>,
    layer: u32,
    neighbours: u32,
    // Which cells have the second list of neighbours: 0 none, 1 those in odd rows, 2 those in odd columns.
    parity: u32,
    slots: u32,
    may_leave: u32,
}

// What a population, or the model without one, knows of the step.
struct Journal {
    step: vec2<u32>,
    items: u32,
    leaving: atomic<u32>,
    left: vec2<u32>,
    // The process that stopped the run, from 1; how; in which step; and at which cell or item.
    stopped_by: u32,
    how: u32,
    stopped_in: vec2<u32>,
    stopped_at: u32,
    // Of an item that a migration sent where it cannot go: its label, its cell, and where it should go.
    label: u32,
    cell: u32,
    destination: u32,
    // Of a cell with too many items: how many.
    count: u32,
}

struct Faults {
    first: atomic<u32>,
    stopped: u32,
}

