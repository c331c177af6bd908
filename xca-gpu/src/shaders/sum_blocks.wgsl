// The sum of each block.

@group(0) @binding(1) var<storage, read_write> sums: array<u32>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) id: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let block = id.x + id.y * workgroups.x;
    parts[local] = sum_of(range_of(block, local));
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
