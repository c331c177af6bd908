//! What a launcher of many processes, such as `mpirun` or `srun`, says to each of them.

use std::env;
use std::time::Duration;

/// The number of processes: of Open MPI, of MPICH and its kin, and of a step of Slurm. A batch script of
/// Slurm is one process, whatever `SLURM_NTASKS` says in it.
const PROCESSES: [&str; 3] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"];

/// The number of a process among them.
const RANK: [&str; 3] = ["OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"];

fn number(names: [&str; 3]) -> Option<usize> {
    names.iter().filter_map(|name| env::var(name).ok()?.parse().ok()).max()
}

/// How many processes were started together, this one included.
pub(crate) fn processes() -> usize {
    number(PROCESSES).unwrap_or(1)
}

/// Whether another process says what all have to say.
pub(crate) fn is_silent() -> bool {
    processes() > 1 && number(RANK).is_some_and(|rank| rank > 0)
}

/// How long a silent process waits before it prints an error. Most errors are found by all processes, and
/// Open MPI ends the others about a second after the first has ended with an error. What is printed after
/// the wait is the error of one process alone.
pub(crate) const PATIENCE: Duration = Duration::from_secs(3);
