// The most items in a cell of each row. One invocation for each row.

@group(0) @binding(0) var<uniform> space: Space;
@group(0) @binding(1) var<storage, read> item_starts: array<u32>;
@group(0) @binding(2) var<storage, read> item_ends: array<u32>;
@group(0) @binding(3) var<storage, read_write> results: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let row = id.x + id.y * workgroups.x * 64u;
    if row >= space.extents.y * space.extents.z {
        return;
    }
    let y = row % space.extents.y + space.halo.y;
    let z = row / space.extents.y + space.halo.z;
    let first = space.halo.x + y * space.row + z * space.layer;
    var most = 0u;
    for (var cell = first; cell < first + space.extents.x; cell += 1u) {
        most = max(most, item_ends[cell] - item_starts[cell]);
    }
    results[row] = most;
}
