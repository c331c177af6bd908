//! Initial states made cell by cell, from random numbers and parameters: the same on every engine.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::{Draw, ParameterError, Stream};
use xca_tests::suite::engines::{self, PRECISIONS};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ground {
    height: Real,
    bits: u32,
    drawn: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Sky {
    height: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Molecule {
    #[position]
    position: Vector3<Real>,
    speed: Real,
}

#[derive(Parameters, Clone, Debug, PartialEq)]
struct Gas {
    density: Real,
    initial: Real,
}

#[elementary_process]
fn draw_once(cell: &mut Cell<Ground>) {
    cell.drawn = cell.random(0);
}

const EXTENTS: [usize; 3] = [7, 5, 3];
const SIDE: f64 = 0.5;

fn builder() -> ModelBuilder {
    Model::builder("gas")
        .extents(EXTENTS)
        .cell_side(SIDE)
        .substates::<Ground>()
        .substates::<Sky>()
        .population::<Molecule>(3)
        .parameters(Gas { density: 0.4, initial: 100.0 })
        .process(draw_once)
        .fill(|site| Ground { height: site.random(0), bits: site.random_bits(1), drawn: -1.0 })
        .fill_with(|site, gas: &Gas| Sky { height: gas.initial + site.random(0) })
        .populate_with(|site, gas: &Gas| {
            let number = (0..3).filter(|draw| site.random(*draw) < gas.density).count();
            let offset =
                |draw| Vector3::new(0, 1, 2).map(|axis| SIDE * (site.random(10 * draw + axis) - 0.5));
            let molecule =
                |draw: usize| Molecule { position: site.centre() + offset(draw), speed: gas.initial };
            (1..=number).map(molecule).collect::<Vec<_>>()
        })
}

/// Numbers are Philox of the seed, the group, the cell and the draw, as it is documented; nothing of it
/// depends on the engine.
#[test]
fn sites_draw_as_documented() -> Result<(), Box<dyn Error>> {
    let model = builder().build()?;
    for engine in engines::all()? {
        for precision in PRECISIONS {
            let options = RunOptions { precision, seed: 77 };
            let mut simulation = Simulation::new(&model, &*engine, options)?;
            let state = simulation.state();
            let words = |group, owner, number| {
                Draw { stream: Stream::initial(group), step: 0, owner, number }.words(options.seed)
            };
            let uniform = |[high, low, ..]: [u32; 4]| {
                (f64::from(high >> 5) * 2_f64.powi(26) + f64::from(low >> 6)) / 2_f64.powi(53)
            };
            let rounded =
                |value: f64| if precision == Precision::F32 { f64::from(value as f32) } else { value };
            let (heights, bits, sky) =
                (state.read(Ground::HEIGHT)?, state.read(Ground::BITS)?, state.read(Sky::HEIGHT)?);
            for cell in 0..105 {
                assert_eq!(heights[cell as usize], rounded(uniform(words(0, cell, 0))));
                assert_eq!(bits[cell as usize], words(0, cell, 1)[0]);
                assert_eq!(sky[cell as usize], rounded(100.0 + uniform(words(1, cell, 0))));
            }
            let mut label = 0;
            for cell in 0..105 {
                let number = (0..3).filter(|draw| uniform(words(2, cell, *draw)) < 0.4).count();
                let here: Vec<_> = state.items::<Molecule>()?;
                for _ in 0..number {
                    let item = &here[label];
                    assert_eq!(
                        (item.label as usize, state.geometry().linear(item.cell)),
                        (label, cell as usize)
                    );
                    assert_eq!(state.geometry().centre(item.cell)[1], (item.cell[1] as f64 + 0.5) * SIDE);
                    let position = item.state.position;
                    let inside = [position.x, position.y, position.z].map(|metres| metres / SIDE);
                    for (place, index) in inside.into_iter().zip(item.cell) {
                        assert!((place - index as f64 - 0.5).abs() <= 0.5 + 1e-6, "{item:?}");
                    }
                    label += 1;
                }
            }
            assert_eq!(state.count_items::<Molecule>()?, label);
            assert!(label > 50, "{label} molecules");
        }
    }
    Ok(())
}

/// What a process draws in the first step has nothing to do with what the initial state was made of.
#[test]
fn processes_draw_other_numbers() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("ground")
        .extents([100, 100, 1])
        .substates::<Ground>()
        .process(draw_once)
        .fill(|site| Ground { height: site.random(0), bits: 0, drawn: 0.0 })
        .build()?;
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    simulation.step()?;
    let state = simulation.state();
    // The covariance of two uniform numbers has a standard error of 1/12 of one over the root of their
    // number.
    let product = state.sum_of(|ground: &Ground| (ground.height - 0.5) * (ground.drawn - 0.5))? / 10_000.0;
    assert!(product.abs() < 5.0 / 1200.0, "{product}");
    let mean = state.sum(Ground::HEIGHT)? / 10_000.0;
    assert!((mean - 0.5).abs() < 0.0145, "{mean}");
    Ok(())
}

/// Whoever sets a parameter before the run: the initial state follows.
#[test]
fn the_initial_state_follows_the_parameters() -> Result<(), Box<dyn Error>> {
    let mut by_name = builder().build()?;
    by_name.set_parameter("initial", "50")?;
    let typed = builder().build()?.with_parameters(Gas { density: 1.0, initial: 50.0 })?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&by_name, &*engine, RunOptions::default())?;
        let state = simulation.state();
        assert!(state.minimum(Sky::HEIGHT)?.is_some_and(|least| (50.0..51.0).contains(&least)));
        assert_eq!(state.maximum(Molecule::SPEED)?, Some(50.0));
        let mut simulation = Simulation::new(&typed, &*engine, RunOptions::default())?;
        assert_eq!(simulation.state().count_items::<Molecule>()?, 3 * 105);
        assert!(simulation.state().maximum(Sky::HEIGHT)?.is_some_and(|largest| largest < 51.0));
    }
    Ok(())
}

