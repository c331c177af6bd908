//! The last state that a run has saved as frames, where there is no checkpoint to look into.

use super::arguments::InspectArguments;
use super::findings::Inside;
use super::numbers::Numbers;
use super::state::{Described, NamedValue, Place, Statistics, linear};
use crate::command::definition::Definition;
use crate::command::outcome::Unable;
use crate::command::render::formats_of;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use xca_checkpoint::Exact;
use xca_io::particle_csv::LABEL;
use xca_io::vtk::{NumberType, ReadArray};
use xca_record::Failure;
use xca_record::format::{Formats, SavedState};
use xca_record::record::FRAMES;

/// A file of a state by its name, `NAME_STEP.EXTENSION`, and what is in it.
struct Frame {
    view: String,
    step: u64,
    state: SavedState,
}

/// The view and the step in the name of a file.
fn named(path: &Path) -> Option<(String, u64)> {
    let (view, step) = path.file_stem()?.to_str()?.rsplit_once('_')?;
    Some((view.to_owned(), step.parse().ok()?))
}

/// The states of the last step that has any, each view once.
fn last(folder: &Path, formats: &Formats) -> Result<Vec<Frame>, Failure> {
    let entries = fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok);
    let mut files: Vec<((String, u64), PathBuf)> =
        entries.filter_map(|entry| Some((named(&entry.path())?, entry.path()))).collect();
    files.sort_by(|((one, early), _), ((other, late), _)| late.cmp(early).then_with(|| one.cmp(other)));
    let mut frames: Vec<Frame> = Vec::new();
    for ((view, step), path) in files {
        if frames.first().is_some_and(|first| first.step != step) {
            break;
        }
        if frames.last().is_some_and(|last| last.view == view) {
            continue;
        }
        if let Some(state) = formats.read(&path) {
            frames.push(Frame { view, step, state: state? });
        }
    }
    Ok(frames)
}

/// What is in the last frames of a run; nothing where it has none.
pub(super) fn inside(
    definition: &Definition<'_>,
    run: &Value,
    arguments: &InspectArguments,
) -> Result<Option<Inside>, Unable> {
    let path = arguments.path.join(FRAMES);
    let mut frames = last(&path, &Formats::default()).map_err(Unable::refused)?;
    if frames.is_empty()
        && path.is_dir()
        && let Some(formats) = formats_of(definition, &arguments.path)
    {
        frames = last(&path, &formats).map_err(Unable::refused)?;
    }
    let Some(step) = frames.first().map(|frame| frame.step) else { return Ok(None) };
    let text = |name: &str| run.get(name).and_then(Value::as_str).unwrap_or("?").to_owned();
    let (mut substates, mut places, mut time) = (Vec::new(), Vec::new(), 0.0);
    for Frame { view, state, .. } in frames {
        time = state.time;
        let arrays = if let Some(extents) = state.cells {
            let cell = arguments.cell.map(|cell| of_cell(&view, extents, &state.arrays, cell)).transpose();
            places.extend(cell.map_err(Unable::refused)?);
            state.arrays
        } else {
            let position = state.positions.map(|array| ReadArray { name: "position".to_owned(), ..array });
            let arrays: Vec<ReadArray> = position.into_iter().chain(state.arrays).collect();
            places.extend(arguments.label.and_then(|label| of_item(&view, &arrays, label)));
            arrays
        };
        let of_array = |array| statistics(&view, array, state.hidden.as_deref());
        substates.extend(arrays.iter().flat_map(of_array));
    }
    let wanted = [
        arguments.cell.map(|cell| format!("cell {cell:?}")),
        arguments.label.map(|label| format!("item with the label {label}")),
    ];
    if let (true, Some(what)) = (places.is_empty(), wanted.into_iter().flatten().next()) {
        return Err(Unable::refused(format!("the frames in {} have no {what}", path.display())));
    }
    Ok(Some(Inside {
        path,
        program: text("program"),
        version: text("version"),
        step,
        time: Exact(time),
        steps_wanted: run.pointer("/progress/steps_wanted").and_then(Value::as_u64).unwrap_or(step),
        parameters: Vec::new(),
        substates,
        places,
    }))
}

fn statistics(view: &str, array: &ReadArray, hidden: Option<&[bool]>) -> Vec<Statistics> {
    let scalar = match array.numbers {
        NumberType::U8 => "u8",
        NumberType::I32 => "i32",
        NumberType::U32 => "u32",
        NumberType::F32 => "f32",
        NumberType::F64 => "f64",
    };
    let names: Vec<String> = (0..array.components).map(|component| array.component_name(component)).collect();
    let value_type = match (array.components, names.first()) {
        (1, _) => scalar.to_owned(),
        (components, Some(first)) if first.starts_with('[') => format!("[{scalar}; {components}]"),
        (components, _) => format!("Vector{components}<{scalar}>"),
    };
    let described = Described {
        name: format!("{view}.{}", array.name),
        value_type: &value_type,
        components: &names,
        states: &array.states,
    };
    described.statistics(Numbers::of_array(array), hidden)
}

/// The values of the item or the cell with this number.
fn values(arrays: &[ReadArray], index: usize) -> Vec<NamedValue> {
    let value = |array: &ReadArray| {
        NamedValue::new(array.name.clone(), &array.states, &Numbers::of_array(array).value(index))
    };
    arrays.iter().map(value).collect()
}

fn of_cell(view: &str, extents: [usize; 3], arrays: &[ReadArray], cell: [usize; 3]) -> Result<Place, String> {
    let index = linear(extents, cell)?;
    Ok(Place { of: view.to_owned(), cell: Some(cell), label: None, values: values(arrays, index) })
}

fn of_item(view: &str, arrays: &[ReadArray], label: u32) -> Option<Place> {
    let mut labels = Numbers::of_array(arrays.iter().find(|array| array.name == LABEL)?).component(0);
    let index = labels.position(|other| other == f64::from(label))?;
    Some(Place { of: view.to_owned(), cell: None, label: Some(label), values: values(arrays, index) })
}
