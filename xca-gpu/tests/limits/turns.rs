//! Loops that an adapter may end early: they give the bits of the reference engine, or an error.

use crate::common::{TestResult, gpu, state_after};
use std::error::Error;
use xca_core::prelude::*;
use xca_gpu::{Gpu, Handicap};

#[derive(Substates, Clone, Copy)]
struct Work {
    turns: u32,
    word: u32,
}

#[elementary_process]
fn while_some_are_left(cell: &mut Cell<Work>) {
    let mut left = cell.turns;
    while left > 0 {
        cell.word = cell.word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        left -= 1;
    }
}

#[elementary_process]
fn until_it_breaks(cell: &mut Cell<Work>) {
    let mut done = 0;
    loop {
        if done == cell.turns {
            break;
        }
        done += 1;
        if done % 3 == 0 {
            continue;
        }
        cell.word = cell.word.wrapping_mul(1_664_525).wrapping_add(done);
    }
}

#[elementary_process]
fn over_a_range(cell: &mut Cell<Work>) {
    for n in 0..cell.turns {
        cell.word = cell.word.wrapping_mul(1_664_525).wrapping_add(n);
    }
}

#[elementary_process]
fn backwards(cell: &mut Cell<Work>) {
    for n in (0..cell.turns).rev() {
        cell.word = cell.word.wrapping_mul(1_664_525).wrapping_add(n);
    }
}

#[elementary_process]
fn through_a_match(cell: &mut Cell<Work>) {
    'all: for n in 0..=cell.turns {
        match n % 3 {
            0 => cell.word = cell.word.wrapping_mul(1_664_525),
            1 => {
                if n == cell.turns {
                    break 'all;
                }
            }
            _ => cell.word = cell.word.wrapping_add(n),
        }
    }
}

/// The turns of neighbouring cells add up where a device does them side by side.
#[elementary_process]
fn in_turns(cell: &mut Cell<Work>) {
    let mine = cell.index().x as u32 % 8;
    for outer in 0..8 {
        if outer == mine {
            for n in 0..cell.turns {
                cell.word = cell.word.wrapping_mul(1_664_525).wrapping_add(n);
            }
        }
    }
}

/// A square of short loops.
#[elementary_process]
fn loops_in_loops(cell: &mut Cell<Work>) {
    let mut side = 0;
    while side * side < cell.turns {
        side += 1;
    }
    for outer in 0..side {
        for inner in 0..side {
            cell.word = cell.word.wrapping_mul(1_664_525).wrapping_add(outer ^ inner);
        }
    }
}

fn models(turns: u32) -> Result<Vec<Model>, ModelError> {
    let model = |name| {
        let builder = Model::builder(name).extents([16, 2, 1]).substates::<Work>();
        builder.fill(move |site| Work { turns: turns - site.cell()[0] as u32, word: 1 })
    };
    Ok(vec![
        model("while").process(while_some_are_left).build()?,
        model("loop").process(until_it_breaks).build()?,
        model("range").process(over_a_range).build()?,
        model("reversed").process(backwards).build()?,
        model("match").process(through_a_match).build()?,
        model("in turns").process(in_turns).build()?,
        model("nested").process(loops_in_loops).build()?,
    ])
}

/// Never another state: the same bits, or an error that names the process and the limit.
fn assert_nothing_is_cut(gpu: &Gpu, turns: u32) -> Result<Vec<String>, ModelError> {
    let mut refused = Vec::new();
    for model in models(turns)? {
        let wanted = state_after(&model, &Reference, 2);
        match state_after(&model, gpu, 2) {
            Ok(found) => assert!(wanted == Ok(found), "`{}` with {turns} turns", model.name()),
            Err(error) => {
                let process = format!("the process `{}` has loops", model.processes()[0].name);
                let limit = format!("about {} turns", gpu.turns().unwrap_or(0));
                assert!(error.contains(&process) && error.contains(&limit), "{error}");
                refused.push(model.name().to_owned());
            }
        }
    }
    Ok(refused)
}

/// On an adapter that does all turns nothing is refused; on one that ends loops early only what it does not
/// finish.
#[test]
fn no_loop_is_cut_in_silence() -> TestResult {
    let gpu = gpu(Handicap::default())?;
    assert!(assert_nothing_is_cut(&gpu, 1000)?.is_empty());
    let limit = gpu.turns();
    for turns in [60_000, 65_530, 65_540, 65_560, 70_000, 200_000] {
        let refused = assert_nothing_is_cut(&gpu, turns)?;
        match limit {
            None => assert!(refused.is_empty(), "{refused:?}"),
            Some(limit) if turns > limit + 1000 => assert_eq!(refused.len(), 7, "{refused:?}"),
            Some(limit) if turns + 1000 < limit => assert!(refused.len() < 3, "{turns}: {refused:?}"),
            Some(_) => {}
        }
    }
    Ok(())
}

/// A row longer than the loops of the adapter is reduced all the same.
#[test]
fn long_rows_are_reduced() -> TestResult {
    let model = Model::builder("row")
        .extents([70_001, 2, 1])
        .substates::<Work>()
        .fill(|site| Work { turns: site.cell()[0] as u32, word: 7 })
        .build()?;
    let gpu = gpu(Handicap::default())?;
    let sum = |engine: &dyn Engine| -> Result<i64, Box<dyn Error>> {
        let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
        Ok(simulation.state().sum(Work::TURNS)?)
    };
    assert_eq!(sum(&Reference)?, sum(&gpu)?);
    Ok(())
}
