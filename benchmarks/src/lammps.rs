//! LAMMPS on the same particles with the same law of contact: pair style `gran/hooke` without friction, which
//! is CADEM's.

use crate::state::State;
use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Whether it is installed.
pub(crate) fn is_installed() -> bool {
    let help = Command::new("lmp").arg("-help").stdout(Stdio::null()).stderr(Stdio::null()).status();
    help.is_ok_and(|status| status.success())
}

/// What LAMMPS takes for a step.
#[derive(Debug)]
pub(crate) struct Cost {
    /// Seconds a step.
    pub(crate) seconds: f64,
    /// How far beyond a contact its lists reach, in metres.
    pub(crate) skin: f64,
}

/// The skins that are tried, in metres.
const SKINS: [f64; 3] = [2e-4, 4e-4, 6e-4];

/// The cost of a step with the best of some skins, on so many processes. It works in the folder.
pub(crate) fn cost(
    state: &State,
    steps: usize,
    threads: usize,
    folder: &Path,
) -> Result<Cost, Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("particles.data"), data(state)?)?;
    fs::write(folder.join("steps.in"), INPUT)?;
    let mut best: Option<Cost> = None;
    for skin in SKINS {
        let seconds = run(folder, skin, steps, threads)?;
        if best.as_ref().is_none_or(|best| seconds < best.seconds) {
            best = Some(Cost { seconds, skin });
        }
    }
    best.ok_or_else(|| "no skin was tried".into())
}

fn run(folder: &Path, skin: f64, steps: usize, threads: usize) -> Result<f64, Box<dyn Error>> {
    let mut command = if threads == 1 {
        Command::new("lmp")
    } else {
        let mut command = Command::new("mpirun");
        command.args(["--bind-to", "none", "-np", &threads.to_string(), "lmp"]);
        command
    };
    // Else it refuses to run in containers.
    command.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    let (skin, steps) = (skin.to_string(), steps.to_string());
    command.args(["-in", "steps.in", "-log", "none", "-var", "skin", &skin, "-var", "steps", &steps]);
    let output = command.current_dir(folder).output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    // The line is `Loop time of 2.2 on 2 procs for 200 steps with 315979 atoms`; the last one counts.
    let time = text.lines().filter_map(|line| line.strip_prefix("Loop time of ")).next_back();
    let seconds = time.and_then(|line| line.split(' ').next()).and_then(|number| number.parse::<f64>().ok());
    match seconds {
        Some(seconds) if output.status.success() => Ok(seconds / steps.parse::<f64>()?),
        _ => Err(format!("LAMMPS ended with an error:\n{text}").into()),
    }
}

/// LAMMPS' own damping is a rate: eta over the reduced mass, which is half a particle's, and a whole one's at
/// a wall.
const INPUT: &str = "\
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
processors * * 1
read_data particles.data
neighbor ${skin} bin
neigh_modify delay 0 every 1 check yes
pair_style gran/hooke 8000 0 30 0 0 0
pair_coeff * *
timestep 1.118033988749895e-5
fix motion all nve
fix weight all gravity 9.81 vector 0 0 -1
fix across all wall/gran hooke 8000 0 15 0 0 0 xplane 0 0.2
fix along all wall/gran hooke 8000 0 15 0 0 0 yplane 0 0.2
fix up all wall/gran hooke 8000 0 15 0 0 0 zplane 0 0.2
thermo 1000000
thermo_modify lost error
run 20
run ${steps}
";

/// The particles as LAMMPS reads them: spheres by diameter and density.
fn data(state: &State) -> Result<String, std::fmt::Error> {
    let State { side, radius, mass, particles, .. } = state;
    let density = mass / (4.0 / 3.0 * std::f64::consts::PI * radius.powi(3));
    let mut text = format!("particles\n\n{} atoms\n1 atom types\n\n", particles.len());
    for axis in ["x", "y", "z"] {
        writeln!(text, "0 {side} {axis}lo {axis}hi")?;
    }
    text.push_str("\nAtoms\n\n");
    for (number, particle) in particles.iter().enumerate() {
        let [x, y, z] = particle.position;
        writeln!(text, "{} 1 {} {density} {x} {y} {z}", number + 1, 2.0 * radius)?;
    }
    text.push_str("\nVelocities\n\n");
    for (number, particle) in particles.iter().enumerate() {
        let [x, y, z] = particle.velocity;
        writeln!(text, "{} {x} {y} {z} 0 0 0", number + 1)?;
    }
    Ok(text)
}
