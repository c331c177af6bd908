//! Tables on the terminal.

use comfy_table::{CellAlignment, ContentLineStyle, LineStyle, Row, Table, TableStyle};
use std::fmt::Write;

/// A table with a line below its header; the columns with these numbers are aligned to the right. Lines do
/// not end in blanks, and there is no line end after the last.
pub fn table(
    header: impl Into<Row>,
    rows: impl IntoIterator<Item = impl Into<Row>>,
    right: &[usize],
) -> String {
    let line = LineStyle::none().fill('─').junction('─');
    let plain = ContentLineStyle::none();
    let mut table = Table::new();
    table.load_style(TableStyle::new().header_lines(plain).header_separator(line).content_lines(plain));
    table.set_header(header);
    for row in rows {
        table.add_row(row);
    }
    for column in right {
        if let Some(column) = table.column_mut(*column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    let mut out = String::new();
    for line in table.lines() {
        // Writing to a string cannot fail.
        let _ = write!(out, "{}{}", if out.is_empty() { "" } else { "\n" }, line.trim_end());
    }
    out
}

/// A table within a width. What does not fit of its last columns stands below each row, indented.
pub fn table_within(width: usize, header: &[String], rows: &[Vec<String>], right: &[usize]) -> String {
    let of = |row: &[String], columns: usize| row[..columns.min(row.len())].to_vec();
    let narrowed = |columns: usize| {
        let rows = rows.iter().map(|row| of(row, columns));
        table(of(header, columns), rows, right)
    };
    let is_narrow = |text: &str| text.lines().all(|line| line.chars().count() <= width);
    let mut columns = header.len();
    let mut text = narrowed(columns);
    while columns > 1 && !is_narrow(&text) {
        columns -= 1;
        text = narrowed(columns);
    }
    let mut lines = text.lines();
    let mut out: Vec<String> = lines.by_ref().take(2).map(str::to_owned).collect();
    for (line, row) in lines.zip(rows) {
        out.push(line.to_owned());
        let rest =
            header.iter().zip(row).skip(columns).filter(|(_, value)| !["", "–"].contains(&value.as_str()));
        let rest: Vec<String> = rest.map(|(name, value)| format!("{name}: {value}")).collect();
        out.extend(wrapped(&rest.join("; "), width - 4).into_iter().map(|line| format!("    {line}")));
    }
    out.join("\n")
}

/// Columns that a terminal has.
pub const WIDTH: usize = 80;

/// A table in which notes stand below each row, indented.
pub fn table_with_notes<const COLUMNS: usize>(
    header: [&str; COLUMNS],
    rows: impl IntoIterator<Item = ([String; COLUMNS], Vec<String>)>,
) -> String {
    let (rows, notes): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
    let bare = table(header, rows, &[]);
    let mut lines = bare.lines();
    let mut out: Vec<String> = lines.by_ref().take(2).map(str::to_owned).collect();
    for (line, notes) in lines.zip(notes) {
        out.push(line.to_owned());
        out.extend(notes.iter().flat_map(|note| wrapped(note, WIDTH - 4)).map(|line| format!("    {line}")));
    }
    out.join("\n")
}

/// The words of a text in lines of at most so many characters, where no word is longer.
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_stand_below_their_rows() {
        let long = "word ".repeat(30);
        let rows = [
            (["a".to_owned(), "1".to_owned()], vec![long, "last".to_owned()]),
            (["b".to_owned(), "2".to_owned()], Vec::new()),
        ];
        let text = table_with_notes(["name", "value"], rows);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 7, "{text}");
        assert!(lines[2].starts_with(" a") && lines[6].starts_with(" b"), "{text}");
        assert_eq!(lines[3].chars().count(), 4 + 15 * 5 - 1, "{text}");
        assert_eq!([lines[4].len(), lines[5].len()], [4 + 15 * 5 - 1, 8], "{text}");
    }

    #[test]
    fn what_does_not_fit_stands_below() {
        let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<Vec<String>>();
        let header = words(&["engine", "ulp", "worst in"]);
        let rows = [words(&["cpu", "12", "cell [10, 20, 3]"]), words(&["gpu", "0", "–"])];
        let wide = table_within(80, &header, &rows, &[1]);
        assert_eq!(wide, table(header.clone(), rows.clone(), &[1]));
        let narrow = table_within(30, &header, &rows, &[1]);
        let lines: Vec<&str> = narrow.lines().collect();
        assert_eq!(lines.len(), 5, "{narrow}");
        assert_eq!(lines[3], "    worst in: cell [10, 20, 3]");
        assert!(lines[0].ends_with("ulp") && lines[2].ends_with("12") && lines[4].ends_with('0'), "{narrow}");
    }

    #[test]
    fn a_word_that_is_too_long_has_a_line_of_its_own() {
        assert_eq!(wrapped("a incomprehensible b", 5), ["a", "incomprehensible", "b"]);
        assert!(wrapped(" ", 5).is_empty());
    }
}
