// Moves one substate of the items into their new order, word by word. One invocation for each word.

@group(0) @binding(0) var<storage, read_write> journal: Journal;
@group(0) @binding(1) var<storage, read_write> faults: Faults;
@group(0) @binding(2) var<storage, read> order: array<u32>;
@group(0) @binding(3) var<storage, read> before: array<u32>;
@group(0) @binding(4) var<storage, read_write> after: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let word = id.x + id.y * workgroups.x * 256u;
    let item = word / WORDS;
    if item >= journal.items - atomicLoad(&journal.leaving) || faults.stopped != 0u {
        return;
    }
    after[word] = before[order[item] * WORDS + word % WORDS];
}
