//! How the user started this program, for hints that name a command.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// A command of this program that the user can paste, such as `./life resume out/life`. Without the words of
/// the process it starts with the name of the program.
pub(crate) fn command(name: &str, words: &[&str]) -> String {
    let start = Start::of_process().map_or_else(|| name.to_owned(), |start| start.words());
    [start].into_iter().chain(words.iter().copied().map(quoted)).collect::<Vec<_>>().join(" ")
}

/// The command of this program that resumes a run.
pub(crate) fn resume(name: &str, folder: &Path) -> String {
    command(name, &["resume", &folder.display().to_string()])
}

/// How a process was started.
#[derive(Debug, Clone)]
struct Start {
    /// The first word of the command line.
    typed: String,
    executable: PathBuf,
    directory: PathBuf,
    /// The package, where `cargo run` started the process.
    package: Option<Package>,
}

#[derive(Debug, Clone)]
struct Package {
    name: String,
    folder: PathBuf,
}

impl Start {
    fn of_process() -> Option<Self> {
        let package = env::var_os("CARGO").and_then(|_| {
            let folder = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR")?);
            Some(Package { name: env::var("CARGO_PKG_NAME").unwrap_or_default(), folder })
        });
        Some(Self {
            typed: env::args_os().next()?.into_string().ok()?,
            executable: env::current_exe().unwrap_or_default(),
            directory: env::current_dir().unwrap_or_default(),
            package,
        })
    }

    /// The words that start the program again.
    fn words(&self) -> String {
        self.of_cargo().unwrap_or_else(|| quoted(&self.typed))
    }

    /// The words where `cargo run` started it. The folder of the executable tells the profile.
    fn of_cargo(&self) -> Option<String> {
        let package = self.package.as_ref()?;
        let profile = match self.executable.parent()?.file_name()?.to_str()? {
            "release" => " --release",
            "debug" => "",
            _ => return None,
        };
        let file = self.executable.file_name()?.to_str()?;
        let program = file.strip_suffix(env::consts::EXE_SUFFIX).unwrap_or(file);
        let is_alone = self.directory.starts_with(&package.folder) && package.is_of(program);
        let choice = if is_alone { String::new() } else { format!(" --bin {program}") };
        Some(format!("cargo run{profile}{choice} --"))
    }
}

impl Package {
    /// Whether this is the only program of the package.
    fn is_of(&self, program: &str) -> bool {
        let manifest = fs::read_to_string(self.folder.join("Cargo.toml")).unwrap_or_default();
        let source = self.folder.join("src");
        self.name == program
            && source.join("main.rs").is_file()
            && !source.join("bin").exists()
            && !manifest.contains("[[bin]]")
    }
}

/// A word with blanks goes between quotation marks.
fn quoted(word: &str) -> String {
    if word.contains(char::is_whitespace) { format!("\"{word}\"") } else { word.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn start(typed: &str, executable: &str) -> Start {
        Start {
            typed: typed.to_owned(),
            executable: executable.into(),
            directory: "/home/me".into(),
            package: None,
        }
    }

    #[test]
    fn a_program_is_named_as_it_was_typed() {
        for typed in ["cadem", "./cadem", "target/release/cadem"] {
            assert_eq!(start(typed, "/home/me/target/release/cadem").words(), typed);
        }
        assert_eq!(start("my models/cadem", "/home/me/my models/cadem").words(), "\"my models/cadem\"");
    }

    #[test]
    fn cargo_is_named_where_it_started_the_program() {
        let package = Package { name: "models".to_owned(), folder: "/home/me/models".into() };
        let by_cargo = |executable: &str| {
            Start { package: Some(package.clone()), ..start("target/cadem", executable) }.words()
        };
        assert_eq!(by_cargo("/home/me/target/release/cadem"), "cargo run --release --bin cadem --");
        assert_eq!(by_cargo("/home/me/target/debug/cadem"), "cargo run --bin cadem --");
        assert_eq!(by_cargo("/usr/bin/cadem"), "target/cadem");
    }

    #[test]
    fn the_only_program_of_a_package_needs_no_name() {
        let folder = tempfile::tempdir().unwrap();
        let write = |file: &str, text: &str| {
            let path = folder.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        };
        write("Cargo.toml", "[package]\nname = \"waves\"\n");
        write("src/main.rs", "");
        let package = Package { name: "waves".to_owned(), folder: folder.path().to_owned() };
        let here = Start {
            directory: folder.path().to_owned(),
            package: Some(package),
            ..start("target/release/waves", "/tmp/target/release/waves")
        };
        assert_eq!(here.words(), "cargo run --release --");
        let elsewhere = Start { directory: "/".into(), ..here.clone() };
        assert_eq!(elsewhere.words(), "cargo run --release --bin waves --");
        write("src/bin/other.rs", "");
        assert_eq!(here.words(), "cargo run --release --bin waves --");
    }
}
