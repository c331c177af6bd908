//! A view of a model, and what it sees of a state.

use super::cells::{Cells, Ground};
use super::items::Items;
use super::numbered_files;
use super::seen::Seen;
use crate::view::AnyView;
use std::path::PathBuf;
use xca_core::{GroupSnapshot, Model, Precision, Snapshot};
use xca_io::atomic::OutputFolder;
use xca_io::map::Map;
use xca_io::vtk::Collection;

/// A view with its files.
#[derive(Debug)]
pub(super) struct Shown {
    pub(super) group: usize,
    pub(super) view: AnyView,
    /// Where cells lie on a map.
    map: Option<Map>,
    /// The frames that there are.
    pub(super) collection: Option<Collection>,
    /// The scale of the first picture.
    pub(super) range: Option<[f64; 2]>,
}

impl Shown {
    /// A view of the group with this number.
    pub(super) fn new(group: usize, view: AnyView, map: Option<Map>) -> Self {
        Self { group, view, map, collection: None, range: None }
    }

    pub(super) fn is_of_items(&self) -> bool {
        matches!(self.view, AnyView::Items(_))
    }

    /// Of the names of its frames.
    pub(super) fn extension(&self) -> &'static str {
        if self.is_of_items() { "vtp" } else { "vti" }
    }

    /// The file of the frame of a step, in the folder of the frames.
    pub(super) fn frame(&self, frames: &OutputFolder, step: u64) -> PathBuf {
        frames.numbered(self.view.name(), step, self.extension())
    }

    /// The files of all frames that are there.
    pub(super) fn frames(&self, frames: &OutputFolder) -> Vec<PathBuf> {
        let [before, after] = self.around_step();
        numbered_files(frames.path(), &before, &after)
    }

    /// The steps of these frames.
    pub(super) fn saved_steps(&self, frames: &OutputFolder) -> Vec<u64> {
        let [before, after] = self.around_step();
        let step = |path: &PathBuf| {
            let name = path.file_name()?.to_str()?;
            name.strip_prefix(&before)?.strip_suffix(&after)?.parse().ok()
        };
        self.frames(frames).iter().filter_map(step).collect()
    }

    /// The name of the view, as files have it.
    pub(super) fn stem(&self) -> String {
        OutputFolder::to_read("").file(self.view.name()).display().to_string()
    }

    /// What stands before and after the step in the name of a frame.
    fn around_step(&self) -> [String; 2] {
        [format!("{}_", self.stem()), format!(".{}", self.extension())]
    }

    /// The file that lists the frames with their times.
    pub(super) fn collection_file(&self) -> String {
        format!("{}.pvd", self.stem())
    }

    /// The items, if it is a view of items.
    pub(super) fn items<'a>(
        &'a self,
        model: &'a Model,
        precision: Precision,
        snapshot: &'a Snapshot,
    ) -> Option<Items<'a>> {
        let (group, geometry) = (&model.groups()[self.group], model.geometry());
        match (&self.view, &snapshot.groups[self.group]) {
            (AnyView::Items(view), GroupSnapshot::Population(population, _)) => {
                Some(Items::new(view, group, geometry, precision, population))
            }
            _ => None,
        }
    }

    /// The substates of cells, if it is a view of these.
    pub(super) fn cells<'a>(
        &'a self,
        model: &'a Model,
        precision: Precision,
        snapshot: &'a Snapshot,
    ) -> Option<Cells<'a>> {
        let (group, geometry) = (&model.groups()[self.group], model.geometry());
        match (&self.view, &snapshot.groups[self.group]) {
            (AnyView::Cells(view), GroupSnapshot::Cells(fields)) => {
                Some(Cells::new(view, group, geometry, precision, fields, self.ground()))
            }
            _ => None,
        }
    }

    /// A view of the same group and the same place.
    pub(super) fn with_view(&self, view: AnyView) -> Self {
        Self::new(self.group, view, self.map.clone())
    }

    /// Where its cells lie on the map.
    pub(super) fn ground(&self) -> Ground<'_> {
        let corner = self.map.as_ref().map(|map| map.placement().corner).unwrap_or_default();
        Ground { corner, missing: self.map.as_ref().and_then(Map::missing) }
    }

    /// What it draws of a state.
    pub(super) fn seen(&self, model: &Model, precision: Precision, snapshot: &Snapshot) -> Option<Seen> {
        let items = self.items(model, precision, snapshot).map(|items| items.seen());
        items.or_else(|| self.cells(model, precision, snapshot).map(|cells| cells.seen()))
    }
}
