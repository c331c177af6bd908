use super::*;
use std::fs;
use std::io::Cursor;
use xca_core::prelude::*;
use xca_core::{GroupSnapshot, ModelBuilder, ParameterError};
use xca_io::atomic::OutputFolder;

#[derive(Substates, Clone, Copy)]
struct Field {
    heat: Real,
    flow: Vector2<f32>,
    kind: u8,
}

#[derive(Substates, Clone, Copy)]
struct Ant {
    #[position]
    position: Vector3<Real>,
    load: i32,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Weather {
    rain: Real,
    days: u32,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Climate {
    rain: Real,
    sun: [Real; 2],
}

#[elementary_process]
fn warm(cell: &mut Cell<Field>, p: &Weather) {
    cell.heat += p.rain;
}

mod edited {
    use super::*;

    #[elementary_process]
    pub(super) fn warm(cell: &mut Cell<Field>, p: &Weather) {
        cell.heat += 2.0 * p.rain;
    }
}

mod with_other_helper {
    use super::{Field, Weather};
    use xca_core::prelude::*;

    #[helper]
    fn twice(value: Real) -> Real {
        2.0 * value
    }

    #[elementary_process]
    pub(super) fn warm_twice(cell: &mut Cell<Field>, p: &Weather) {
        cell.heat += twice(p.rain);
    }
}

#[helper]
fn twice(value: Real) -> Real {
    value + value
}

#[elementary_process]
fn warm_twice(cell: &mut Cell<Field>, p: &Weather) {
    cell.heat += twice(p.rain);
}

const ODD_HEAT: u64 = 0x7ff8_0000_0bad_cafe;

fn model() -> Model {
    let ant = |label| Item { label, cell: [1, 0, 0], state: Ant { position: Vector3::splat(1.5), load: -7 } };
    Model::builder("field")
        .extents([2, 1, 1])
        .parameters(Weather { rain: 0.25, days: 3 })
        .substates::<Field>()
        .population::<Ant>(3)
        .process(warm)
        .fill(|site| Field { heat: site.cell()[0] as f64, flow: Vector2::new(-0.0, 2.0), kind: 9 })
        .initialise(move |state| Ok(state.set_items(vec![ant(6), ant(2)])?))
        .build()
        .unwrap()
}

fn simulation() -> Simulation {
    let mut simulation = Simulation::new(&model(), &Reference, RunOptions::default()).unwrap();
    simulation.run(3).unwrap();
    simulation.state().set(Field::HEAT, [1, 0, 0], f64::from_bits(ODD_HEAT)).unwrap();
    simulation.state().set_parameters(Weather { rain: f64::NEG_INFINITY, days: 4 }).unwrap();
    simulation
}

fn identity() -> Identity {
    let command_line = vec!["field".to_owned(), "run".to_owned()];
    Identity { program: "field".to_owned(), version: "1.2.3".to_owned(), command_line, ..Identity::default() }
}

fn checkpoint(simulation: &Simulation) -> Checkpoint {
    let model = model();
    let run = Origin::new(&identity(), &model, &[], simulation.options(), 10, Outputs::Every(2));
    let snapshot = simulation.snapshot().unwrap();
    let time = 0.25 * snapshot.step as f64;
    Checkpoint {
        description: Description::new(run, &model, None, time, &snapshot.outline(), Recorded::default()),
        snapshot,
    }
}

#[test]
fn every_bit_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.checkpoint");
    let mut simulation = simulation();
    simulation.state().stop("enough");
    let written = checkpoint(&simulation);
    written.write(&path).unwrap();
    let read = Checkpoint::read(&path).unwrap();
    assert_eq!(read.description, written.description);
    assert!(read.snapshot == written.snapshot);
    let options = RunOptions::default();
    let mut resumed = Simulation::resume(&model(), &Reference, options, &read.snapshot).unwrap();
    assert_eq!(resumed.state().get(Field::HEAT, [1, 0, 0]).unwrap().to_bits(), ODD_HEAT);
    assert_eq!(resumed.state().parameters::<Weather>().unwrap().rain, f64::NEG_INFINITY);
    assert_eq!((resumed.step_number(), resumed.stop_reason()), (3, Some("enough")));
}

/// The bytes are as described in docs/checkpoints.md.
#[test]
fn the_format_is_the_documented_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.checkpoint");
    checkpoint(&simulation()).write(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    let end = bytes.iter().position(|byte| *byte == b'\n').unwrap();
    let line = std::str::from_utf8(&bytes[..end]).unwrap();
    let words: Vec<&str> = line.split(' ').collect();
    assert_eq!(words[..2], ["xca-checkpoint", "1"]);
    let [description, data] = [words[2], words[3]].map(|word| word.parse::<usize>().unwrap());
    let (start, sum) = (end + 1 + description, end + 1 + description + data);
    let json: serde_json::Value = serde_json::from_slice(&bytes[end + 1..start]).unwrap();
    for (pointer, value) in [
        ("/step", "3"),
        ("/time", "0.75"),
        ("/run/program", "\"field\""),
        ("/run/steps_wanted", "10"),
        ("/run/parameters/0/components/0", "0.25"),
        ("/parameters/0/components/0", "\"0xfff0000000000000\""),
        ("/parameters/1/name", "\"days\""),
        ("/groups/0/of", "\"cells\""),
        ("/groups/0/substates/1/type", "\"Vector2<f32>\""),
        ("/groups/0/substates/1/lanes", "2"),
        ("/groups/0/substates/0/scalar", "\"f64\""),
        ("/groups/1/items", "2"),
        ("/groups/1/left", "0"),
    ] {
        assert_eq!(json.pointer(pointer).unwrap().to_string(), value, "{pointer}");
    }
    let mut wanted = Vec::new();
    wanted.extend(0.75_f64.to_le_bytes());
    wanted.extend(ODD_HEAT.to_le_bytes());
    [-0.0_f32, 2.0, -0.0, 2.0].iter().for_each(|lane| wanted.extend(lane.to_le_bytes()));
    wanted.extend([9, 9]);
    [0_u32, 2, 2, 6].iter().for_each(|number| wanted.extend(number.to_le_bytes()));
    [1.5_f64; 6].iter().for_each(|lane| wanted.extend(lane.to_le_bytes()));
    [-7_i32; 2].iter().for_each(|load| wanted.extend(load.to_le_bytes()));
    assert_eq!(bytes[start..sum], wanted);
    assert_eq!(bytes[sum..], crc32fast::hash(&bytes[..sum]).to_le_bytes());
}

#[test]
fn no_part_and_no_bit_can_be_missing_or_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.checkpoint");
    checkpoint(&simulation()).write(&path).unwrap();
    let whole = fs::read(&path).unwrap();
    let read = |bytes: &[u8]| {
        let mut file = Cursor::new(bytes);
        let opened = file::open(&path, &mut file, bytes.len() as u64)?;
        file::read(&path, &opened.description, file).map(drop)
    };
    read(&whole).unwrap();
    for length in 0..whole.len() {
        let error = read(&whole[..length]).unwrap_err();
        assert!(
            matches!(error, CheckpointError::Truncated { found, .. } if found == length as u64),
            "{error}"
        );
    }
    for bit in 0..whole.len() * 8 {
        let mut altered = whole.clone();
        altered[bit / 8] ^= 1 << (bit % 8);
        assert!(read(&altered).is_err(), "bit {bit}");
    }
    fs::write(&path, [&whole[..], &whole[..]].concat()).unwrap();
    assert!(matches!(Checkpoint::read(&path), Err(CheckpointError::Altered { .. })));
    let error = Checkpoint::read(folder.path()).unwrap_err();
    assert!(matches!(error, CheckpointError::Read { .. }), "{error}");
}

