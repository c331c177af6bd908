// Where each item goes, and how many come to each cell. One invocation for each item.

const STAY: u32 = 0xffffffffu;
const OUTSIDE: u32 = 0xfffffffeu;
const NOWHERE: u32 = 0xfffffffdu;
// Instead of a cell: the item leaves the space.
const LEAVES: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> space: Space;
@group(0) @binding(1) var<storage, read_write> journal: Journal;
@group(0) @binding(2) var<storage, read_write> faults: Faults;
@group(0) @binding(3) var<storage, read> displacements: array<vec4<i32>>;
@group(0) @binding(4) var<storage, read> destinations: array<u32>;
@group(0) @binding(5) var<storage, read> item_cells: array<u32>;
@group(0) @binding(6) var<storage, read_write> targets: array<u32>;
@group(0) @binding(7) var<storage, read_write> arrivals: array<atomic<u32>>;

fn stored_number(cell: vec3<i32>) -> u32 {
    let at = vec3<u32>(cell) + space.halo;
    return at.x + at.y * space.row + at.z * space.layer;
}

// The index along an axis by the boundary rule, or -1 beyond a flat face.
fn along(index: i32, extent: i32, toroidal: u32) -> i32 {
    if index >= 0 && index < extent {
        return index;
    }
    return select(-1, ((index % extent) + extent) % extent, toroidal != 0u);
}

fn is_neighbour(cell: vec3<i32>, to: vec3<i32>) -> bool {
    var start = 0u;
    if (space.parity == 1u && (cell.y & 1) == 1) || (space.parity == 2u && (cell.x & 1) == 1) {
        start = space.neighbours;
    }
    let extents = vec3<i32>(space.extents);
    for (var n = 0u; n < space.neighbours; n += 1u) {
        let at = cell + displacements[start + n].xyz;
        let there = vec3<i32>(
            along(at.x, extents.x, space.toroidal.x),
            along(at.y, extents.y, space.toroidal.y),
            along(at.z, extents.z, space.toroidal.z),
        );
        if all(there == to) {
            return true;
        }
    }
    return false;
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let item = id.x + id.y * workgroups.x * 256u;
    if item >= journal.items || faults.stopped != 0u {
        return;
    }
    let here = item_cells[item];
    let destination = destinations[item];
    var there = here;
    if destination == OUTSIDE && space.may_leave != 0u {
        there = LEAVES;
        atomicAdd(&journal.leaving, 1u);
    } else if destination == OUTSIDE || destination == NOWHERE {
        atomicMin(&faults.first, item);
    } else if destination != STAY {
        let width = space.extents.x;
        let area = width * space.extents.y;
        let to = vec3<i32>(vec3<u32>(destination % width, destination / width % space.extents.y, destination / area));
        there = stored_number(to);
        if there != here {
            let rest = here % space.layer;
            let home = vec3<u32>(rest % space.row, rest / space.row, here / space.layer) - space.halo;
            if !is_neighbour(vec3<i32>(home), to) {
                atomicMin(&faults.first, item);
            }
        }
    }
    targets[item] = there;
    if there != LEAVES {
        atomicAdd(&arrivals[there], 1u);
    }
}
