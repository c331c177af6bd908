//! An index beyond an array of an item.

use super::model::{Field, Grain, TABLE, base, beyond, stops};
use std::error::Error;
use xca_core::prelude::*;

#[elementary_process]
fn own_of_an_item(me: &mut Slot<Grain>) {
    me.sum = me.shares[me.index as usize];
}

#[elementary_process]
fn written_of_an_item(me: &mut Slot<Grain>) {
    me.shares[me.index as usize] += 1.0;
}

#[elementary_process]
fn of_another_item(me: &mut Slot<Grain>) {
    for other in me.others() {
        me.sum += other.shares[other.index as usize];
    }
}

#[elementary_process]
fn of_the_cell(me: &mut Slot<Grain>, cell: &Cell<Field>) {
    me.sum += cell.numbers[me.index as usize] as Real;
}

#[elementary_process]
fn of_an_item_in_the_cell(cell: &mut Cell<Field>, grains: &Slots<Grain>) {
    for grain in grains {
        cell.total += grain.shares[grain.index as usize];
    }
}

#[migration]
fn moved_by_a_table(me: &Slot<Grain>) -> Destination {
    if TABLE[me.index as usize] == 9 { Destination::Outside } else { Destination::Stay }
}

#[test]
fn an_item() -> Result<(), Box<dyn Error>> {
    let cell = [3, 1, 1];
    stops(base(24).process(own_of_an_item), cell, Some(4), &beyond(3, 9))?;
    stops(base(24).process(written_of_an_item), cell, Some(4), &beyond(3, 9))?;
    // The item with the label 4 sees that with the label 7.
    stops(base(24).process(of_another_item), cell, Some(4), &beyond(3, 8))?;
    stops(base(24).process(of_the_cell), cell, Some(4), &beyond(3, 9))?;
    stops(base(24).process(of_an_item_in_the_cell), cell, None, &beyond(3, 9))?;
    stops(base(24).process(moved_by_a_table), cell, Some(4), &beyond(4, 9))
}
