// After a migration: the items that left are no longer counted. One invocation.

@group(0) @binding(0) var<storage, read_write> journal: Journal;
@group(0) @binding(1) var<storage, read_write> faults: Faults;

@compute @workgroup_size(1)
fn main() {
    if faults.stopped != 0u {
        return;
    }
    let leaving = atomicLoad(&journal.leaving);
    journal.items -= leaving;
    let low = journal.left.x + leaving;
    journal.left = vec2<u32>(low, journal.left.y + select(0u, 1u, low < leaving));
    atomicStore(&journal.leaving, 0u);
}
