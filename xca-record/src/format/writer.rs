//! What a format has to do.

use super::{Moment, OutputFile, RecordedState, ResumedRun, SavedState, SavedView, Subject, View};
use crate::failure::Failure;
use serde_json::Value;
use std::fmt;
use std::path::Path;

/// A format in which the states of a run are written.
///
/// The frame does the rest with what [`Self::files`] lists: `run.json` tells these files, files of others
/// under their names are never replaced, a new run removes those of the one before, and a run that is resumed
/// those that come after its checkpoint.
///
/// ```
/// use std::path::Path;
/// use xca_record::format::{Moment, OutputFile, RecordedState, Subject, Writer};
/// use xca_record::Failure;
///
/// /// The number of items in each state, as a text.
/// #[derive(Debug)]
/// struct Counts;
///
/// impl Writer for Counts {
///     fn name(&self) -> &'static str {
///         "counts"
///     }
///
///     fn about(&self) -> &'static str {
///         "the number of items in each state"
///     }
///
///     fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
///         let views = subject.views().filter(|view| view.shows_items());
///         views.map(|view| OutputFile::of_view(Moment::Each, view, "txt")).collect()
///     }
///
///     fn record(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
///         for view in state.subject().views() {
///             if let Some(items) = state.items(view) {
///                 let file = OutputFile::of_view(Moment::Each, view, "txt");
///                 std::fs::write(state.path(&file), items.count()?.to_string())?;
///             }
///         }
///         Ok(())
///     }
/// }
/// ```
pub trait Writer: fmt::Debug + Send + Sync {
    /// The word by which a command line names it, such as `vtk`.
    fn name(&self) -> &'static str;

    /// What it writes, for help: a few words without a full stop.
    fn about(&self) -> &'static str;

    /// Refuses a model that the format cannot hold, before anything runs.
    ///
    /// # Errors
    /// Why it cannot.
    fn check(&self, _subject: Subject<'_>) -> Result<(), Failure> {
        Ok(())
    }

    /// All files that it makes of a run.
    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile>;

    /// Writes the files of the first state, after [`Self::record`].
    ///
    /// # Errors
    /// Where a file cannot be written; so with all that follows.
    fn begin(&mut self, _state: RecordedState<'_>) -> Result<(), Failure> {
        Ok(())
    }

    /// Writes the files that each recorded state has, and goes on with those of the run. The initial and the
    /// final state are among them.
    ///
    /// # Errors
    /// As [`Self::begin`].
    fn record(&mut self, _state: RecordedState<'_>) -> Result<(), Failure> {
        Ok(())
    }

    /// Writes the files of the final state, after [`Self::record`].
    ///
    /// # Errors
    /// As [`Self::begin`].
    fn finish(&mut self, _state: RecordedState<'_>) -> Result<(), Failure> {
        Ok(())
    }

    /// What it has to know to go on after a checkpoint, which keeps it.
    fn memory(&self) -> Value {
        Value::Null
    }

    /// Goes on after the last of these steps, of whose states all files are there, with what it knew then.
    ///
    /// # Errors
    /// Where the memory is not its own, or a file cannot be written.
    fn resume(&mut self, _run: ResumedRun<'_>, _memory: &Value) -> Result<(), Failure> {
        Ok(())
    }

    /// Reads back a file of one state; nothing where it is no such file of this format.
    fn read(&self, _path: &Path) -> Option<Result<SavedState, Failure>> {
        None
    }

    /// The files that hold a state of a view together, and that [`Self::read_state`] reads; none where the
    /// format does not give it back. Default: the file of each state of the view.
    fn state_files(&self, subject: Subject<'_>, view: View<'_>) -> Vec<OutputFile> {
        let mut files = self.files(subject);
        files.retain(|file| file.moment() == Moment::Each && file.is_of(&view.stem()));
        files.truncate(1);
        files
    }

    /// Reads back a state of a view, all of whose files are there; nothing where the format does not give it
    /// back. Default: what [`Self::read`] reads.
    fn read_state(&self, saved: SavedView<'_>) -> Option<Result<SavedState, Failure>> {
        let files = self.state_files(saved.subject(), saved.view());
        self.read(&saved.path(files.first()?))
    }
}
