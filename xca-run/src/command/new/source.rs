//! Where a new crate gets xca from.

use std::fs;
use std::path::Path;
use toml::{Table, Value};

/// A dependency on the crate `xca`, as a manifest has it, without features.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Source(Table);

/// The keys of a dependency that say where it comes from.
const KEYS: [&str; 7] = ["path", "git", "branch", "tag", "rev", "version", "registry"];

impl Source {
    /// The folder of the crate `xca`, or of a workspace that has it.
    pub(super) fn of_path(folder: &Path) -> Option<Self> {
        let folder = [folder.join("xca"), folder.to_owned()].into_iter().find(|folder| is_xca(folder))?;
        Some(Self::one("path", &std::path::absolute(folder).ok()?.display().to_string()))
    }

    /// A git repository that has the crate.
    pub(super) fn of_git(url: &str) -> Self {
        Self::one("git", url)
    }

    /// The dependency of the nearest manifest upward from a folder, seen from `seen_from` of that folder.
    ///
    /// So a crate that is made in a checkout of xca, or beside a model, depends on the same xca.
    pub(super) fn above(folder: &Path, seen_from: &Path) -> Option<Self> {
        let mut seen_from = seen_from.to_owned();
        for folder in folder.ancestors() {
            let manifest = fs::read_to_string(folder.join("Cargo.toml")).ok();
            let manifest = manifest.and_then(|text| text.parse::<Table>().ok());
            if let Some(source) = manifest.and_then(|manifest| Self::in_manifest(&manifest, &seen_from)) {
                return Some(source);
            }
            if seen_from.is_relative() {
                seen_from.push("..");
            } else {
                seen_from.pop();
            }
        }
        None
    }

    fn in_manifest(manifest: &Table, folder: &Path) -> Option<Self> {
        let of_package = manifest.get("dependencies");
        let of_workspace = manifest.get("workspace").and_then(|workspace| workspace.get("dependencies"));
        let tables = [of_package, of_workspace].into_iter().flatten().filter_map(Value::as_table);
        let mut dependencies = tables.flatten();
        dependencies.find_map(|(name, dependency)| Self::of_dependency(name, dependency, folder))
    }

    /// What a dependency says, if it is xca and says it here.
    fn of_dependency(name: &str, dependency: &Value, folder: &Path) -> Option<Self> {
        let package = dependency.get("package").and_then(Value::as_str).unwrap_or(name);
        if package != "xca" {
            return None;
        }
        if let Some(version) = dependency.as_str() {
            return Some(Self::one("version", version));
        }
        let mut found = Table::new();
        for key in KEYS {
            if let Some(value) = dependency.get(key) {
                found.insert(key.to_owned(), value.clone());
            }
        }
        if let Some(path) = found.get("path").and_then(Value::as_str) {
            let path = folder.join(path).display().to_string();
            return Some(Self::one("path", &path));
        }
        (!found.is_empty()).then_some(Self(found))
    }

    fn one(key: &str, text: &str) -> Self {
        Self([(key.to_owned(), Value::String(text.to_owned()))].into_iter().collect())
    }

    /// The keys and values, as they stand in an inline table.
    pub(super) fn text(&self) -> String {
        let entries: Vec<String> = self.0.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        entries.join(", ")
    }

    /// As data.
    pub(super) fn table(&self) -> &Table {
        &self.0
    }
}

/// Whether a folder holds the crate `xca`.
fn is_xca(folder: &Path) -> bool {
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap_or_default();
    let manifest: Table = manifest.parse().unwrap_or_default();
    let name = manifest.get("package").and_then(|package| package.get("name"));
    name.and_then(Value::as_str) == Some("xca")
}

/// Finds xca upward from the current folder, then from the program that runs.
///
/// A version alone would not do: the name `xca` of the registry belongs to another crate.
pub(super) fn found() -> Option<Source> {
    let here = std::env::current_dir().ok();
    let program = std::env::current_exe().ok();
    found_from(here.as_deref(), program.as_deref().and_then(Path::parent))
}

/// Finds xca upward from the folder in which the new crate is made, then from that of a program.
fn found_from(here: Option<&Path>, program: Option<&Path>) -> Option<Source> {
    // The new crate stands one folder below the current one.
    let near = here.and_then(|here| Source::above(here, Path::new("..")));
    near.or_else(|| program.and_then(|folder| Source::above(folder, folder)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(folder: &Path, file: &str, text: &str) {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    #[test]
    fn the_nearest_manifest_that_says_it_is_followed() {
        let root = tempfile::tempdir().unwrap();
        let root = root.path();
        let workspace = "[workspace.dependencies]\nxca = { path = \"parts/xca\", version = \"3.0\" }";
        written(root, "Cargo.toml", workspace);
        written(root, "member/Cargo.toml", "[dependencies]\nxca = { workspace = true }\nserde = \"1\"");
        written(
            root,
            "member/git/Cargo.toml",
            "[dependencies]\nca = { package = \"xca\", git = \"g\", rev = \"r\" }",
        );
        written(root, "member/git/plain/Cargo.toml", "[dependencies]\nxca = \"0.7\"");
        let text =
            |folder: &str, seen_from: &Path| Source::above(&root.join(folder), seen_from).unwrap().text();
        let below = Path::new("..");
        assert_eq!(text("", below), "path = \"../parts/xca\"");
        assert_eq!(text("member/src", below), "path = \"../../../parts/xca\"");
        let absolute = root.join("member");
        assert_eq!(text("member", &absolute), format!("path = \"{}\"", root.join("parts/xca").display()));
        assert_eq!(text("member/git/src/bin", below), "git = \"g\", rev = \"r\"");
        assert_eq!(text("member/git/plain", below), "version = \"0.7\"");
    }

    #[test]
    fn the_current_folder_comes_before_the_program_and_nothing_after_it() {
        let root = tempfile::tempdir().unwrap();
        let root = root.path();
        written(root, "here/Cargo.toml", "[dependencies]\nxca = { path = \"near\" }");
        written(root, "program/Cargo.toml", "[dependencies]\nxca = { path = \"far\" }");
        written(root, "other/Cargo.toml", "[dependencies]\nserde = \"1\"");
        let [here, program, other] = ["here", "program", "other"].map(|folder| root.join(folder));
        let text = |here, program| found_from(here, program).map(|source| source.text());
        assert_eq!(text(Some(&*here), Some(&*program)).as_deref(), Some("path = \"../near\""));
        let far = format!("path = \"{}\"", program.join("far").display());
        assert_eq!(text(Some(&*other), Some(&*program)), Some(far));
        assert_eq!(text(Some(&*other), Some(&*other)), None);
        assert_eq!(text(None, None), None);
    }

    #[test]
    fn a_folder_must_have_the_crate() {
        let root = tempfile::tempdir().unwrap();
        written(root.path(), "checkout/xca/Cargo.toml", "[package]\nname = \"xca\"");
        written(root.path(), "other/Cargo.toml", "[package]\nname = \"xca-like\"");
        let path = root.path().join("checkout/xca").display().to_string();
        for folder in ["checkout", "checkout/xca"] {
            assert_eq!(Source::of_path(&root.path().join(folder)), Some(Source::one("path", &path)));
        }
        assert_eq!(Source::of_path(&root.path().join("other")), None);
    }
}