/// The checksum can be right although the content is wrong.
#[test]
fn parts_that_contradict_each_other_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.checkpoint");
    let mut odd = checkpoint(&simulation());
    if let GroupSnapshot::Cells(fields) = &mut odd.snapshot.groups[0] {
        fields[2].push(1);
        fields[1].truncate(15);
    }
    odd.write(&path).unwrap();
    // The length is right, but the planes are not. Only the simulation can find this.
    assert!(Checkpoint::read(&path).is_ok());
    let mut short = checkpoint(&simulation());
    short.description.groups.pop();
    short.write(&path).unwrap();
    let read = Checkpoint::read(&path).unwrap();
    let error = Simulation::resume(&model(), &Reference, RunOptions::default(), &read.snapshot).unwrap_err();
    assert!(error.to_string().contains("it has 1 structs of substates, not 2"), "{error}");
}

/// A forged checkpoint can have a correct checksum.
#[test]
fn forged_checkpoints_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.checkpoint");
    let changes: [fn(&mut Checkpoint); 12] = [
        |forged| {
            forged.description.groups[0].substates[2].stored.lanes = 0;
            forged.description.groups[0].substates[2].components.clear();
            let GroupSnapshot::Cells(fields) = &mut forged.snapshot.groups[0] else { panic!("no cells") };
            fields[2].clear();
        },
        |forged| forged.description.groups[0].substates[0].components.clear(),
        |forged| forged.description.groups[0].substates[0].states.push("Hot".to_owned()),
        // A mask of more cells than fit into memory.
        |forged| {
            forged.description.run.model["cells"] = serde_json::json!([1_u64 << 40, 1, 1]);
            forged.description.missing.push(description::Run::all(&[true])[0]);
            forged.description.groups.clear();
            forged.snapshot.groups.clear();
        },
        |forged| forged.description.run.model["cells"] = serde_json::json!([1000, 1000, 1]),
        |forged| forged.description.run.model["cells"] = serde_json::json!([1_u64 << 32, 1_u64 << 32, 1]),
        |forged| forged.description.run.model["cells"] = serde_json::json!("many"),
        |forged| forged.description.step = forged.description.run.steps_wanted + 1,
        |forged| forged.description.recorded = recorded(&[0, 2, 2]),
        |forged| forged.description.recorded = recorded(&[0, 99]),
        |forged| forged.description.parameters[0].components[0] = Exact(f64::NAN),
        |forged| {
            let GroupSnapshot::Population(population, _) = &mut forged.snapshot.groups[1] else {
                panic!("no items")
            };
            population.counts[0] += 1000;
        },
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut forged = checkpoint(&simulation());
        forged.write(&path).unwrap();
        Checkpoint::read(&path).unwrap();
        change(&mut forged);
        forged.write(&path).unwrap();
        let read = Checkpoint::read(&path);
        assert!(matches!(read, Err(CheckpointError::Altered { .. })), "{number}: {read:?}");
    }
}

