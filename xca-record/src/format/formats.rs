//! The formats that there are, and those of a run.

use super::ascii_grid::AsciiGrids;
use super::extended_xyz::ExtendedXyz;
use super::geotiff::GeoTiffs;
use super::pictures::Pictures;
use super::space_time::SpaceTime;
use super::table::ItemTable;
use super::vtk::Vtk;
use super::{SavedState, Writer};
use crate::failure::Failure;
use std::path::Path;

/// All formats that a run can have, and which of them it has.
#[derive(Debug)]
pub struct Formats {
    known: Vec<Known>,
}

#[derive(Debug)]
struct Known {
    writer: Box<dyn Writer>,
    is_chosen: bool,
}

/// A format that there is not.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("unknown format `{name}`; there are {known}")]
pub struct FormatError {
    name: String,
    known: String,
}

impl Default for Formats {
    /// `vtk`, `csv` and `png` are chosen, `asc`, `tif`, `xyz` and `spacetime` are known too.
    fn default() -> Self {
        let chosen: [Box<dyn Writer>; 3] =
            [Box::new(Vtk::default()), Box::new(ItemTable), Box::new(Pictures::default())];
        let others: [Box<dyn Writer>; 4] =
            [Box::new(AsciiGrids), Box::new(GeoTiffs), Box::new(ExtendedXyz), Box::new(SpaceTime::default())];
        let known = |is_chosen: bool| move |writer| Known { writer, is_chosen };
        Self {
            known: chosen.into_iter().map(known(true)).chain(others.into_iter().map(known(false))).collect(),
        }
    }
}

impl Formats {
    /// Adds a format, and chooses it. It takes the place of one with the same name.
    pub fn add(&mut self, writer: impl Writer + 'static) {
        self.known.retain(|known| known.writer.name() != writer.name());
        self.known.push(Known { writer: Box::new(writer), is_chosen: true });
    }

    /// Chooses these formats, and no others.
    ///
    /// # Errors
    /// Where there is no format of a name.
    pub fn choose(&mut self, names: &[&str]) -> Result<(), FormatError> {
        self.check(names)?;
        self.known.iter_mut().for_each(|known| known.is_chosen = names.contains(&known.writer.name()));
        Ok(())
    }

    /// Chooses these formats beside the others.
    ///
    /// # Errors
    /// Where there is no format of a name.
    pub fn choose_too(&mut self, names: &[&str]) -> Result<(), FormatError> {
        self.check(names)?;
        self.known.iter_mut().for_each(|known| known.is_chosen |= names.contains(&known.writer.name()));
        Ok(())
    }

    fn check(&self, names: &[&str]) -> Result<(), FormatError> {
        let is_unknown = |name: &&&str| self.known.iter().all(|known| known.writer.name() != **name);
        let Some(name) = names.iter().find(is_unknown) else { return Ok(()) };
        let known: Vec<&str> = self.known.iter().map(|known| known.writer.name()).collect();
        Err(FormatError { name: (*name).to_owned(), known: known.join(", ") })
    }

    /// All formats that there are.
    pub fn all(&self) -> impl Iterator<Item = &dyn Writer> {
        self.known.iter().map(|known| &*known.writer)
    }

    /// Those that are chosen.
    pub fn chosen(&self) -> impl Iterator<Item = &dyn Writer> {
        self.known.iter().filter(|known| known.is_chosen).map(|known| &*known.writer)
    }

    /// The names of those that are chosen.
    pub fn names(&self) -> Vec<&'static str> {
        self.chosen().map(Writer::name).collect()
    }

    /// As [`Self::chosen`], to write with.
    pub(crate) fn writers(&mut self) -> impl Iterator<Item = &mut Box<dyn Writer>> {
        self.known.iter_mut().filter(|known| known.is_chosen).map(|known| &mut known.writer)
    }

    /// Reads back a file of one state, of whichever format; nothing where none reads such files.
    pub fn read(&self, path: &Path) -> Option<Result<SavedState, Failure>> {
        self.all().find_map(|writer| writer.read(path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_chosen_by_name() {
        let mut formats = Formats::default();
        assert_eq!(formats.names(), ["vtk", "csv", "png"]);
        formats.choose_too(&["asc"]).unwrap();
        assert_eq!(formats.names(), ["vtk", "csv", "png", "asc"]);
        formats.choose(&["png"]).unwrap();
        assert_eq!(formats.names(), ["png"]);
        let error = formats.choose_too(&["png", "gif"]).unwrap_err().to_string();
        assert_eq!(error, "unknown format `gif`; there are vtk, csv, png, asc, tif, xyz, spacetime");
        formats.add(Pictures::default());
        assert_eq!(formats.all().filter(|writer| writer.name() == "png").count(), 1);
    }
}
