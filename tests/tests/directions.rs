//! Who may depend on whom, and where unsafe code may stand: read from the workspace itself.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

type TestResult = Result<(), Box<dyn Error>>;

/// For each member, the members that it may depend on. A new member finds its place here first.
const DIRECTIONS: [(&str, &[&str]); 38] = [
    ("xca-methods", &[]),
    ("xca-spelling", &[]),
    ("xca-fields", &[]),
    ("xca-macros", &["xca-fields", "xca-methods", "xca-spelling"]),
    ("xca-values", &[]),
    ("xca-space", &["xca-values"]),
    ("xca-process", &["xca-macros", "xca-methods", "xca-space", "xca-values"]),
    ("xca-core", &["xca-macros", "xca-process", "xca-values"]),
    ("xca-wgsl", &["xca-core", "xca-methods"]),
    ("xca-pace", &[]),
    ("xca-wavefront", &[]),
    ("xca-cpu", &["xca-core", "xca-pace", "xca-wavefront"]),
    ("xca-gpu", &["xca-core", "xca-wgsl"]),
    ("xca-parts", &["xca-core"]),
    ("xca-mpi", &["xca-core", "xca-parts"]),
    ("xca-io", &[]),
    ("xca-machine", &["xca-io"]),
    ("xca-picture", &["xca-io"]),
    ("xca-checkpoint", &["xca-core", "xca-io", "xca-wgsl"]),
    ("xca-observe", &["xca-core", "xca-checkpoint"]),
    ("xca-record", &["xca-core", "xca-io", "xca-machine", "xca-checkpoint", "xca-observe", "xca-picture"]),
    ("xca-compare", &["xca-core", "xca-machine", "xca-checkpoint", "xca-record"]),
    ("xca-ensemble", &["xca-core", "xca-io", "xca-checkpoint", "xca-record"]),
    ("xca-report", &["xca-core", "xca-io", "xca-checkpoint", "xca-record", "xca-compare", "xca-ensemble"]),
    ("xca-watch", &["xca-core", "xca-io", "xca-picture", "xca-record"]),
    (
        "xca-run",
        &[
            "xca-core",
            "xca-cpu",
            "xca-gpu",
            "xca-parts",
            "xca-mpi",
            "xca-io",
            "xca-machine",
            "xca-checkpoint",
            "xca-picture",
            "xca-record",
            "xca-compare",
            "xca-ensemble",
            "xca-report",
            "xca-watch",
        ],
    ),
    (
        "xca",
        &[
            "xca-core",
            "xca-cpu",
            "xca-gpu",
            "xca-parts",
            "xca-io",
            "xca-picture",
            "xca-record",
            "xca-compare",
            "xca-ensemble",
            "xca-run",
        ],
    ),
    ("cadem", &["xca-core"]),
    ("xca-examples", &["xca-core", "xca-run", "xca", "cadem"]),
    ("new-model", &["xca"]),
    ("xca-tests-additions", &["xca"]),
    ("xca-tests-library", &["xca"]),
    ("xca-tests-book", &[]),
    (
        "xca-tests-fuzz",
        &["xca-core", "xca-checkpoint", "xca-ensemble", "xca-io", "xca-picture", "xca-record", "xca-run"],
    ),
    ("xca-tests-memory", &["xca-core", "xca-cpu", "xca-parts"]),
    ("xca-benchmarks", &["xca-core", "xca-cpu", "xca-gpu", "xca-parts", "xca-io", "cadem", "xca-examples"]),
    (
        "xca-tests",
        &[
            "xca-methods",
            "xca-core",
            "xca-cpu",
            "xca-gpu",
            "xca-parts",
            "xca-run",
            "xca-wgsl",
            "xca",
            "cadem",
            "xca-examples",
        ],
    ),
    ("xca-tests-renamed", &["xca"]),
];

/// Members that may use nothing from elsewhere but this.
const FEW_FRIENDS: [(&str, &[&str]); 5] = [
    ("xca-values", &["bytemuck", "serde", "thiserror"]),
    ("xca-space", &["serde", "thiserror"]),
    ("xca-process", &["bytemuck", "serde", "thiserror"]),
    ("xca-core", &["bytemuck", "serde", "thiserror"]),
    ("cadem", &["serde", "thiserror"]),
];

/// The members that name no engine.
const WITHOUT_ENGINES: [&str; 5] = ["xca-values", "xca-space", "xca-process", "xca-core", "cadem"];

/// What drives threads and devices, and the members that may: engines, and the benchmarks, which measure
/// loops by hand.
const DRIVERS: [(&str, &[&str]); 2] = [("rayon", &["xca-cpu", "xca-benchmarks"]), ("wgpu", &["xca-gpu"])];

/// The engines; none may know of another.
const ENGINES: [&str; 3] = ["xca-cpu", "xca-gpu", "xca-parts"];

