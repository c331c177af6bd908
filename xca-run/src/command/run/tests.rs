//! Runs of a model with substates of cells and two populations, of which the frame is told nothing.

use super::*;
use crate::command::definition::Definition;
use crate::command::{execute, parse};
use crate::engines::Engines;
use crate::program::Given;
use serde_json::Value;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use xca_core::prelude::*;
use xca_record::SetUp;
use xca_record::{CellView, ItemView};
use xca_record::{Failure, Observable};

#[derive(Substates, Clone, Copy)]
struct Grass {
    height: Real,
    wind: Vector2<f32>,
    kind: u8,
}

#[derive(Substates, Clone, Copy)]
struct Hare {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    age: u32,
}

#[derive(Substates, Clone, Copy)]
struct Stone {
    weight: f32,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Growth {
    rate: Real,
    limit: i32,
}

#[elementary_process]
fn grow(cell: &mut Cell<Grass>, p: &Growth) {
    cell.height += p.rate;
}

#[elementary_process]
fn age(me: &mut Slot<Hare>, p: &Growth) {
    me.age += 1;
    if me.age > 100 - (p.limit as u32) {
        me.fault(7, me.velocity.x);
    }
}

fn model() -> Result<Model, Failure> {
    let hare = |label: u32| Item {
        label,
        cell: [label as usize % 4, 1, 0],
        state: Hare {
            position: Vector3::new(f64::from(label % 4) * 0.5 + 0.25, 0.75, 0.25),
            velocity: Vector3::new(0.0, 3.0, 4.0),
            age: label,
        },
    };
    Ok(Model::builder("meadow")
        .extents([4, 3, 2])
        .cell_side(0.5)
        .substates::<Grass>()
        .population::<Hare>(2)
        .population::<Stone>(1)
        .parameters(Growth { rate: 0.5, limit: 0 })
        .process(grow)
        .process(age)
        .fault_text(7, "a hare is too old")
        .fill(|site| {
            let [x, ..] = site.cell();
            Grass { height: x as f64, wind: Vector2::new(1.0, x as f32), kind: 2 }
        })
        .initialise(move |state| Ok(state.set_items(vec![hare(9), hare(4), hare(6)])?))
        .initialise(|state| {
            Ok(state.set_items(vec![Item { label: 1, cell: [3, 2, 1], state: Stone { weight: 2.5 } }])?)
        })
        .stop_when(Schedule::At(vec![60]), |_| Ok(Some("the summer is over".to_owned())))
        .build()?)
}

type Make = dyn Fn(Given) -> Result<SetUp, Failure> + std::panic::RefUnwindSafe;

/// Runs a model with these options, in a folder of its own unless `out` is given.
fn run_model(make: &Make, words: &[&str], out: &Path) -> (Result<Ended, Unable>, Value) {
    let set_up = |_: &clap::ArgMatches, given: Given| make(given).map_err(Unable::Refused);
    let definition = Definition {
        name: "meadow",
        about: "",
        version: "0",
        examples: "",
        options: std::convert::identity,
        set_up: &set_up,
        engines: &Engines::default(),
    };
    let out_text = out.to_str().unwrap();
    let first = ["meadow", "run", "--quiet", "--out", out_text];
    let words = first.iter().chain(words);
    let words: Vec<OsString> = words.map(OsString::from).collect();
    let ended = parse::invocation(&definition, &words).and_then(execute);
    let report = fs::read_to_string(out.join("run.json")).unwrap_or_else(|_| "null".to_owned());
    (ended, serde_json::from_str(&report).unwrap())
}

fn plain(_: Given) -> Result<SetUp, Failure> {
    Ok(SetUp::new(model()?, 50))
}

fn message(ended: &Result<Ended, Unable>) -> String {
    match ended {
        Err(
            Unable::Refused(error)
            | Unable::RefusedOffering(error, _)
            | Unable::Failed(error)
            | Unable::FailedLeaving(error, _),
        ) => error.to_string(),
        Err(Unable::CommandLine(error)) => error.to_string(),
        Ok(_) => "no error".to_owned(),
    }
}

fn lines(path: &Path) -> Vec<String> {
    fs::read_to_string(path).unwrap().lines().map(str::to_owned).collect()
}

#[test]
fn a_model_of_which_nothing_is_said_has_all_files() {
    let folder = tempfile::tempdir().unwrap();
    let (ended, report) = run_model(&plain, &["--steps", "5", "--every", "2"], folder.path());
    assert!(matches!(ended, Ok(Ended::Done)), "{}", message(&ended));
    for file in [
        "grass.pvd",
        "hare.pvd",
        "stone.pvd",
        "initial.png",
        "initial_hare.png",
        "final.png",
        "final_stone.png",
    ] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
    for step in [0, 2, 4, 5] {
        for file in ["grass_%.vti", "hare_%.vtp", "stone_%.vtp"] {
            let file = file.replace('%', &format!("{step:08}"));
            assert!(folder.path().join("frames").join(&file).is_file(), "{file}");
        }
    }
    let items = lines(&folder.path().join("final.csv"));
    assert_eq!(items[0], "label,x,y,z,velocity_x,velocity_y,velocity_z,age");
    assert!(items[1].starts_with("4,2.5000000000000000e-1,7.5") && items[1].ends_with(",9"), "{}", items[1]);
    assert_eq!(items.len(), 4);
    assert_eq!(lines(&folder.path().join("final_stone.csv")), ["label,weight", "1,2.5000000000000000e0"]);
    let series = lines(&folder.path().join("observables.csv"));
    assert_eq!(
        series[0],
        "step,time,grass_height_min,grass_height_mean,grass_height_max,grass_wind_x_mean,grass_wind_y_mean,\
         grass_kind_min,grass_kind_sum,grass_kind_max,hare_items,hare_largest_occupancy,hare_position_x_mean,\
         hare_position_y_mean,hare_position_z_mean,hare_velocity_x_mean,hare_velocity_y_mean,hare_velocity_z_mean,\
         hare_age_min,hare_age_sum,hare_age_max,stone_items,stone_largest_occupancy,stone_weight_min,stone_weight_mean,\
         stone_weight_max"
    );
    assert_eq!(series.len(), 5);
    assert!(series[4].starts_with("5,5,2.5,4,5.5,1,1.5,2,48,2,3,1,"), "{}", series[4]);
    assert_eq!(report["progress"]["outcome"], "done");
    assert_eq!(report["parameters"]["rate"], 0.5);
    assert_eq!(report["model"]["groups"][1]["slots"], 2);
}

#[test]
fn views_say_what_is_saved() {
    let make = |_: Given| -> Result<SetUp, Failure> {
        let hares = ItemView::named("hares")
            .only(Hare::AGE, 9)
            .columns(Hare::POSITION, ["x", "y", "z"])
            .columns(Hare::AGE, ["years"])
            .radius(0.1)
            .colour(Hare::AGE, "age");
        let grass = CellView::named("grass").draw(Grass::WIND, "wind").layer(1).range(0.0, 5.0);
        let observe = |state: &State<'_>| Ok(vec![Observable::new("grass", "m", state.sum(Grass::HEIGHT)?)]);
        let set_up = SetUp::new(model()?, 3).time_step(0.25).observables(observe);
        set_up.items(hares).cells(grass).note("season", "summer")
    };
    let folder = tempfile::tempdir().unwrap();
    let (ended, report) = run_model(&make, &["--set", "rate=1", "--precision", "f32"], folder.path());
    assert!(matches!(ended, Ok(Ended::Done)), "{}", message(&ended));
    // The hare that was 6 is 9 now.
    let items = lines(&folder.path().join("final.csv"));
    assert_eq!(items.len(), 2);
    assert!(items[0] == "label,x,y,z,years" && items[1].starts_with("6,1.25"), "{items:?}");
    let series = lines(&folder.path().join("observables.csv"));
    assert_eq!(series, ["step,time,grass", "0,0,36", "1,0.25,60", "2,0.5,84", "3,0.75,108"]);
    assert_eq!(report["observables"][0]["final"], 108.0);
    assert_eq!((&report["season"], &report["progress"]["time"]), (&"summer".into(), &0.75.into()));
    assert!(
        fs::read_to_string(folder.path().join("hares.pvd")).unwrap().contains("frames/hares_00000003.vtp")
    );
}

/// What is recorded of a step comes after the steering of that step, at step 0 too.
#[test]
fn sources_are_in_the_balance_of_every_step() {
    let make = |_: Given| -> Result<SetUp, Failure> {
        let model = Model::builder("lake")
            .extents([4, 3, 1])
            .boundary(Boundary::Reflecting)
            .face(Face::South, Boundary::Flat)
            .substates::<Stone>()
            .fill(|_| Stone { weight: 1.0 })
            .steer(Schedule::EveryFromStart(1), |state| {
                Ok(state.update(Stone::WEIGHT, &[[1, 2, 0], [3, 0, 0]], |_, weight| weight + 2.0)?)
            })
            .build()?;
        let observe =
            |state: &State<'_>| Ok(vec![Observable::new("weight", "kg", state.sum(Stone::WEIGHT)?)]);
        Ok(SetUp::new(model, 3).observables(observe))
    };
    let folder = tempfile::tempdir().unwrap();
    let (ended, report) = run_model(&make, &[], folder.path());
    assert!(matches!(ended, Ok(Ended::Done)), "{}", message(&ended));
    let series = lines(&folder.path().join("observables.csv"));
    assert_eq!(series, ["step,time,weight", "0,0,16", "1,1,20", "2,2,24", "3,3,28"]);
    let boundaries = &report["model"]["boundaries"];
    assert_eq!((&boundaries["south"], &boundaries["north"]), (&"flat".into(), &"reflecting".into()));
}

#[test]
fn views_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |make: &Make| {
        let (ended, _) = run_model(make, &[], &folder.path().join("out"));
        assert!(matches!(ended, Err(Unable::Refused(_))));
        assert!(!folder.path().join("out").exists());
        message(&ended)
    };
    let said = refused(&|given| Ok(plain(given)?.items(ItemView::<Grass>::named("g"))));
    assert_eq!(said, "the view `g` shows substates that the model does not have as items");
    let said = refused(&|given| Ok(plain(given)?.cells(CellView::<Grass>::named("g").layer(2))));
    assert_eq!(said, "the view `g` draws layer 2, but the space has 2 layers");
    let twice =
        |given| Ok(plain(given)?.cells(CellView::<Grass>::named("a")).items(ItemView::<Hare>::named("a")));
    assert!(refused(&twice).contains("the files of the views `a` and `a` would have"));
}

