//! A model with cells and two populations, and a program of it.

use crate::command::definition::Definition;
use crate::command::outcome::{Ended, Unable};
use crate::command::{execute, parse};
use crate::engines::Engines;
use crate::program::Given;
use clap::{Args, FromArgMatches};
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use xca_core::prelude::*;
use xca_record::Failure;
use xca_record::SetUp;
use xca_record::{CellView, ItemView};

#[derive(Substates, Clone, Copy)]
struct Water {
    depth: Real,
    flow: Vector2<f32>,
    kind: u8,
}

#[derive(Substates, Clone, Copy)]
struct Fish {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    age: u32,
    kind: u8,
}

#[derive(Substates, Clone, Copy)]
struct Stone {
    weight: f32,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Weather {
    rain: Real,
}

#[elementary_process]
fn rise(cell: &mut Cell<Water>, p: &Weather) {
    cell.depth += p.rain * (cell.kind as Real);
    cell.flow.x = cell.flow.x * 1.25;
}

#[elementary_process]
fn swim(me: &mut Slot<Fish>, p: &Weather) {
    me.age += 1;
    me.velocity = me.velocity * 0.5;
    me.position += me.velocity * p.rain;
}

#[derive(Args)]
struct Pond {
    /// Cells along x
    #[arg(long, required = true)]
    width: usize,
}

fn model(width: usize) -> Result<Model, Failure> {
    let fish = |label: u32| Item {
        label,
        cell: [label as usize % 4, 1, 0],
        state: Fish {
            position: Vector3::new(f64::from(label % 4) * 0.5 + 0.3, 0.7, 0.2),
            velocity: Vector3::new(0.0, 0.01 * f64::from(label), 0.02),
            age: label,
            kind: (label % 2) as u8,
        },
    };
    let stone = |label: u32| Item {
        label,
        cell: [3 - label as usize, 2, 1],
        state: Stone { weight: 1.5 + label as f32 },
    };
    Ok(Model::builder("pond")
        .extents([width, 3, 2])
        .cell_side(0.5)
        .substates::<Water>()
        .population::<Fish>(2)
        .population::<Stone>(1)
        .parameters(Weather { rain: 0.125 })
        .process(rise)
        .process(swim)
        .fill(|site| {
            let [x, y, z] = site.cell();
            let depth = 0.1 * x as f64 + 1.0 / (1.0 + y as f64);
            Water { depth, flow: Vector2::new(1.0 + z as f32, 0.1), kind: ((x + y) % 2) as u8 }
        })
        .initialise(move |state| Ok(state.set_items(vec![fish(9), fish(4), fish(7), fish(2)])?))
        .initialise(move |state| Ok(state.set_items(vec![stone(2), stone(0), stone(1)])?))
        .build()?)
}

type Make = dyn Fn(usize) -> Result<SetUp, Failure> + std::panic::RefUnwindSafe;

/// Only some of the fish are shown, and not all of what they have.
pub(super) fn pond(width: usize) -> Result<SetUp, Failure> {
    let fish = ItemView::named("fish").only(Fish::KIND, 1).columns(Fish::POSITION, ["x", "y", "z"]);
    let fish = fish.columns(Fish::AGE, ["age"]).radius(0.1);
    let water = CellView::named("water").draw(Water::DEPTH, "depth (m)");
    Ok(SetUp::new(model(width)?, 6).title("A pond").time_step(0.25).cells(water).items(fish))
}

/// The depth of the water and the speed of the fish: as substates, or computed of them.
pub(super) fn measured(width: usize, is_computed: bool) -> Result<SetUp, Failure> {
    let (water, fish) = (CellView::<Water>::named("water"), ItemView::<Fish>::named("fish"));
    let (water, fish) = if is_computed {
        let speed = |fish: &Fish| fish.velocity.dot(fish.velocity).sqrt();
        (water.draw_with("depth (m)", |cell: &Water| cell.depth), fish.colour_with("speed", speed))
    } else {
        (water.draw(Water::DEPTH, "depth (m)"), fish.colour(Fish::VELOCITY, "speed"))
    };
    Ok(SetUp::new(model(width)?, 6).cells(water).items(fish))
}

/// A program, and a folder that it works in.
pub(super) struct Place {
    pub(super) folder: TempDir,
    pub(super) name: &'static str,
    pub(super) version: &'static str,
    pub(super) make: Box<Make>,
}

impl Place {
    pub(super) fn new(
        make: impl Fn(usize) -> Result<SetUp, Failure> + std::panic::RefUnwindSafe + 'static,
    ) -> Self {
        let folder = tempfile::tempdir().unwrap();
        Self { folder, name: "pond", version: "1", make: Box::new(make) }
    }

    /// Runs a command line, in which `@` stands for the folder.
    fn invoke(&self, words: &str) -> Result<Ended, Unable> {
        let make = &*self.make;
        let set_up = |matches: &clap::ArgMatches, _: Given| {
            let pond = Pond::from_arg_matches(matches).map_err(Unable::CommandLine)?;
            make(pond.width).map_err(Unable::Refused)
        };
        let (name, version) = (self.name, self.version);
        let options = Pond::augment_args;
        let definition = Definition {
            name,
            about: "",
            version,
            examples: "",
            options,
            set_up: &set_up,
            engines: &Engines::default(),
        };
        let words = words.replace('@', &format!("{}/", self.folder.path().display()));
        let words = [name].into_iter().chain(words.split_whitespace());
        let words: Vec<OsString> = words.map(OsString::from).chain(["--quiet".into()]).collect();
        parse::invocation(&definition, &words).and_then(execute)
    }

    pub(super) fn succeed(&self, words: &str) {
        let ended = self.invoke(words);
        assert!(matches!(ended, Ok(Ended::Done)), "{words}: {}", message(&ended));
    }

    /// What is said of a command line that is refused.
    pub(super) fn refused(&self, words: &str) -> String {
        let ended = self.invoke(words);
        assert!(matches!(ended, Err(Unable::Refused(_) | Unable::CommandLine(_))), "{words}");
        message(&ended)
    }

    pub(super) fn files(&self, folder: &str) -> Vec<(String, Vec<u8>)> {
        let entries = fs::read_dir(self.folder.path().join(folder)).unwrap().map(Result::unwrap);
        let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
        let mut files: Vec<_> = entries
            .filter(|entry| entry.path().is_file())
            .map(|entry| (name(&entry.path()), fs::read(entry.path()).unwrap()))
            .collect();
        files.sort();
        files
    }
}

fn message(ended: &Result<Ended, Unable>) -> String {
    match ended {
        Err(
            Unable::Refused(error)
            | Unable::RefusedOffering(error, _)
            | Unable::Failed(error)
            | Unable::FailedLeaving(error, _),
        ) => error.to_string(),
        Err(Unable::CommandLine(error)) => error.to_string(),
        Ok(_) => "no error".to_owned(),
    }
}
