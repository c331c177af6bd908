//! An epidemic: people infect their neighbours, recover, and are immune for some time.
//!
//! It is a model of the SIRS kind (susceptible, infected, recovered, susceptible again) with one person in
//! each cell.

use xca::prelude::*;

/// What a person can be.
#[derive(States, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Health {
    /// Can be infected.
    Susceptible,
    /// Infects neighbours.
    Infected,
    /// Cannot be infected.
    Immune,
}

/// The substates of a cell.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// What the person is today.
    pub health: Health,
    /// How long the person has been infected or immune.
    #[substate(unit = "d")]
    pub days: u32,
}

/// The parameters: `--set contagion=0.2` changes one.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Disease {
    /// Share of people who are infected at the start.
    #[parameter(range = 0.0..=1.0)]
    pub infected_at_start: Real,
    /// Probability that an infected neighbour infects a person in a day.
    #[parameter(range = 0.0..=1.0)]
    pub contagion: Real,
    /// Duration of the infection.
    #[parameter(unit = "d", range = 1..)]
    pub infection: u32,
    /// Duration of the immunity.
    #[parameter(unit = "d")]
    pub immunity: u32,
}

/// Infected neighbours infect a susceptible person, each with a random number of its own.
#[elementary_process]
fn infect(person: &mut Cell<Person>, disease: &Disease) {
    if person.health == Health::Susceptible {
        for n in 1..person.neighbour_count() {
            let meets_infected = person.neighbour(n).health == Health::Infected;
            if meets_infected && person.random(n) < disease.contagion {
                person.health = Health::Infected;
                person.days = 0;
            }
        }
    }
}

/// The infection ends after some days, and so does the immunity.
#[elementary_process]
fn recover(person: &mut Cell<Person>, disease: &Disease) {
    person.days += 1;
    match person.health {
        Health::Infected if person.days > disease.infection => {
            person.health = Health::Immune;
            person.days = 0;
        }
        Health::Immune if person.days > disease.immunity => person.health = Health::Susceptible,
        Health::Susceptible => person.days = 0,
        _ => {}
    }
}

/// The model: space, neighbourhood, substates, parameters, processes in order, initial state.
///
/// # Errors
/// If the parts of the model do not fit together.
pub fn model() -> Result<Model, ModelError> {
    let disease = Disease { infected_at_start: 0.001, contagion: 0.1, infection: 7, immunity: 60 };
    Model::builder("new-model")
        .extents([160, 160, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Person>()
        .parameters(disease)
        .process(infect)
        .process(recover)
        .fill_with(|site, disease: &Disease| {
            let is_infected = site.random(0) < disease.infected_at_start;
            Person { health: if is_infected { Health::Infected } else { Health::Susceptible }, days: 0 }
        })
        .build()
}