#[test]
fn a_fault_ends_the_run_and_leaves_what_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let (ended, report) = run_model(&plain, &["--set", "limit=87", "--every", "2"], folder.path());
    assert!(matches!(&ended, Err(Unable::FailedLeaving(_, left)) if left.starts_with("4 steps are done")));
    let said = message(&ended);
    assert!(said.starts_with("step 5: a hare is too old: `age` reports fault 7"), "{said}");
    assert_eq!(report["progress"]["outcome"], "failed");
    assert_eq!(report["progress"]["reason"], said);
    assert_eq!(report["progress"]["steps"], 4);
    assert_eq!(lines(&folder.path().join("observables.csv")).len(), 4);
    assert!(folder.path().join("initial.png").is_file() && !folder.path().join("final.png").exists());
}

#[test]
fn a_criterion_ends_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let (ended, report) = run_model(&plain, &["--steps", "80"], folder.path());
    assert!(matches!(ended, Ok(Ended::Done)));
    let progress = &report["progress"];
    assert_eq!((&progress["outcome"], &progress["steps"]), (&"stopped".into(), &60.into()));
    assert_eq!(progress["reason"], "the summer is over");
    assert!(folder.path().join("final.csv").is_file());
}

#[test]
fn mistakes_are_found_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let said = |make: &Make, words: &[&str]| {
        let (ended, _) = run_model(make, words, &out);
        assert!(matches!(ended, Err(Unable::Refused(_))) && !out.exists(), "{}", message(&ended));
        message(&ended)
    };
    assert_eq!(
        said(&plain, &["--set", "rat=1"]),
        "no parameter is called `rat`; known parameters: rate, limit"
    );
    assert!(said(&plain, &["--set", "limit=0.5"]).contains("`0.5` is no value for the parameter `limit`"));
    assert!(
        said(&plain, &["--engine", "reference", "--threads", "2"]).contains("--threads is for --engine cpu")
    );
    assert_eq!(said(&|_| Err("no meadow".into()), &[]), "no meadow");
    let bare = |_: Given| -> Result<SetUp, Failure> {
        Ok(SetUp::new(Model::builder("bare").extents([3, 3, 1]).substates::<Stone>().build()?, 1))
    };
    assert_eq!(said(&bare, &["--set", "a=1"]), "this model has no parameters; `a=1` cannot be set");
}

