// After a migration has put its items into ranges: if a cell has too many, nothing more is changed. One invocation.

struct Stamp {
    process: u32,
    how: u32,
}

@group(0) @binding(0) var<uniform> stamp: Stamp;
@group(0) @binding(1) var<storage, read_write> journal: Journal;
@group(0) @binding(2) var<storage, read_write> faults: Faults;
@group(0) @binding(3) var<storage, read> item_starts: array<u32>;
@group(0) @binding(4) var<storage, read> item_ends: array<u32>;

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
        journal.count = item_ends[first] - item_starts[first];
    }
}
