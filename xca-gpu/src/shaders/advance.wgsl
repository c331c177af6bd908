// After a step: the next one. One invocation for each journal, which lie 64 words apart.

@group(0) @binding(0) var<storage, read_write> journals: array<u32>;
@group(0) @binding(1) var<storage, read_write> faults: Faults;

@compute @workgroup_size(1)
fn main(@builtin(workgroup_id) id: vec3<u32>) {
    if faults.stopped != 0u {
        return;
    }
    let low = journals[id.x * 64u] + 1u;
    journals[id.x * 64u] = low;
    if low == 0u {
        journals[id.x * 64u + 1u] += 1u;
    }
}
