//! A machine without a desktop.

use crate::common::TestResult;
use std::process::Command;

/// Also what the test below runs in a process of its own.
#[test]
fn adapters_are_found() {
    assert!(!xca_gpu::adapters().is_empty());
}

/// Layers of drivers that look for a desktop would complain.
#[test]
fn nothing_is_said_where_there_is_no_desktop() -> TestResult {
    let mut program = Command::new(std::env::current_exe()?);
    program.args(["--exact", "silence::adapters_are_found", "--nocapture"]);
    for variable in ["XDG_RUNTIME_DIR", "WAYLAND_DISPLAY", "DISPLAY"] {
        program.env_remove(variable);
    }
    let output = program.output()?;
    let [out, errors] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    assert!(output.status.success() && out.contains("1 passed"), "{out}");
    assert_eq!(errors, "");
    Ok(())
}
