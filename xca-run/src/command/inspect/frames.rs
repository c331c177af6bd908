//! The last state that a run has saved as frames, where there is no checkpoint to look into.

use super::state::{Described, NamedValue, Place, Statistics, linear};
use super::{Inside, InspectArguments, Unable};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use xca_io::particle_csv::LABEL;
use xca_io::vtk::{DenseFile, NumberType, ReadArray, read_dense, read_particles};
use xca_record::numbers::Exact;
use xca_record::record::{FRAMES, Plane};

/// A frame by its name, `NAME_STEP.vti` or `.vtp`.
struct Frame {
    path: PathBuf,
    view: String,
    step: u64,
    is_dense: bool,
}

impl Frame {
    fn named(path: PathBuf) -> Option<Self> {
        let is_dense = match path.extension()?.to_str()? {
            "vti" => true,
            "vtp" => false,
            _ => return None,
        };
        let (view, step) = path.file_stem()?.to_str()?.rsplit_once('_')?;
        Some(Self { view: view.to_owned(), step: step.parse().ok()?, is_dense, path })
    }
}

/// The frames of the last step that has any.
fn last(folder: &Path) -> Vec<Frame> {
    let entries = fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok);
    let mut frames: Vec<Frame> = entries.filter_map(|entry| Frame::named(entry.path())).collect();
    let step = frames.iter().map(|frame| frame.step).max();
    frames.retain(|frame| Some(frame.step) == step);
    frames.sort_by(|one, other| one.view.cmp(&other.view));
    frames
}

/// What is in the last frames of a run; nothing where it has none.
pub(super) fn inside(
    folder: &Path,
    run: &Value,
    arguments: &InspectArguments,
) -> Result<Option<Inside>, Unable> {
    let path = folder.join(FRAMES);
    let frames = last(&path);
    let Some(step) = frames.first().map(|frame| frame.step) else { return Ok(None) };
    let text = |name: &str| run.get(name).and_then(Value::as_str).unwrap_or("?").to_owned();
    let (mut substates, mut places, mut time) = (Vec::new(), Vec::new(), 0.0);
    for frame in frames {
        let (arrays, found, hidden) = if frame.is_dense {
            let file = read_dense(&frame.path).map_err(Unable::refused)?;
            time = file.time;
            let cell = arguments.cell.map(|cell| of_cell(&frame.view, &file, cell)).transpose();
            let found = cell.map_err(Unable::refused)?;
            (file.arrays, found, file.hidden)
        } else {
            let file = read_particles(&frame.path).map_err(Unable::refused)?;
            time = file.time;
            let position = ReadArray { name: "position".to_owned(), ..file.positions };
            let arrays = [vec![position], file.arrays].concat();
            let item = arguments.label.and_then(|label| of_item(&frame.view, &arrays, label));
            (arrays, item, None)
        };
        places.extend(found);
        let of_array = |array| statistics(&frame.view, array, hidden.as_deref());
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
    let value_type = match (array.components, array.component_names.first()) {
        (1, _) => scalar.to_owned(),
        (components, Some(first)) if first.starts_with('[') => format!("[{scalar}; {components}]"),
        (components, _) => format!("Vector{components}<{scalar}>"),
    };
    let described = Described {
        name: format!("{view}.{}", array.name),
        value_type: &value_type,
        components: &array.component_names,
        states: &array.states,
    };
    described.statistics(&Plane::of_array(array), hidden)
}

/// The values of the item or the cell with this number.
fn values(arrays: &[ReadArray], index: usize) -> Vec<NamedValue> {
    let value = |array: &ReadArray| {
        NamedValue::new(array.name.clone(), &array.states, &Plane::of_array(array), index)
    };
    arrays.iter().map(value).collect()
}

fn of_cell(view: &str, file: &DenseFile, cell: [usize; 3]) -> Result<Place, String> {
    let extents = file.grid.cells;
    let index = linear(extents, cell)?;
    Ok(Place { of: view.to_owned(), cell: Some(cell), label: None, values: values(&file.arrays, index) })
}

fn of_item(view: &str, arrays: &[ReadArray], label: u32) -> Option<Place> {
    let labels = Plane::of_array(arrays.iter().find(|array| array.name == LABEL)?).component(0);
    let index = labels.iter().position(|other| *other == f64::from(label))?;
    Some(Place { of: view.to_owned(), cell: None, label: Some(label), values: values(arrays, index) })
}
