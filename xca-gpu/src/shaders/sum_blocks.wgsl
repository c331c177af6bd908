// The sum of each block of 1024 values. One workgroup for each block.

@group(0) @binding(0) var<storage, read> values: array<u32>;
@group(0) @binding(1) var<storage, read_write> sums: array<u32>;

var<workgroup> parts: array<u32, 64>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) id: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = id.x + id.y * workgroups.x;
    let first = block * 1024u + local * 16u;
    let end = min(first + 16u, arrayLength(&values));
    var sum = 0u;
    for (var i = first; i < end; i += 1u) {
        sum += values[i];
    }
    parts[local] = sum;
    workgroupBarrier();
    for (var step = 32u; step > 0u; step /= 2u) {
        if local < step {
            parts[local] += parts[local + step];
        }
        workgroupBarrier();
    }
    if local == 0u && block < arrayLength(&sums) {
        sums[block] = parts[0];
    }
}
