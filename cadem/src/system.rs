//! The model: the cellular space, its slots, and the processes in order.

use crate::configuration::Configuration;
use crate::error::CademError;
use crate::material::Material;
use crate::particles::{Particle, ParticleError};
use crate::processes::{
    NOT_A_NUMBER, THROUGH_WALL, TOO_FAST, accelerate, displace, guard_walls, inner_contacts, outer_contacts,
    outer_walls, reassign, reset_forces,
};
use crate::substates::Dem;
use crate::time_step::Integrator;
use crate::walls::Walls;
use xca_core::{Float, Item, Model, ModelBuilder, Neighbourhood, Precision, State, SteeringError};

/// Builds the model of a system that starts from these particles.
///
/// The parameters can still be changed by name ([`Model::set_parameter`]); what the initial state needs of
/// them is checked again when a simulation of the model begins.
///
/// # Errors
/// Where the system or a particle makes no sense; the message says what to change.
pub fn model(configuration: &Configuration, particles: Vec<Particle>) -> Result<Model, CademError> {
    configuration.check()?;
    configuration.check_particles(&particles)?;
    let material = configuration.material();
    let mut builder = Model::builder("cadem")
        .extents(configuration.cells)
        .cell_side(configuration.cell_side)
        .neighbourhood(Neighbourhood::moore(1))
        .boundary(configuration.walls.boundary())
        .population::<Dem>(configuration.slots())
        .parameters(material)
        .fault_text(TOO_FAST, "a particle moves further than its radius in one step (the value is its speed in m/s; a smaller time step helps)")
        .fault_text(
            NOT_A_NUMBER,
            "the velocity of a particle is NaN (two centres at one place, or an unstable time step)",
        )
        .fault_text(THROUGH_WALL, "a particle passes a wall where it has no opening (the value is its speed in m/s; a smaller time step or stiffer walls help)")
        .process(reset_forces)
        .process(inner_contacts)
        .process(outer_contacts);
    if configuration.walls == Walls::PerSlot {
        builder = builder.process(outer_walls);
    }
    let open = !configuration.openings.is_empty();
    if open {
        builder = builder.items_may_leave::<Dem>();
    }
    let moved =
        |builder: ModelBuilder| if open { builder.process(guard_walls) } else { builder }.process(displace);
    builder = match configuration.integrator {
        Integrator::SemiImplicit => moved(builder.process(accelerate)),
        Integrator::Explicit => moved(builder).process(accelerate),
    };
    let configuration = configuration.clone();
    let initialise = move |state: &mut State<'_>| initialise(state, &configuration, &material, &particles);
    Ok(builder.process(reassign).initialise(initialise).build()?)
}

/// Fills the slots.
fn initialise(
    state: &mut State<'_>,
    configuration: &Configuration,
    checked: &Material,
    particles: &[Particle],
) -> Result<(), SteeringError> {
    let material: Material = state.parameters()?;
    let changed;
    let configuration = if material == *checked {
        configuration
    } else {
        changed = configuration.with_material(&material);
        changed.check()?;
        changed.check_particles(particles)?;
        &changed
    };
    let mut items = Vec::with_capacity(particles.len());
    for particle in particles {
        let cell =
            cell_of(configuration, particle.position, state.precision()).ok_or(ParticleError::Outside {
                label: particle.label,
                position: particle.position,
                sides: configuration.sides(),
            })?;
        items.push(Item { label: particle.label, cell, state: particle.substates() });
    }
    items.extend(configuration.boundary_slots());
    Ok(state.set_items(items)?)
}

/// The cell that contains a position once it is rounded to the precision of the run.
fn cell_of(configuration: &Configuration, position: [f64; 3], precision: Precision) -> Option<[usize; 3]> {
    let side = configuration.cell_side;
    let mut cell = [0; 3];
    for axis in 0..3 {
        let number = match precision {
            Precision::F32 => f32::cell_number(position[axis] as f32, side as f32),
            Precision::F64 => f64::cell_number(position[axis], side),
        };
        cell[axis] = number
            .and_then(|number| usize::try_from(number).ok())
            .filter(|n| *n < configuration.cells[axis])?;
    }
    Some(cell)
}
