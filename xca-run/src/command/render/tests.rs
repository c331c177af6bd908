//! Pictures of what runs have left, as the command line makes them.

mod pond;

use pond::{Place, measured, pond};
use std::fs;
use xca_core::{GroupSnapshot, Precision, Reference, RunOptions, Simulation};
use xca_record::record::Recorder;

const SMALL: &str = "--pixels 700x320";

#[test]
fn saved_states_look_as_they_did_when_they_were_run() {
    let place = Place::new(pond);
    for precision in ["f64", "f32"] {
        let run = format!("--width 4 --steps 6 --every 2 --precision {precision}");
        place.succeed(&format!("run {run} --out @run"));
        let before = place.files("run");
        let looks = [
            "--substate age",
            "--axis x --layer 1",
            "",
            "--axis y",
            "--view isometric --range 0,2.5",
            "--substate flow",
            "--substate kind",
            "--substate position --range 0.5,1",
            "--substate weight",
            "--substate depth,age",
            "--view slice --view isometric --view spheres --substate depth --substate kind --substate weight --pixels 1000x400",
        ];
        let count = if precision == "f64" { looks.len() } else { 2 };
        for look in &looks[..count] {
            let pixels = if look.contains("pixels") { "" } else { SMALL };
            place.succeed(&format!("render {run} {look} {pixels} --out @again"));
            place.succeed(&format!("render @run {look} {pixels} --out @saved"));
            let (again, saved) = (place.files("again/frames"), place.files("saved/frames"));
            let names: Vec<&str> = saved.iter().map(|(name, _)| name.as_str()).collect();
            let wanted = [0, 2, 4, 6].map(|step| format!("frame_{step:08}.png"));
            assert_eq!(names, wanted, "{look}");
            assert!(again == saved, "{precision} {look}");
            assert!(saved.windows(2).all(|pair| pair[0].1 != pair[1].1), "{look}: all look alike");
            let animation =
                |folder| place.files(folder).into_iter().find(|(name, _)| name == "animation.png");
            assert!(animation("again").is_some() && animation("again") == animation("saved"), "{look}");
        }
        assert!(place.files("run") == before, "the run is as it was");
        assert_eq!(place.files("run/frames").len(), 12);
    }
}

/// A format that keeps no types gives back what it was written of, for all that a view saves.
#[test]
fn items_look_the_same_drawn_of_extended_xyz() {
    let place = Place::new(pond);
    for precision in ["f64", "f32"] {
        let run = format!("--width 4 --steps 6 --every 3 --precision {precision}");
        place.succeed(&format!("run {run} --formats xyz,png --out @run"));
        for look in ["--substate age", "--substate position --range 0.5,1", "--substate weight"] {
            place.succeed(&format!("render {run} {look} {SMALL} --out @again"));
            place.succeed(&format!("render @run {look} {SMALL} --out @saved"));
            assert_eq!(place.files("saved/frames").len(), 3, "{look}");
            assert!(place.files("again/frames") == place.files("saved/frames"), "{precision} {look}");
        }
    }
    let said = place.refused("render @run --substate depth");
    assert!(
        said.ends_with(
            "run (png, xyz) do not give `water` back; run it with --formats +vtk, or draw a checkpoint"
        ),
        "{said}"
    );
    let place = Place::new(|width| measured(width, true));
    place.succeed("run --width 4 --steps 6 --every 3 --precision f32 --formats xyz --out @run");
    for out in
        ["render --width 4 --steps 6 --every 3 --precision f32 --out @again", "render @run --out @saved"]
    {
        place.succeed(&format!("{out} --view spheres {SMALL}"));
    }
    assert!(place.files("again/frames") == place.files("saved/frames"));
    let frame = place.folder.path().join("run/frames/fish_00000000.xyz");
    let text = fs::read_to_string(&frame).unwrap();
    fs::write(&frame, text.replacen(":age:I:1", ":age:R:1", 1).replacen(" 7 1\n", " 7.5 1\n", 1)).unwrap();
    let said = place.refused("render @run --substate age");
    assert!(said.contains("7.5 of particle ") && said.contains(" is no value of `age`"), "{said}");
}