#[test]
fn observables_must_stay_the_same() {
    let make = |given: Given| -> Result<SetUp, Failure> {
        Ok(plain(given)?.observables(|state| {
            let name = if state.step() < 2 { "early" } else { "late" };
            Ok(vec![Observable::number(name, 1.0)])
        }))
    };
    let folder = tempfile::tempdir().unwrap();
    let (ended, _) = run_model(&make, &["--every", "1"], folder.path());
    assert_eq!(
        message(&ended),
        "the observables after step 2 differ from those of the start: late instead of early"
    );
}

/// 0/0 in step 7, in one cell.
#[elementary_process]
fn wither(cell: &mut Cell<Grass>, p: &Growth, space: &Space) {
    if space.step() == 6 && cell.index().x == 2 && cell.index().y == 1 {
        cell.height = (p.rate - p.rate) / (p.rate - p.rate);
    }
}

fn withering(_: Given) -> Result<SetUp, Failure> {
    let model = Model::builder("meadow")
        .extents([4, 3, 2])
        .substates::<Grass>()
        .parameters(Growth { rate: 0.5, limit: 0 })
        .process(wither)
        .build()?;
    Ok(SetUp::new(model, 20))
}

#[test]
fn nan_ends_the_run_and_the_last_good_checkpoint_stays() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["--every", "20", "--checkpoint-every", "5"];
    let (ended, report) = run_model(&withering, &words, folder.path());
    assert!(matches!(&ended, Err(Unable::FailedLeaving(..))));
    let said = message(&ended);
    assert!(
        said.starts_with("step 10: `Grass.height` is NaN in cell [2, 1, 0]; add --allow-non-finite"),
        "{said}"
    );
    assert_eq!(report["progress"]["outcome"], "failed");
    assert_eq!(report["progress"]["reason"], said);
    let checkpoints = || -> Vec<_> {
        let names = fs::read_dir(folder.path().join("checkpoints")).unwrap();
        let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.starts_with("step_")).collect()
    };
    assert_eq!(checkpoints(), ["step_00000005.checkpoint"]);

    let (ended, report) =
        run_model(&withering, &[&words[..], &["--allow-non-finite", "--overwrite"]].concat(), folder.path());
    assert!(matches!(ended, Ok(Ended::Done)), "{}", message(&ended));
    assert_eq!(report["progress"]["steps"], 20);
    assert!(checkpoints().contains(&"step_00000015.checkpoint".to_owned()));
}

