//! Tells the program which commit it was built of, and by which compiler, where that can be known.

use std::process::Command;

fn main() {
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    if let Some(version) = line_of(&compiler, &["--version"]) {
        println!("cargo::rustc-env=XCA_COMPILER={version}");
    }
    if let Some(commit) = line_of("git", &["rev-parse", "--short=12", "HEAD"]) {
        println!("cargo::rustc-env=XCA_COMMIT={commit}");
    }
    println!("cargo::rerun-if-changed=build.rs");
    // Every commit and every change of branch adds a line there. A source tree without git has no such file,
    // and is not watched.
    let log = line_of("git", &["rev-parse", "--git-path", "logs/HEAD"]);
    if let Some(log) = log.filter(|log| std::path::Path::new(log).is_file()) {
        println!("cargo::rerun-if-changed={log}");
    }
}

/// What a program says in its only line; nothing if there is no such program, or it has nothing to say.
fn line_of(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let line = text.lines().next()?.trim();
    (output.status.success() && !line.is_empty()).then(|| line.to_owned())
}