/// What is computed looks as the substate does that it is equal to, in a run and drawn of its files.
#[test]
fn what_is_computed_of_substates_is_drawn() {
    for precision in ["f64", "f32"] {
        let pictures = [false, true].map(|is_computed| {
            let place = Place::new(move |width| measured(width, is_computed));
            let run = format!("--width 4 --steps 6 --every 3 --precision {precision}");
            place.succeed(&format!("run {run} --out @run"));
            let mut pictures = Vec::new();
            for look in ["", "--axis x --layer 1", "--axis y", "--view isometric", "--view spheres"] {
                place.succeed(&format!("render {run} {look} {SMALL} --out @again"));
                place.succeed(&format!("render @run {look} {SMALL} --out @saved"));
                let saved = place.files("saved/frames");
                assert!(place.files("again/frames") == saved, "{precision} {look}");
                assert!(saved.windows(2).all(|pair| pair[0].1 != pair[1].1), "{look}: all look alike");
                pictures.push(saved);
            }
            let of_run = place.files("run").into_iter().filter(|(name, _)| name.ends_with("png"));
            (pictures, of_run.collect::<Vec<_>>())
        });
        assert_eq!(pictures[0].1.len(), 6);
        assert!(pictures[0] == pictures[1], "{precision}");
    }
}

#[test]
fn a_checkpoint_looks_like_the_state_of_its_step() {
    let place = Place::new(pond);
    place.succeed("run --width 4 --steps 6 --every 1 --checkpoint-every 3 --out @run");
    let checkpoint = "@run/checkpoints/step_00000003.checkpoint";
    for look in ["--range 0,3", "--view isometric --range 0,3", "--substate age --range 0,20"] {
        place.succeed(&format!("render @run {look} {SMALL} --out @saved --every 3"));
        place.succeed(&format!("render {checkpoint} {look} {SMALL}"));
        let frames = place.files("saved/frames");
        assert_eq!(frames.len(), 3);
        assert_eq!(place.files("run_pictures"), [("step_00000003.png".to_owned(), frames[1].1.clone())]);
    }
    // Alone, it has a scale of its own.
    place.succeed(&format!("render {checkpoint} {SMALL} --out @alone"));
    place.succeed(&format!("render {checkpoint} {SMALL} --out @saved --range 0,3"));
    let said = place.refused(&format!("render {checkpoint} --every 2"));
    assert_eq!(said, "--every is for several pictures; a checkpoint gives one");
    assert!(place.files("alone")[0].1 != place.files("saved")[0].1);
}

#[test]
fn what_is_not_saved_is_said_and_a_checkpoint_has_it() {
    let place = Place::new(pond);
    place.succeed("run --width 4 --steps 6 --checkpoint-every 3 --out @run");
    let said = place.refused("render @run --substate velocity --out @saved");
    assert!(
        said.ends_with(
            "run/frames/fish_00000000.vtp does not hold the substate `velocity`, but label, age: the view of \
             `fish` saves only these; a checkpoint holds everything"
        ),
        "{said}"
    );
    // What the fish are coloured by unless something else is named.
    assert!(place.refused("render @run --view spheres --out @saved").contains("the substate `velocity`"));
    assert!(!place.folder.path().join("saved").exists());
    place.succeed("render @run/checkpoints/step_00000003.checkpoint --substate velocity --out @saved");
    assert_eq!(place.files("saved").len(), 1);
}