#[test]
fn nan_ends_the_run_at_an_output() {
    let folder = tempfile::tempdir().unwrap();
    let (ended, _) = run_model(&withering, &["--every", "2"], folder.path());
    assert!(message(&ended).starts_with("step 8: `Grass.height` is NaN in cell [2, 1, 0]"));
    // Steps 0, 2, 4 and 6, below the names.
    assert_eq!(lines(&folder.path().join("observables.csv")).len(), 5);
    // The last state is one too.
    let (ended, _) = run_model(&withering, &["--steps", "7", "--every", "100"], folder.path());
    assert!(message(&ended).starts_with("step 7: `Grass.height` is NaN in cell [2, 1, 0]"));
    assert!(!folder.path().join("final.png").exists());
}

/// Before an earlier run loses its files.
#[test]
fn an_initial_state_with_nan_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (_, earlier) = run_model(&plain, &["--steps", "3"], folder.path());
    let rotten = |_: Given| -> Result<SetUp, Failure> {
        let model = Model::builder("meadow").extents([4, 3, 2]).substates::<Grass>();
        let nan = Grass { height: f64::NAN, wind: Vector2::new(0.0, 0.0), kind: 0 };
        Ok(SetUp::new(model.fill(move |_| nan).build()?, 5))
    };
    let (ended, report) = run_model(&rotten, &[], folder.path());
    assert!(matches!(ended, Err(Unable::Refused(_))));
    assert!(
        message(&ended).starts_with("step 0: `Grass.height` is NaN in cell [0, 0, 0]"),
        "{}",
        message(&ended)
    );
    assert_eq!(report, earlier);
    let (ended, _) = run_model(&rotten, &["--allow-non-finite"], folder.path());
    assert!(matches!(ended, Ok(Ended::Done)));
}

#[test]
fn a_time_step_must_be_positive() {
    let folder = tempfile::tempdir().unwrap();
    for (seconds, text) in [(f64::NAN, "NaN"), (0.0, "0"), (-0.5, "-0.5"), (f64::INFINITY, "inf")] {
        let make = move |given| Ok(plain(given)?.time_step(seconds));
        let (ended, report) = run_model(&make, &[], folder.path());
        assert!(matches!(ended, Err(Unable::Refused(_))), "{seconds}");
        assert_eq!(message(&ended), format!("the time step is {text} s; it must be a positive number"));
        assert_eq!(report, Value::Null);
    }
}
