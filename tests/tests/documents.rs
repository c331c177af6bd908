//! The documents speak of what is there: links, paths, tests, programs, unsafe code.

use std::fs;
use std::path::{Path, PathBuf};

type TestResult = Result<(), Box<dyn std::error::Error>>;

fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// A document of the workspace.
struct Document {
    path: PathBuf,
    text: String,
}

impl Document {
    fn all() -> Result<Vec<Self>, Box<dyn std::error::Error>> {
        let mut paths = Vec::new();
        let mut folders = vec![root(), root().join("docs")];
        for entry in fs::read_dir(root())? {
            let folder = entry?.path();
            if folder.join("Cargo.toml").exists() {
                folders.push(folder);
            }
        }
        for folder in folders {
            for entry in fs::read_dir(folder)? {
                let path = entry?.path();
                if path.extension().is_some_and(|extension| extension == "md") {
                    paths.push(path);
                }
            }
        }
        paths.into_iter().map(|path| Ok(Self { text: fs::read_to_string(&path)?, path })).collect()
    }

    /// The lines that are in no block of code.
    fn prose(&self) -> impl Iterator<Item = &str> {
        let mut in_code = false;
        self.text.lines().filter(move |line| {
            let is_fence = line.trim_start().starts_with("```");
            in_code ^= is_fence;
            !in_code && !is_fence
        })
    }

    /// What stands between backticks in the prose.
    fn quoted(&self) -> impl Iterator<Item = &str> {
        self.prose().flat_map(|line| line.split('`').skip(1).step_by(2))
    }

    /// Where the links of the prose lead, other than to the web.
    fn links(&self) -> impl Iterator<Item = &str> {
        let targets = self.prose().flat_map(|line| line.split("](").skip(1));
        targets.filter_map(|rest| rest.split([')', '#']).next()).filter(|target| !target.contains("://"))
    }

    fn name(&self) -> String {
        self.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
    }
}

/// Whether a quoted text means a file or folder of the workspace.
fn is_path(quoted: &str) -> bool {
    let Some((first, _)) = quoted.split_once('/') else { return false };
    let is_member = root().join(first).join("Cargo.toml").exists();
    (is_member || ["docs", "scripts"].contains(&first)) && !quoted.contains([' ', '<', '*'])
}

#[test]
fn links_lead_somewhere() -> TestResult {
    let mut links = 0;
    for document in Document::all()? {
        let folder = document.path.parent().map(Path::to_owned).unwrap_or_default();
        for link in document.links() {
            assert!(link.is_empty() || folder.join(link).exists(), "{}: {link}", document.name());
            links += 1;
        }
    }
    assert!(links > 20, "{links}");
    Ok(())
}

/// A path may be followed by a function: `folder/file.rs: name_of_the_test`.
#[test]
fn paths_and_functions_exist() -> TestResult {
    let (mut paths, mut functions) = (0, 0);
    for document in Document::all()? {
        for quoted in document.quoted() {
            let (path, function) = match quoted.split_once(": ") {
                Some((path, function)) => (path, Some(function)),
                None => (quoted, None),
            };
            if !is_path(path) {
                continue;
            }
            paths += 1;
            let file = root().join(path);
            assert!(file.exists(), "{}: {path}", document.name());
            if let Some(function) = function {
                functions += 1;
                let text = fs::read_to_string(file)?;
                assert!(text.contains(&format!("fn {function}(")), "{}: {quoted}", document.name());
            }
        }
    }
    assert!(paths > 50 && functions > 10, "{paths} {functions}");
    Ok(())
}

/// The commands name programs and crates that exist.
#[test]
fn commands_can_be_run() -> TestResult {
    let members = fs::read_to_string(root().join("Cargo.toml"))?;
    let mut commands = 0;
    for document in Document::all()? {
        for line in document.text.lines() {
            for command in line.split("cargo ").skip(1) {
                let words: Vec<&str> = command.split([' ', '`']).collect();
                for pair in words.windows(2) {
                    let exists = match pair {
                        ["--bin", name] => root().join(format!("examples/src/bin/{name}.rs")).exists(),
                        ["-p", name] => {
                            // `xca-tests-book` lies in `tests/book`, `xca-tests` in `tests`.
                            let folder =
                                name.strip_prefix("xca-").unwrap_or(name).replace("tests-", "tests/");
                            [folder, (*name).to_owned()]
                                .iter()
                                .any(|one| members.contains(&format!("\"{one}\"")))
                        }
                        _ => continue,
                    };
                    assert!(exists, "{}: {line}", document.name());
                    commands += 1;
                }
            }
        }
    }
    assert!(commands > 5, "{commands}");
    Ok(())
}

