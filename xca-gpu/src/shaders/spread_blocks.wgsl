// The sum of all values before each, from the sums before each block.

@group(0) @binding(1) var<storage, read> before: array<u32>;
@group(0) @binding(2) var<storage, read_write> results: array<u32>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) id: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = id.x + id.y * workgroups.x;
    let range = range_of(block, local);
    let sum = sum_of(range);
    parts[local] = sum;
    workgroupBarrier();
    for (var step = 1u; step < 64u; step *= 2u) {
        var earlier = 0u;
        if local >= step {
            earlier = parts[local - step];
        }
        workgroupBarrier();
        parts[local] += earlier;
        workgroupBarrier();
    }
    if block >= arrayLength(&before) {
        return;
    }
    var running = before[block] + parts[local] - sum;
    for (var i = range.x; i < range.y; i += 1u) {
        results[i] = running;
        running += values[i];
    }
}
