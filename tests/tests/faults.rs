//! Faults: each kind stops the run on every engine in the same step with the same message, and none goes on.

use std::error::Error;
use xca_core::Fault;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, assert_same_fault};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Spot {
    value: Real,
    zero: i32,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Mote {
    #[position]
    position: Vector3<Real>,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Plan {
    /// In which step something goes wrong.
    step: u32,
    /// How an item moves in that step.
    jump: Vector3<Real>,
}

const TOO_HOT: u32 = 7;

/// All cells in the two last rows.
#[elementary_process]
fn complain(cell: &mut Cell<Spot>, p: &Plan, space: &Space) {
    if space.step() == p.step && cell.index().y >= space.extents().y - 2 {
        cell.fault(TOO_HOT, cell.value);
        cell.fault(TOO_HOT + 1, 0.0);
    }
}

/// All cells.
#[elementary_process]
fn complain_too(cell: &mut Cell<Spot>, p: &Plan, space: &Space) {
    if space.step() == p.step {
        cell.fault(TOO_HOT + 2, 0.0);
    }
}

#[elementary_process]
fn stare(cell: &mut Cell<Spot>, p: &Plan, space: &Space) {
    if space.step() == p.step && cell.index().x > 0 {
        cell.value = cell.neighbour(cell.neighbour_count() + 3).value;
    }
}

#[elementary_process]
fn divide(cell: &mut Cell<Spot>, p: &Plan, space: &Space) {
    if space.step() == p.step && cell.value > 231.0 {
        cell.value = (6 / cell.zero) as Real;
    }
}

#[elementary_process]
fn divide_at_neighbours(cell: &mut Cell<Spot>) {
    if cell.neighbour(2).value + cell.value > 4.0 {
        cell.value = (6 / cell.zero) as Real;
    }
}

#[elementary_process]
fn divide_for_items(me: &mut Slot<Mote>, p: &Plan, space: &Space) {
    if space.step() == p.step && me.label() % 4 == 2 {
        me.position.y = (6 / (me.label() / 8)) as Real;
    }
}

#[elementary_process]
fn complain_or_divide(cell: &mut Cell<Spot>) {
    if cell.index().x == 1 {
        cell.fault(TOO_HOT, cell.value);
    }
    if cell.index().x == 2 {
        cell.value = (6 / cell.zero) as Real;
    }
}

#[elementary_process]
fn complain_and_divide(cell: &mut Cell<Spot>) {
    if cell.index().z > 1 {
        cell.fault(TOO_HOT, cell.value);
        cell.value = (6 / cell.zero) as Real;
    }
}

#[elementary_process]
fn protest(me: &mut Slot<Mote>, p: &Plan, space: &Space) {
    if space.step() == p.step {
        me.fault(TOO_HOT, me.position.x);
    }
}

#[elementary_process]
fn jump(me: &mut Slot<Mote>, p: &Plan, space: &Space) {
    if space.step() == p.step {
        me.position += p.jump;
    }
}

/// Goes nowhere, where the jump is infinite.
#[elementary_process]
fn vanish(me: &mut Slot<Mote>, p: &Plan, space: &Space) {
    if space.step() == p.step {
        me.position += p.jump - p.jump;
    }
}

#[elementary_process]
fn push_left(me: &mut Slot<Mote>) {
    if me.index().x == 1 {
        me.position.x -= 1.0;
    }
}

#[migration]
fn land(me: &Slot<Mote>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

#[migration]
fn drop_out(me: &Slot<Mote>) -> Destination {
    if me.label() > 4 { Destination::Outside } else { Destination::Stay }
}

const EXTENTS: [usize; 3] = [4, 9, 8];

/// Many rows, a few items: two in the first cell, one beside it, two in the last one.
fn base(step: u32, by: [f64; 3]) -> ModelBuilder {
    Model::builder("faulty")
        .extents(EXTENTS)
        .neighbourhood(Neighbourhood::von_neumann(1))
        .parameters(Plan { step, jump: Vector3::new(by[0], by[1], by[2]) })
        .substates::<Spot>()
        .population::<Mote>(2)
        .fault_text(TOO_HOT, "it is too hot")
        .fill(|site| {
            let [x, y, z] = site.cell().map(|index| index as f64);
            Spot { value: x + 10.0 * y + 100.0 * z, zero: 0 }
        })
        .initialise(|state| {
            let item = |label: u32, cell: [usize; 3]| {
                let [x, y, z] = cell.map(|index| index as f64 + 0.5);
                Item { label, cell, state: Mote { position: Vector3::new(x, y, z) } }
            };
            let last = EXTENTS.map(|extent| extent - 1);
            Ok(state.set_items(vec![
                item(6, [0; 3]),
                item(4, [0; 3]),
                item(5, [1, 0, 0]),
                item(1, last),
                item(2, last),
            ])?)
        })
}

/// The fault of a model and the whole message.
fn fault(builder: ModelBuilder) -> Result<(u64, Fault, String), Box<dyn Error>> {
    let model = builder.build()?;
    let engines = engines::all()?;
    let mut found = None;
    for precision in engines::PRECISIONS {
        let options = RunOptions { precision, seed: 0 };
        let error = assert_same_fault(&model, &engines, options, 5);
        let message = error.to_string();
        let RunError::Fault { step, fault, .. } = error else { return Err(message.into()) };
        found = Some((step, fault, message));
    }
    found.ok_or_else(|| "no precision".into())
}

#[test]
fn reported_by_a_cell() -> Result<(), Box<dyn Error>> {
    let (step, fault, message) = fault(base(2, [0.0; 3]).process(complain))?;
    let wanted =
        Fault::Reported { process: "complain", cell: [0, 7, 0], label: None, code: TOO_HOT, value: 70.0 };
    assert_eq!((step, fault), (3, wanted));
    assert_eq!(message, "step 3: it is too hot: `complain` reports fault 7 with value 70 in cell [0, 7, 0]");
    Ok(())
}

#[test]
fn reported_by_an_item() -> Result<(), Box<dyn Error>> {
    let (step, fault, message) = fault(base(0, [0.0; 3]).process(protest))?;
    let wanted =
        Fault::Reported { process: "protest", cell: [0; 3], label: Some(4), code: TOO_HOT, value: 0.5 };
    assert_eq!((step, fault), (1, wanted));
    assert_eq!(
        message,
        "step 1: it is too hot: `protest` reports fault 7 with value 0.5 for item 4 in cell [0, 0, 0]"
    );
    Ok(())
}

#[test]
fn a_neighbour_beyond_the_neighbourhood() -> Result<(), Box<dyn Error>> {
    let (step, fault, message) = fault(base(1, [0.0; 3]).process(stare))?;
    let wanted = Fault::BeyondNeighbourhood { process: "stare", cell: [1, 0, 0], index: 10, size: 7 };
    assert_eq!((step, fault), (2, wanted));
    assert_eq!(
        message,
        "step 2: `stare` asks for neighbour 10 in cell [1, 0, 0], but the neighbourhood has 7 cells (0 to 6)"
    );
    Ok(())
}

/// The fifth item finds two others in the first cell.
#[test]
fn a_full_cell() -> Result<(), Box<dyn Error>> {
    let (step, fault, message) = fault(base(1, [0.0; 3]).process(push_left).process(land))?;
    assert_eq!(
        (step, fault),
        (1, Fault::CellFull { process: Some("land"), cell: [0, 0, 0], items: 3, slots: 2 })
    );
    for words in [
        "step 1: `land` moves too many items into one cell: cell [0, 0, 0] would hold 3 items",
        "2 slots",
        "give the population more slots",
    ] {
        assert!(message.contains(words), "{message}");
    }
    Ok(())
}

#[test]
fn too_far() -> Result<(), Box<dyn Error>> {
    let (step, fault, message) = fault(base(1, [1.0, 1.0, 0.0]).process(jump).process(land))?;
    let wanted = Fault::TooFar { process: "land", label: 4, from: [0, 0, 0], to: [1, 1, 0] };
    assert_eq!((step, fault), (2, wanted));
    assert!(
        message.starts_with("step 2: `land` moves item 4 from cell [0, 0, 0] to cell [1, 1, 0]"),
        "{message}"
    );
    Ok(())
}

#[test]
fn nowhere() -> Result<(), Box<dyn Error>> {
    let (step, fault, message) = fault(base(1, [0.0, f64::INFINITY, 0.0]).process(vanish).process(land))?;
    let wanted = Fault::Nowhere { process: "land", label: 4, cell: [0, 0, 0] };
    assert_eq!((step, fault), (2, wanted));
    assert_eq!(message, "step 2: `land` finds item 4 of cell [0, 0, 0] at a NaN position");
    Ok(())
}

#[test]
fn out_of_a_closed_space() -> Result<(), Box<dyn Error>> {
    for jump_by in [[0.0, 0.0, 1.0], [0.0, 0.0, f64::INFINITY], [0.0, 0.0, 1e38]] {
        let (step, fault, message) = fault(base(3, jump_by).process(jump).process(land))?;
        assert_eq!(step, 4);
        let (label, cell) = if jump_by[2] == 1.0 { (1, [3, 8, 7]) } else { (4, [0, 0, 0]) };
        assert_eq!(fault, Fault::Left { process: "land", label, cell });
        assert!(
            message.starts_with(&format!("step 4: `land` moves item {label} of cell {cell:?} out")),
            "{message}"
        );
    }
    let (_, fault, _) = fault(base(0, [0.0; 3]).process(drop_out))?;
    assert_eq!(fault, Fault::Left { process: "drop_out", label: 6, cell: [0, 0, 0] });
    Ok(())
}

#[test]
fn a_panic() -> Result<(), Box<dyn Error>> {
    let (step, found, message) = fault(base(1, [0.0; 3]).process(divide))?;
    let zero = || "attempt to divide by zero".to_owned();
    let wanted = Fault::Panicked { process: "divide", cell: [2, 3, 2], label: None, message: zero() };
    assert_eq!((step, found), (2, wanted));
    assert_eq!(message, "step 2: the code of `divide` panicked in cell [2, 3, 2]: attempt to divide by zero");
    let (step, found, message) = fault(base(1, [0.0; 3]).process(divide_for_items))?;
    let wanted =
        Fault::Panicked { process: "divide_for_items", cell: [0; 3], label: Some(6), message: zero() };
    assert_eq!((step, found), (2, wanted));
    assert_eq!(
        message,
        "step 2: the code of `divide_for_items` panicked for item 6 in cell [0, 0, 0]: attempt to divide by zero"
    );
    // Where the neighbourhood changes from column to column.
    let hexagons = Model::builder("hexagons")
        .extents([6, 2, 1])
        .neighbourhood(Neighbourhood::hexagonal(Hexagons::SideUp))
        .substates::<Spot>()
        .fill(|site| Spot { value: site.cell()[0] as f64, zero: 0 })
        .process(divide_at_neighbours);
    let cell = match fault(hexagons)? {
        (1, Fault::Panicked { process: "divide_at_neighbours", cell, label: None, .. }, _) => cell,
        other => panic!("{other:?}"),
    };
    assert_eq!(cell, [3, 0, 0]);
    Ok(())
}

/// The first fault is that of the first process, then of the first cell, then of the first label, whatever
/// ran first.
#[test]
fn the_first_fault() -> Result<(), Box<dyn Error>> {
    let process = |builder| -> Result<String, Box<dyn Error>> {
        Ok(match fault(builder)?.1 {
            Fault::Reported { process, cell, .. } => format!("{process} {cell:?}"),
            Fault::Panicked { process, .. } => format!("{process} panicked"),
            other => other.to_string(),
        })
    };
    let base = || base(0, [0.0; 3]);
    assert_eq!(process(base().process(complain).process(complain_too))?, "complain [0, 7, 0]");
    assert_eq!(process(base().process(complain_too).process(complain))?, "complain_too [0, 0, 0]");
    assert_eq!(process(base().process(complain).process(protest))?, "complain [0, 7, 0]");
    assert_eq!(process(base().process(protest).process(complain))?, "protest [0, 0, 0]");
    assert_eq!(process(base().process(complain).process(drop_out))?, "complain [0, 7, 0]");
    // A panic takes the place of its process, and of its cell.
    assert_eq!(process(base().process(complain).process(divide))?, "complain [0, 7, 0]");
    assert_eq!(process(base().process(divide).process(complain))?, "divide panicked");
    assert_eq!(process(base().process(complain_or_divide))?, "complain_or_divide [1, 0, 0]");
    assert_eq!(process(base().process(complain_and_divide))?, "complain_and_divide [0, 0, 2]");
    Ok(())
}
