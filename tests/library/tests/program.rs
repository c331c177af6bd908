//! The program is run as a user would, killed, and run again.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;

type TestResult = Result<(), Box<dyn Error>>;

fn run(out: &Path) -> TestResult {
    let output = Command::new(env!("CARGO_BIN_EXE_xca-tests-library")).arg(out).output()?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Ok(())
}

#[test]
fn a_main_of_forty_lines_leaves_the_files_of_a_run_and_goes_on() -> TestResult {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("plate");
    run(&out)?;
    let files = ["observables.csv", "plate.pvd", "final.png", "frames/plate_00000700.vti", "temperature.asc"];
    let first = files.map(|file| fs::read(out.join(file)).unwrap_or_default());
    assert!(first.iter().all(|bytes| !bytes.is_empty()));
    let heat: f64 = String::from_utf8(first[4].clone())?
        .lines()
        .skip(6)
        .flat_map(str::split_whitespace)
        .map(|text| text.parse::<f64>().unwrap_or(f64::NAN))
        .sum();
    // Faces are flat and cold outside, so heat is lost; by how much the steps of a loop by hand say.
    assert!((heat - by_hand()).abs() < 1e-6, "{heat} instead of {}", by_hand());
    // As if it had been killed after step 750: what came later is missing, and comes again.
    for file in files.iter().filter(|file| !file.ends_with(".csv") && !file.ends_with(".pvd")) {
        fs::remove_file(out.join(file)).or_else(|_| fs::metadata(out.join(file)).map(drop))?;
    }
    fs::write(out.join("frames/plate_00000700.vti"), &first[3])?;
    fs::remove_file(out.join("checkpoints/step_00001000.checkpoint"))?;
    run(&out)?;
    assert_eq!(files.map(|file| fs::read(out.join(file)).unwrap_or_default()), first);
    let report = fs::read_to_string(out.join("run.json"))?;
    assert!(report.contains("step_00000750.checkpoint"), "{report}");
    Ok(())
}

/// The sum of the temperatures after 1000 steps.
fn by_hand() -> f64 {
    const SIDE: usize = 64;
    let mut now = vec![0.0; SIDE * SIDE];
    for (cell, value) in now.iter_mut().enumerate() {
        *value = if cell % SIDE < SIDE / 2 { 100.0 } else { 0.0 };
    }
    for _ in 0..1000 {
        let before = now.clone();
        let at = |x: usize, y: usize| {
            let inside = (1..=SIDE).contains(&x) && (1..=SIDE).contains(&y);
            if inside { before[(y - 1) * SIDE + x - 1] } else { 0.0 }
        };
        for y in 1..=SIDE {
            for x in 1..=SIDE {
                let around = at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1);
                now[(y - 1) * SIDE + x - 1] += 0.2 * (around - 4.0 * at(x, y));
            }
        }
    }
    now.iter().sum()
}
