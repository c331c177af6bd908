//! What the engines cost. `cargo run --release -p xca-benchmarks -- --help` lists the benchmarks.

mod boltzmann;
mod comparison;
mod dense;
mod engines;
mod mathematics;
mod particles;
mod timing;

use clap::{Parser, Subcommand};
use std::error::Error;
use std::io::{self, Write};
use std::process::ExitCode;
use xca_core::Precision;

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
    /// CADEM at the start: a step's time, and the cost of a particle for systems of different size.
    Particles {
        /// The cells along each side of the cubes: 50, 100 and 200 hold some 40,000, 316,000 and 2,500,000 particles.
        #[arg(long, value_delimiter = ',', default_values_t = [50, 100, 200])]
        cells: Vec<usize>,
        /// How many steps to do before the steps that are timed.
        #[arg(long, default_value_t = 0)]
        after: u64,
        /// How many steps are timed.
        #[arg(long, default_value_t = 40)]
        steps: usize,
    },
    /// A call of each function of `xca_core::math`, on one thread.
    Mathematics,
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
            for comparison in [
                dense::heat(256, arguments.threads, arguments.rounds, 10)?,
                dense::life(4096, arguments.threads, arguments.rounds, 20)?,
            ] {
                say!("{comparison}")?;
            }
        }
        Benchmark::Boltzmann { size, steps } => {
            for precision in [Precision::F32, Precision::F64] {
                say!("{}", boltzmann::fluid(size, precision, arguments.threads, arguments.rounds, steps)?)?;
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
        Benchmark::Particles { cells, after, steps } => {
            for cells in cells {
                let mut simulation = particles::simulation(cells, arguments.threads)?;
                simulation.run(after)?;
                let cost = particles::cost(&mut simulation, steps)?;
                let [median, low, high] = cost.seconds;
                say!(
                    "cadem, {} particles in {cells}^3 cells, after {} steps: {:.2} ms a step ({:.2} to {:.2}), {:.1} ns a particle; state {:.1} MB",
                    cost.particles,
                    cost.step,
                    median * 1e3,
                    low * 1e3,
                    high * 1e3,
                    median * 1e9 / cost.particles as f64,
                    cost.memory as f64 / 1e6,
                )?;
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
