//! The crate that `new` writes.

use crate::running::{LIFE, Workplace};
use std::fs;
use std::path::Path;
use std::process::Command;

/// The crate compiles as it is written, its test too, with nothing but what its own manifest names. To run it
/// here, all that it depends on would have to be compiled once more, which takes minutes: that the very same
/// sources pass their test is shown by the crate `tests/new`.
#[test]
fn a_new_crate_compiles_as_it_is() {
    let place = Workplace::new();
    let output = place.invocation(LIFE, "new my-waves").output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    // The versions that are tested, and that are here already.
    fs::copy(workspace.join("Cargo.lock"), place.path("my-waves/Cargo.lock")).unwrap();
    // Kept from one test to the next, and no one else's: cargo waits for nobody.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("new");
    let output = Command::new(env!("CARGO"))
        .args(["check", "--all-targets", "--offline", "--quiet"])
        .current_dir(place.path("my-waves"))
        .env("CARGO_TARGET_DIR", target)
        .env("RUSTFLAGS", "-D warnings")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn nothing_is_written_where_something_is_or_no_crate_can_be() {
    let place = Workplace::new();
    fs::create_dir(place.path("waves")).unwrap();
    for (words, wanted) in [
        ("waves", "waves exists already"),
        ("2d", "the name of a crate"),
        ("../waves", "the name of a crate"),
        ("fn", "is a keyword of Rust"),
        ("ripples --xca-path waves", "waves is not a folder of xca"),
    ] {
        let output = place.invocation(LIFE, &format!("new {words}")).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        assert!(said.contains(wanted), "{words}: {said}");
    }
    assert_eq!(fs::read_dir(place.path("waves")).unwrap().count(), 0);
    assert!(!place.path("ripples").exists());
}
