//! Conway's Game of Life on a torus, from a random soup.
use xca::prelude::*;

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

fn main() -> ExitCode {
    xca::run::main_of!("life", "Conway's Game of Life on a torus", |_given| {
        let model = Model::builder("life")
            .extents([256, 256, 1])
            .neighbourhood(Neighbourhood::moore_2d(1))
            .boundary(Boundary::Toroidal)
            .substates::<Life>()
            .process(evolve)
            .fill(|site| Life { alive: u8::from(site.random(0) < 0.3) })
            .build()?;
        Ok(SetUp::new(model, 1000))
    })
}
