//! A table of the items of the final state, exact: [`crate::read_items`] reads it back.

use super::{Moment, OutputFile, RecordedState, Subject, View, Writer};
use crate::failure::Failure;
use crate::record::Unwritten;
use xca_io::particle_csv::{self, Column};

/// `final.csv` of the first population that is saved, `final_NAME.csv` of the others.
#[derive(Debug)]
pub(super) struct ItemTable;

fn file(subject: Subject<'_>, view: View<'_>) -> OutputFile {
    let first = subject.views().find(View::shows_items).map(|first| first.number());
    if first == Some(view.number()) {
        OutputFile::unnamed(Moment::Last, "csv")
    } else {
        OutputFile::of_view(Moment::Last, view, "csv")
    }
}

impl Writer for ItemTable {
    fn name(&self) -> &'static str {
        "csv"
    }

    fn about(&self) -> &'static str {
        "the items of the final state: final.csv"
    }

    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
        subject.views().filter(View::shows_items).map(|view| file(subject, view)).collect()
    }

    fn finish(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        for view in state.subject().views() {
            let Some(items) = state.items(view) else { continue };
            let path = state.path(&file(state.subject(), view));
            let headers = items.headers();
            let headers: Vec<&str> = headers.iter().map(String::as_str).collect();
            particle_csv::write_rows(&path, &headers, |rows| {
                let written = items.blocks(|block| {
                    let table = block.table();
                    let columns = table.iter();
                    let columns: Vec<Column<'_>> =
                        columns.map(|column| Column::Typed(column.column_type, &column.values)).collect();
                    let mut places = 0..block.labels().len();
                    Ok::<(), Unwritten>(
                        places.try_for_each(|place| rows.add(block.labels(), &columns, place))?,
                    )
                });
                written.map_err(|Unwritten(error)| error)
            })?;
        }
        Ok(())
    }
}
