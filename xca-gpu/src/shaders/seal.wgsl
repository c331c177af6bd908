// After a process that may stop the run: if it did, nothing more is changed. One invocation. What else is
// taken down is told by the file that follows; it has to be now, because where things lie later depends on
// the steps that were recorded already.

struct Stamp {
    process: u32,
    how: u32,
}

@group(0) @binding(0) var<uniform> stamp: Stamp;
@group(0) @binding(1) var<storage, read_write> journal: Journal;
@group(0) @binding(2) var<storage, read_write> faults: Faults;

@compute @workgroup_size(1)
fn main() {
    let first = atomicLoad(&faults.first);
    if faults.stopped == 0u && first != 0xffffffffu {
        faults.stopped = 1u;
        journal.stopped_by = stamp.process + 1u;
        journal.how = stamp.how;
        journal.stopped_in = journal.step;
        journal.stopped_at = first;
        take_down(first);
    }
}

