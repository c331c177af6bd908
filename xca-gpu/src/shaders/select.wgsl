// The tiles in which something has changed that a process reads or writes since it ran there last. One
// workgroup.

// For each substate of the process and each process that writes it: where that notes its changes, and whether
// the substate is read at neighbours.
@group(0) @binding(0) var<storage, read> sources: array<vec2<u32>>;
@group(0) @binding(1) var<storage, read_write> activity: array<u32>;
// The size of the dispatch.
@group(0) @binding(2) var<storage, read_write> dispatch: array<u32>;

var<workgroup> length: atomic<u32>;

// A cell that is so far from the cells of a tile along an axis, round the axis.
fn away(first: u32, size: u32, cells: u32, distance: i32) -> u32 {
    let last = min(first + size, cells) - 1u;
    let at = select(i32(first), i32(last), distance > 0) + distance;
    let extent = i32(cells);
    return u32(((at % extent) + extent) % extent);
}

// Whether a substate has changed in a tile, or where the tile's neighbourhood reaches.
fn has_changed(source: vec2<u32>, tile: u32, since: u32) -> bool {
    if source.y == 0u {
        return activity[source.x + tile] >= since;
    }
    let row = tile / ALONG_X;
    let first = vec3<u32>(tile % ALONG_X * SIZE_X, row % ALONG_Y * SIZE_Y, row / ALONG_Y * SIZE_Z);
    for (var z = -i32(REACH_Z); z <= i32(REACH_Z); z += 1) {
        let layer = away(first.z, SIZE_Z, CELLS_Z, z) / SIZE_Z * ALONG_Y;
        for (var y = -i32(REACH_Y); y <= i32(REACH_Y); y += 1) {
            let line = (layer + away(first.y, SIZE_Y, CELLS_Y, y) / SIZE_Y) * ALONG_X;
            for (var x = -i32(REACH_X); x <= i32(REACH_X); x += 1) {
                if activity[source.x + line + away(first.x, SIZE_X, CELLS_X, x) / SIZE_X] >= since {
                    return true;
                }
            }
        }
    }
    return false;
}

fn is_due(tile: u32, since: u32) -> bool {
    if since == 0u {
        return true;
    }
    for (var i = 0u; i < SOURCES; i += 1u) {
        if has_changed(sources[i], tile, since) {
            return true;
        }
    }
    return false;
}

@compute @workgroup_size(256)
fn main(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        atomicStore(&length, 0u);
    }
    workgroupBarrier();
    let run_number = activity[0] + 1u;
    for (var tile = local; tile < TILES; tile += 256u) {
        let ran = REGION + 64u + TILES + tile;
        if is_due(tile, activity[ran]) {
            activity[REGION + 64u + atomicAdd(&length, 1u)] = tile;
            activity[ran] = run_number;
        }
    }
    workgroupBarrier();
    if local == 0u {
        let tiles = atomicLoad(&length);
        activity[REGION] = run_number;
        activity[REGION + 1u] = tiles;
        activity[0] = run_number;
        let low = activity[1] + tiles;
        activity[2] += select(0u, 1u, low < tiles);
        activity[1] = low;
        dispatch[3u * PLACE] = min(tiles, MOST);
        dispatch[3u * PLACE + 1u] = (tiles + MOST - 1u) / MOST;
        dispatch[3u * PLACE + 2u] = 1u;
    }
}
