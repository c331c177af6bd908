//! CADEM: spheres that fall, collide and come to rest, from the initial states of De Rango et al. or from a
//! file.
use cadem::{Case, Configuration, Dem, Diagnostics, Integrator, Opening, PARTICLE, TimeStep, Walls};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;
use xca_examples::cadem_input::{opening, particles};
use xca_run::prelude::*;

#[derive(Args)]
struct Cadem {
    /// The system
    #[arg(long, value_name = "CASE", default_value = "illustration", value_parser = case())]
    case: Case,
    /// Start from the particles of a CSV file with the header label,x,y,z,vx,vy,vz (SI units), such as the
    /// final.csv of a run
    #[arg(long, value_name = "FILE")]
    particles: Option<PathBuf>,
    /// Cells along each side of the domain, instead of the case's; the authors' recipe then fills the larger
    /// domain
    #[arg(long, value_name = "N", value_parser = whole_cells)]
    side: Option<usize>,
    /// How walls act, instead of the case's law
    #[arg(long, value_name = "LAW", value_parser = walls())]
    walls: Option<Walls>,
    /// How velocity and position advance
    #[arg(long, value_name = "NAME", value_parser = integrator())]
    integrator: Option<Integrator>,
    /// The slots of a cell; 11 in the paper, unless given as many as settled particles need
    #[arg(long, value_name = "N", value_parser = whole_number)]
    slots: Option<usize>,
    /// Let a contact take so many steps: dt = pi sqrt(m / k_n) / N. The paper's eq. 3, instead of 0.1 sqrt(m
    /// / k_n)
    #[arg(long, value_name = "N", value_parser = positive_number)]
    subdivisions: Option<f64>,
    /// Leave a wall open, so that particles leave there: x-low, …, z-high, or some of its cells,
    /// z-low:8,8:11,11
    #[arg(long, value_name = "FACE", value_parser = opening)]
    open: Vec<Opening>,
    /// Start even where particles overlap, as in the final state of another run
    #[arg(long)]
    allow_overlaps: bool,
}

impl Cadem {
    fn configuration(&self, given: &Given) -> Result<Configuration, Failure> {
        let mut configuration = self.case.configuration();
        if let Some(side) = self.side {
            configuration.cells = [side; 3];
        }
        configuration.walls = self.walls.unwrap_or(configuration.walls);
        configuration.integrator = self.integrator.unwrap_or(configuration.integrator);
        configuration.slots = self.slots.or(configuration.slots);
        if let Some(subdivisions) = self.subdivisions {
            configuration.time_step = TimeStep::Subdivisions(subdivisions);
        }
        configuration.openings.clone_from(&self.open);
        configuration.allow_overlaps |= self.allow_overlaps;
        configuration.seed = u32::try_from(given.seed)
            .map_err(|_| format!("the seed of the particles is at most {}, not {}", u32::MAX, given.seed))?;
        for parameter in &given.parameters {
            configuration.set(&parameter.name, &parameter.value)?;
        }
        configuration.check()?;
        Ok(configuration)
    }
}

impl Program for Cadem {
    const NAME: &'static str = "cadem";
    const ABOUT: &'static str = "CADEM: spheres that fall, collide and come to rest";
    const EXAMPLES: &'static str = "--case table1 --steps 500 --out out/table1\n\
                                    --particles out/cadem/final.csv --allow-overlaps --out out/next\n\
                                    --set damping=0.05 --open z-low:8,8:11,11";

    fn set_up(&self, given: Given) -> Result<SetUp, Failure> {
        let configuration = self.configuration(&given)?;
        let particles = match &self.particles {
            Some(path) => particles(path, &configuration)?,
            None => {
                // The recipe makes 0.32 particles for each cell; until the run begins each takes some 300
                // bytes.
                let cells: u128 = configuration.cells.iter().map(|&cells| cells as u128).product();
                xca_run::check_memory(cells * 100, "the particles of the initial state")?;
                configuration.authors_particles()?
            }
        };
        let model = cadem::model(&configuration, particles)?;
        let (walls, is_closed) = (configuration.walls, configuration.openings.is_empty());
        let view = ItemView::named("particles")
            .only(Dem::ID, PARTICLE)
            .columns(Dem::POSITION, ["x", "y", "z"])
            .columns(Dem::VELOCITY, ["vx", "vy", "vz"])
            .radius(configuration.radius)
            .colour(Dem::VELOCITY, "speed (m s^-1)");
        let start =
            self.particles.as_ref().map_or_else(|| self.case.to_string(), |path| path.display().to_string());
        let mut set_up = SetUp::new(model, configuration.steps)
            .title(format!("CADEM, {start}"))
            .time_step(configuration.material().time_step)
            .observables(move |state| Ok(observables(&Diagnostics::of(state, walls)?, is_closed)))
            .items(view)
            .note("configuration", &configuration)?;
        set_up.warnings.extend(configuration.warnings(given.precision));
        if let Some(path) = &self.particles {
            set_up = set_up.input(path);
        }
        Ok(set_up)
    }
}

fn whole_cells(text: &str) -> Result<usize, &'static str> {
    text.parse().map_err(|_| "it must be a whole number of cells, such as 50 for 0.1 m")
}

fn observables(diagnostics: &Diagnostics, is_closed: bool) -> Vec<Observable> {
    let unit = |name: &str| match name {
        _ if name.ends_with("energy") => "J",
        _ if name.starts_with("momentum") => "kg m/s",
        "largest_speed" => "m/s",
        "largest_overlap" => "m",
        _ => "",
    };
    let pairs = Diagnostics::NAMES.into_iter().zip(diagnostics.values());
    let observables = pairs.map(|(name, value)| {
        let observable = Observable::new(name, unit(name), value);
        if name == "particles" && is_closed { observable.conserved() } else { observable }
    });
    observables.collect()
}

/// A parser for the names of `all`.
fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [(T, &'static str, &'static str); N],
) -> impl TypedValueParser<Value = T> {
    let names = all.map(|(_, name, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(names)
        .map(move |text| all.iter().find(|(_, name, _)| *name == text).map_or(all[0].0, |(value, ..)| *value))
}

fn case() -> impl TypedValueParser<Value = Case> {
    one_of(Case::ALL.map(|case| {
        let help = match case {
            Case::Illustration => "2,602 particles, 0.1 s: the authors' small system",
            Case::Table1 => "315,979 particles, 0.1 s: the paper's benchmark",
            Case::Published => "2,602 soft particles, 749 steps: the authors' published run",
        };
        (case, case.name(), help)
    }))
}

fn walls() -> impl TypedValueParser<Value = Walls> {
    one_of(Walls::ALL.map(|walls| {
        let help = match walls {
            Walls::Single => "Each wall is the domain's face and acts once",
            Walls::PerSlot => "The authors' program: one radius inside, ninefold",
        };
        (walls, walls.name(), help)
    }))
}

fn integrator() -> impl TypedValueParser<Value = Integrator> {
    one_of(Integrator::ALL.map(|integrator| {
        let help = match integrator {
            Integrator::SemiImplicit => "Semi-implicit Euler",
            Integrator::Explicit => "As the paper prints it: contacts gain energy",
        };
        (integrator, integrator.name(), help)
    }))
}

fn main() -> ExitCode {
    xca_run::main!(Cadem)
}
