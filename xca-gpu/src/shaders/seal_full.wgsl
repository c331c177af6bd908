// After a migration has put its items into ranges: of a cell with too many.

@group(0) @binding(3) var<storage, read> item_starts: array<u32>;
@group(0) @binding(4) var<storage, read> item_ends: array<u32>;

fn take_down(cell: u32) {
    journal.count = item_ends[cell] - item_starts[cell];
}
