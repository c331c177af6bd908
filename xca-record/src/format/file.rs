//! The names of files: one place that makes them, and finds files by them.

use super::{Moment, View};
use crate::record::{FRAMES, RunFolder, SavedRun};
use std::path::{Path, PathBuf};
use xca_io::atomic::{OutputFolder, plain_name};
use xca_io::numbered;

/// A file of a run, or one for each of its recorded states.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFile {
    moment: Moment,
    /// Of the first and the final state there may be none.
    stem: Option<String>,
    extension: &'static str,
}

impl OutputFile {
    /// The file of a view, or of one file for each state of it.
    pub fn of_view(moment: Moment, view: View<'_>, extension: &'static str) -> Self {
        Self { moment, stem: Some(view.stem()), extension }
    }

    /// The file with a name. Characters other than ASCII letters, digits, `.`, `_` and `-` become `_`.
    pub fn named(moment: Moment, name: &str, extension: &'static str) -> Self {
        Self { moment, stem: Some(plain_name(name)), extension }
    }

    /// The file of the first or the final state that has no other name: `final.csv`.
    pub fn unnamed(moment: Moment, extension: &'static str) -> Self {
        Self { moment, stem: None, extension }
    }

    /// What it is of.
    pub fn moment(&self) -> Moment {
        self.moment
    }

    /// Whether it has this name.
    pub(crate) fn is_of(&self, stem: &str) -> bool {
        self.stem.as_deref() == Some(stem)
    }

    /// As `run.json` lists it; `*` stands for the number of the step.
    pub fn listed(&self) -> String {
        match self.moment {
            Moment::Each => {
                format!("{FRAMES}/{}_*.{}", self.stem.as_deref().unwrap_or("state"), self.extension)
            }
            _ => self.own_name(),
        }
    }

    /// Its name in the folder of the run.
    pub(crate) fn own_name(&self) -> String {
        let word = match self.moment {
            Moment::First => Some("initial"),
            Moment::Last => Some("final"),
            Moment::Run | Moment::Each => None,
        };
        let words: Vec<&str> = word.into_iter().chain(self.stem.as_deref()).collect();
        format!("{}.{}", words.join("_"), self.extension)
    }

    /// Where it is, of the state after a step.
    pub(crate) fn path(&self, folder: &RunFolder, step: u64) -> PathBuf {
        match self.moment {
            Moment::Each => self.frame(&folder.frames, step),
            _ => folder.top.file(&self.own_name()),
        }
    }

    /// Where the file of a state is in a folder of frames.
    pub(crate) fn frame(&self, frames: &OutputFolder, step: u64) -> PathBuf {
        frames.numbered(self.stem.as_deref().unwrap_or("state"), step, self.extension)
    }

    /// Whether it can hold the state after a step: the file of the final state holds that of the last alone.
    pub(crate) fn can_be_of(&self, run: &SavedRun, step: u64) -> bool {
        match self.moment {
            Moment::Each => true,
            Moment::Last => step == run.last_step,
            Moment::Run | Moment::First => false,
        }
    }

    /// The steps of the states that are there.
    pub(crate) fn steps(&self, run: &SavedRun) -> Vec<u64> {
        if self.moment == Moment::Each {
            let saved = self.saved(&run.folder.join(FRAMES)).into_iter();
            return saved.map(|(step, _)| step).collect();
        }
        let is_there = run.folder.join(self.own_name()).is_file();
        let last = Some(run.last_step).filter(|step| is_there && self.can_be_of(run, *step));
        last.into_iter().collect()
    }

    /// The files of states that are there, with the numbers of their steps.
    pub(crate) fn saved(&self, frames: &Path) -> Vec<(u64, PathBuf)> {
        let before = format!("{}_", self.stem.as_deref().unwrap_or("state"));
        let after = format!(".{}", self.extension);
        let step = |path: &PathBuf| {
            let name = path.file_name()?.to_str()?;
            name.strip_prefix(&before)?.strip_suffix(&after)?.parse().ok()
        };
        let files = numbered::files(frames, &before, &after).into_iter();
        files.filter_map(|path| Some((step(&path)?, path))).collect()
    }
}
