// Sorts the items of each cell by label, and looks whether they are too many. One invocation for each stored
// cell.

@group(0) @binding(0) var<uniform> space: Space;
@group(0) @binding(1) var<storage, read_write> journal: Journal;
@group(0) @binding(2) var<storage, read_write> faults: Faults;
@group(0) @binding(3) var<storage, read> item_starts: array<u32>;
@group(0) @binding(4) var<storage, read_write> item_ends: array<u32>;
@group(0) @binding(5) var<storage, read> item_labels: array<u32>;
@group(0) @binding(6) var<storage, read_write> order: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let cell = id.x + id.y * workgroups.x * 256u;
    if cell >= space.cells || faults.stopped != 0u {
        return;
    }
    let first = item_starts[cell];
    // The last cell's range ends with the items that stay.
    var end = journal.items - atomicLoad(&journal.leaving);
    if cell + 1u < space.cells {
        end = item_starts[cell + 1u];
    }
    item_ends[cell] = end;
    if end - first > space.slots {
        atomicMin(&faults.first, cell);
        return;
    }
    for (var i = first + 1u; i < end; i += 1u) {
        let item = order[i];
        let label = item_labels[item];
        var at = i;
        while at > first && item_labels[order[at - 1u]] > label {
            order[at] = order[at - 1u];
            at -= 1u;
        }
        order[at] = item;
    }
}
