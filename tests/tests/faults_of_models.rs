//! Models that cannot be built or started: each mistake has its error, whose message says what to change.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::{ModelBuilder, NeighbourhoodError, StartError};
use xca_tests::suite::engines;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Soil {
    water: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Worm {
    #[position]
    position: Vector3<Real>,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Weather {
    rain: Real,
}

#[elementary_process]
fn seep(cell: &mut Cell<Soil>) {
    cell.water *= 0.5;
}

#[elementary_process]
fn soak(cell: &mut Cell<Soil>, p: &Weather) {
    cell.water += p.rain;
}

#[elementary_process]
fn crawl(me: &mut Slot<Worm>) {
    me.position.x += 0.1;
}

#[elementary_process]
fn drink(me: &mut Slot<Worm>, cell: &Cell<Soil>) {
    me.position.z += cell.water;
}

#[elementary_process]
fn flee(me: &mut Slot<Worm>) {
    for other in me.others_within(0.5) {
        me.position += (me.position - other.position) * 0.1;
    }
}

#[migration]
fn burrow(me: &Slot<Worm>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

#[elementary_process]
fn dig(cell: &mut Cell<Worm>) {
    cell.position.x += 1.0;
}

#[elementary_process]
fn glide(me: &mut Slot<Soil>) {
    me.water += 1.0;
}

fn soil() -> ModelBuilder {
    Model::builder("garden").extents([4, 4, 4]).substates::<Soil>()
}

/// Building must fail with this variant, and a message that holds all of these words.
macro_rules! refused {
    ($builder:expr, $variant:pat, $($words:literal),+) => {{
        let error = $builder.build().expect_err("a model that cannot be built");
        assert!(matches!(error, $variant), "{error:?}");
        let message = error.to_string();
        $(assert!(message.contains($words), "`{message}` does not say `{}`", $words);)+
    }};
}

#[test]
fn spaces() {
    use ModelError::{CellSide, NoExtents, TooManyCells, ZeroExtent};
    refused!(
        Model::builder("garden").substates::<Soil>(),
        NoExtents { .. },
        "`garden`",
        "call `.extents([x, y, z])`"
    );
    refused!(soil().extents([3, 0, 2]), ZeroExtent { axis: 'y', .. }, "along y", "[3, 0, 2]", "at least 1");
    refused!(soil().extents([65_536, 65_536, 1]), TooManyCells { .. }, "too large", "at most 4294967293");
    refused!(soil().extents([usize::MAX, usize::MAX, 2]), TooManyCells { .. }, "too large");
    for side in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused!(soil().cell_side(side), CellSide { .. }, "the cell side is", "must be a positive number");
    }
}

#[test]
fn neighbourhoods() {
    use ModelError::{NeighbourhoodTooWide, OddHexagonalTorus, ReflectedHexagons};
    let flat = soil().extents([4, 2, 4]).neighbourhood(Neighbourhood::moore(3));
    refused!(
        flat,
        NeighbourhoodTooWide { axis: 'y', reach: 3, extent: 2, .. },
        "Moore, radius 3",
        "along y",
        "2 cells",
        "flat boundary",
        "use more cells"
    );
    let torus =
        soil().extents([4, 4, 2]).boundary(Boundary::Toroidal).neighbourhood(Neighbourhood::von_neumann(1));
    refused!(
        torus,
        NeighbourhoodTooWide { axis: 'z', reach: 1, extent: 2, .. },
        "along z",
        "toroidal",
        "within one layer for a 2D model"
    );
    let mirror =
        soil().extents([1, 4, 4]).boundary(Boundary::Reflecting).neighbourhood(Neighbourhood::moore(2));
    refused!(mirror, NeighbourhoodTooWide { axis: 'x', .. }, "reflecting");
    let hexagons =
        |hexagons, extents| soil().extents(extents).neighbourhood(Neighbourhood::hexagonal(hexagons));
    let torus = [Boundary::Toroidal; 3];
    refused!(
        hexagons(Hexagons::CornerUp, [4, 5, 1]).boundaries(torus),
        OddHexagonalTorus { axis: 'y', extent: 5 },
        "even number of cells along y",
        "not 5"
    );
    refused!(
        hexagons(Hexagons::SideUp, [7, 4, 1]).boundaries(torus),
        OddHexagonalTorus { axis: 'x', extent: 7 },
        "even number of cells along x"
    );
    let mirror = [Boundary::Reflecting; 3];
    refused!(
        hexagons(Hexagons::CornerUp, [4, 4, 1]).boundaries(mirror),
        ReflectedHexagons { axis: 'y' },
        "reflecting boundary along y"
    );
    refused!(
        hexagons(Hexagons::SideUp, [4, 4, 1]).boundaries(mirror),
        ReflectedHexagons { axis: 'x' },
        "reflecting boundary along x"
    );
    let no_centre = Neighbourhood::custom(vec![[1, 0, 0], [0, 0, 0]]).expect_err("no centre");
    assert_eq!(no_centre, NeighbourhoodError::NoCentre);
    assert!(no_centre.to_string().contains("put [0, 0, 0] first"));
    let twice = Neighbourhood::custom(vec![[0, 0, 0], [1, 2, 0], [1, 2, 0]]).expect_err("twice");
    assert!(twice.to_string().contains("[1, 2, 0] stands twice"));
}

#[test]
fn faces() {
    use ModelError::{HalfTorus, Length, NotAdded, OutsideOfItems, OutsideUnseen, ReflectedHexagons};
    refused!(
        soil().face(Face::West, Boundary::Toroidal),
        HalfTorus { toroidal: Face::West, other: Face::East, boundary: Boundary::Flat },
        "the west face is toroidal and the east face is flat",
        "make both toroidal, or neither"
    );
    refused!(
        soil().boundary(Boundary::Toroidal).face(Face::Bottom, Boundary::Reflecting),
        HalfTorus { toroidal: Face::Top, other: Face::Bottom, boundary: Boundary::Reflecting },
        "the top face is toroidal and the bottom face is reflecting"
    );
    assert!(soil().boundary(Boundary::Reflecting).face(Face::East, Boundary::Flat).build().is_ok());
    let torus = soil().face(Face::North, Boundary::Toroidal).face(Face::South, Boundary::Toroidal);
    assert!(torus.build().is_ok());
    let unseen = soil().face(Face::North, Boundary::Reflecting).outside(Face::North, Soil { water: 1.0 });
    refused!(
        unseen,
        OutsideUnseen { substates: "Soil", face: Face::North, boundary: Boundary::Reflecting },
        "`Soil` has outside values for the north face, which is reflecting",
        "make the face flat"
    );
    let worm = Worm { position: Vector3::splat(0.0) };
    refused!(soil().outside(Face::North, worm), NotAdded { substates: "Worm" }, "add it first");
    let worms = soil().population::<Worm>(2).outside(Face::North, worm);
    refused!(worms, OutsideOfItems { substates: "Worm" }, "`Worm` is a population");
    let hexagons = soil()
        .extents([4, 4, 1])
        .neighbourhood(Neighbourhood::hexagonal(Hexagons::CornerUp))
        .face(Face::South, Boundary::Reflecting);
    refused!(hexagons, ReflectedHexagons { axis: 'y' }, "along y");
    refused!(soil().extents([9, 1, 1]).cell_side(1e308), Length { .. }, "give a smaller cell side");
}

#[test]
fn substates() {
    use ModelError::{NoSlots, NoSubstates, NotAdded, ReflectedPopulation, SubstatesTwice};
    refused!(
        Model::builder("garden").extents([1, 1, 1]),
        NoSubstates { .. },
        "`garden`",
        "call `.substates::<S>()`"
    );
    refused!(soil().substates::<Soil>(), SubstatesTwice { substates: "Soil" }, "`Soil`", "twice");
    refused!(soil().population::<Soil>(2), SubstatesTwice { .. }, "`Soil`");
    refused!(soil().population::<Worm>(0), NoSlots { substates: "Worm" }, "`Worm`", "at least 1");
    refused!(soil().items_may_leave::<Worm>(), NotAdded { substates: "Worm" }, "`Worm`", "add it first");
    refused!(soil().items_may_leave::<Soil>(), NotAdded { substates: "Soil" }, "`Soil`");
    let mirror =
        soil().population::<Worm>(2).boundaries([Boundary::Flat, Boundary::Toroidal, Boundary::Reflecting]);
    refused!(
        mirror,
        ReflectedPopulation { substates: "Worm", face: Face::Bottom },
        "`Worm`",
        "at the bottom face",
        "use a flat or toroidal one"
    );
    let mirror = soil().population::<Worm>(2).face(Face::North, Boundary::Reflecting);
    refused!(mirror, ReflectedPopulation { face: Face::North, .. }, "at the north face");
}

#[test]
fn processes() {
    use ModelError::{
        CellsOfPopulation, ItemsOfCells, Parameters, SearchOfWritten, UnknownSubstates, ZeroInterval,
    };
    refused!(
        soil().process(crawl),
        UnknownSubstates { process: "crawl", substates: "Worm" },
        "`crawl`",
        "add `.substates::<Worm>()` or `.population::<Worm>(slots)`"
    );
    let worms = || Model::builder("worms").extents([4, 4, 4]).population::<Worm>(2);
    refused!(
        worms().process(drink),
        UnknownSubstates { process: "drink", substates: "Soil" },
        "`drink`",
        "`Soil`"
    );
    refused!(worms().process(burrow).process(seep), UnknownSubstates { process: "seep", .. }, "`seep`");
    refused!(
        worms().process(dig),
        CellsOfPopulation { process: "dig", .. },
        "`dig`",
        "take `me: &mut Slot<Worm>`"
    );
    refused!(
        soil().process(glide),
        ItemsOfCells { process: "glide", .. },
        "`glide`",
        "take `cell: &mut Cell<Soil>`"
    );
    refused!(
        worms().population::<Soil>(1).process(drink),
        CellsOfPopulation { process: "drink", .. },
        "`Soil` is a population"
    );
    refused!(
        soil().process(soak),
        Parameters { process: "soak", wanted: "Weather", .. },
        "`soak`",
        "call `.parameters(Weather {"
    );
    refused!(
        worms().process(flee),
        SearchOfWritten { process: "flee", substate: "position" },
        "`flee`",
        "`position`",
        "search in one process, move in the next"
    );
    refused!(soil().steer(Schedule::Every(0), |_| Ok(())), ZeroInterval, "at least 1 step");
    refused!(soil().steer(Schedule::EveryFromStart(0), |_| Ok(())), ZeroInterval, "at least 1 step");
    assert!(soil().parameters(Weather { rain: 1.0 }).process(soak).build().is_ok());
}

mod other {
    use xca_core::prelude::*;

    /// The name of another struct.
    #[derive(Substates, Clone, Copy, Debug, PartialEq)]
    pub(crate) struct Soil {
        pub(crate) water: Real,
    }
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Stream {
    flow: Vector2<Real>,
    depth: Real,
    flow_y: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Weir {
    flow_1: Real,
    flow: [Real; 3],
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Sluice {
    flow: [Vector2<Real>; 2],
    flow_1: Vector2<Real>,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ticket {
    label: u32,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Kite {
    y: Real,
    #[position]
    position: Vector3<Real>,
}

/// The same names apart: a position of cells is none, and cells have no labels.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Fine {
    label: u32,
    x: Real,
    position: Vector3<Real>,
    water: Real,
}

#[test]
fn names_that_mean_two_things() {
    use ModelError::{FieldNamedLabel, SameColumn, SameStructName};
    refused!(
        soil().substates::<other::Soil>(),
        SameStructName { name: "Soil", .. },
        "faults_of_models::Soil` and `faults_of_models::other::Soil`",
        "rename"
    );
    refused!(
        soil().substates::<Stream>(),
        SameColumn { substates: "Stream", first: "flow", second: "flow_y", .. },
        "`flow` and `flow_y`",
        "`Stream`"
    );
    refused!(
        soil().population::<Kite>(1),
        SameColumn { substates: "Kite", first: "y", second: "position", .. },
        "`y` and `position`"
    );
    refused!(
        soil().substates::<Weir>(),
        SameColumn { substates: "Weir", first: "flow_1", second: "flow", .. },
        "`flow_1` and `flow`"
    );
    refused!(
        soil().substates::<Sluice>(),
        SameColumn { substates: "Sluice", first: "flow", second: "flow_1", .. },
        "the column `flow_1_x`"
    );
    refused!(soil().population::<Ticket>(1), FieldNamedLabel { substates: "Ticket" }, "`label`", "`Ticket`");
    assert!(soil().substates::<Fine>().build().is_ok());
}

/// Heavy cells.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Lead {
    a: Vector4<f64>,
    b: Vector4<f64>,
    c: Vector4<f64>,
    d: Vector4<f64>,
    e: Vector4<f64>,
    f: Vector4<f64>,
    g: Vector4<f64>,
    h: Vector4<f64>,
    i: Vector4<f64>,
    j: Vector4<f64>,
    k: Vector4<f64>,
    l: Vector4<f64>,
}

/// Lengths that are numbers in `f64` alone.
#[test]
fn lengths_beyond_a_precision() -> Result<(), Box<dyn Error>> {
    for side in [1e-60, 1e38] {
        let model = soil().extents([40, 1, 1]).cell_side(side).build()?;
        for engine in engines::all()? {
            let start = |precision| Simulation::new(&model, &*engine, RunOptions { precision, seed: 0 });
            assert!(start(Precision::F64).is_ok());
            let error = start(Precision::F32).expect_err("no length").to_string();
            assert!(error.contains("overflows or vanishes in f32; run in f64"), "{error}");
        }
    }
    Ok(())
}

/// A space that no machine holds is refused before any memory is asked for.
#[test]
fn too_large_to_start() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("heavy")
        .extents([1600, 1600, 1600])
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [1600, 1600, 1600]])?)
        .population::<Worm>(4)
        .substates::<Lead>()
        .build()?;
    for engine in engines::all()? {
        let error = Simulation::new(&model, &*engine, RunOptions::default()).expect_err("too large");
        assert!(matches!(error, RunError::Start(StartError::TooLarge { .. })), "{error:?}");
        let message = error.to_string();
        // Parts run on the engine that says it.
        let name = if engine.name() == "parts" { "cpu" } else { engine.name() };
        for words in [name, "cannot hold this model", "use fewer cells or slots"] {
            assert!(message.contains(words), "{message}");
        }
    }
    Ok(())
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Share {
    #[parameter(positive, range = ..=1.0)]
    first: Real,
    #[parameter(range = ..1.0, positive)]
    second: Real,
}

/// `positive` is the lower end of a range with an upper end, in whatever order they stand.
#[test]
fn positive_with_an_upper_end() {
    let model = |first, second| soil().parameters(Share { first, second }).build();
    assert!(model(1.0, 0.5).is_ok());
    for (first, second) in
        [(0.0, 0.5), (-0.5, 0.5), (1.5, 0.5), (f64::NAN, 0.5), (0.5, 0.0), (0.5, -1.0), (0.5, 1.0)]
    {
        assert!(matches!(model(first, second), Err(ModelError::Parameter(_))), "{first} and {second}");
    }
}
