//! Runs that are killed at any moment, and go on.
#![cfg(unix)]

use crate::running::{CADEM, LIFE, MOD2, Workplace, assert_same_results, report};
use std::fs;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Numbers that look random.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % limit
    }
}

/// Lets a process run for so long; nothing if it had to be killed.
fn run_for(command: &mut Command, time: Duration) -> Option<ExitStatus> {
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begin = Instant::now();
    while begin.elapsed() < time {
        if let Some(status) = child.try_wait().unwrap() {
            return Some(status);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    let status = child.wait().unwrap();
    // It may have ended just before.
    status.code().map(|_| status)
}

/// Kills a run so many times, at moments that differ, and demands that it ends as one that was left alone.
fn kill(place: &Workplace, program: &str, options: &str, times: usize) {
    let start = Instant::now();
    place.succeed(program, &format!("{options} --out whole"));
    // Some of the attempts end before they are killed, whatever the machine.
    let longest = start.elapsed().as_micros() as u64 * 5 / 4;
    let begin = format!("run {options} --checkpoint-every 20 --out here");
    let engines = ["--engine cpu --threads 2", "--engine reference", "--engine cpu --threads 1"];
    let (mut numbers, mut killed, mut ended) = (Numbers(7), 0, 0);
    let mut resumed = 0;
    let mut go_on = false;
    while killed < times || ended == 0 {
        let words = match go_on {
            true => format!("resume here {}", engines[numbers.below(3) as usize]),
            false => begin.clone(),
        };
        let limit = if killed < times {
            Duration::from_micros(numbers.below(longest))
        } else {
            Duration::from_secs(60)
        };
        match run_for(&mut place.invocation(program, &words), limit) {
            None => {
                killed += 1;
                resumed += usize::from(go_on);
            }
            Some(status) => {
                assert!(status.success(), "{program} {words}: {status}");
                assert_same_results(&place.path("whole"), &place.path("here"), &words);
                assert_eq!(report(&place.path("here"))["progress"]["outcome"], "done");
                ended += 1;
                fs::remove_dir_all(place.path("here")).unwrap();
            }
        }
        // Half of a checkpoint has another name.
        let kept = fs::read_dir(place.path("here/checkpoints")).into_iter().flatten();
        go_on = kept
            .filter(|entry| !entry.as_ref().unwrap().file_name().to_str().unwrap().starts_with('.'))
            .count()
            > 0;
    }
    assert!(resumed > 0, "the run was never under way when it was killed");
}

#[test]
fn fifty_times_while_cells_change() {
    kill(&Workplace::new(), MOD2, "--size 8 --steps 400 --every 100", 50);
}

#[test]
fn fifty_times_while_particles_move() {
    let place = Workplace::new();
    place.write("drop.csv", "label,x,y,z,vx,vy,vz\n5,0.011,0.011,0.001,0,0,-2\n8,0.005,0.005,0.001,0,0,-2\n");
    kill(&place, CADEM, "--particles drop.csv --side 8 --open z-low:5,5:5,5 --steps 160 --every 40", 50);
}

/// Two processes never write to one folder.
#[test]
fn a_run_that_is_not_dead_is_not_resumed() {
    let place = Workplace::new();
    let mut child =
        place.command(LIFE, "--steps 1000000000 --every 100000000 --checkpoint-every 5 --out here");
    let mut child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begin = Instant::now();
    let checkpoints = place.path("here/checkpoints");
    while !fs::read_dir(&checkpoints).is_ok_and(|entries| entries.count() > 1) {
        assert!(begin.elapsed() < Duration::from_secs(60), "no checkpoint comes");
        std::thread::sleep(Duration::from_millis(5));
    }
    let output = place.invocation(LIFE, "resume here").output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    let again = place.fail(2, LIFE, "--steps 3 --out here");
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert_eq!(said, "error: another run is writing to here\n");
    assert_eq!(again, said);
}

/// With checkpoints, Ctrl-C writes one more; the run goes on from the very step, and the end that was
/// recorded is taken back.
#[test]
fn a_run_goes_on_after_ctrl_c() {
    let place = Workplace::new();
    let options = "--size 12 --steps 4000 --every 200";
    place.succeed(MOD2, &format!("{options} --out whole"));
    let mut child = place.command(MOD2, &format!("{options} --checkpoint-every 1h --out here"));
    let child = child.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begin = Instant::now();
    let rows =
        || fs::read_to_string(place.path("here/observables.csv")).map_or(0, |text| text.lines().count());
    while rows() < 4 {
        assert!(begin.elapsed() < Duration::from_secs(60), "the run does not get on");
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(said.contains(&format!("; continue with `{MOD2} resume here`")), "{said}");
    let steps = report(&place.path("here"))["progress"]["steps"].as_u64().unwrap();
    assert!(place.path(&format!("here/checkpoints/step_{steps:08}.checkpoint")).is_file());
    assert!(place.path("here/final.png").is_file());
    let output = place.invocation(MOD2, "resume here").output().unwrap();
    assert!(output.status.success());
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains(&format!("resumed after step {steps}\n")), "{said}");
    assert_same_results(&place.path("whole"), &place.path("here"), "after Ctrl-C");
}
