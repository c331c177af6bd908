//! No files of a crate use each other in a circle.

mod components;
mod modules;

use components::circles;
use modules::Crate;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use toml::Table;

fn root() -> Result<PathBuf, std::io::Error> {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()
}

/// The roots of the crates in a folder of sources.
fn roots(member: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let mut roots = vec![member.join("src/lib.rs"), member.join("src/main.rs")];
    for folder in ["src/bin", "tests", "benches"] {
        let Ok(entries) = fs::read_dir(member.join(folder)) else { continue };
        for entry in entries {
            let path = entry?.path();
            let is_source = path.extension().is_some_and(|extension| extension == "rs");
            roots.push(if is_source { path } else { path.join("main.rs") });
        }
    }
    roots.retain(|root| root.exists());
    Ok(roots)
}

#[test]
fn no_files_use_each_other_in_a_circle() -> Result<(), Box<dyn Error>> {
    let top = root()?;
    let workspace: Table = fs::read_to_string(top.join("Cargo.toml"))?.parse()?;
    let members = workspace["workspace"]["members"].as_array().ok_or("no members")?;
    let mut found = 0;
    for member in members {
        let member = top.join(member.as_str().ok_or("a member without a name")?);
        for root in roots(&member)? {
            let uses = Crate::read(&root)?.uses();
            for circle in circles(&uses) {
                found += 1;
                println!("circle {} {}", found, circle.len());
                for file in &circle {
                    let there: Vec<String> = uses[*file]
                        .iter()
                        .filter(|other| circle.contains(other))
                        .map(|o| o.strip_prefix(&top).unwrap().display().to_string())
                        .collect();
                    println!("   {} -> {}", file.strip_prefix(&top)?.display(), there.join(", "));
                }
            }
        }
    }
    assert_eq!(found, 0);
    Ok(())
}
