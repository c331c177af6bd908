//! Models whose bits must not depend on how their space is cut.

use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(crate) struct Site {
    pub(crate) fuel: u32,
    pub(crate) lit: u32,
    trail: [u32; 2],
    ember: u32,
    pub(crate) heat: Real,
    flow: [Real; 3],
    place: i32,
}

#[derive(Parameters, Clone, Copy, Debug)]
pub(crate) struct Rule {
    /// So many burning neighbours set a cell on fire.
    pub(crate) catch: u32,
}

/// Goes to a second buffer.
#[elementary_process]
fn ignite(cell: &mut Cell<Site>, rule: &Rule) {
    let mut burning = 0;
    for n in 1..cell.neighbour_count() {
        burning += cell.neighbour(n).lit;
    }
    if cell.lit == 0 && burning >= rule.catch {
        cell.lit = cell.fuel;
    }
}

/// Draws beside a fire alone.
#[elementary_process]
fn glow(cell: &mut Cell<Site>) {
    if cell.lit > 0 && cell.random(0) < 0.5 {
        cell.ember += 1;
    }
}

/// Writes in place.
#[elementary_process]
fn burn(cell: &mut Cell<Site>) {
    if cell.lit > 0 {
        cell.lit -= 1;
        cell.fuel /= 2;
    }
}

/// Another one that sends the same substate to a second buffer, in some steps only.
#[elementary_process]
fn rekindle(cell: &mut Cell<Site>) {
    if cell.lit == 1 && cell.neighbour(1).lit > 2 {
        cell.lit = 2;
    }
}

/// An array, and where a cell lies.
#[elementary_process]
fn smoke(cell: &mut Cell<Site>) {
    cell.trail[1] = cell.trail[0];
    let mut sum = 0;
    let mut existing = 0;
    for n in 0..cell.neighbour_count() {
        sum = 31 * (sum % 1000) + cell.neighbour(n).fuel;
        if cell.exists(n) {
            existing += 1;
        }
    }
    cell.trail[0] = sum;
    cell.place = cell.index().x + 10 * cell.index().y + 100 * cell.index().z + 1000 * existing;
}

/// An array that is read at neighbours, element by element.
#[elementary_process]
fn stream(cell: &mut Cell<Site>) {
    let last = cell.neighbour_count() - 1;
    cell.flow[0] = 0.5 * cell.neighbour(last).flow[1] + cell.heat;
    cell.flow[1] = 0.25 * cell.neighbour(0).flow[2] + 0.125 * cell.neighbour(1 % (last + 1)).flow[0];
    cell.flow[2] = cell.flow[0] - cell.flow[1];
}

#[elementary_process]
fn warm(cell: &mut Cell<Site>) {
    let mut sum = 0.0;
    for n in 0..cell.neighbour_count() {
        sum += cell.neighbour(n).heat + 0.01 * cell.neighbour(n).flow[2];
    }
    cell.heat = 0.9 * sum / (cell.neighbour_count() as Real) + (cell.lit as Real);
}

/// A number below `below` that depends on the cell and on `which`.
pub(crate) fn number(cell: [usize; 3], which: u32, below: u32) -> u32 {
    let mut mixed =
        cell.iter().fold(which, |mixed, index| mixed.wrapping_mul(977).wrapping_add(*index as u32));
    for factor in [0x7feb_352d_u32, 0x846c_a68b, 0x9e37_79b1] {
        mixed = (mixed ^ (mixed >> 15)).wrapping_mul(factor);
    }
    (mixed >> 8) % below
}

/// A fire here and there in a wood; in later steps more of them, and another rule. With `warms` all cells
/// change in each step, else few.
pub(crate) fn wood(
    extents: [usize; 3],
    neighbourhood: Neighbourhood,
    boundaries: Faces<Boundary>,
    warms: bool,
) -> Result<Model, ModelError> {
    let corner = extents.map(|extent| extent - 1);
    let outside =
        |lit: u32| Site { fuel: 3, lit, trail: [7; 2], ember: 0, heat: 0.5, flow: [0.1, 0.2, 0.3], place: 0 };
    let mut builder = Model::builder("wood")
        .extents(extents)
        .neighbourhood(neighbourhood)
        .boundaries(boundaries)
        .substates::<Site>();
    for (face, lit) in Face::ALL.into_iter().zip(0..) {
        if boundaries[face] == Boundary::Flat {
            builder = builder.outside(face, outside(lit));
        }
    }
    let builder = builder
        .parameters(Rule { catch: 3 })
        .process((ignite, glow, burn))
        .process_every(3, rekindle)
        .process(smoke);
    let builder = if warms { builder.process((stream, warm)) } else { builder };
    builder
        .steer(Schedule::At(vec![6, 11]), move |state| {
            Ok(state.set_cells(Site::LIT, [(corner, 4), ([0; 3], 4)])?)
        })
        .steer(Schedule::At(vec![8]), |state| Ok(state.set_parameters(Rule { catch: 0 })?))
        .steer(Schedule::At(vec![9]), |state| Ok(state.set_parameters(Rule { catch: 9 })?))
        .steer(Schedule::At(vec![13]), |state| {
            let mut lit = state.read(Site::LIT)?;
            lit.iter_mut().enumerate().filter(|(cell, _)| cell % 97 == 5).for_each(|(_, lit)| *lit = 5);
            Ok(state.write(Site::LIT, &lit)?)
        })
        .fill(|site| Site {
            fuel: number(site.cell(), 1, 6),
            lit: u32::from(number(site.cell(), 2, 40) == 0) * 4,
            heat: f64::from(number(site.cell(), 3, 1000)) * 1e-3,
            ..Site { fuel: 0, lit: 0, trail: [0; 2], ember: 0, heat: 0.0, flow: [0.0; 3], place: 0 }
        })
        .build()
}

/// The game of life on a torus.
pub(crate) mod life {
    use super::*;

    #[derive(Substates, Clone, Copy, Debug, PartialEq)]
    pub(crate) struct Life {
        pub(crate) alive: u32,
    }

    #[elementary_process]
    fn evolve(cell: &mut Cell<Life>) {
        let mut sum = 0;
        for n in 1..cell.neighbour_count() {
            sum += cell.neighbour(n).alive;
        }
        cell.alive = (sum == 3 || (sum == 2 && cell.alive == 1)) as u32;
    }

    /// A glider goes round the space and comes back after four steps for each cell of a side.
    pub(crate) fn glider(side: usize) -> Result<Model, ModelError> {
        const GLIDER: [[usize; 3]; 5] = [[1, 0, 0], [2, 1, 0], [0, 2, 0], [1, 2, 0], [2, 2, 0]];
        Model::builder("life")
            .extents([side, side, 1])
            .neighbourhood(Neighbourhood::moore_2d(1))
            .boundary(Boundary::Toroidal)
            .substates::<Life>()
            .process(evolve)
            .fill(|site| Life { alive: u32::from(GLIDER.contains(&site.cell())) })
            .build()
    }
}
