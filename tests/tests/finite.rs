//! `watch_finite`: a NaN or an infinity stops the run on every engine, with its step, substate, cell and
//! item.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::reduction::{Reduced, Reduction};
use xca_core::{Fault, ModelBuilder};
use xca_tests::suite::engines::{self, assert_same_fault, assert_same_runs};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Heat {
    zero: u8,
    temperature: Real,
    flow: [Vector2<f32>; 2],
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    spin: f32,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Mishap {
    /// In which step, counted from 0, something goes wrong.
    step: u32,
    /// 0 in every run: the compiler must not know it.
    nought: Real,
}

/// 0/0 in the cells of the last row.
#[elementary_process]
fn divide(cell: &mut Cell<Heat>, p: &Mishap, space: &Space) {
    cell.temperature = 0.5 * cell.temperature;
    if space.step() == p.step && cell.index().y == 3 && cell.index().x > 1 {
        cell.temperature = p.nought / p.nought;
    }
}

/// 1/0 in one component in one cell.
#[elementary_process]
fn overflow(cell: &mut Cell<Heat>, p: &Mishap, space: &Space) {
    if space.step() == p.step && cell.index().x == 4 && cell.index().y == 2 {
        cell.flow[1].y = -1.0 / (p.nought as f32);
    }
}

#[elementary_process]
fn spin(me: &mut Slot<Grain>, p: &Mishap, space: &Space) {
    if space.step() == p.step && me.label() % 5 == 3 {
        me.spin = 1.0 / (p.nought as f32);
    }
}

#[elementary_process]
fn stray(me: &mut Slot<Grain>, p: &Mishap, space: &Space) {
    if space.step() == p.step && me.label() == 11 {
        me.position.z = p.nought / p.nought;
    }
}

/// 6 × 4 cells, all of them warm; a grain in each cell of the first two rows.
fn model() -> ModelBuilder {
    Model::builder("finite")
        .extents([6, 4, 1])
        .substates::<Heat>()
        .population::<Grain>(1)
        .parameters(Mishap { step: 6, nought: 0.0 })
        .fill(|_| Heat { zero: 0, temperature: 1.0, flow: [Vector2::splat(1.0); 2] })
        .populate(|site| (site.cell()[1] < 2).then(|| Grain { position: site.centre(), spin: 0.0 }))
}

const PRECISIONS: [Precision; 2] = [Precision::F32, Precision::F64];

fn stops(model: &Model, wanted: &str) -> Result<(), Box<dyn Error>> {
    let engines = engines::all()?;
    for precision in PRECISIONS {
        let options = RunOptions { precision, seed: 1 };
        let error = assert_same_fault(model, &engines, options, 12);
        assert!(matches!(&error, RunError::Fault { fault: Fault::NotFinite { .. }, .. }), "{error:?}");
        assert_eq!(error.to_string(), wanted, "{precision}");
    }
    Ok(())
}

#[test]
fn the_first_cell_is_named() -> Result<(), Box<dyn Error>> {
    let model = model().process(divide).process(overflow).watch_finite(Schedule::Every(1)).build()?;
    stops(&model, "step 7: `Heat.temperature` is NaN in cell [2, 3, 0]")
}

#[test]
fn components_are_named() -> Result<(), Box<dyn Error>> {
    let model = model().process(overflow).watch_finite(Schedule::Every(1)).build()?;
    stops(&model, "step 7: `Heat.flow[1].y` is -inf in cell [4, 2, 0]")
}

#[test]
fn items_are_named() -> Result<(), Box<dyn Error>> {
    let spinning = model().process(spin).watch_finite(Schedule::EveryFromStart(1)).build()?;
    stops(&spinning, "step 7: `Grain.spin` is inf for item 3 in cell [3, 0, 0]")?;
    let straying = model().process((spin, stray)).watch_finite(Schedule::Every(7)).build()?;
    stops(&straying, "step 7: `Grain.position.z` is NaN for item 11 in cell [5, 1, 0]")
}

/// The criteria would stop the run, or never do: NaN is neither above a number nor at most as large.
#[test]
fn a_stop_criterion_never_decides_on_nan() -> Result<(), Box<dyn Error>> {
    let said = "step 7: `Heat.temperature` is NaN in cell [2, 3, 0]";
    let is_below = |hottest: Option<f64>| hottest.is_some_and(|hottest| hottest <= -1.0);
    let is_not_above = |hottest: Option<f64>| !hottest.is_some_and(|hottest| hottest > -1.0);
    for is_over in [is_below, is_not_above] {
        let model = model().process(divide).stop_when(Schedule::Every(1), move |state| {
            Ok(is_over(state.maximum(Heat::TEMPERATURE)?).then(|| "converged".to_owned()))
        });
        stops(&model.build()?, said)?;
    }
    let summed = model().process(divide).stop_when(Schedule::Every(1), |state| {
        let sum = state.sum_of(|heat: &Heat| heat.temperature)?;
        Ok((sum.is_nan() || sum <= -1.0).then(|| "converged".to_owned()))
    });
    stops(&summed.build()?, said)?;
    // Where NaN has a meaning the criterion decides.
    let meant = model().process(divide).allow_non_finite(Heat::TEMPERATURE);
    let meant = meant.stop_when(Schedule::Every(1), |state| {
        let hottest = state.maximum(Heat::TEMPERATURE)?;
        Ok(hottest.filter(|hottest| hottest.is_nan()).map(|_| "gone".to_owned()))
    });
    let mut simulation = Simulation::new(&meant.build()?, &Reference, RunOptions::default())?;
    simulation.run(20)?;
    assert_eq!((simulation.step_number(), simulation.stop_reason()), (7, Some("gone")));
    Ok(())
}

#[test]
fn a_rare_check_finds_it_later() -> Result<(), Box<dyn Error>> {
    let model = model().process(divide).watch_finite(Schedule::Every(5)).build()?;
    stops(&model, "step 10: `Heat.temperature` is NaN in cell [2, 3, 0]")
}

#[test]
fn a_substate_may_mean_it() -> Result<(), Box<dyn Error>> {
    let engines = engines::all()?;
    let model = model()
        .process((divide, overflow, spin))
        .watch_finite(Schedule::EveryFromStart(1))
        .allow_non_finite(Heat::TEMPERATURE)
        .allow_non_finite(Grain::SPIN)
        .allow_non_finite(Heat::FLOW)
        .build()?;
    for precision in PRECISIONS {
        assert_same_runs(&model, &engines, RunOptions { precision, seed: 1 }, 12)?;
    }
    Ok(())
}

#[test]
fn the_start_and_the_end() -> Result<(), Box<dyn Error>> {
    let infinite = |_: Site| Heat { zero: 0, temperature: f64::INFINITY, flow: [Vector2::splat(0.0); 2] };
    for engine in engines::all()? {
        for schedule in [Schedule::Start, Schedule::EveryFromStart(3), Schedule::At(vec![0])] {
            let model = model().fill(infinite).watch_finite(schedule).build()?;
            let error = Simulation::new(&model, &*engine, RunOptions::default()).expect_err("it is infinite");
            assert_eq!(error.to_string(), "step 0: `Heat.temperature` is inf in cell [0, 0, 0]");
        }
        let model = model().process(divide).watch_finite(Schedule::End).build()?;
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        simulation.run(9)?;
        let error = simulation.finish().expect_err("it is NaN").to_string();
        assert_eq!(error, "step 9: `Heat.temperature` is NaN in cell [2, 3, 0]");
        assert_eq!(simulation.check_finite().expect_err("it still is").to_string(), error);
    }
    Ok(())
}

#[test]
fn a_snapshot_of_an_earlier_step_goes_on() -> Result<(), Box<dyn Error>> {
    let model = model().process(divide).watch_finite(Schedule::Every(1)).build()?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        simulation.run(5)?;
        let earlier = simulation.snapshot()?;
        simulation.run(5).expect_err("it is NaN");
        assert!(matches!(simulation.step(), Err(RunError::Broken { step: 7 })));
        simulation.restore(&earlier)?;
        simulation.state().set_parameter("step", "100")?;
        simulation.run(5)?;
        assert_eq!(simulation.step_number(), 10);
    }
    Ok(())
}

