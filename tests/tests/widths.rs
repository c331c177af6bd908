//! Text that people read fits in 110 columns: comments, and pages.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

const MOST_COLUMNS: usize = 110;

/// Folders with what is not ours to set, or is set by others.
const LEFT_OUT: [&str; 5] = ["target", "out", ".git", "node_modules", "misuse"];

fn files(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if path.is_dir() {
            if !LEFT_OUT.contains(&name) {
                self::files(&path, files)?;
            }
        } else if path.extension().is_some_and(|kind| ["rs", "wgsl", "md"].iter().any(|one| kind == *one)) {
            files.push(path);
        }
    }
    Ok(())
}

/// What cannot be broken: a row of a table, and one long word such as a link.
fn is_in_one_piece(text: &str) -> bool {
    text.starts_with('|') || text.split_whitespace().any(|word| word.len() > MOST_COLUMNS / 2)
}

#[test]
fn text_is_no_wider_than_a_page() -> Result<(), Box<dyn Error>> {
    let mut all = Vec::new();
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."), &mut all)?;
    let (mut lines, mut wide) = (0, Vec::new());
    for path in &all {
        let is_page = path.extension().is_some_and(|kind| kind == "md");
        let mut is_code = false;
        for (number, line) in fs::read_to_string(path)?.lines().enumerate() {
            is_code ^= is_page && line.starts_with("```");
            let text = if is_page { Some(line) } else { line.trim_start().strip_prefix("//") };
            let text = text.map(|text| text.trim_start_matches(['/', '!']).trim_start());
            let Some(text) = text.filter(|_| !is_code) else { continue };
            lines += 1;
            if line.chars().count() > MOST_COLUMNS && !is_in_one_piece(text) {
                wide.push(format!("{}:{}", path.display(), number + 1));
            }
        }
    }
    assert!(all.len() > 500 && lines > 10_000, "{} files, {lines} lines", all.len());
    assert!(wide.is_empty(), "wider than {MOST_COLUMNS} columns:\n{}", wide.join("\n"));
    Ok(())
}
