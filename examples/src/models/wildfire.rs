//! A forest fire with wind and slope (Alexandridis, Vakalis, Siettos and Bafas, Applied Mathematics and
//! Computation 204, 2008).

use xca_core::prelude::*;

/// What a fire does to a cell.
#[derive(States, Clone, Copy, Debug, PartialEq)]
pub enum Cover {
    /// Nothing that can burn.
    Bare,
    /// Plants that can burn.
    Whole,
    /// Plants on fire.
    Burning,
    /// Ashes.
    Burnt,
}

/// A landscape.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Landscape {
    /// What the fire has done.
    pub cover: Cover,
    /// Fuel: 1 is as much as there can be.
    pub fuel: Real,
    /// Of the ground.
    #[substate(unit = "m")]
    pub altitude: Real,
}

/// How fire passes.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Weather {
    /// The probability in a step that fire passes to a cell full of fuel, on flat ground without wind.
    #[parameter(range = 0.0..=1.0)]
    pub spread: Real,
    /// Wind towards east and north.
    #[parameter(unit = "m/s", range = -150.0..=150.0)]
    pub wind: Vector2<Real>,
    /// The effect of the wind's speed, and that of the angle with it.
    #[parameter(unit = "s/m", range = 0.0..=1.0)]
    pub wind_effects: [Real; 2],
    /// The effect of the slope.
    #[parameter(unit = "1/degree", range = 0.0..=1.0)]
    pub slope_effect: Real,
    /// The probability in a step that a fire goes out.
    #[parameter(range = 0.0..=1.0)]
    pub extinction: Real,
}

impl Default for Weather {
    /// The values of the paper, without wind.
    fn default() -> Self {
        Self {
            spread: 0.58,
            wind: Vector2::splat(0.0),
            wind_effects: [0.045, 0.131],
            slope_effect: 0.078,
            extinction: 1.0,
        }
    }
}

/// How much likelier fire passes along this way, given wind and slope.
#[helper]
pub fn likelihood(way: Vector2<Real>, rise: Real, weather: &Weather) -> Real {
    let speed = weather.wind.length();
    let mut wind = 1.0;
    if speed > 0.0 {
        let cosine = way.dot(weather.wind) / (way.length() * speed);
        wind = (weather.wind_effects[0] * speed + weather.wind_effects[1] * speed * (cosine - 1.0)).exp();
    }
    let degrees = (rise / way.length()).atan().to_degrees();
    wind * (weather.slope_effect * degrees).exp()
}

/// Fire passes from each burning neighbour on its own.
#[elementary_process]
pub fn burn(cell: &mut Cell<Landscape>, weather: &Weather, space: &Space) {
    match cell.cover {
        Cover::Whole => {
            let mut escape = 1.0;
            for n in 1..cell.neighbour_count() {
                if cell.neighbour(n).cover == Cover::Burning {
                    let from = cell.displacement(n);
                    let way = Vector2::new(-from.x as Real, -from.y as Real) * space.side();
                    let rise = cell.altitude - cell.neighbour(n).altitude;
                    let chance = weather.spread * cell.fuel * likelihood(way, rise, weather);
                    escape *= 1.0 - chance.min(1.0);
                }
            }
            // Far from a fire no number is drawn: nothing can happen there.
            if escape < 1.0 && cell.random(0) >= escape {
                cell.cover = Cover::Burning;
            }
        }
        Cover::Burning => {
            if cell.random(1) < weather.extinction {
                cell.cover = Cover::Burnt;
            }
        }
        Cover::Bare | Cover::Burnt => {}
    }
}

/// A landscape that begins as the function says; the run ends when the fire is out.
///
/// # Errors
/// Where a parameter is out of its range.
pub fn model(
    extents: [usize; 2],
    side: f64,
    weather: Weather,
    begin: impl Fn(Site) -> Landscape + Send + Sync + 'static,
) -> Result<Model, ModelError> {
    Model::builder("wildfire")
        .extents([extents[0], extents[1], 1])
        .cell_side(side)
        .neighbourhood(Neighbourhood::moore_2d(1))
        .substates::<Landscape>()
        .parameters(weather)
        .process(burn)
        .fill(begin)
        .stop_when(Schedule::Every(5), |state| {
            let is_out = state.count(Landscape::COVER, Cover::Burning)? == 0;
            Ok(is_out.then(|| "the fire is out".to_owned()))
        })
        .build()
}