/// No member has more lines of source than this, without those of its tests.
const MOST_LINES: usize = 7000;

/// No file has more lines than this, those of tests included.
const MOST_LINES_OF_A_FILE: usize = 450;

/// The files that argue for unsafe code.
const UNSAFE: [&str; 20] = [
    "xca-process/src/kernel/cells.rs",
    "xca-process/src/kernel/distance.rs",
    "xca-process/src/kernel/requests.rs",
    "xca-process/src/kernel/row.rs",
    "xca-process/src/kernel/search.rs",
    "xca-process/src/kernel/values.rs",
    "xca-process/src/kernel/wide.rs",
    "xca-process/src/kernel/work.rs",
    "xca-process/src/kernel/written.rs",
    "xca-core/src/reference/pass.rs",
    "xca-values/src/vector.rs",
    "xca-cpu/src/rows/halo.rs",
    "xca-cpu/src/rows/pass.rs",
    "xca-cpu/src/rows/pieces.rs",
    "xca-cpu/src/rows/prepared.rs",
    "xca-cpu/src/rows/search.rs",
    "xca-gpu/src/device/instance.rs",
    "xca-gpu/src/device/passthrough.rs",
    "xca-machine/src/allocation.rs",
    "xca-mpi/src/sending.rs",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A member of the workspace.
struct Member {
    folder: PathBuf,
    name: String,
    manifest: Table,
}

impl Member {
    fn all() -> Result<Vec<Self>, Box<dyn Error>> {
        let workspace: Table = fs::read_to_string(root().join("Cargo.toml"))?.parse()?;
        let members = workspace["workspace"]["members"].as_array().ok_or("no members")?;
        let mut all = Vec::new();
        for member in members {
            let folder = root().join(member.as_str().ok_or("a member without a name")?);
            let manifest: Table = fs::read_to_string(folder.join("Cargo.toml"))?.parse()?;
            let name = manifest["package"]["name"].as_str().ok_or("a package without a name")?.to_owned();
            all.push(Self { folder, name, manifest });
        }
        Ok(all)
    }

    /// The names of the packages in these tables, also in those for some targets only.
    fn packages(&self, kinds: &[&str]) -> Vec<String> {
        let targets = self.manifest.get("target").and_then(Value::as_table);
        let tables = targets.into_iter().flat_map(|targets| targets.values().filter_map(Value::as_table));
        let mut packages = Vec::new();
        for table in tables.chain([&self.manifest]) {
            for dependencies in kinds.iter().filter_map(|kind| table.get(*kind)?.as_table()) {
                for (name, about) in dependencies {
                    let renamed = about.get("package").and_then(Value::as_str);
                    packages.push(renamed.unwrap_or(name).to_owned());
                }
            }
        }
        packages
    }

    /// What the member itself needs; tests of it may need more.
    fn needs(&self) -> Vec<String> {
        self.packages(&["dependencies", "build-dependencies"])
    }

    fn sources(&self, folder: &str) -> Result<Vec<(String, String)>, Box<dyn Error>> {
        let mut folders = vec![self.folder.join(folder)];
        let mut sources = Vec::new();
        while let Some(folder) = folders.pop() {
            let Ok(entries) = fs::read_dir(&folder) else { continue };
            for entry in entries {
                let path = entry?.path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|extension| extension == "rs") {
                    let name = path.strip_prefix(root())?.to_string_lossy().replace('\\', "/");
                    sources.push((name, fs::read_to_string(&path)?));
                }
            }
        }
        Ok(sources)
    }
}

/// Whether the text has the word, not as a part of another one.
fn has_word(text: &str, word: &str) -> bool {
    let part = |character: char| character.is_alphanumeric() || character == '_';
    text.match_indices(word).any(|(at, _)| {
        let (before, after) = (text[..at].chars().next_back(), text[at + word.len()..].chars().next());
        !before.is_some_and(part) && !after.is_some_and(part)
    })
}

/// The code without comments and without what stands between quotes, line by line.
fn code(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    lines.map(|line| line.split('"').step_by(2).collect::<String>() + "\n").collect()
}

/// Whether the code has something unsafe, or allows itself to.
fn has_unsafe(code: &str) -> bool {
    let after = ["{", "fn ", "impl ", "impl<", "trait ", "extern "];
    let unsafely = code.split("unsafe ").skip(1).any(|rest| after.iter().any(|word| rest.starts_with(word)));
    unsafely || ["allow(unsafe_code", "expect(unsafe_code"].iter().any(|words| code.contains(words))
}

#[test]
fn members_depend_only_on_those_below() -> TestResult {
    let members = Member::all()?;
    let names: Vec<&str> = members.iter().map(|member| member.name.as_str()).collect();
    for member in &members {
        let allowed = DIRECTIONS.iter().find(|(name, _)| *name == member.name);
        let (_, allowed) =
            allowed.ok_or_else(|| format!("`{}` has no place among the members", member.name))?;
        for package in member.needs() {
            let known = names.contains(&package.as_str());
            assert!(
                !known || allowed.contains(&package.as_str()),
                "`{}` depends on `{package}`",
                member.name
            );
        }
    }
    Ok(())
}

