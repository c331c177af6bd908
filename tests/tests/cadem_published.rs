//! scratch
use cadem::{Case, Diagnostics};
use std::time::Instant;
use xca_core::prelude::*;

#[test]
fn published() -> Result<(), Box<dyn std::error::Error>> {
    let c = Case::Published.configuration();
    for engine in [&Reference as &dyn Engine, &xca_cpu::Cpu::new()?] {
        let start = Instant::now();
        let model = cadem::model(&c, c.authors_particles()?)?;
        let mut s = Simulation::new(&model, engine, RunOptions::default())?;
        println!("start {:?}", start.elapsed());
        let steps = if engine.name() == "cpu" { 749 } else { 20 };
        s.run(steps)?;
        println!("{} {:?} {steps}", engine.name(), start.elapsed());
        let d = Diagnostics::of(&s.state(), c.walls)?;
        println!("{d:?} {:.9}", d.kinetic_energy + d.potential_energy);
    }
    Ok(())
}
