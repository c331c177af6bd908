//! What the engines cost. `cargo run --release -p xca-benchmarks -- --help` lists the benchmarks.

mod bandwidth;
mod boltzmann;
mod comparison;
mod dense;
mod engines;
mod gpu;
mod lammps;
mod landslide;
mod mathematics;
mod particles;
mod parts;
mod quiet;
mod state;
mod timing;

use clap::{Args, Parser, Subcommand};
use particles::Rounds;
use state::{Stage, State};
use std::error::Error;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;
use xca_core::{Model, Precision};

/// Prints a line; that it is lost is an error.
macro_rules! say {
    ($($text:tt)*) => {
        writeln!(io::stdout(), $($text)*)
    };
}

/// What the engines of xca cost on this machine.
#[derive(Parser, Debug)]
struct Arguments {
    /// How many threads the CPU engine uses.
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// How many rounds count.
    #[arg(long, default_value_t = 9)]
    rounds: usize,
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Subcommand, Debug)]
enum Benchmark {
    /// Heat 256^3 and Life 4096^2 against loops written by hand with rayon.
    Dense,
    /// The gallery's fluid (D3Q19) against a loop written by hand with rayon.
    Boltzmann {
        /// The cells along each side of the cube.
        #[arg(long, default_value_t = 64)]
        size: usize,
        /// How many steps make a round.
        #[arg(long, default_value_t = 10)]
        steps: usize,
    },
    /// The GPU engine against the CPU engine for CADEM, mod2 256^3, Life 4096^2 and heat 256^3.
    Engines {
        /// How many steps make a round.
        #[arg(long, default_value_t = 5)]
        steps: u64,
    },
    /// The GPU engine against itself: a landslide with work on all cells, and corrected division and square
    /// root.
    Gpu {
        #[command(flatten)]
        map: Map,
        /// How many steps make a round. The landslide goes on from round to round.
        #[arg(long, default_value_t = 20)]
        steps: u64,
    },
    /// CADEM: a step's time in three states of the paper's benchmark, and the cost of a particle for systems
    /// of different size.
    Particles {
        /// States of the 315,979 particles. Those after the start are computed once, which takes minutes, and
        /// kept.
        #[arg(long, value_delimiter = ',', default_values = ["start", "bouncing", "settled"])]
        states: Vec<Stage>,
        /// Cells along each side of other cubes, at the start: 50 and 200 hold some 40,000 and 2,500,000
        /// particles.
        #[arg(long, value_delimiter = ',', default_values_t = [50, 200])]
        cells: Vec<usize>,
        /// How many steps make a round.
        #[arg(long, default_value_t = 40)]
        steps: usize,
        /// Run LAMMPS (`lmp`) in turns with the states, if it is installed.
        #[arg(long)]
        lammps: bool,
        /// Where states are kept.
        #[arg(long, default_value = "target/benchmarks")]
        folder: PathBuf,
    },
    /// Two parts of a space, with one thread each, whose messages are late: heat 256^3 and CADEM.
    Parts {
        /// The delays in milliseconds. The first should be 0.
        #[arg(long, value_delimiter = ',', default_values_t = [0.0, 1.0, 4.0])]
        delays: Vec<f64>,
        /// How many steps make a round.
        #[arg(long, default_value_t = 20)]
        steps: u64,
    },
    /// Models that are quiet nearly everywhere: the CPU engine as it is against itself where it works on all
    /// cells.
    Quiet,
    /// A landslide against active cells by hand. These use one thread.
    Landslide {
        #[command(flatten)]
        map: Map,
        /// How many steps make a round. The landslide goes on from round to round.
        #[arg(long, default_value_t = 50)]
        steps: u64,
    },
    /// A call of each function of `xca_core::math`, on one thread.
    Mathematics,
}

/// The ground of a landslide.
#[derive(Args, Debug)]
struct Map {
    /// A grid of altitudes; a slope of 600 x 500 cells without it.
    #[arg(long, value_name = "FILE", requires = "debris")]
    dem: Option<PathBuf>,
    /// A grid of debris.
    #[arg(long, value_name = "FILE", requires = "dem")]
    debris: Option<PathBuf>,
}

