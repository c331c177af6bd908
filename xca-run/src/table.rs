//! Tables on the terminal.

use comfy_table::{CellAlignment, ContentLineStyle, LineStyle, Row, Table, TableStyle};
use std::fmt::Write;

/// A table with a line below its header; the columns with these numbers are aligned to the right. Lines do not end in blanks, and there is no
/// line end after the last.
pub(crate) fn table(
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
