//! Kernels that take memory for what it is not, written by hand without unsafe code: each ends with a fault
//! of its process.

use std::any::TypeId;
use xca_core::ElementaryProcess;
use xca_core::kernel::{Access, KernelElement, Row};
use xca_core::prelude::*;
use xca_core::{Argument, Fault, Holds, Process, ProcessKind, ir};

#[derive(Substates, Clone, Copy)]
struct Land {
    kind: u8,
    slope: Vector2<f64>,
}

#[derive(Substates, Clone, Copy)]
struct Hare {
    kind: u8,
}

#[derive(Substates, Clone, Copy)]
struct Fox {
    kind: u8,
}

/// As large as a `Vector2<f64>`, but of another alignment.
#[derive(Clone, Copy)]
struct Wide;

impl KernelElement for Wide {
    type Memory = u128;
    type Batch = ();

    fn from_memory(_: u128) -> Self {
        Self
    }

    fn to_memory(self) -> u128 {
        0
    }

    fn lane((): &(), _: usize) -> Self {
        Self
    }

    fn set_lane((): &mut (), _: usize, _: Self) {}
}

const LAND: Argument = Argument { type_id: TypeId::of::<Land>, schema: Land::SCHEMA, holds: Holds::Cells };
const HARES: Argument = Argument { type_id: TypeId::of::<Hare>, schema: Hare::SCHEMA, holds: Holds::Items };
const FOXES: Argument = Argument { type_id: TypeId::of::<Fox>, schema: Fox::SCHEMA, holds: Holds::Items };

#[elementary_process]
fn harmless(cell: &mut Cell<Land>) {
    cell.kind = 1;
}

/// What the macro would have written for a process with this kernel.
fn process(
    substates: &'static [Argument],
    access: &'static [Access],
    kernel: xca_core::kernel::RowKernel,
) -> Process {
    let body: fn() -> ir::Function = harmless::process().body;
    let kind = if substates[0].holds == Holds::Items { ProcessKind::Items } else { ProcessKind::Cells };
    Process {
        name: "forged",
        kind,
        substates,
        parameters: &[],
        local_interaction: access.iter().any(|access| access.others),
        access,
        body,
        row_f32: kernel,
        row_f64: kernel,
        ..harmless::process()
    }
}

const READ: Access = Access { argument: 0, field: 0, centre: true, others: false, write: false };
const WRITTEN: Access = Access { write: true, ..READ };

macro_rules! forged {
    ($name:ident, $substates:expr, $access:expr, $kernel:expr) => {
        struct $name;

        impl ElementaryProcess for $name {
            fn process() -> Process {
                process($substates, $access, $kernel)
            }
        }
    };
}

fn columns(row: &Row<'_>, mut each: impl FnMut(xca_core::kernel::Column<'_>)) {
    row.columns().for_each(&mut each);
}

forged!(AnotherSize, &[LAND], &[WRITTEN], |row| {
    row.write_cells::<u32>(0);
});
forged!(AnotherLength, &[LAND], &[READ], |row| {
    row.read_cells::<[u8; 2]>(0);
});
forged!(AnotherAlignment, &[LAND], &[Access { field: 1, ..READ }], |row| {
    let values = row.read_cells::<Wide>(0);
    columns(row, |cell| {
        values.here(cell);
    });
});
forged!(NoNeighbours, &[LAND], &[READ], |row| {
    row.read_around::<u8>(0);
});
forged!(NotWritten, &[LAND], &[READ], |row| {
    row.write_cells::<u8>(0);
});
forged!(WrittenTwice, &[LAND], &[WRITTEN], |row| {
    let (first, second) = (row.write_cells::<u8>(0), row.write_cells::<u8>(0));
    (first[0], second[0]) = (1, 2);
});
forged!(WrittenAndRead, &[LAND], &[WRITTEN], |row| {
    row.read_cells::<u8>(0);
});
forged!(CellsAsItems, &[LAND], &[READ], |row| {
    row.read_own_items::<u8>(0);
});
forged!(ItemsAsCells, &[HARES], &[READ], |row| {
    row.read_cells::<u8>(0);
});
forged!(OnlyOwnItems, &[HARES], &[READ], |row| {
    row.read_items::<u8>(0);
});
forged!(ItemsOfOthers, &[HARES, FOXES], &[Access { argument: 1, others: true, ..READ }], |row| {
    let values = row.read_items::<u8>(0);
    assert!(values.iter().all(|value| *value == 0));
});
forged!(NoSuchEntry, &[LAND], &[READ], |row| {
    row.read_cells::<u8>(1);
});

fn message<P: ElementaryProcess>(forged: P) -> String {
    let model = Model::builder("forged")
        .extents([2, 1, 1])
        .substates::<Land>()
        .population::<Hare>(3)
        .population::<Fox>(1)
        .process(forged)
        .populate(|_| vec![Hare { kind: 0 }; 3])
        .build()
        .expect("the definition is in order");
    let mut simulation =
        Simulation::new(&model, &Reference, RunOptions::default()).expect("the state can be made");
    match simulation.step() {
        Err(RunError::Fault { fault: Fault::Panicked { process: "forged", message, .. }, .. }) => message,
        other => format!("no fault: {other:?}"),
    }
}

#[test]
fn memory_is_compared_with_what_a_kernel_takes_it_for() {
    assert_eq!(message(AnotherSize), "an entry of another type");
    assert_eq!(message(AnotherLength), "an entry of another type");
    assert_eq!(message(AnotherAlignment), "a type of another alignment");
    assert_eq!(message(NoNeighbours), "an entry whose neighbours cannot be read");
    assert_eq!(message(NotWritten), "an entry that cannot be written");
    assert_eq!(message(WrittenTwice), "an entry that is written already");
    assert_eq!(message(WrittenAndRead), "an entry that is written in place");
    assert_eq!(message(CellsAsItems), "an entry of cells");
    assert_eq!(message(ItemsAsCells), "an entry of items");
    assert_eq!(message(OnlyOwnItems), "an entry whose other items cannot be read");
    assert_eq!(message(ItemsOfOthers), "an entry of other items");
    assert_eq!(message(NoSuchEntry), "index out of bounds: the len is 1 but the index is 1");
}