/// The checksum can be right although the description tells of more or fewer data than there are.
#[test]
fn data_of_another_size_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.checkpoint");
    checkpoint(&simulation()).write(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    let altered = |from: &str, to: &str| {
        let place = bytes.windows(from.len()).position(|part| part == from.as_bytes()).unwrap();
        let mut forged = bytes.clone();
        forged[place..place + from.len()].copy_from_slice(to.as_bytes());
        let end = forged.len() - 4;
        let sum = crc32fast::hash(&forged[..end]);
        forged[end..].copy_from_slice(&sum.to_le_bytes());
        fs::write(&path, forged).unwrap();
        Checkpoint::read(&path)
    };
    assert!(altered("\"items\": 2", "\"items\": 2").is_ok());
    for (from, to) in [("\"items\": 2", "\"items\": 1"), ("\"items\": 2", "\"items\": 9")] {
        let read = altered(from, to);
        assert!(matches!(read, Err(CheckpointError::Altered { .. })), "{to}: {read:?}");
    }
    // More than fit into memory.
    let (from, to) = ("\"items\": 2,\n      \"left\": 0", "\"items\":9999999999,\"left\":0");
    let read = altered(from, to);
    assert!(matches!(read, Err(CheckpointError::Altered { .. })), "{read:?}");
}

/// What a recorder keeps after recording these steps.
fn recorded(steps: &[u64]) -> Recorded {
    let text = serde_json::json!({
        "steps": steps, "series": { "bytes": 0, "crc32": 0 }, "first": [], "last": [], "formats": {}
    });
    serde_json::from_value(text).unwrap()
}

#[test]
fn the_last_two_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let run = OutputFolder::create(folder.path()).unwrap();
    let mut simulation = simulation();
    let mut checkpoints = CheckpointFolder::create(&run, None).unwrap();
    let steps = || -> Vec<String> {
        let name = |path: std::path::PathBuf| path.file_stem().unwrap().to_str().unwrap().to_owned();
        CheckpointFolder::of_run(folder.path()).into_iter().map(name).collect()
    };
    assert!(steps().is_empty());
    for wanted in [vec![3], vec![4, 3], vec![5, 4], vec![6, 5]] {
        let description = checkpoint(&simulation).description;
        checkpoints.write(&description, &simulation).unwrap();
        checkpoints.write(&description, &simulation).unwrap();
        let wanted: Vec<String> = wanted.iter().map(|step| format!("step_{step:08}")).collect();
        assert_eq!(steps(), wanted);
        simulation.run(1).unwrap();
    }
    // A run resumed from the older checkpoint removes the later one, once there is another valid one.
    let older = CheckpointFolder::of_run(folder.path()).pop().unwrap();
    let snapshot = Checkpoint::read(&older).unwrap().snapshot;
    let mut resumed = Simulation::resume(&model(), &Reference, RunOptions::default(), &snapshot).unwrap();
    fs::rename(
        CheckpointFolder::of_run(folder.path())[0].clone(),
        run.path().join("checkpoints/step_00000099.checkpoint"),
    )
    .unwrap();
    let mut checkpoints = CheckpointFolder::create(&run, Some(&older)).unwrap();
    assert_eq!(steps(), ["step_00000099", "step_00000005"]);
    resumed.run(2).unwrap();
    checkpoints.write(&checkpoint(&resumed).description, &resumed).unwrap();
    assert_eq!(steps(), ["step_00000007", "step_00000005"]);
}

