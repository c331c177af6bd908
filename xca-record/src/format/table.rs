//! A table of the items of the final state, exact: [`crate::read_items`] reads it back.

use super::{Moment, OutputFile, RecordedState, Subject, View, Writer};
use crate::failure::Failure;
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
            let Some(items) = state.items(view)? else { continue };
            let table = items.table();
            let columns: Vec<(&str, Column<'_>)> = table
                .iter()
                .map(|column| (column.header.as_str(), Column::Typed(column.column_type, &column.values)))
                .collect();
            particle_csv::write(&state.path(&file(state.subject(), view)), items.labels(), &columns)?;
        }
        Ok(())
    }
}
