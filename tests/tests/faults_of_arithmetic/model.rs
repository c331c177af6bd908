//! A model some cells and items of which are faulty.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::{Fault, ModelBuilder};
use xca_tests::suite::engines::{self, assert_same_fault};

#[derive(States, Clone, Copy, Debug, PartialEq)]
pub(super) enum Ground {
    Rock,
    Soil,
    Water,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(super) struct Field {
    /// In which cell something goes wrong.
    pub(super) index: u32,
    pub(super) numbers: [i32; 3],
    pub(super) flows: [Vector2<Real>; 2],
    pub(super) marks: [bool; 2],
    pub(super) ground: Ground,
    pub(super) divisor: i32,
    pub(super) pair: Vector2<i32>,
    pub(super) byte: u8,
    pub(super) total: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(super) struct Grain {
    pub(super) index: u32,
    pub(super) shares: [Real; 3],
    pub(super) sum: Real,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
pub(super) struct Plan {
    pub(super) weights: [Real; 3],
    pub(super) wanted: [bool; 2],
    pub(super) least: i32,
}

pub(super) const TABLE: [i32; 4] = [3, 1, 4, 1];

/// Of 24 cells those from the place on are faulty: each asks for elements, and divides by numbers, of its
/// own.
pub(super) fn base(from: usize) -> ModelBuilder {
    let place = |[x, y, z]: [usize; 3]| x + 4 * y + 12 * z;
    Model::builder("faulty")
        .extents([4, 3, 2])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .boundaries([Boundary::Toroidal, Boundary::Flat, Boundary::Flat])
        .parameters(Plan { weights: [0.5, 0.25, 0.125], wanted: [false, true], least: i32::MIN })
        .substates::<Field>()
        .population::<Grain>(3)
        .fill(move |site| {
            let place = place(site.cell());
            let faulty = place >= from;
            Field {
                index: if faulty { 3 + (place - from) as u32 } else { 1 },
                numbers: [1, 2, 3],
                flows: [Vector2::new(0.5, 1.5), Vector2::new(2.5, place as f64)],
                marks: [true, false],
                ground: Ground::Soil,
                divisor: i32::from(!faulty),
                pair: Vector2::new(6, i32::MIN),
                byte: u8::from(!faulty),
                total: 0.0,
            }
        })
        .initialise(move |state| {
            let grain = |label: u32, cell: [usize; 3], index: u32| {
                let state = Grain { index, shares: [1.0, 2.0, 3.0], sum: 0.0 };
                Item { label, cell, state }
            };
            Ok(state.set_items(vec![
                grain(9, [0, 0, 0], 2),
                grain(7, [3, 1, 1], 8),
                grain(4, [3, 1, 1], 9),
                grain(2, [3, 2, 1], 5),
            ])?)
        })
}

/// Each engine stops in the first step, at this cell and item, with this message.
pub(super) fn stops(
    builder: ModelBuilder,
    cell: [usize; 3],
    label: Option<u32>,
    message: &str,
) -> Result<(), Box<dyn Error>> {
    let model = builder.build()?;
    let process = model.processes()[0].name;
    let engines = engines::all()?;
    for precision in engines::PRECISIONS {
        let error = assert_same_fault(&model, &engines, RunOptions { precision, seed: 0 }, 2);
        let RunError::Fault { step: 1, fault, .. } = error else { panic!("{process}: {error}") };
        let wanted = Fault::Panicked { process, cell, label, message: message.to_owned() };
        assert_eq!(fault, wanted);
    }
    Ok(())
}

/// The tenth cell is the first one with a fault.
pub(super) const FIRST: usize = 9;
pub(super) const CELL: [usize; 3] = [1, 2, 0];

pub(super) fn beyond(length: u32, index: u32) -> String {
    format!("index out of bounds: the len is {length} but the index is {index}")
}
