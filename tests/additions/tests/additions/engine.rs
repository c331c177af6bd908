//! An engine from elsewhere.

use super::{TestResult, plate, report, succeed};
use std::fs;

#[test]
fn it_runs_resumes_sweeps_and_is_compared() -> TestResult {
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    succeed(folder, "run --engine twins --copies 3 --out twins --checkpoint-every 20 --quiet")?;
    succeed(folder, "run --engine reference --out plain --quiet")?;
    let told = report(&folder.join("twins/run.json"))?;
    assert_eq!((&told["engine"], &told["device"]["copies"]), (&"twins".into(), &"3".into()));
    for file in ["observables.csv", "frames/plate_00000030.vti", "final.png"] {
        assert_eq!(fs::read(folder.join("twins").join(file))?, fs::read(folder.join("plain").join(file))?);
    }
    let checkpoint = "twins/checkpoints/step_00000020.checkpoint";
    succeed(folder, &format!("resume twins --checkpoint {checkpoint} --quiet"))?;
    assert_eq!(report(&folder.join("twins/run.json"))?["device"]["copies"], "3");
    succeed(folder, &format!("resume twins --checkpoint {checkpoint} --engine cpu --quiet"))?;
    assert_eq!(report(&folder.join("twins/run.json"))?["engine"], "cpu");
    succeed(folder, "sweep --engine twins --seeds 2 --out sweep --quiet")?;
    succeed(folder, "compare --engines reference,twins:4,twins@f32 --repeats 1 --out compared --quiet")?;
    let told = report(&folder.join("compared/compare.json"))?;
    assert_eq!(told["engines"][1]["name"], "twins:4");
    assert_eq!(told["engines"][1]["verdict"], "IDENTICAL");
    Ok(())
}

#[test]
fn help_and_list_tell_of_it() -> TestResult {
    let folder = tempfile::tempdir()?;
    let help = succeed(folder.path(), "run --help")?;
    assert!(help.contains("Serial, and everything several times"), "{help}");
    assert!(help.contains("--copies <N>"), "{help}");
    let list = succeed(folder.path(), "list")?;
    assert!(list.contains("twins       Serial, and everything several times"), "{list}");
    for (words, wanted) in [
        ("run --copies 2", "--copies is for --engine twins, not for the cpu engine"),
        ("run --engine twins --copies 10", "it must be a whole number from 1 to 9"),
        ("run --engine twins --threads 2", "--threads is for --engine cpu, not for the twins engine"),
        ("run --engine twin", "unknown engine `twin`; there are cpu[:N], gpu[:N|NAME], "),
        ("run --engine twins --print-source", "the twins engine generates no code"),
    ] {
        let output = plate(folder.path(), words)?;
        let said = String::from_utf8(output.stderr)?;
        assert_eq!(output.status.code(), Some(2), "{words}");
        assert!(said.contains(wanted), "{words}: {said}");
    }
    Ok(())
}