#[derive(Parameters, Clone, Debug)]
struct Fluid {
    density: Real,
}

#[test]
fn other_parameters_are_refused() -> Result<(), Box<dyn Error>> {
    let error = builder().build()?.with_parameters(Fluid { density: 1.0 }).expect_err("they are others");
    assert_eq!(error, ParameterError::OtherStruct { wanted: "Fluid", given: "Gas".to_owned() });
    let error = builder().fill_with(|_, fluid: &Fluid| Sky { height: fluid.density }).build();
    let error = error.expect_err("the model has no such parameters");
    assert_eq!(
        error,
        ModelError::InitialParameters { substates: "Sky", wanted: "Fluid", given: "Gas".to_owned() }
    );
    assert!(error.to_string().contains("call `.parameters(Fluid {"));
    Ok(())
}

#[test]
fn the_wrong_kind_of_substates_is_refused() {
    let molecule = || Molecule { position: Vector3::splat(0.0), speed: 0.0 };
    let error = builder().fill(move |_| molecule()).build().expect_err("it is a population");
    assert_eq!(error, ModelError::FillOfPopulation { substates: "Molecule" });
    let error = builder().populate(|_| [Sky { height: 0.0 }]).build().expect_err("they are of cells");
    assert_eq!(error, ModelError::PopulatedCells { substates: "Sky" });
    let model = Model::builder("sky").extents([1, 1, 1]).substates::<Sky>();
    let error = model.populate(move |_| Some(molecule())).build().expect_err("there is no such population");
    assert_eq!(error, ModelError::NotAdded { substates: "Molecule" });
}

#[test]
fn more_items_than_slots_are_refused() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("crowd")
        .extents([2, 2, 1])
        .population::<Molecule>(1)
        .populate(|site| {
            let number = if site.cell() == [1, 0, 0] { 2 } else { 1 };
            (0..number).map(move |_| Molecule { position: site.centre(), speed: 0.0 })
        })
        .build()?;
    for engine in engines::all()? {
        let error = Simulation::new(&model, &*engine, RunOptions::default()).expect_err("a cell is full");
        let error = error.to_string();
        assert!(error.contains("cell [1, 0, 0] would hold 2 items, but a cell has 1 slot"), "{error}");
    }
    Ok(())
}
