//! Bad input gets a clear error, a non-zero exit code, and nothing is run.

use crate::running::{CADEM, HEAT, LANDSLIDE, LIFE, MOD2, Workplace};
use std::process::Command;

const HEADER: &str = "label,x,y,z,vx,vy,vz\n";

/// Programs, options and what they must say. Nothing may be written.
fn refused(cases: &[(&str, &str, &str)]) {
    let place = Workplace::new();
    for (program, options, wanted) in cases {
        let said = place.fail(2, program, options);
        assert!(said.contains(wanted), "{options}: {said}");
        assert!(!place.path("out").exists(), "{options}");
    }
}

#[test]
fn names_that_no_one_knows() {
    refused(&[
        (CADEM, "--case tabel1", "possible values: illustration, table1, published"),
        (
            CADEM,
            "--set stifness=1",
            "no parameter is called `stifness`; known parameters: stiffness, damping, mass",
        ),
        (CADEM, "--walls none", "possible values: single, per-slot"),
        (CADEM, "--integrator verlet", "possible values: semi-implicit, explicit"),
        (CADEM, "--open floor", "unknown face `floor`; the faces are x-low"),
        (
            CADEM,
            "--engine abacus",
            "unknown engine `abacus`; there are cpu[:N], gpu[:N|NAME], mpi:cpu[:THREADS]|gpu[:NAME], \
             parts:N:cpu[:THREADS]|gpu[:NAME], reference",
        ),
        (
            HEAT,
            "--set beta=1",
            "no parameter is called `beta`; known parameters: alpha, diffusivity, initial",
        ),
        (LIFE, "--set beta=1", "this model has no parameters; `beta=1` cannot be set"),
        (LIFE, "--sieps 3", "unexpected argument '--sieps'"),
    ]);
}

#[test]
fn values_that_make_no_sense() {
    refused(&[
        (CADEM, "--threads 0", "the number of threads must be at least 1"),
        (CADEM, "--threads 100000", "100000 threads are too many"),
        (
            CADEM,
            "--engine reference --threads 2",
            "--threads is for --engine cpu, not for the reference engine",
        ),
        (CADEM, "--engine gpu --threads 2", "--threads is for --engine cpu, not for the gpu engine"),
        (CADEM, "--engine gpu --adapter abacus", "no adapter is `abacus`; this machine has 0: "),
        (CADEM, "--engine gpu --arithmetic lax", "unknown arithmetic `lax`; use best, strict or relaxed"),
        (CADEM, "--adapter 0", "--adapter is for --engine gpu, not for the cpu engine"),
        (CADEM, "--precision f16", "`f16` is not a precision; use f32 or f64"),
        (CADEM, "--set stiffness=-1", "`stiffness` is -1, but must be above 0 and finite (N/m)"),
        (CADEM, "--set stiffness=nan", "`nan` is no value for the parameter `stiffness`"),
        (CADEM, "--set stiffness", "write NAME=VALUE"),
        (CADEM, "--steps -5", "the number of steps must be a whole number"),
        (CADEM, "--every 0", "the interval must be at least 1 step"),
        (CADEM, "--subdivisions 0", "it must be a finite number above 0"),
        (CADEM, "--seed 5000000000", "the seed of the particles is at most 4294967295"),
        (CADEM, "--slots 2", "2 slots do not hold the 3 BOUNDARY slots"),
        (CADEM, "--open z-low:8,8:99,99", "that face has [20, 20] cells"),
        (HEAT, "--set alpha=0.3", "`alpha` is 0.3, but must be above 0 and at most 0.16666666666666666"),
        (HEAT, "--set alpha=0", "`alpha` is 0, but must be above 0"),
        (HEAT, "--set diffusivity=-1e-4", "`diffusivity` is -0.0001, but must be above 0"),
        (HEAT, "--set initial=-300", "`initial` is -300, but must be at least -273.15"),
        (HEAT, "--side -1", "it must be a finite number above 0"),
        (HEAT, "--until nan", "it must be a finite number at least 0"),
        (LANDSLIDE, "--set rate=5", "`rate` is 5, but must be at least 0 and at most 1"),
        (LANDSLIDE, "--set adherence=-5", "`adherence` is -5, but must be at least 0 (m)"),
        (LANDSLIDE, "--until nan", "invalid value 'nan' for '--until <METRES>': it must be a finite number"),
        (CADEM, "--seed -1", "a seed must be a whole number from 0 to 18446744073709551615"),
        (HEAT, "--side inf", "it must be a finite number above 0"),
        (HEAT, "--set alpha=1e300", "the parameter `alpha` is 1e300, but must be"),
        (MOD2, "--size 2", "too far for 2 cells with a toroidal boundary"),
    ]);
}

