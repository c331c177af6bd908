// Fills the halo of a substate that cannot be reached at once: words are picked up from its parts and set
// down in its parts. One invocation for each word.

@group(0) @binding(0) var<storage, read> crossings: array<vec2<u32>>;
@group(0) @binding(1) var<storage, read_write> part: array<u32>;
@group(0) @binding(2) var<storage, read_write> ferry: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let word = id.x + id.y * workgroups.x * 256u;
    let number = word / WORDS;
    if number >= CROSSINGS {
        return;
    }
    let crossing = crossings[FIRST + number];
    let there = crossing.x * WORDS + word % WORDS;
    let seat = crossing.y * WORDS + word % WORDS;
    if PICK_UP {
        ferry[seat] = part[there];
    } else {
        part[there] = ferry[seat];
    }
}
