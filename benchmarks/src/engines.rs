//! The GPU engine against the CPU engine: set-up, transfer and steps apart.

use crate::dense;
use crate::state::State;
use crate::timing::{Times, interleaved};
use std::error::Error;
use std::time::Instant;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_gpu::{Gpu, GpuOptions};

#[derive(Substates, Clone)]
struct Parity {
    odd: u8,
}

#[elementary_process]
fn add_up(cell: &mut Cell<Parity>) {
    let mut sum = 0;
    for n in 0..cell.neighbour_count() {
        sum += cell.neighbour(n).odd;
    }
    cell.odd = sum % 2;
}

fn mod2_model(size: usize) -> Result<Model, ModelError> {
    Model::builder("mod2")
        .extents([size; 3])
        .neighbourhood(Neighbourhood::moore(1))
        .boundary(Boundary::Toroidal)
        .substates::<Parity>()
        .process(add_up)
        .fill(|site| {
            let [x, y, z] = site.cell();
            Parity { odd: u8::from((x * 31 + y * 17 + z * 7) % 5 == 0) }
        })
        .build()
}

/// What a model costs on one engine.
#[derive(Debug)]
pub(crate) struct Cost {
    /// The engine, with its threads or its adapter.
    pub(crate) engine: String,
    /// Seconds from the model to the initial state on the engine.
    pub(crate) set_up: f64,
    /// Seconds to bring the whole state to the host.
    pub(crate) transfer: f64,
    /// Seconds a step.
    pub(crate) step: Times,
    /// The bytes of the state.
    pub(crate) memory: usize,
}

/// The costs of a model on both engines.
#[derive(Debug)]
pub(crate) struct Comparison {
    pub(crate) name: &'static str,
    /// Cells, or particles.
    pub(crate) things: usize,
    pub(crate) costs: Vec<Cost>,
    /// Whether both ended with the same bits.
    pub(crate) same: bool,
}

/// Runs the models on both engines, in turns.
pub(crate) fn compare(threads: usize, rounds: usize, steps: u64) -> Result<Vec<Comparison>, Box<dyn Error>> {
    let cpu = Cpu::with_threads(threads)?;
    let gpu = Gpu::new(&GpuOptions::default())?;
    let arithmetic = if gpu.is_strict() { "strict" } else { "relaxed" };
    let engines: [(String, &dyn Engine); 2] = [
        (format!("cpu, {threads} threads"), &cpu),
        (format!("gpu, {}, {arithmetic}", gpu.adapter().name), &gpu),
    ];
    let table1 = State::start(100)?;
    let models = [
        ("cadem table1, particles", table1.particles.len(), table1.model()?),
        ("mod2 256^3, cells", 256 * 256 * 256, mod2_model(256)?),
        ("life 4096^2, cells", 4096 * 4096, dense::life_model(4096)?),
        ("heat 256^3 f64, cells", 256 * 256 * 256, dense::heat_model(256)?),
    ];
    models
        .into_iter()
        .map(|(name, things, model)| {
            let mut simulations = Vec::new();
            let mut set_ups = Vec::new();
            for (_, engine) in &engines {
                let start = Instant::now();
                simulations.push(Simulation::new(&model, *engine, RunOptions::default())?);
                set_ups.push(start.elapsed().as_secs_f64());
            }
            let mut failures = Vec::new();
            let [cpu, gpu] = simulations.as_mut_slice() else { return Err("two engines".into()) };
            let mut other_failures = Vec::new();
            let times = interleaved(
                rounds,
                &mut [&mut || failures.extend(cpu.run(steps).err()), &mut || {
                    other_failures.extend(gpu.run(steps).err());
                }],
            );
            if let Some(failure) = failures.into_iter().chain(other_failures).next() {
                return Err(failure.into());
            }
            let mut states = Vec::new();
            let mut costs = Vec::new();
            for (((simulation, set_up), (engine, _)), times) in
                simulations.iter().zip(set_ups).zip(&engines).zip(times)
            {
                let start = Instant::now();
                states.push(simulation.snapshot()?);
                let (transfer, memory) = (start.elapsed().as_secs_f64(), simulation.memory());
                let step = times.per(steps as usize);
                costs.push(Cost { engine: engine.clone(), set_up, transfer, step, memory });
            }
            Ok(Comparison { name, things, costs, same: states[0] == states[1] })
        })
        .collect()
}