/// Each component has its own count, and infinities count.
#[test]
fn counts_by_component() -> Result<(), Box<dyn Error>> {
    let model = model().process((divide, overflow, spin)).build()?;
    for engine in engines::all()? {
        for precision in PRECISIONS {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed: 1 })?;
            simulation.run(7)?;
            let state = simulation.state();
            let count = |results: Vec<Reduced>| -> Vec<f64> {
                results.into_iter().filter_map(Reduced::number).collect()
            };
            let non_finite = &Reduction::CountNonFinite;
            assert_eq!(count(state.reduce(Heat::TEMPERATURE, non_finite)?), [4.0]);
            assert_eq!(count(state.reduce(Heat::FLOW, non_finite)?), [0.0, 0.0, 0.0, 1.0]);
            assert_eq!(count(state.reduce(Heat::ZERO, non_finite)?), [0.0]);
            assert_eq!(count(state.reduce(Grain::SPIN, non_finite)?), [2.0]);
            assert_eq!(count(state.reduce(Grain::POSITION, non_finite)?), [0.0, 0.0, 0.0]);
        }
    }
    Ok(())
}

#[test]
fn mistakes_are_refused() {
    let never = model().watch_finite(Schedule::Every(0)).build().expect_err("never");
    assert_eq!(never, ModelError::ZeroInterval);
    let builder = Model::builder("grains").extents([2, 2, 1]).population::<Grain>(1);
    let error = builder.allow_non_finite(Heat::TEMPERATURE).build().expect_err("no such struct");
    assert_eq!(error, ModelError::NotAdded { substates: "Heat" });
}
