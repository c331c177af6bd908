//! Parts that do not belong together refuse to start, and say why; none waits.

use super::{Site, TestResult, cpu, wood};
use std::sync::Arc;
use std::thread;
use xca_core::engine::StartError;
use xca_core::prelude::*;
use xca_parts::{Balance, Channels, Grid, Tag, Transport, TransportError, decline, host, serve};

/// What a part is of.
#[derive(Clone)]
struct Side {
    model: Model,
    precision: Precision,
    grid: Grid,
}

/// What the host says of three parts, the last of which is of something else.
fn said(own: &Side, other: &Side) -> Result<String, Box<dyn std::error::Error>> {
    let engine = Arc::new(cpu(1, 0)?);
    let mut ends = Channels::connect(3);
    let sides = [other.clone(), own.clone()];
    let mut threads = Vec::new();
    for side in sides {
        let (end, engine) = (ends.pop().ok_or("no end")?, Arc::clone(&engine));
        threads.push(thread::spawn(move || {
            serve(engine, &side.model, side.precision, side.grid, Box::new(end));
        }));
    }
    let end = ends.pop().ok_or("no end")?;
    let started = host(engine, &own.model, own.precision, own.grid, Balance::default(), Box::new(end));
    let said = started.map_or_else(|error: StartError| error.to_string(), |_| "it has started".to_owned());
    threads.into_iter().try_for_each(thread::JoinHandle::join).map_err(|_| "a part has panicked")?;
    Ok(said)
}

#[elementary_process]
fn cool(cell: &mut Cell<Site>) {
    cell.heat = 0.0;
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Climate {
    rain: Real,
}

#[elementary_process]
fn damp(cell: &mut Cell<Site>, p: &Climate) {
    cell.heat -= p.rain;
}

fn small(rain: f64, width: usize, is_cool: bool) -> Result<Model, ModelError> {
    let builder = Model::builder("small")
        .extents([width, 6, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .substates::<Site>()
        .parameters(Climate { rain })
        .process(damp);
    if is_cool { builder.process(cool).build() } else { builder.build() }
}

#[test]
fn parts_of_other_models_refuse_to_start() -> TestResult {
    let side = |model: Model| Side { model, precision: Precision::F64, grid: Grid { y: 3, z: 1 } };
    let own = side(small(0.5, 5, false)?);
    assert_eq!(said(&own, &own)?, "it has started");
    let wood = wood([5, 6, 1], Neighbourhood::moore_2d(1), Faces::all(Boundary::Flat), false)?;
    for (other, wanted) in [
        (side(small(0.25, 5, false)?), "part 2 differs in its parameters: checksum "),
        (side(small(0.5, 6, false)?), "part 2 differs in its space: checksum "),
        (side(small(0.5, 5, true)?), "part 2 differs in its processes: checksum "),
        (side(wood), "part 2 differs in its model: wood in place of small of part 0; start the same program"),
        (
            Side { precision: Precision::F32, ..own.clone() },
            "part 2 differs in its precision: f32 in place of f64 of part 0",
        ),
        (Side { grid: Grid { y: 4, z: 1 }, ..own.clone() }, "its cut: 4 x 1 parts in place of 3 x 1 parts"),
    ] {
        let said = said(&own, &other)?;
        assert!(said.contains(wanted), "{said}");
    }
    Ok(())
}

/// A part of an older build, one that cannot begin, and one that has gone.
#[test]
fn parts_that_do_not_begin_are_told() -> TestResult {
    let model = small(0.5, 5, false)?;
    let said = |begin: &(dyn Fn(Channels) -> Result<(), TransportError> + Sync)| {
        let mut ends = Channels::connect(2);
        let (Some(other), Some(own)) = (ends.pop(), ends.pop()) else { return String::new() };
        thread::scope(|scope| {
            let other = scope.spawn(|| begin(other));
            let grid = Grid { y: 2, z: 1 };
            let engine = cpu(1, 0).map_err(|error| error.to_string());
            let started = engine.and_then(|engine| {
                host(Arc::new(engine), &model, Precision::F64, grid, Balance::default(), Box::new(own))
                    .map_err(|error| error.to_string())
            });
            let ended = other.join();
            assert!(matches!(ended, Ok(Ok(()))));
            started.err().unwrap_or_default()
        })
    };
    let older = said(&|mut end| end.send(0, Tag::Reply, b"version=0.0.9\nmodel=small\n".to_vec()));
    assert!(older.contains("part 1 differs in its version: 0.0.9 in place of 0."), "{older}");
    let foreign = said(&|mut end| end.send(0, Tag::Reply, vec![0xff, 0xfe]));
    assert!(foreign.contains("part 1 differs in its version: nothing in place of"), "{foreign}");
    let declined = said(&|end| {
        decline("cannot read map.asc", Box::new(end));
        Ok(())
    });
    assert!(declined.contains("part 1: cannot read map.asc"), "{declined}");
    let gone = said(&|mut end| {
        end.end();
        Ok(())
    });
    assert!(gone.contains("part 1 has ended"), "{gone}");
    Ok(())
}