#[test]
fn only_steps_that_are_wanted_and_whole_are_drawn() {
    let place = Place::new(pond);
    place.succeed("run --width 4 --steps 6 --every 1 --out @run");
    fs::remove_file(place.folder.path().join("run/frames/fish_00000004.vtp")).unwrap();
    let names = |folder: &str| -> Vec<String> {
        place.files(folder).into_iter().map(|(name, _)| name[12..14].to_owned()).collect()
    };
    place.succeed(&format!("render @run {SMALL} --substate depth,age --every 2 --animation none"));
    assert_eq!(names("run_pictures/frames"), ["00", "02", "06"]);
    assert_eq!(place.files("run_pictures").len(), 1, "the report alone");
    place.succeed(&format!("render @run {SMALL} --every 4 --animation gif --fps 50"));
    assert_eq!(names("run_pictures/frames"), ["00", "04"]);
    let report = String::from_utf8(place.files("run_pictures")[1].1.clone()).unwrap();
    assert!(report.contains("animation.gif") && report.contains("\"outcome\": \"done\""), "{report}");
    fs::remove_file(place.folder.path().join("run/frames/water_00000000.vti")).unwrap();
    assert!(place.refused("render @run --every 7").contains("is of a step that 7 divides"));
    assert!(place.refused("render @run --animation gif --fps 51").contains("give --fps 50 or less"));
}

#[test]
fn runs_of_others_are_refused() {
    let mut place = Place::new(pond);
    place.succeed("run --width 4 --checkpoint-every 3 --out @run");
    let both = ["@run", "@run/checkpoints/step_00000003.checkpoint"];
    let said = |place: &Place, wanted: &str| {
        for path in both {
            let said = place.refused(&format!("render {path} --out @saved"));
            assert!(said.starts_with("cannot draw ") && said.contains(wanted), "{said}");
        }
        assert!(!place.folder.path().join("saved").exists());
    };
    place.name = "lake";
    said(&place, ": its program is pond, not lake");
    (place.name, place.version) = ("pond", "2");
    said(&place, ": its version of the program is 1, not 2");
    place.version = "1";
    place.make = Box::new(|width| pond(width + 1));
    said(&place, ": its model is cells [4,3,2], not cells [5,3,2]");
    place.make = Box::new(|width| {
        let mut set_up = pond(width)?;
        set_up.model.set_parameter("rain", "0.25")?;
        Ok(set_up)
    });
    said(&place, ": its set of parameters is rain = 0.125, not rain = 0.25");
    place.make = Box::new(pond);
    place.succeed("render @run --out @saved");
}

#[test]
fn files_that_are_none_of_a_run_are_refused() {
    let place = Place::new(pond);
    let write = |name: &str, bytes: &[u8]| fs::write(place.folder.path().join(name), bytes).unwrap();
    assert!(
        place
            .refused("render @nothing")
            .ends_with("nothing does not exist; give the output directory of a run, or a checkpoint")
    );
    write("notes.txt", b"a day at the pond");
    assert!(place.refused("render @notes.txt").contains("is not a checkpoint of an xca program"));
    fs::create_dir(place.folder.path().join("empty")).unwrap();
    let said = place.refused("render @empty");
    assert!(said.contains("empty is not the output of a run: it has no run.json"), "{said}");
    place.succeed("run --width 4 --steps 6 --every 3 --checkpoint-every 3 --out @run");
    place.succeed(&format!("render @run {SMALL}"));
    assert!(place.refused("render @run_pictures").contains("holds pictures of a run, not the run"));
    // A frame that is cut off, even the last one, and one of another model.
    let frame = "run/frames/water_00000006.vti";
    let whole = fs::read(place.folder.path().join(frame)).unwrap();
    write(frame, &whole[..whole.len() - 5]);
    assert!(place.refused("render @run").contains("water_00000006.vti is truncated"));
    let text = String::from_utf8_lossy(&whole).into_owned();
    assert_eq!(text.matches("0 4 0 3 0 2").count(), 2);
    let last = text.rfind("<Piece").unwrap() + "<Piece Extent=\"".len();
    write(frame, &[&whole[..last], b"0 4 0 2 0 3", &whole[last + 11..]].concat());
    let said = place.refused("render @run");
    assert!(said.contains("does not fit the model: it has [4, 2, 3] cells, not [4, 3, 2]"), "{said}");
    fs::remove_dir_all(place.folder.path().join("run/frames")).unwrap();
    let said = place.refused("render @run");
    assert!(said.contains("no state is saved in") && said.ends_with("step_00000006.checkpoint"), "{said}");
}

