// After a migration has said where its items go: if one cannot go there, nothing more is changed. One invocation.

struct Stamp {
    process: u32,
    how: u32,
}

@group(0) @binding(0) var<uniform> stamp: Stamp;
@group(0) @binding(1) var<storage, read_write> journal: Journal;
@group(0) @binding(2) var<storage, read_write> faults: Faults;
@group(0) @binding(3) var<storage, read> item_labels: array<u32>;
@group(0) @binding(4) var<storage, read> item_cells: array<u32>;
@group(0) @binding(5) var<storage, read> destinations: array<u32>;

@compute @workgroup_size(1)
fn main() {
    let first = atomicLoad(&faults.first);
    if faults.stopped == 0u && first != 0xffffffffu {
        faults.stopped = 1u;
        journal.stopped_by = stamp.process + 1u;
        journal.how = stamp.how;
        journal.stopped_in = journal.step;
        journal.stopped_at = first;
        // Taken down now: where they lie later depends on the steps that were recorded already.
        journal.label = item_labels[first];
        journal.cell = item_cells[first];
        journal.destination = destinations[first];
    }
}
