//! The commands of the book that its test does not run, and what checks them instead.

/// A command, as a page writes it.
pub(super) struct Elsewhere {
    pub(super) command: &'static str,
    /// A file of the workspace.
    pub(super) checked_by: Option<&'static str>,
    pub(super) why: &'static str,
}

const fn by(checked_by: &'static str, command: &'static str, why: &'static str) -> Elsewhere {
    Elsewhere { command, checked_by: Some(checked_by), why }
}

const fn by_nothing(command: &'static str, why: &'static str) -> Elsewhere {
    Elsewhere { command, checked_by: None, why }
}

const STARTER: &str = "examples/tests/programs/begun.rs";

pub(super) const ELSEWHERE: &[Elsewhere] = &[
    by("scripts/vulkan", "apt-get install mesa-vulkan-drivers", "installs this package"),
    by_nothing("apt install lammps", "only a benchmark needs it"),
    by_nothing("apt-get install build-essential", "nothing is built without a C linker"),
    by_nothing("sudo apt-get install build-essential", "nothing is built without a C linker"),
    by(
        "tests/new/Cargo.toml",
        "cargo add --path PATH_OF_THIS_REPOSITORY/xca --features run",
        "is a crate with this dependency",
    ),
    by(
        "tests/library/Cargo.toml",
        "cargo add --path PATH_OF_THE_REPOSITORY/xca --features record",
        "is a crate with this dependency",
    ),
    by(STARTER, "cd waves", "goes into such a crate"),
    by(STARTER, "cargo test", "compiles the tests of such a crate; the crate `tests/new` runs them"),
    by("tests/new/tests/program.rs", "cargo run --release -- run", "runs the program of such a crate"),
    by("tests/src/lib.rs", "cargo run --release", "compiles and runs the programs of the guide"),
    by(
        "tests/new/tests/program.rs",
        "cargo run --release --features xca/gpu,xca/terminal",
        "the program that names these features",
    ),
    by("scripts/test", "cargo test --doc -p xca-tests", "runs the tests of the workspace"),
    by(
        "scripts/test",
        "cargo build --release --features mpi --bin cadem",
        "builds the programs with this feature for the tests of `mpi`",
    ),
    by("tests/book/tests/links.rs", "cargo run -p xca-tests-book", "builds the same book"),
    by("scripts/test", "bash scripts/test", "runs this test"),
    by("scripts/test", "bash scripts/test quick", "takes the same steps, and more"),
    by("scripts/test", "bash scripts/mpi", "calls it"),
    by_nothing("bash scripts/gallery", "takes minutes; its programs have tests"),
    by(
        "tests/tests/mathematics.rs",
        "cargo run --release -p xca-tests --example mathematics -- 100000",
        "measures the same errors on fewer values",
    ),
    by(
        "benchmarks/tests/output.rs",
        "cargo run --release -p xca-benchmarks -- --rounds 41 mathematics",
        "runs it with one round",
    ),
    by(
        "benchmarks/tests/output.rs",
        "cargo run --release -p xca-benchmarks -- --rounds 7 parts",
        "runs another benchmark",
    ),
    by("benchmarks/tests/output.rs", "cargo run --release -p xca-benchmarks --", "runs one of them"),
    by_nothing("module load openmpi", "for Slurm; the page says that it was not run"),
    by_nothing(
        "srun --mpi=pmix ./cadem run --case table1 --side 400 --engine mpi:cpu --checkpoint-every 30min",
        "for Slurm; the page says that it was not run",
    ),
    by_nothing("srun --mpi=pmix ./cadem resume out/cadem", "for Slurm; the page says that it was not run"),
];
