//! The report as Markdown.

use super::sheets::{self, Sheet};
use std::fmt::Write;
use xca_compare::ComparisonReport;

pub(super) fn markdown(comparison: &ComparisonReport) -> String {
    let mut out = format!("# {}\n\n**{}**\n", sheets::headline(comparison), comparison.verdict);
    // Writing to a string cannot fail.
    let _ = list(&mut out, sheets::findings(comparison));
    if comparison.differs() {
        let _ = write!(out, "\n{}\n", sheets::CHAOS);
    }
    let _ = list(&mut out, sheets::notes(comparison));
    for sheet in sheets::all(comparison) {
        let _ = write!(out, "\n## {}\n\n{}", sheet.title, table(&sheet));
    }
    let _ = write!(out, "\n## Circumstances\n");
    let _ = list(
        &mut out,
        sheets::circumstances(comparison).iter().map(|(name, value)| format!("{name}: {value}")),
    );
    out
}

fn list(out: &mut String, lines: impl IntoIterator<Item = String>) -> std::fmt::Result {
    for (index, line) in lines.into_iter().enumerate() {
        writeln!(out, "{}- {}", if index == 0 { "\n" } else { "" }, escaped(&line))?;
    }
    Ok(())
}

/// What Markdown would read as more than text.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        if "\\`*_[]<>|#".contains(character) {
            out.push('\\');
        }
        out.push(character);
    }
    out
}

fn table(sheet: &Sheet) -> String {
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| escaped(cell)).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let rules =
        (0..sheet.header.len()).map(|column| if sheet.right.contains(&column) { "---:" } else { "---" });
    let rule = format!("| {} |\n", rules.collect::<Vec<_>>().join(" | "));
    let rows = sheet.rows.iter().map(|row| line(row));
    [line(&sheet.header), rule].into_iter().chain(rows).collect()
}