/// Parameters of several structs. Two of them have the same name.
#[test]
fn parameters_of_several_structs() -> Result<(), ParameterError> {
    let mut model = Model::builder("field")
        .extents([2, 1, 1])
        .substates::<Field>()
        .parameters(Weather { rain: 0.25, days: 3 })
        .parameters(Climate { rain: 8.0, sun: [0.5, 2.0] })
        .build()
        .unwrap();
    let origin =
        |model: &Model| Origin::new(&identity(), model, &[], RunOptions::default(), 10, Outputs::Every(2));
    let listed = |parameters: &[Parameter]| parameters.iter().map(ToString::to_string).collect::<Vec<_>>();
    let run = origin(&model);
    assert_eq!(
        listed(&run.parameters),
        ["Weather.rain = 0.25", "days = 3.0", "Climate.rain = 8.0", "sun = 0.5,2.0"]
    );
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default()).unwrap();
    simulation.state().set_parameter("Climate.rain", "9").unwrap();
    let snapshot = simulation.snapshot().unwrap();
    let description =
        Description::new(run.clone(), &model, None, 3.0, &snapshot.outline(), Recorded::default());
    assert_eq!(
        listed(&description.parameters),
        ["Weather.rain = 0.25", "days = 3.0", "Climate.rain = 9.0", "sun = 0.5,2.0"]
    );
    let checkpoint = Checkpoint { description, snapshot };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    checkpoint.write(&path).unwrap();
    assert!(Checkpoint::read(&path).unwrap().snapshot == checkpoint.snapshot);
    model.set_parameter("Weather.rain", "1")?;
    assert_eq!(run.mismatch(&origin(&model)).unwrap().what, "parameters");
    Ok(())
}

#[test]
fn another_run_is_known_by_what_differs() -> Result<(), ParameterError> {
    let simulation = simulation();
    let run = checkpoint(&simulation).description.run;
    let own = |model: &Model, seed, [steps, every]: [u64; 2]| {
        let options = RunOptions { seed, ..RunOptions::default() };
        Origin::new(&identity(), model, &[], options, steps, Outputs::Every(every))
    };
    let text = |difference: Option<Difference>| {
        difference.map(|Difference { what, found, wanted }| format!("{what}: {found}, not {wanted}"))
    };
    assert_eq!(text(run.mismatch(&own(&model(), 0, [10, 2]))), None);
    assert_eq!(text(run.mismatch(&own(&model(), 5, [10, 2]))).unwrap(), "seed: 0, not 5");
    // A run may continue beyond its end.
    assert_eq!(text(run.mismatch(&own(&model(), 0, [11, 2]))), None);
    assert_eq!(text(run.mismatch(&own(&model(), 0, [10, 3]))).unwrap(), "interval of outputs: 2, not 3");
    let mut other = model();
    other.set_parameter("days", "8")?;
    assert_eq!(
        text(run.mismatch(&own(&other, 0, [10, 2]))).unwrap(),
        "parameters: rain = 0.25, days = 3.0, not rain = 0.25, days = 8.0"
    );
    let wider = Model::builder("field").extents([3, 1, 1]).substates::<Field>().build().unwrap();
    assert_eq!(
        text(run.mismatch(&own(&wider, 0, [10, 2]))).unwrap(),
        "model: cells [2,1,1], not cells [3,1,1]"
    );
    // The same process with another body.
    let with = |process: fn(ModelBuilder) -> ModelBuilder| {
        let builder = Model::builder("field").extents([2, 1, 1]).substates::<Field>();
        let parameters = Weather { rain: 0.25, days: 3 };
        own(&process(builder.parameters(parameters)).build().unwrap(), 0, [10, 2])
    };
    let difference = with(|builder| builder.process(warm)).mismatch(&with(|b| b.process(edited::warm)));
    assert_eq!(difference.unwrap().what, "code of the processes");
    // The same process with another interval.
    let seldom = || with(|builder| builder.process_every(10, warm));
    assert_eq!(seldom().mismatch(&seldom()), None);
    let difference = with(|builder| builder.process(warm)).mismatch(&seldom());
    assert_eq!(difference.unwrap().what, "code of the processes");
    let helped = || with(|builder| builder.process(warm_twice));
    assert_eq!(helped().mismatch(&helped()), None);
    // The same process with another helper function.
    let difference = helped().mismatch(&with(|builder| builder.process(with_other_helper::warm_twice)));
    assert_eq!(difference.unwrap().what, "code of the processes");
    assert_eq!(text(run.other_program(["0.1.0", "field", "1.2.3"])), None);
    let newer = run.other_program(["0.2.0", "field", "1.2.3"]);
    assert_eq!(text(newer).unwrap(), "version of the framework: 0.1.0, not 0.2.0");
    Ok(())
}
