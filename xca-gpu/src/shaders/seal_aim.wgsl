// After a migration has said where its items go: of an item that cannot go there.

@group(0) @binding(3) var<storage, read> item_labels: array<u32>;
@group(0) @binding(4) var<storage, read> item_cells: array<u32>;
@group(0) @binding(5) var<storage, read> destinations: array<u32>;

fn take_down(item: u32) {
    journal.label = item_labels[item];
    journal.cell = item_cells[item];
    journal.destination = destinations[item];
}