#[test]
fn sizes_that_no_machine_has() {
    refused(&[
        (CADEM, "--side 0", "each of the three numbers must be at least 1"),
        (CADEM, "--side 0.04", "it must be a whole number of cells"),
        (CADEM, "--side 1000000", "BOUNDARY slots; labels for 2147483647 are there; use fewer cells"),
        (HEAT, "--size 0", "the space has no cells along x"),
        (HEAT, "--size 100000", "is too large: cells are numbered by 32 bits"),
        (HEAT, "--size 99999999999999999999", "it must be a whole number from 0 to "),
        (HEAT, "--size -1", "it must be a whole number from 0 to "),
        (MOD2, "--size 1.5", "it must be a whole number from 0 to "),
        (CADEM, "--slots -3", "it must be a whole number from 0 to "),
    ]);
    if cfg!(target_os = "linux") {
        refused(&[
            (CADEM, "--side 1600", "GB of memory, and "),
            (CADEM, "--engine reference --slots 100000 --side 60", "the reference engine"),
            (HEAT, "--size 1600 --engine reference", "GB of memory, and "),
        ]);
    }
}

#[test]
fn particles_that_no_run_can_start_from() {
    let place = Workplace::new();
    for (rows, wanted) in [
        (
            "1,0.01,0.01,0.01,0,0,0\n\n2,0.01,zwei,0.01,0,0,0\n",
            "in.csv:4: `zwei` in column `y` is not a number",
        ),
        ("1,0.01,0.01\n", "in.csv:2: 3 fields in this row, 7 in the header"),
        ("1,0.01,0.01,nan,0,0,0\n", "in.csv:2: `nan` in column `z` is not a finite number"),
        ("x,0.01,0.01,0.01,0,0,0\n", "in.csv:2: the label `x` is not a whole number"),
        (
            "3,0.01,0.01,0.01,0,0,0\n3,0.02,0.01,0.01,0,0,0\n",
            "in.csv:3: the label 3 stands on line 2 already",
        ),
        (
            "# here\n4,0.01,0.01,0.05,0,0,0\n",
            "in.csv:3: particle 4 at [0.01, 0.01, 0.05] m is outside the domain",
        ),
        (
            "1,0.01,0.01,0.01,0,0,0\n2,0.02,0.01,0.01,0,0,0\n3,0.0105,0.01,0.01,0,0,0\n",
            "in.csv:2 and line 4: particles 1 and 3 overlap",
        ),
        ("4000000000,0.01,0.01,0.01,0,0,0\n", "in.csv:2: the label 4000000000 is too large"),
    ] {
        place.write("in.csv", &format!("{HEADER}{rows}"));
        let said = place.fail(2, CADEM, "--particles in.csv");
        assert!(said.contains(wanted), "{said}");
    }
    place.write("in.csv", "label,x,y,vx,vy,vz\n1,0,0,0,0,0\n");
    assert!(place.fail(2, CADEM, "--particles in.csv").contains("in.csv:1: the header has no column `z`"));
    let said = place.fail(2, CADEM, "--particles away.csv");
    assert!(said.contains("cannot open the particle file away.csv\ncaused by: "), "{said}");
    assert!(!place.path("out").exists());
}

#[test]
fn faults_end_a_run_that_has_begun() {
    let place = Workplace::new();
    place.write("fast.csv", &format!("{HEADER}7,0.01,0.01,0.01,1e6,0,0\n"));
    let said = place.fail(1, CADEM, "--particles fast.csv --steps 3");
    assert!(said.contains("error: step 1: a particle moves further than its radius"), "{said}");
    assert!(said.contains("item 7 in cell [5, 5, 5]") && said.contains("is in out/cadem"), "{said}");
    // A third particle falls into a cell on the floor, where the floor takes one of three slots.
    let rows = "1,0.0105,0.0105,0.0006,0,0,0\n2,0.0115,0.0115,0.0006,0,0,0\n3,0.011,0.011,0.0025,0,0,-1\n";
    place.write("full.csv", &format!("{HEADER}{rows}"));
    let said = place.fail(1, CADEM, "--particles full.csv --slots 3 --steps 2000");
    assert!(said.contains("cell [5, 5, 0] would hold 4 items") && said.contains("3 slots"), "{said}");
    // At the start it is a mistake of the input.
    assert!(place.fail(2, CADEM, "--slots 4").contains("would hold 5 items"));
}

