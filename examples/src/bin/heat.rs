//! Heat in a cube of copper whose faces are kept at 0 °C, compared with the solution in closed form.
//!
//! The temperature starts as T0 sin(pi x / L) sin(pi y / L) sin(pi z / L). Under the heat equation this
//! shape only fades, by exp(-3 pi^2 D t / L^2). Each cell stands for a point; N of them along each axis,
//! and the faces, divide L into N + 1 parts h. In the explicit scheme, with alpha = D dt / h^2, the same
//! shape fades by 1 - 12 alpha sin^2(pi / (2 (N + 1))) in each step. The time step follows from alpha.
use std::f64::consts::PI;
use xca_core::statistics::{Squares, mean};
use xca_run::prelude::*;

#[derive(Substates, Clone)]
struct Heat {
    #[substate(unit = "°C")]
    temperature: Real,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Copper {
    /// alpha = D dt / h^2; the scheme is stable up to 1/6.
    #[parameter(range = ..=1.0 / 6.0, positive)]
    alpha: Real,
    /// Thermal diffusivity D.
    #[parameter(unit = "m2/s", range = ..f64::INFINITY, positive)]
    diffusivity: Real,
    /// Initial temperature T0 of the middle, above absolute zero.
    #[parameter(unit = "°C", range = -273.15..f64::INFINITY)]
    initial: Real,
}

#[elementary_process]
fn diffuse(cell: &mut Cell<Heat>, p: &Copper) {
    let mut flux = 0.0;
    for n in 1..cell.neighbour_count() {
        flux += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature += p.alpha * flux;
}

#[derive(Args)]
struct Cube {
    /// Cells along each side
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = whole_number)]
    size: usize,
    /// The length of a side, in m
    #[arg(long, value_name = "METRES", default_value_t = 0.1, value_parser = positive_number)]
    side: f64,
    /// Stop when no cell is further than this from 0 °C, in °C
    #[arg(long, value_name = "DEGREES", default_value_t = 20.0, value_parser = number_in(0.0..))]
    until: f64,
}

impl Cube {
    /// The part of the initial temperature of the middle that a cell starts with.
    fn shape(size: usize, cell: [usize; 3]) -> f64 {
        cell.map(|index| (PI * (index + 1) as f64 / (size + 1) as f64).sin()).iter().product()
    }
}

impl Program for Cube {
    const NAME: &'static str = "heat";
    const ABOUT: &'static str = "Heat in a cube of copper, compared with the solution in closed form";
    const EXAMPLES: &'static str =
        "--size 128 --until 50\n--set alpha=0.16 --set initial=500 --precision f32";

    fn set_up(&self, given: Given) -> Result<SetUp, Failure> {
        let copper = given.applied_to(Copper { alpha: 0.125, diffusivity: 1.11e-4, initial: 100.0 })?;
        let Self { size, side, until } = *self;
        let width = side / (size + 1) as f64;
        let time_step = copper.alpha * width * width / copper.diffusivity;
        let decay = 3.0 * PI * PI * copper.diffusivity / (side * side);
        let model = Model::builder("heat")
            .extents([size; 3])
            .cell_side(width)
            .neighbourhood(Neighbourhood::von_neumann(1))
            .boundary(Boundary::Flat)
            .substates::<Heat>()
            .parameters(copper)
            .process(diffuse)
            .fill_with(move |site, copper: &Copper| Heat {
                temperature: copper.initial * Self::shape(size, site.cell()),
            })
            .stop_when(Schedule::EveryFromStart(10), move |state| {
                let hottest = state.maximum(Heat::TEMPERATURE)?.unwrap_or(0.0);
                let coldest = state.minimum(Heat::TEMPERATURE)?.unwrap_or(0.0);
                let is_over = hottest <= until && coldest >= -until;
                Ok(is_over.then(|| format!("no cell is further than {until} °C from 0 °C")))
            })
            .build()?;
        let observe = move |state: &State<'_>| {
            let exact = copper.initial * (-decay * state.step() as f64 * time_step).exp();
            let temperatures = state.read(Heat::TEMPERATURE)?;
            let (mut errors, mut norm) = (Squares::default(), Squares::default());
            for (index, temperature) in temperatures.iter().enumerate() {
                let wanted = exact * Self::shape(size, state.geometry().indices(index));
                errors.add(temperature - wanted);
                norm.add(wanted);
            }
            let error = errors.root(1.0) / norm.root(1.0).max(f64::MIN_POSITIVE);
            Ok(vec![
                Observable::new("hottest", "°C", state.maximum(Heat::TEMPERATURE)?.unwrap_or(0.0)),
                Observable::new("mean", "°C", mean(temperatures.iter().copied())),
                Observable::new("exact_in_the_middle", "°C", exact),
                Observable::number("relative_error", error),
            ])
        };
        // A little longer than it takes, should the criterion not be met.
        let steps =
            (1.1 * (copper.initial.abs() / until).ln() / (decay * time_step) + 20.0).clamp(1.0, 1e9) as u64;
        let view = CellView::named("heat").draw(Heat::TEMPERATURE, "temperature (°C)");
        Ok(SetUp::new(model, steps).time_step(time_step).observables(observe).cells(view))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Cube)
}
