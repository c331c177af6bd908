//! What the names of files tell.

use crate::record::FRAMES;

/// What a file is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Moment {
    /// The whole run, and written on: `NAME.pvd`.
    Run,
    /// The first state: `initial_NAME.png`.
    First,
    /// Each recorded state: `frames/NAME_00000050.vti`.
    Each,
    /// The final state: `final_NAME.csv`.
    Last,
}

/// What tells the files of a format from others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shape<'a> {
    pub(crate) moment: Moment,
    pub(crate) extension: &'a str,
}

/// The shape of a name as `run.json` lists it; none of a name that no format makes.
pub(crate) fn shape(name: &str) -> Option<Shape<'_>> {
    if let Some((folder, file)) = name.split_once('/') {
        let (stem, extension) = file.split_once("_*.")?;
        let is_plain = !stem.is_empty() && !stem.contains(['*', '/']) && !extension.contains(['*', '/', '.']);
        return (folder == FRAMES && is_plain).then_some(Shape { moment: Moment::Each, extension });
    }
    let (stem, extension) = name.rsplit_once('.')?;
    if stem.is_empty() || name.contains('*') {
        return None;
    }
    let begins =
        |word: &str| stem.strip_prefix(word).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'));
    let moment = match stem {
        _ if begins("initial") => Moment::First,
        _ if begins("final") => Moment::Last,
        _ => Moment::Run,
    };
    Some(Shape { moment, extension })
}