#[test]
fn the_core_and_the_models_have_few_friends() -> TestResult {
    let members = Member::all()?;
    for (name, friends) in FEW_FRIENDS {
        let member = members.iter().find(|member| member.name == name).ok_or(name)?;
        for package in member.needs() {
            let known = members.iter().any(|member| member.name == package);
            assert!(known || friends.contains(&package.as_str()), "`{name}` depends on `{package}`");
        }
    }
    Ok(())
}

#[test]
fn engines_do_not_know_each_other() -> TestResult {
    for member in Member::all()? {
        let all = member.packages(&["dependencies", "build-dependencies", "dev-dependencies"]);
        for engine in ENGINES {
            // Not even in their tests; and the models and the core not in theirs.
            let apart = ENGINES.contains(&member.name.as_str()) || WITHOUT_ENGINES.contains(&&*member.name);
            assert!(!apart || !all.contains(&engine.to_owned()), "`{}` knows `{engine}`", member.name);
        }
        for (driver, allowed) in DRIVERS {
            let uses = all.contains(&driver.to_owned());
            assert!(!uses || allowed.contains(&&*member.name), "`{}` depends on `{driver}`", member.name);
        }
    }
    Ok(())
}

#[test]
fn the_core_and_the_models_name_no_engine() -> TestResult {
    for member in Member::all()?.iter().filter(|member| WITHOUT_ENGINES.contains(&&*member.name)) {
        let mut sources = member.sources("src")?;
        sources.extend(member.sources("tests")?);
        assert!(sources.len() > 5);
        for (name, text) in sources {
            for word in ["rayon", "wgpu", "xca_cpu", "xca_gpu", "Cpu"] {
                assert!(!has_word(&text, word), "{name} has the word `{word}`");
            }
        }
    }
    Ok(())
}

#[test]
fn unsafe_code_stands_where_it_is_argued_for() -> TestResult {
    let mut found = Vec::new();
    for member in Member::all()? {
        let inherits = member.manifest.get("lints").and_then(|lints| lints.get("workspace"));
        assert_eq!(inherits.and_then(Value::as_bool), Some(true), "`{}` has lints of its own", member.name);
        for folder in ["src", "tests", "examples", "benches"] {
            for (name, text) in member.sources(folder)? {
                // What must not compile is no code.
                if name.contains("/tests/misuse/") || name == "tests/tests/directions.rs" {
                    continue;
                }
                if has_unsafe(&code(&text)) {
                    assert!(UNSAFE.contains(&&*name), "{name} has unsafe code");
                    found.push(name);
                }
            }
        }
    }
    for file in UNSAFE {
        assert!(found.iter().any(|name| name == file), "{file} has no unsafe code; take it from the list");
    }
    let workspace: Table = fs::read_to_string(root().join("Cargo.toml"))?.parse()?;
    assert_eq!(workspace["workspace"]["lints"]["rust"]["unsafe_code"].as_str(), Some("deny"));
    Ok(())
}

/// The lines of a source file before its own module of tests.
fn lines(text: &str) -> usize {
    text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().lines().count()
}

#[test]
fn no_member_is_large() -> TestResult {
    for member in Member::all()? {
        let sources = member.sources("src")?;
        let own = sources.iter().filter(|(name, _)| !name.contains("/tests/") && !name.ends_with("tests.rs"));
        let count: usize = own.map(|(_, text)| lines(text)).sum();
        assert!(count <= MOST_LINES, "`{}` has {count} lines", member.name);
    }
    Ok(())
}

#[test]
fn no_file_is_long() -> TestResult {
    let mut count = 0;
    for member in Member::all()? {
        for (name, text) in member.sources("")? {
            let lines = text.lines().count();
            assert!(lines <= MOST_LINES_OF_A_FILE, "{name} has {lines} lines");
            count += 1;
        }
    }
    assert!(count > 500, "{count} files are not the workspace");
    Ok(())
}

#[test]
fn words_and_code() {
    assert_eq!(lines("one\ntwo\n#[cfg(test)]\nmod tests {\nthree"), 2);
    assert!(has_word("use rayon::prelude", "rayon") && has_word("(rayon)", "rayon"));
    assert!(!has_word("crayons", "rayon") && !has_word("rayon_core", "rayon"));
    assert_eq!(code("let a = \"unsafe\"; // unsafe\nunsafe {}"), "let a = ; \nunsafe {}\n");
    assert!(has_unsafe("pub unsafe fn a()") && has_unsafe("#![allow(unsafe_code)]"));
    assert!(!has_unsafe("yield unsafe as") && !has_unsafe("#![forbid(unsafe_code)]"));
}
