use super::*;
use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};
use xca_core::Reference;
use xca_core::prelude::*;

#[derive(Substates, Clone)]
struct Walker {
    place: Real,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Walk {
    stride: Real,
    drift: Real,
}

#[elementary_process]
fn walk(cell: &mut Cell<Walker>, p: &Walk) {
    cell.place += p.drift + p.stride * (cell.random(0) - 0.5);
}

fn set_up() -> Result<SetUp, Failure> {
    let model = Model::builder("walk")
        .extents([4, 1, 1])
        .substates::<Walker>()
        .parameters(Walk { stride: 1.0, drift: 0.0 })
        .process(walk)
        .fill(|_| Walker { place: 0.0 })
        .build()?;
    Ok(SetUp::new(model, 20))
}

fn engine() -> Result<Box<dyn Engine>, Failure> {
    Ok(Box::new(Reference))
}

fn ensemble() -> Ensemble {
    Ensemble::new().sweep("stride", [0.0, 2.0]).sweep("drift", ["0.5", "1"]).seeds(5, 3)
}

#[test]
fn members_are_all_combinations_and_the_seeds_vary_fastest() {
    let members = ensemble().members();
    let shown: Vec<String> = members
        .iter()
        .map(|member| {
            format!("{} {} {}", member.parameters[0].value, member.parameters[1].value, member.seed)
        })
        .collect();
    assert_eq!(shown.len(), 12);
    assert_eq!(shown[..4], ["0 0.5 5", "0 0.5 6", "0 0.5 7", "0 1 5"]);
    assert_eq!(shown[11], "2 1 7");
}

#[test]
fn the_table_is_the_same_with_any_number_of_jobs_and_holds_what_is_known() {
    let folder = tempfile::tempdir().unwrap();
    let mut texts = Vec::new();
    for jobs in [1, 3, 20] {
        let out = folder.path().join(jobs.to_string());
        let finished = ensemble().jobs(jobs).run(&out, &engine, &mut |_| set_up(), &mut ()).unwrap();
        // Without strides, all walkers are where the drift has brought them.
        for row in finished.iter().filter(|row| row.member.parameters[0].value == "0") {
            let drift: f64 = row.member.parameters[1].value.parse().unwrap();
            assert!(row.observables.iter().all(|found| found.value == 20.0 * drift), "{row:?}");
        }
        texts.push([MEMBERS, SUMMARY].map(|file| fs::read_to_string(out.join(file)).unwrap()));
    }
    assert!(texts.iter().all(|text| *text == texts[0]));
    let [members, summary] = &texts[0];
    assert_eq!(members.lines().count(), 13);
    assert!(members.starts_with("member,seed,stride,drift,end,reason,steps,"), "{members}");
    assert_eq!(summary.lines().count(), 5);
    let still = summary.lines().nth(1).unwrap();
    assert!(still.starts_with("0,0.5,3,10,0,10,10,"), "{still}");
    // Seeds make other walks: the spread over them is not 0.
    let wild = summary.lines().nth(3).unwrap().split(',').nth(4).unwrap();
    assert!(wild.parse::<f64>().unwrap() > 0.01, "{summary}");
}

#[test]
fn a_member_that_fails_does_not_end_the_others_and_is_tried_again() {
    let folder = tempfile::tempdir().unwrap();
    let ensemble = Ensemble::new().sweep("drift", ["1", "nonsense", "inf", "2"]).jobs(2);
    let tried = AtomicUsize::new(0);
    let mut counted = |_: &Member| {
        tried.fetch_add(1, Ordering::Relaxed);
        set_up()
    };
    let finished = ensemble.run(folder.path(), &engine, &mut counted, &mut ()).unwrap();
    let failed: Vec<bool> = finished.iter().map(|row| matches!(row.end, End::Failed(_))).collect();
    assert_eq!(failed, [false, true, true, false]);
    let further = finished[3].observables[0].value - finished[0].observables[0].value;
    assert!((further - 20.0).abs() < 1e-12, "{further}");
    assert_eq!(tried.load(Ordering::Relaxed), 1 + 4);
    let first = fs::read_to_string(folder.path().join(MEMBERS)).unwrap();
    let again = ensemble.run(folder.path(), &engine, &mut counted, &mut ()).unwrap();
    assert_eq!(tried.load(Ordering::Relaxed), 1 + 4 + 1 + 2);
    assert_eq!(again.len(), 4);
    assert_eq!(fs::read_to_string(folder.path().join(MEMBERS)).unwrap(), first);
}

/// Ends after so many members.
struct Impatient(usize);

impl EnsembleMonitor for Impatient {
    fn ended(&mut self, _: &Finished) {
        self.0 = self.0.saturating_sub(1);
    }

    fn is_interrupted(&self) -> bool {
        self.0 == 0
    }
}

#[test]
fn what_was_interrupted_goes_on_and_ends_with_the_same_table() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
    ensemble().run(&whole, &engine, &mut |_| set_up(), &mut ()).unwrap();
    let first = ensemble().jobs(1).run(&parts, &engine, &mut |_| set_up(), &mut Impatient(5)).unwrap();
    assert!((5..12).contains(&first.len()), "{}", first.len());
    let mut tried = 0;
    let mut counted = |_: &Member| {
        tried += 1;
        set_up()
    };
    ensemble().run(&parts, &engine, &mut counted, &mut ()).unwrap();
    assert_eq!(tried, 1 + 12 - first.len());
    for file in [MEMBERS, SUMMARY] {
        assert_eq!(fs::read(whole.join(file)).unwrap(), fs::read(parts.join(file)).unwrap(), "{file}");
    }
}