#[test]
fn the_folder_of_a_run_is_not_taken_for_pictures() {
    let place = Place::new(pond);
    place.succeed("run --width 4 --checkpoint-every 3 --out @run");
    let before = (place.files("run"), place.files("run/frames"), place.files("run/checkpoints"));
    for words in ["render @run --out @run", "render --width 4 --out @run"] {
        assert!(place.refused(words).contains("holds a run, which this would overwrite"), "{words}");
    }
    let after = (place.files("run"), place.files("run/frames"), place.files("run/checkpoints"));
    assert!(before == after);
    // But a folder of pictures is.
    place.succeed(&format!("render --width 4 {SMALL} --out @pictures"));
    place.succeed(&format!("render @run {SMALL} --out @pictures"));
}

#[test]
fn a_run_that_is_drawn_has_its_own_options() {
    let place = Place::new(pond);
    place.succeed("run --width 4 --out @run");
    for (option, name) in [("--width 5", "--width"), ("--steps 3", "--steps"), ("--seed 2", "--seed")] {
        let said = place.refused(&format!("render @run {option}"));
        assert_eq!(
            said,
            format!("{name} is for a new run; this one is drawn from its files, with its own options")
        );
    }
    assert!(place.refused("render").contains("--width"), "an option that is required is so for a run");
    fs::write(place.folder.path().join("look.toml"), "pixels = '400x300'\nsubstate = ['depth']\n").unwrap();
    place.succeed("render @run --config @look.toml");
}

#[test]
fn panels_are_counted() {
    let place = Place::new(pond);
    for (words, wanted) in [
        (
            "--view slice,isometric --substate depth,kind,age",
            "--substate is given 3 times and --view 2 times",
        ),
        (
            "--view slice,isometric --pixels 639x400",
            "639x400 pixels are too few for 2 panels; they take 640x314",
        ),
        ("--view isometric,isometric --layer 1", "--axis and --layer are for slices of cells"),
        ("--view slice,isometric --axis x,y", "--axis and --layer are for slices of cells"),
        ("--view slice,isometric --layer 2", "there is no layer 2: along that axis there are 2"),
        (
            "--range 0,1 --range 0,2 --range 1,2 --view slice,isometric",
            "--range is given 3 times and --view 2 times",
        ),
        ("--axis x,w", "it must be x, y or z"),
    ] {
        let said = place.refused(&format!("render --width 4 {words} --out @out"));
        assert!(said.contains(wanted), "{words}: {said}");
    }
    assert!(!place.folder.path().join("out").exists());
    place.succeed("render --width 4 --steps 0 --view slice,isometric --axis x --layer 3 --out @out");
}

#[test]
fn a_state_of_another_shape_does_not_fit() {
    let recorder = Recorder::new(pond(4).unwrap()).unwrap();
    let options = RunOptions { precision: Precision::F64, seed: 1 };
    let simulation = Simulation::new(recorder.model(), &Reference, options).unwrap();
    let snapshot = simulation.snapshot().unwrap();
    assert!(recorder.fits(Precision::F64, &snapshot));
    assert!(!recorder.fits(Precision::F32, &snapshot));
    let changes: [fn(&mut Vec<GroupSnapshot>); 5] = [
        |groups| drop(groups.pop()),
        |groups| groups.swap(0, 1),
        |groups| {
            let GroupSnapshot::Cells(fields) = &mut groups[0] else { panic!("no cells") };
            fields[2].pop();
        },
        |groups| {
            let GroupSnapshot::Population(population, _) = &mut groups[1] else { panic!("no items") };
            population.counts[0] += 1;
        },
        |groups| {
            let GroupSnapshot::Population(population, _) = &mut groups[1] else { panic!("no items") };
            population.fields.pop();
        },
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut changed = snapshot.clone();
        change(&mut changed.groups);
        assert!(!recorder.fits(Precision::F64, &changed), "{number}");
    }
}
