// Fills the halo of a substate, word by word. One invocation for each word.

@group(0) @binding(0) var<storage, read> pairs: array<vec2<u32>>;
@group(0) @binding(1) var<storage, read_write> plane: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let word = id.x + id.y * workgroups.x * 256u;
    let number = word / WORDS;
    if number >= PAIRS {
        return;
    }
    let pair = pairs[number];
    plane[pair.x * WORDS + word % WORDS] = plane[pair.y * WORDS + word % WORDS];
}