#[test]
fn folders_that_a_run_must_not_write_to() {
    let place = Workplace::new();
    place.write("file", "mine");
    assert!(place.fail(2, LIFE, "--out file").contains("cannot use file as the output folder"));
    assert!(place.fail(2, LIFE, "--out file/below").contains("cannot create the output folder file/below"));
    place.succeed(CADEM, "--steps 0 --out run");
    let said = place.fail(2, CADEM, "--particles run/final.csv --out run");
    assert!(said.contains("the run starts from run/final.csv, which it would overwrite"), "{said}");
    std::fs::create_dir(place.path("data")).unwrap();
    place.write("data/final.csv", "mine");
    let said = place.fail(2, CADEM, "--steps 0 --out data");
    assert!(said.contains("data holds `final.csv`, which is not from an earlier run"), "{said}");
    assert_eq!(place.read("data/final.csv"), "mine");
}

#[test]
fn configuration_files_with_mistakes() {
    let place = Workplace::new();
    for (text, wanted) in [
        ("sise = 3", "run.toml: unknown key `sise`; there are size, side, until, precision"),
        ("alpha = 0.1", "and parameters of the model below [set]"),
        ("[set]\nbeta = 1", "no parameter is called `beta`"),
        ("size = 'x'", "run.toml: invalid value 'x' for '--size <N>'"),
        ("size = 3\nuntil =", "run.toml:2: "),
    ] {
        place.write("run.toml", text);
        let said = place.fail(2, HEAT, "--config run.toml");
        assert!(said.contains(wanted), "{said}");
    }
    let said = place.fail(2, HEAT, "--config away.toml");
    assert!(said.contains("cannot read the configuration away.toml\ncaused by: "), "{said}");
}

#[test]
fn help_is_there_for_everyone() {
    for program in [CADEM, HEAT, LIFE, MOD2] {
        let output = Command::new(program).args(["run", "--help"]).output().unwrap();
        let help = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success());
        for text in [
            "--engine",
            "--threads",
            "--precision",
            "--set",
            "--config",
            "--every",
            "Examples:",
            "Exit codes:",
        ] {
            assert!(help.contains(text), "{program} {text}");
        }
        for command in ["run", "resume", "list", "inspect", "compare"] {
            let output = Command::new(program).args([command, "--help"]).output().unwrap();
            let help = String::from_utf8(output.stdout).unwrap();
            assert!(output.status.success());
            let name = program.rsplit('/').next().unwrap();
            for text in ["Examples:\n", "Exit codes:\n", &format!("\n  {name} {command}")] {
                assert!(help.contains(text), "{program} {command}: {text}");
            }
        }
        assert_eq!(Command::new(program).output().unwrap().status.code(), Some(2));
    }
}

#[test]
fn warnings_are_printed_also_where_nothing_else_is() {
    let place = Workplace::new();
    let wanted = "warning: a contact takes 5.0 steps; fewer than 20 give a wrong energy; \
                  a time step of 1.242e-5 s is small enough\n";
    let output = place.run(CADEM, "--set time_step=5e-5 --steps 1 --quiet");
    assert_eq!(String::from_utf8(output.stderr).unwrap(), wanted);
    assert!(output.status.success() && output.stdout.is_empty());
    let report: serde_json::Value = serde_json::from_str(&place.read("out/cadem/run.json")).unwrap();
    assert_eq!(format!("warning: {}\n", report["warnings"][0].as_str().unwrap()), wanted);
    let output = place.run(CADEM, "--case table1 --precision f32 --steps 0 --quiet --out single");
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.starts_with("warning: in f32 a particle slower than about"), "{said}");
    let output = place.invocation(CADEM, "list --set time_step=5e-5").output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), wanted);
}