#[test]
fn other_ensembles_and_foreign_files_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    ensemble().run(folder.path(), &engine, &mut |_| set_up(), &mut ()).unwrap();
    let error = ensemble().seeds(0, 3).run(folder.path(), &engine, &mut |_| set_up(), &mut ()).unwrap_err();
    assert!(error.to_string().contains("holds another ensemble"), "{error}");
    // The same axes over another model, and over an input that has changed.
    let mut other = |_: &Member| {
        let mut set_up = set_up()?;
        set_up.model.set_parameter("drift", "3")?;
        Ok(set_up)
    };
    let error = ensemble().run(folder.path(), &engine, &mut other, &mut ()).unwrap_err();
    assert!(error.to_string().contains("holds another ensemble"), "{error}");
    let [input, out] = ["map", "of_map"].map(|name| folder.path().join(name));
    for (text, goes_on) in [("1 2", true), ("1 2", true), ("1 3", false)] {
        fs::write(&input, text).unwrap();
        let result = ensemble().run(&out, &engine, &mut |_| Ok(set_up()?.input(&input)), &mut ());
        assert_eq!(result.is_ok(), goes_on, "{text}");
    }
    fs::remove_file(folder.path().join(ENSEMBLE)).unwrap();
    let error = ensemble().run(folder.path(), &engine, &mut |_| set_up(), &mut ()).unwrap_err();
    assert!(error.to_string().contains("holds `members.csv`"), "{error}");
    for (wrong, wanted) in [
        (Ensemble::new().sweep("drift", [0.0; 0]), "`drift` has no values"),
        (Ensemble::new().sweep("drift", [0.0]).sweep("drift", [1.0]), "swept twice"),
    ] {
        let error = wrong.run(folder.path(), &engine, &mut |_| set_up(), &mut ()).unwrap_err();
        assert!(error.to_string().contains(wanted), "{error}");
    }
}

#[test]
fn no_more_members_are_alive_at_once_than_there_are_jobs() {
    static ALIVE: AtomicUsize = AtomicUsize::new(0);
    static MOST: AtomicUsize = AtomicUsize::new(0);
    struct Counted;
    impl Drop for Counted {
        fn drop(&mut self) {
            ALIVE.fetch_sub(1, Ordering::SeqCst);
        }
    }
    let make = |_: &Member| {
        let counted = Counted;
        MOST.fetch_max(ALIVE.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
        Ok(set_up()?.observables(move |state| {
            let _ = &counted;
            Ok(vec![xca_record::Observable::number("step", state.step() as f64)])
        }))
    };
    let folder = tempfile::tempdir().unwrap();
    let many = Ensemble::new().seeds(0, 40).jobs(2);
    many.run(folder.path(), &engine, &mut { make }, &mut ()).unwrap();
    assert!(MOST.load(Ordering::SeqCst) <= 3, "{MOST:?}");
}

/// An open quotation mark makes one row of all that follows.
#[test]
fn a_row_of_the_table_has_an_end() {
    let folder = tempfile::tempdir().unwrap();
    ensemble().run(folder.path(), &engine, &mut |_| set_up(), &mut ()).unwrap();
    let path = folder.path().join("members.csv");
    let mut table = fs::read(&path).unwrap();
    table.push(b'"');
    table.resize(table.len() + (17 << 20), b'\n');
    fs::write(&path, table).unwrap();
    let error = ensemble().run(folder.path(), &engine, &mut |_| set_up(), &mut ()).unwrap_err();
    let mut error: Option<&dyn std::error::Error> = Some(&error);
    let mut said = String::new();
    while let Some(cause) = error {
        said += &cause.to_string();
        error = cause.source();
    }
    assert!(said.contains("members.csv") && said.contains("a row is longer than 16 MiB"), "{said}");
}

/// Interrupts as soon as a member has done a step.
struct AtOnce<'a>(&'a AtomicUsize);

impl EnsembleMonitor for AtOnce<'_> {
    fn is_interrupted(&self) -> bool {
        self.0.load(Ordering::Relaxed) > 0
    }
}

/// A member that is given up leaves no row.
#[test]
fn a_long_member_is_given_up() {
    static STEPS: AtomicUsize = AtomicUsize::new(0);
    const LONG: u64 = 5_000_000;
    let counted = |_: &Member| -> Result<SetUp, Failure> {
        let model = Model::builder("long")
            .extents([4, 1, 1])
            .substates::<Walker>()
            .parameters(Walk { stride: 1.0, drift: 0.0 })
            .process(walk)
            .steer(Schedule::Every(1), |_| {
                STEPS.fetch_add(1, Ordering::Relaxed);
                Ok(())
            })
            .build()?;
        Ok(SetUp::new(model, LONG))
    };
    let folder = tempfile::tempdir().unwrap();
    let one = Ensemble::new().seeds(1, 1).jobs(1);
    let done = one.run(folder.path(), &engine, &mut { counted }, &mut AtOnce(&STEPS)).unwrap();
    let steps = STEPS.swap(0, Ordering::Relaxed);
    assert!(done.is_empty() && (1..LONG as usize).contains(&steps), "{steps} steps");
    assert!(!fs::read_to_string(folder.path().join(MEMBERS)).is_ok_and(|table| table.lines().count() > 1));
}
