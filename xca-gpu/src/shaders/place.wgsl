// Puts the number of each item into the range of its cell, in any order. One invocation for each item.

@group(0) @binding(0) var<storage, read_write> journal: Journal;
@group(0) @binding(1) var<storage, read_write> faults: Faults;
@group(0) @binding(2) var<storage, read> targets: array<u32>;
@group(0) @binding(3) var<storage, read> item_starts: array<u32>;
// Counted down to zero, ready for the next migration.
@group(0) @binding(4) var<storage, read_write> arrivals: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> order: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let item = id.x + id.y * workgroups.x * 256u;
    if item >= journal.items || faults.stopped != 0u {
        return;
    }
    let there = targets[item];
    if there != 0xffffffffu {
        order[item_starts[there] + atomicSub(&arrivals[there], 1u) - 1u] = item;
    }
}
