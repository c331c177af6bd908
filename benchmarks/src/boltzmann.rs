//! A fluid (D3Q19) on the CPU engine against a loop written by hand.

mod by_hand;
mod model;

use crate::comparison::Comparison;
use crate::timing::interleaved;
use by_hand::{Lattice, Number};
use model::Fluid;
use std::error::Error;
use xca_core::Precision;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_examples::models::boltzmann::{DIRECTIONS, neighbourhood};

/// Of a kinematic viscosity of 0.1 cells squared a step.
const OMEGA: f64 = 1.0 / (3.0 * 0.1 + 0.5);

/// Fluid in a periodic cube of `size` cells along each side, in one precision.
pub(crate) fn fluid(
    size: usize,
    precision: Precision,
    threads: usize,
    rounds: usize,
    steps: usize,
) -> Result<Comparison, Box<dyn Error>> {
    match precision {
        Precision::F32 => fluid_of::<f32>(size, threads, rounds, steps),
        Precision::F64 => fluid_of::<f64>(size, threads, rounds, steps),
    }
}

fn fluid_of<T: Number>(
    size: usize,
    threads: usize,
    rounds: usize,
    steps: usize,
) -> Result<Comparison, Box<dyn Error>> {
    let model = model::model(size, neighbourhood()?, OMEGA).map_err(|error| error.to_string())?;
    let options = RunOptions { precision: T::PRECISION, ..RunOptions::default() };
    let mut simulation = Simulation::new(&model, &Cpu::with_threads(threads)?, options)?;
    let directions = neighbourhood()?.displacements([0; 3]).to_vec();
    let mut lattice = Lattice::<T>::new(size, directions, &simulation.state().read(Fluid::F)?);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let mut failure = None;
    let times = interleaved(
        rounds,
        &mut [&mut || failure = simulation.run(steps as u64).err().or(failure.take()), &mut || {
            pool.install(|| (0..steps).for_each(|_| lattice.step(T::from_f64(OMEGA))));
        }],
    );
    failure.map_or(Ok(()), Err)?;
    // The two add in other orders, so they agree but for rounding.
    let cell = [0, 0, size / 4];
    let f = simulation.state().get(Fluid::F, cell)?;
    let far = f.iter().zip(lattice.particles(cell)).map(|(f, by_hand)| (f - by_hand).abs());
    if !far.fold(0.0, f64::max).lt(&1e-4) {
        return Err("the engine and the loop by hand differ".into());
    }
    let name = format!("D3Q19 {size}^3, {}", T::PRECISION);
    let bytes = 2 * DIRECTIONS * size_of::<T>();
    Comparison::new(name, size.pow(3), bytes, steps, times)
}
