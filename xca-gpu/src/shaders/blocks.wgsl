// Values in blocks of 1024, one workgroup for each: each invocation sums up 16 of them.

@group(0) @binding(0) var<storage, read> values: array<u32>;

var<workgroup> parts: array<u32, 64>;

// The values of an invocation: the first, and one past the last.
fn range_of(block: u32, local: u32) -> vec2<u32> {
    let first = block * 1024u + local * 16u;
    return vec2<u32>(first, min(first + 16u, arrayLength(&values)));
}

fn sum_of(range: vec2<u32>) -> u32 {
    var sum = 0u;
    for (var i = range.x; i < range.y; i += 1u) {
        sum += values[i];
    }
    return sum;
}