impl Map {
    fn model(self) -> Result<Model, Box<dyn Error>> {
        match self.dem.zip(self.debris) {
            Some((dem, debris)) => landslide::map(&dem, &debris),
            None => Ok(landslide::slope()?),
        }
    }
}

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        // No one reads on, as after `| head -1`.
        Err(error) if is_broken_pipe(&*error) => ExitCode::SUCCESS,
        Err(error) => {
            // There is no other place to tell that it is lost.
            let _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn is_broken_pipe(error: &(dyn Error + 'static)) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

fn run(arguments: Arguments) -> Result<(), Box<dyn Error>> {
    match arguments.benchmark {
        Benchmark::Dense => {
            let bandwidth = bandwidth::bandwidth(arguments.threads)?;
            say!("memory: {:.1} GB/s are read and written while a large array is copied", bandwidth / 1e9)?;
            for comparison in [
                dense::heat(256, arguments.threads, arguments.rounds, 32)?,
                dense::life(4096, arguments.threads, arguments.rounds, 128)?,
            ] {
                say!("{}", comparison.line(bandwidth))?;
            }
        }
        Benchmark::Boltzmann { size, steps } => {
            let bandwidth = bandwidth::bandwidth(arguments.threads)?;
            say!("memory: {:.1} GB/s are read and written while a large array is copied", bandwidth / 1e9)?;
            for precision in [Precision::F32, Precision::F64] {
                let fluid = boltzmann::fluid(size, precision, arguments.threads, arguments.rounds, steps)?;
                say!("{}", fluid.line(bandwidth))?;
            }
        }
        Benchmark::Engines { steps } => {
            for comparison in engines::compare(arguments.threads, arguments.rounds, steps)? {
                let bits = if comparison.same { "the same bits" } else { "OTHER BITS" };
                say!("{} ({}), {bits}:", comparison.name, comparison.things)?;
                for cost in &comparison.costs {
                    let (low, high) = cost.step.spread();
                    say!(
                        "  {}: set-up {:.2} s, transfer {:.3} s, {:.2} ms a step ({:.2} to {:.2}), {:.1} million a second; state {:.0} MB",
                        cost.engine,
                        cost.set_up,
                        cost.transfer,
                        cost.step.median() * 1e3,
                        low * 1e3,
                        high * 1e3,
                        comparison.things as f64 / cost.step.median() / 1e6,
                        cost.memory as f64 / 1e6,
                    )?;
                }
            }
        }
        Benchmark::Particles { states, cells, steps, lammps, folder } => {
            let rounds = Rounds { rounds: arguments.rounds, steps, threads: arguments.threads };
            let beside = lammps && lammps::is_installed();
            if lammps && !beside {
                say!("LAMMPS is not installed: there is no program `lmp`")?;
            }
            for stage in states {
                let state = State::at(stage, arguments.threads, &folder)?;
                let name = format!("{stage:?}").to_lowercase();
                say!("{}", particles::cost(&name, &state, rounds, beside.then_some(&*folder))?)?;
            }
            for cells in cells {
                let state = State::start(cells)?;
                say!("{}", particles::cost(&format!("start, {cells}^3 cells"), &state, rounds, None)?)?;
            }
        }
        Benchmark::Parts { delays, steps } => {
            let delay = |milliseconds: f64| Duration::try_from_secs_f64(milliseconds / 1e3);
            let delays: Vec<Duration> = delays.into_iter().map(delay).collect::<Result<_, _>>()?;
            let heat = dense::heat_model(256)?;
            let particles = State::start(100)?.model()?;
            for (name, model) in [("heat 256^3", &heat), ("CADEM, 315,979 particles", &particles)] {
                say!("{}", parts::cost(name, model, &delays, arguments.rounds, steps)?)?;
            }
        }
        Benchmark::Quiet => {
            for model in quiet::Quiet::all()? {
                say!("{}", model.cost(arguments.threads, arguments.rounds)?)?;
            }
        }
        Benchmark::Landslide { map, steps } => {
            say!("{}", landslide::cost(&map.model()?, arguments.threads, arguments.rounds, steps)?)?;
        }
        Benchmark::Gpu { map, steps } => {
            say!("{}", gpu::activity(&map.model()?, arguments.rounds, steps)?)?;
            for cost in gpu::corrections(arguments.rounds, steps)? {
                say!("{cost}")?;
            }
        }
        Benchmark::Mathematics => {
            for precision in [Precision::F32, Precision::F64] {
                for (name, times) in mathematics::costs(precision, arguments.rounds)? {
                    let (low, high) = times.spread();
                    say!(
                        "{name} {precision}: {:.1} ns ({:.1} to {:.1})",
                        times.median() * 1e9,
                        low * 1e9,
                        high * 1e9
                    )?;
                }
            }
        }
    }
    Ok(())
}