#[test]
fn the_program_of_the_readme_is_the_example() -> TestResult {
    let program = fs::read_to_string(root().join("examples/src/bin/life.rs"))?;
    let readme = fs::read_to_string(root().join("README.md"))?;
    assert!(readme.contains(&format!("```rust\n{program}```\n")), "the README shows another program");
    assert!(program.lines().count() <= 30, "it has {} lines", program.lines().count());
    Ok(())
}

/// The most lines of code that models have, without blank lines and comments.
const MOST_LINES: [(&str, usize); 4] = [("excitable", 30), ("boltzmann", 80), ("debris", 150), ("lava", 200)];

/// A model that grows is one for which the language lacks something.
#[test]
fn models_are_short() -> TestResult {
    for (model, most) in MOST_LINES {
        let text = fs::read_to_string(root().join(format!("examples/src/models/{model}.rs")))?;
        let is_code = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with("//");
        let lines = text.lines().filter(is_code).count();
        assert!((most / 2..=most).contains(&lines), "{model}.rs has {lines} lines; {most} are allowed");
    }
    Ok(())
}

/// docs/SUMMARY.md, from which a book is made, has all pages of docs.
#[test]
fn the_book_has_every_page() -> TestResult {
    let documents = Document::all()?;
    let summary = documents.iter().find(|document| document.name() == "SUMMARY.md").ok_or("no summary")?;
    let pages: Vec<&str> = summary.links().collect();
    let docs = root().join("docs");
    for document in documents.iter().filter(|document| document.path.starts_with(&docs)) {
        let name = document.name();
        assert!(name == "SUMMARY.md" || pages.contains(&name.as_str()), "docs/SUMMARY.md lacks {name}");
    }
    Ok(())
}

/// docs/gallery.md has a section for each program of the examples, with its file and a command that runs it.
#[test]
fn the_gallery_shows_every_program() -> TestResult {
    let gallery = fs::read_to_string(root().join("docs/gallery.md"))?;
    let mut programs = 0;
    for entry in fs::read_dir(root().join("examples/src/bin"))? {
        let path = entry?.path();
        let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        for part in [
            format!("\n## {name}\n"),
            format!("`examples/src/bin/{name}.rs`"),
            format!("--bin {name} -- run"),
        ] {
            assert!(gallery.contains(&part), "docs/gallery.md lacks {part}");
        }
        programs += 1;
    }
    assert!(programs > 10, "{programs}");
    Ok(())
}

/// docs/architecture.md lists the files with unsafe code.
#[test]
fn unsafe_code_is_where_the_architecture_says() -> TestResult {
    let architecture = fs::read_to_string(root().join("docs/architecture.md"))?;
    let mut folders: Vec<PathBuf> = fs::read_dir(root())?
        .map(|entry| entry.map(|entry| entry.path().join("src")))
        .collect::<Result<_, _>>()?;
    let mut found = 0;
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for entry in entries {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs")
                && fs::read_to_string(&path)?.contains("[allow(unsafe_code)]")
            {
                found += 1;
                let name = path.strip_prefix(root())?.to_string_lossy().replace('\\', "/");
                assert!(architecture.contains(&format!("| `{name}`")), "{name} is not listed");
            }
        }
    }
    assert!(found > 2, "{found}");
    Ok(())
}

/// The tables of methods are the list from which they are accepted, checked and written.
#[test]
fn methods_are_those_of_the_list() -> TestResult {
    for document in ["docs/guide.md", "xca-macros/docs/elementary_process.md"] {
        let text = fs::read_to_string(root().join(document))?;
        for row in xca_methods::table() {
            assert!(text.lines().any(|line| line == row), "{document} lacks the row\n{row}");
        }
    }
    Ok(())
}
