//! Jobs whose processes are threads.

use super::Job;
use crate::engine::Mpi;
use crate::mailbox::tests::Threads;
use crate::place::Place;
use crate::wire::Wire;
use std::num::NonZeroU64;
use std::thread;
use xca_core::engine::{Execution, StartError};
use xca_core::prelude::*;
use xca_core::{Precision, Snapshot};
use xca_cpu::Cpu;
use xca_parts::{Balance, Grid};

#[derive(Substates, Clone)]
struct Life {
    alive: u8,
}

#[elementary_process]
fn evolve(cell: &mut Cell<Life>) {
    let mut count = 0;
    for n in 1..cell.neighbour_count() {
        count += cell.neighbour(n).alive;
    }
    cell.alive = if count == 3 || (count == 2 && cell.alive == 1) { 1 } else { 0 };
}

fn life(width: usize) -> Model {
    Model::builder("life")
        .extents([width, 9, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Life>()
        .process(evolve)
        .fill(|site| Life { alive: u8::from(site.random(0) < 0.4) })
        .build()
        .unwrap()
}

/// The number of threads, or those of the place.
fn part(word: &str, place: &Place) -> Result<Box<dyn Engine>, String> {
    let threads = if word.is_empty() { place.threads } else { word.parse().map_err(|_| "no number")? };
    let cpu = Cpu::with_threads(threads).map_err(|error| error.to_string())?;
    Ok(Box::new(cpu))
}

/// What the host comes to in a job of so many processes, whose others make this model.
fn hosted<T>(size: usize, model: fn(Precision) -> Result<Model, String>, work: impl FnOnce(Job) -> T) -> T {
    hosted_on(Threads::connect(size), model, work)
}

fn hosted_on<T>(
    wires: Vec<Box<dyn Wire>>,
    model: fn(Precision) -> Result<Model, String>,
    work: impl FnOnce(Job) -> T,
) -> T {
    thread::scope(|scope| {
        let mut wires = wires.into_iter();
        let own = wires.next().unwrap();
        for wire in wires {
            scope.spawn(move || {
                let mut model = model;
                Job::new(wire).serve(&part, &mut model).unwrap();
            });
        }
        work(Job::new(own))
    })
}

fn after(engine: &dyn Engine, steps: u64) -> Snapshot {
    let mut simulation = Simulation::new(&life(20), engine, RunOptions::default()).unwrap();
    simulation.run(steps).unwrap();
    simulation.snapshot().unwrap()
}

#[test]
fn processes_come_to_what_one_comes_to() {
    let wanted = after(&Reference, 25);
    for size in [1, 2, 3, 5] {
        let got = hosted(size, |_| Ok(life(20)), |job| after(&Mpi::new(job, &part, "1").unwrap(), 25));
        assert!(got == wanted, "{size} processes");
    }
}

/// Messages that each need further calls to be sent.
#[test]
fn late_messages_arrive() {
    let wires = Threads::connect_late(3);
    let got = hosted_on(wires, |_| Ok(life(20)), |job| after(&Mpi::new(job, &part, "1").unwrap(), 25));
    assert!(got == after(&Reference, 25));
}

/// A soup in a few rows of many: the bounds of the processes move to it.
fn corner() -> Model {
    Model::builder("corner")
        .extents([70, 40, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .substates::<Life>()
        .process(evolve)
        .fill(|site| Life { alive: u8::from(site.cell()[1] < 12 && site.random(0) < 0.4) })
        .build()
        .unwrap()
}

#[test]
fn bounds_of_processes_follow_the_work() {
    let balance = Balance { every: NonZeroU64::new(2), cost: 0 };
    let run = |engine: &dyn Engine| {
        let mut simulation = Simulation::new(&corner(), engine, RunOptions::default()).unwrap();
        simulation.run(30).unwrap();
        (simulation.snapshot().unwrap(), simulation.figures())
    };
    let (wanted, _) = run(&Reference);
    for (size, grid) in [(2, None), (4, Some(Grid { y: 4, z: 1 }))] {
        let (got, figures) = hosted(
            size,
            |_| Ok(corner()),
            |job| {
                let engine = Mpi::new(job, &part, "1").unwrap().with_balance(balance);
                run(&engine.in_grid(grid))
            },
        );
        assert!(got == wanted, "{size} processes");
        let moved = figures.iter().find(|figure| figure.name == "bounds_moved").unwrap();
        assert!(moved.value >= 1.0, "{size} processes: {figures:?}");
    }
}

#[test]
fn a_grid_has_a_part_for_each_process() {
    hosted(
        2,
        |_| Ok(corner()),
        |job| {
            let engine = |grid| Mpi::new(job.clone(), &part, "1").unwrap().in_grid(grid);
            for (grid, words) in [
                (Grid { y: 3, z: 1 }, "3x1 are 3 parts, but the job has 2 processes"),
                (Grid { y: 1, z: 2 }, "cannot be cut into 1 parts along y and 2 along z"),
            ] {
                let started = engine(grid).start(&corner(), Precision::F64);
                let text = started.err().map(|error| error.to_string()).unwrap_or_default();
                assert!(text.contains(words), "{text}");
            }
        },
    );
}

/// Executions do not take each other's messages, and a job outlives those that have ended.
#[test]
fn several_executions_are_there_at_once() {
    let wanted = after(&Reference, 10);
    hosted(
        3,
        |_| Ok(life(20)),
        |job| {
            let [one, two] = ["1", "2"].map(|threads| Mpi::new(job.clone(), &part, threads).unwrap());
            let mut first = Simulation::new(&life(20), &one, RunOptions::default()).unwrap();
            let mut second = Simulation::new(&life(20), &two, RunOptions::default()).unwrap();
            for _ in 0..5 {
                first.run(2).unwrap();
                second.step().unwrap();
            }
            assert!(first.snapshot().unwrap() == wanted);
            drop(first);
            second.run(5).unwrap();
            assert!(second.snapshot().unwrap() == wanted);
            assert!(after(&one, 10) == wanted);
        },
    );
}

#[test]
fn processes_that_cannot_begin_are_told_and_serve_on() {
    let said = |model: fn(Precision) -> Result<Model, String>| {
        hosted(3, model, |job| {
            let engine = Mpi::new(job, &part, "").unwrap();
            let started = Simulation::new(&life(20), &engine, RunOptions::default());
            started.err().map(|error| error.to_string()).unwrap_or_default()
        })
    };
    let text = said(|_| Err("cannot read map.asc".to_owned()));
    assert!(text.contains("part 1: cannot read map.asc"), "{text}");
    let text = said(|_| Ok(life(21)));
    assert!(text.contains("part 1 differs in its space: checksum "), "{text}");
}

#[test]
fn the_host_knows_where_the_processes_are() {
    hosted(
        4,
        |_| Ok(life(20)),
        |job| {
            let engine = Mpi::new(job, &part, "3").unwrap();
            assert_eq!((engine.name(), engine.threads()), ("mpi", 12));
            let facts = engine.facts();
            let ranks = "0: machine 0, 3 threads; 1: machine 0, 3 threads; 2: machine 1, 3 threads; \
                     3: machine 1, 3 threads";
            assert!(facts.contains(&("ranks", ranks.to_owned())), "{facts:?}");
            // Two of four are on the machine of the host.
            let all = Cpu::with_threads(1).unwrap().least_memory(&life(20), Precision::F64);
            assert!(all > 2 * 20 * 9);
            assert_eq!(engine.least_memory(&life(20), Precision::F64), all / 2);
        },
    );
}

/// An engine whose name says on which machine it is the how manieth.
#[derive(Debug)]
struct Card(usize);

impl Engine for Card {
    fn name(&self) -> &str {
        "card"
    }

    fn threads(&self) -> usize {
        1
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        vec![("adapter", format!("card {}", self.0)), ("arithmetic", "strict".to_owned())]
    }

    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError> {
        Reference.start(model, precision)
    }
}

/// What the host says of a job of four processes with this word.
fn told(word: &str) -> Result<Vec<(&'static str, String)>, String> {
    fn card(word: &str, place: &Place) -> Result<Box<dyn Engine>, String> {
        let is_missing = word == "broken" && place.machine == "machine 1" && place.number == 1;
        if is_missing { Err("no card\nis there".to_owned()) } else { Ok(Box::new(Card(place.number))) }
    }
    thread::scope(|scope| {
        let mut wires = Threads::connect(4).into_iter();
        let own = wires.next().unwrap();
        for wire in wires {
            scope.spawn(move || Job::new(wire).serve(&card, &mut |_| Ok(life(20))).unwrap());
        }
        Mpi::new(Job::new(own), &card, word).map(|engine| engine.facts())
    })
}

#[test]
fn the_host_knows_what_the_processes_run_on() {
    let facts = told("sound").unwrap();
    for wanted in [("adapter", "0: card 0; 1: card 1; 2: card 0; 3: card 1"), ("arithmetic", "strict")] {
        assert!(facts.contains(&(wanted.0, wanted.1.to_owned())), "{facts:?}");
    }
    assert_eq!(told("broken").unwrap_err(), "rank 3 (machine 1): no card; is there");
}
