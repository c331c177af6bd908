//! A small model with every kind of substate, and the folder of a run of it.

use crate::measured::TestResult;
use std::ffi::OsString;
use std::path::Path;
use xca_core::prelude::*;
use xca_record::record::{Look, Recorder, SavedRun, ViewKind};
use xca_record::{Failure, Interval, Run, SetUp};
use xca_run::CommandLine;

#[derive(States, Clone, Copy, Debug, PartialEq)]
pub(crate) enum Phase {
    Solid,
    Liquid,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plate {
    temperature: Real,
    phase: Phase,
    marks: [i32; 3],
    flow: Vector2<Real>,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grain {
    #[position]
    position: Vector3<Real>,
    wet: bool,
    age: u32,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Metal {
    #[parameter(range = 0.0..=1.0)]
    conductivity: Real,
}

#[elementary_process]
fn conduct(cell: &mut Cell<Plate>, metal: &Metal) {
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        sum += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature += metal.conductivity * sum;
}

#[elementary_process]
fn grow_old(me: &mut Slot<Grain>) {
    me.age += 1;
}

/// The model on squares, with what is recorded of it.
pub(crate) fn set_up() -> Result<SetUp, Failure> {
    set_up_on(Neighbourhood::von_neumann_2d(1))
}

/// The model with these neighbours.
pub(crate) fn set_up_on(neighbourhood: Neighbourhood) -> Result<SetUp, Failure> {
    let model = Model::builder("plate")
        .extents([6, 5, 1])
        .neighbourhood(neighbourhood)
        .substates::<Plate>()
        .population::<Grain>(2)
        .parameters(Metal { conductivity: 0.1 })
        .process(conduct)
        .process(grow_old)
        .fill(|site| Plate {
            temperature: site.random(0),
            phase: if site.random(1) < 0.5 { Phase::Solid } else { Phase::Liquid },
            marks: [1, -2, 3],
            flow: Vector2::new(0.5, -0.5),
        })
        .populate(|site| {
            let grain = |wet| Grain { position: site.centre(), wet, age: 0 };
            (site.random(0) < 0.7).then(|| grain(site.random(1) < 0.5))
        })
        .build()?;
    Ok(SetUp::new(model, 4))
}

/// The program of the model.
pub(crate) fn program() -> CommandLine<'static> {
    CommandLine::of_model("plate", "A plate that cools", "1.0.0", |_| set_up())
}

/// What the program says to these arguments.
pub(crate) fn read(arguments: &[&str], path: &Path) -> Result<String, Failure> {
    let words = ["plate"].iter().chain(arguments).map(OsString::from);
    let words: Vec<OsString> = words.chain([path.as_os_str().to_owned()]).collect();
    program().read(&words)
}

/// Draws what a frame shows, in each way that its view has.
pub(crate) fn draw(frame: &Path, views: &[ViewKind]) -> Result<(), Failure> {
    let number = frame.file_stem().and_then(|stem| stem.to_str()).and_then(|stem| stem.rsplit_once('_'));
    let step = number.map_or(Ok(0), |(_, number)| number.parse())?;
    let recorder = Recorder::new(set_up()?)?;
    for view in views {
        let look = Look { view: Some(*view), ..Look::default() };
        let drawing = recorder.drawing(&[look], Some([400, 300]))?;
        let folder = frame.parent().and_then(Path::parent).unwrap_or(frame).to_owned();
        let run = SavedRun { folder, precision: Precision::F64, last_step: 4 };
        let seen = drawing.seen_in(&run, step)?;
        let mut scales = drawing.fixed_scales();
        drawing.widen(&mut scales, &seen);
        drawing.picture(step, &seen, &scales)?;
    }
    Ok(())
}

/// Leaves the files of a run in a folder.
pub(crate) fn run(folder: &Path) -> TestResult {
    run_of(set_up()?, folder)
}

/// Leaves the files of a run of this set-up in a folder.
pub(crate) fn run_of(set_up: SetUp, folder: &Path) -> TestResult {
    let run = Run::new(set_up)?.every(2).checkpoint_every(Interval::Steps(2));
    let mut recording = run.begin(folder, &Reference)?;
    recording.go(&mut ())?;
    Ok(())
}
