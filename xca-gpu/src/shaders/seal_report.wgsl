// After a process that may report faults: the record that it made tells the rest.

fn take_down(first: u32) {}
