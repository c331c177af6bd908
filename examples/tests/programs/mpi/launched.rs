//! Starting programs by `mpirun`.

use crate::running::{Workplace, warns_at_most};
use std::fs;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Longer than any test takes: what is still there then hangs.
const PATIENCE: Duration = Duration::from_secs(120);

/// The command `mpirun -n RANKS PROGRAM WORDS`.
pub(crate) fn mpirun(place: &Workplace, ranks: usize, program: &str, words: &str) -> Command {
    let mut command = Command::new("mpirun");
    command.args(["-n", &ranks.to_string(), "--oversubscribe", "--bind-to", "none"]);
    command.arg(program).args(words.split_whitespace()).current_dir(place.path(""));
    on_this_machine(&mut command);
    command
}

/// Lets `mpirun` start processes on a machine of tests, however few cores it has; what they say is kept.
pub(super) fn on_this_machine(command: &mut Command) -> &mut Command {
    let settings = [
        ("OMPI_ALLOW_RUN_AS_ROOT", "1"),
        ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
        // Containers may forbid the other ways to share memory.
        ("OMPI_MCA_btl_vader_single_copy_mechanism", "none"),
        ("OMPI_MCA_rmaps_base_oversubscribe", "1"),
    ];
    command.envs(settings).env_remove("RUST_BACKTRACE");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped())
}

/// Waits until a command has ended; one that hangs is killed.
pub(crate) fn ended(mut child: Child, name: &str) -> Output {
    let begin = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begin.elapsed() > PATIENCE {
            // Its processes go with it.
            signal(child.id(), "-TERM");
            thread::sleep(Duration::from_secs(2));
            child.kill().unwrap();
            panic!("{name} hangs");
        }
        thread::sleep(Duration::from_millis(10));
    }
    child.wait_with_output().unwrap()
}

/// What a command says, and how it ends.
pub(crate) fn run(place: &Workplace, ranks: usize, program: &str, words: &str) -> Output {
    let child = mpirun(place, ranks, program, words).spawn().expect("scripts/mpi installs mpirun");
    ended(child, &format!("{program} {words} on {ranks} ranks"))
}

/// Runs a program that must succeed.
pub(crate) fn succeed(place: &Workplace, ranks: usize, program: &str, words: &str) -> String {
    let output = run(place, ranks, program, words);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && warns_at_most(&said), "{words} on {ranks} ranks: {said}");
    String::from_utf8(output.stdout).unwrap()
}

/// Sends a signal to a process.
pub(crate) fn signal(process: u32, name: &str) {
    assert!(Command::new("kill").args([name, &process.to_string()]).status().unwrap().success());
}

/// The process of a rank, among those that a command has started.
pub(crate) fn process_of(launcher: u32, rank: usize) -> u32 {
    let wanted = format!("OMPI_COMM_WORLD_RANK={rank}");
    let children = |of: u32| -> Vec<u32> {
        let path = format!("/proc/{of}/task");
        let tasks = fs::read_dir(path).map(|tasks| tasks.flatten().collect::<Vec<_>>()).unwrap_or_default();
        let text =
            tasks.iter().map(|task| fs::read_to_string(task.path().join("children")).unwrap_or_default());
        text.collect::<String>().split_whitespace().map(|number| number.parse().unwrap()).collect()
    };
    let is_wanted = |process: &u32| {
        let settings = fs::read(format!("/proc/{process}/environ")).unwrap_or_default();
        settings.split(|byte| *byte == 0).any(|setting| setting == wanted.as_bytes())
    };
    children(launcher).into_iter().find(is_wanted).expect("the rank is there")
}

/// Waits until something has come about.
pub(crate) fn wait_until(what: &str, has_come: impl Fn() -> bool) {
    let begin = Instant::now();
    while !has_come() {
        assert!(begin.elapsed() < PATIENCE, "{what} does not come");
        thread::sleep(Duration::from_millis(10));
    }
}
