//! No files of a crate use each other in a circle.
//!
//! A file uses another one if its code names something that the other one defines. The name is followed
//! through re-exports to its definition. So a parent that only declares and re-exports its children is in no
//! circle with them. Modules that are compiled for tests only do not count. Methods do not count either: a
//! file may hold more methods of a type that another file defines.
//!
//! A circle that stays is named in `known.rs`, with its reason.

mod components;
mod known;
mod modules;

use components::circles;
use known::{KNOWN, Known};
use modules::Crate;
use std::collections::BTreeSet;
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

/// A circle by the names of its files, and what its files use of each other.
struct Circle {
    files: BTreeSet<String>,
    uses: String,
}

fn all_circles() -> Result<Vec<Circle>, Box<dyn Error>> {
    let top = root()?;
    let workspace: Table = fs::read_to_string(top.join("Cargo.toml"))?.parse()?;
    let members = workspace["workspace"]["members"].as_array().ok_or("no members")?;
    let name = |file: &Path| file.strip_prefix(&top).unwrap_or(file).display().to_string();
    let mut all = Vec::new();
    for member in members {
        for root in roots(&top.join(member.as_str().ok_or("a member without a name")?))? {
            let uses = Crate::read(&root)?.uses();
            for circle in circles(&uses) {
                let mut text = String::new();
                for file in &circle {
                    for (other, names) in uses[*file].iter().filter(|(other, _)| circle.contains(other)) {
                        let names: Vec<&str> = names.iter().map(String::as_str).collect();
                        text += &format!("  {} uses {}: {}\n", name(file), name(other), names.join(", "));
                    }
                }
                all.push(Circle { files: circle.into_iter().map(|file| name(file)).collect(), uses: text });
            }
        }
    }
    Ok(all)
}

#[test]
fn no_files_use_each_other_in_a_circle() -> Result<(), Box<dyn Error>> {
    let found = all_circles()?;
    let is_known = |circle: &Circle, known: &Known| {
        circle.files.iter().all(|file| known.files.iter().any(|name| known.path(name) == *file))
    };
    let new: Vec<&str> = found
        .iter()
        .filter(|circle| !KNOWN.iter().any(|known| is_known(circle, known)))
        .map(|circle| circle.uses.as_str())
        .collect();
    assert!(new.is_empty(), "{} circles of files:\n{}", new.len(), new.join("\n"));
    for known in KNOWN {
        let is_there = found.iter().any(|circle| is_known(circle, known));
        assert!(is_there, "there is no circle of {:?} any more; take it from the list", known.files);
    }
    Ok(())
}
