//! Pictures of runs, and the animation of them.

use crate::running::{CADEM, DEBRIS, HEAT, LANDSLIDE, LIFE, MOD2, POND, Workplace};
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// Draws a run, which must succeed; gives the pictures and the animation.
fn rendered(place: &Workplace, program: &str, options: &str, out: &str) -> (Vec<PathBuf>, PathBuf) {
    let output = place.invocation(program, &format!("render {options} --out {out}")).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && said.is_empty(), "{program} {options}: {said}");
    let entries = fs::read_dir(place.path(out).join("frames")).unwrap();
    let mut frames: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    frames.sort();
    (frames, place.path(out).join("animation.png"))
}

type Png = png::Reader<BufReader<File>>;

fn open(path: &Path) -> Png {
    png::Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap()
}

/// Width and height of a picture, and its pixels.
fn decoded(path: &Path) -> ([usize; 2], Vec<[u8; 3]>) {
    let mut reader = open(path);
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let pixels = bytes.as_chunks::<3>().0.to_vec();
    ([info.width as usize, info.height as usize], pixels)
}

#[test]
fn a_run_becomes_pictures_and_an_animation() {
    let place = Workplace::new();
    let options = "--steps 30 --every 8 --pixels 420x380 --fps 7";
    let (frames, animation) = rendered(&place, LIFE, options, "a");
    let names: Vec<String> =
        frames.iter().map(|path| path.file_name().unwrap().to_string_lossy().into_owned()).collect();
    let wanted = [0, 8, 16, 24].map(|step| format!("frame_{step:08}.png"));
    assert_eq!(names, wanted);
    let pictures: Vec<_> = frames.iter().map(|path| decoded(path)).collect();
    assert!(pictures.iter().all(|(size, _)| *size == [420, 380]));
    assert!(pictures.windows(2).all(|pair| pair[0].1 != pair[1].1));
    let mut reader = open(&animation);
    assert_eq!((reader.info().width, reader.info().height), (420, 380));
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 4);
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    for _ in 0..4 {
        reader.next_frame(&mut bytes).unwrap();
        let frame = reader.info().frame_control().unwrap();
        assert_eq!((frame.delay_num, frame.delay_den), (1, 7));
    }
    // The same again on another engine, over what is there.
    let before: Vec<Vec<u8>> =
        frames.iter().chain([&animation]).map(|path| fs::read(path).unwrap()).collect();
    let (frames, animation) = rendered(&place, LIFE, &format!("{options} --engine reference"), "a");
    let after: Vec<Vec<u8>> = frames.iter().chain([&animation]).map(|path| fs::read(path).unwrap()).collect();
    assert!(before == after);
}

#[test]
fn one_scale_serves_all_pictures() {
    let place = Workplace::new();
    // The cube cools, so the scale is that of its first state: the hottest colour is gone in the last
    // picture.
    let (frames, _) = rendered(&place, HEAT, "--size 9 --steps 60 --every 20 --engine reference", "a");
    let colours = |path: &Path| decoded(path).1.into_iter().collect::<BTreeSet<_>>();
    let middle = |path: &Path| {
        let ([width, height], pixels) = decoded(path);
        // The drawing of 9 by 9 cells of 85 pixels begins at (36, 96).
        assert!(width > 36 + 765 && height > 96 + 765);
        pixels[(96 + 382) * width + 36 + 382]
    };
    let lightness = |[r, g, b]: [u8; 3]| u32::from(r) + u32::from(g) + u32::from(b);
    let shown: Vec<u32> = frames.iter().map(|path| lightness(middle(path))).collect();
    assert!(shown.windows(2).all(|pair| pair[0] > pair[1]), "{shown:?}");
    assert!(colours(&frames[0]).contains(&middle(&frames[0])));
    // With both ends given, the hottest cell of the first picture is as before where the ends are those of
    // the run.
    let (other, _) = rendered(&place, HEAT, "--size 9 --steps 0 --range 0,400 --engine reference", "b");
    assert!(lightness(middle(&other[0])) < shown[0]);
}

#[test]
fn each_view_draws_something_of_its_own() {
    let place = Workplace::new();
    let mut seen = BTreeSet::new();
    for (number, (program, options)) in [
        (MOD2, "--size 16 --steps 0"),
        (MOD2, "--size 16 --steps 0 --axis x"),
        (MOD2, "--size 16 --steps 0 --axis y --layer 8"),
        (MOD2, "--size 16 --steps 0 --layer 9"),
        (MOD2, "--size 16 --steps 0 --view isometric"),
        (CADEM, "--steps 0"),
        (CADEM, "--steps 0 --substate position --pixels 640x480"),
    ]
    .into_iter()
    .enumerate()
    {
        let (frames, _) = rendered(&place, program, options, &number.to_string());
        assert_eq!(frames.len(), 1);
        assert!(seen.insert(decoded(&frames[0]).1), "{program} {options} looks like another");
    }
}

#[test]
fn what_cannot_be_drawn_is_said_before_anything_is_run() {
    let place = Workplace::new();
    for (program, options, wanted) in [
        (LIFE, "--substate colour", "unknown substate `colour`; there are alive"),
        (LIFE, "--view spheres", "this model has no items to draw"),
        (LIFE, "--substate alive --view spheres", "cannot be drawn as spheres"),
        (CADEM, "--view slice", "this model has no cells to draw"),
        (CADEM, "--layer 3", "for slices of cells"),
        (LIFE, "--layer 1", "there is no layer 1"),
        (LIFE, "--pixels 100x100", "from 320x280"),
        (LIFE, "--range 3,1", "the lower one first"),
        (LIFE, "--fps 0", "0 is not in 1..=100"),
    ] {
        let output = place.invocation(program, &format!("render {options}")).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{options}: {said}");
        assert!(said.contains(wanted), "{options}: {said}");
    }
    assert!(!place.path("out").exists());
}

/// The names of the files of a folder, with their bytes.
fn all(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    let mut all: Vec<_> =
        entries.filter(|path| path.is_file()).map(|path| (name(&path), fs::read(path).unwrap())).collect();
    all.sort();
    all
}

/// Calls a program, which must succeed and say nothing on stderr; gives what it said else.
fn said(place: &Workplace, program: &str, words: &str) -> String {
    let output = place.invocation(program, words).output().unwrap();
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && complaint.is_empty(), "{program} {words}: {complaint}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn what_a_run_has_left_is_drawn_as_the_run_itself() {
    let place = Workplace::new();
    for (program, name, run, look) in [
        (HEAT, "heat", "--size 12 --steps 40 --every 20", "--range 0,100 --pixels 420x380"),
        (
            HEAT,
            "heat",
            "--size 12 --steps 40 --every 20 --precision f32",
            "--view isometric --pixels 420x380",
        ),
        (LIFE, "life", "--steps 12 --every 4", ""),
        (LANDSLIDE, "landslide", "--steps 60 --every 30", "--pixels 480x500"),
        (LANDSLIDE, "landslide", "--steps 60 --every 30", "--substate altitude,thickness"),
        (DEBRIS, "debris", "--steps 60 --every 30", ""),
        (CADEM, "cadem", "--steps 10 --every 5", "--range 0,0.5 --pixels 420x380"),
    ] {
        said(&place, program, &format!("run {run} --quiet"));
        let run_folder = place.path("out").join(name);
        let before = [all(&run_folder), all(&run_folder.join("frames"))];
        let told = said(&place, program, &format!("render out/{name} {look}"));
        assert!(
            told.contains(&format!("pictures of the states in out/{name}; they are in out/{name}_pictures"))
        );
        said(&place, program, &format!("render {run} {look} --out again --quiet"));
        let [saved, again] = [place.path(&format!("out/{name}_pictures")), place.path("again")];
        assert!(all(&saved.join("frames")) == all(&again.join("frames")), "{name} {look}");
        let animation = |folder: &Path| fs::read(folder.join("animation.png")).unwrap();
        assert!(animation(&saved) == animation(&again), "{name} {look}");
        assert!(before == [all(&run_folder), all(&run_folder.join("frames"))], "{name} has been changed");
    }
}

/// Hexagons too: the picture of the run itself is that of its frame.
#[test]
fn a_picture_of_a_run_is_that_of_its_frame() {
    let place = Workplace::new();
    for (program, name) in [(DEBRIS, "debris"), (LANDSLIDE, "landslide")] {
        said(&place, program, "run --steps 0 --quiet");
        said(&place, program, &format!("render out/{name} --animation none"));
        let [of_run, of_frame] = ["out/@/final.png", "out/@_pictures/frames/frame_00000000.png"]
            .map(|path| fs::read(place.path(&path.replace('@', name))).unwrap());
        assert!(of_run == of_frame, "{name}");
    }
}

/// The final state is drawn of its grids as of the checkpoint, which has every bit.
#[test]
fn grids_are_drawn_as_the_state_that_they_are_of() {
    let place = Workplace::new();
    place.write("g.asc", ISLAND);
    place.write("d.asc", &ISLAND.replace("501", "5").replace("50", "0"));
    let slide = "--dem g.asc --debris d.asc --steps 7";
    let substates = "--substate altitude --substate thickness --pixels 1000x420";
    let pond =
        ["--substate ground", "--substate wet --pixels 500x400", "--substate outflow", "--substate depth"];
    let cases = [substates, "", "--view isometric"].map(|look| (LANDSLIDE, slide, look));
    let pond = pond.map(|look| (POND, "--steps 8", look));
    for precision in ["f64", "f32"] {
        for (format, extension) in [("tif", "tif"), ("asc", "asc")] {
            for (program, options) in [(LANDSLIDE, slide), (POND, "--steps 8")] {
                let options = format!("{options} --precision {precision} --checkpoint-every 4");
                // That of another program would be in the way.
                if place.path("run").exists() {
                    fs::remove_dir_all(place.path("run")).unwrap();
                }
                // The landslide warns that the island is small.
                place.succeed(program, &format!("{options} --formats {format},png --quiet --out run"));
                assert!(all(&place.path("run")).iter().any(|(name, _)| name.ends_with(extension)));
                for (_, _, look) in cases.iter().chain(&pond).filter(|(other, ..)| *other == program) {
                    let step = if program == POND { "00000008" } else { "00000007" };
                    let checkpoint = format!("run/checkpoints/step_{step}.checkpoint");
                    said(&place, program, &format!("render run {look} --out of_grids"));
                    said(&place, program, &format!("render {checkpoint} {look} --out of_checkpoint"));
                    let of_grids = all(&place.path("of_grids/frames"));
                    let wanted = fs::read(place.path(&format!("of_checkpoint/step_{step}.png"))).unwrap();
                    assert_eq!(of_grids.len(), 1);
                    assert!(of_grids[0].1 == wanted, "{format} {precision} {look}");
                }
            }
        }
    }
    // The run's own picture, of a state that has the scale of the first one.
    place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --steps 0 --formats tif,png --quiet --out first");
    said(&place, LANDSLIDE, "render first --out of_first");
    let picture = fs::read(place.path("of_first/frames/frame_00000000.png")).unwrap();
    assert!(picture == fs::read(place.path("first/final.png")).unwrap());
}

/// A map of 4 by 3 cells, one of them without ground.
const ISLAND: &str = "ncols 4\nnrows 3\nxllcorner 100\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n\
     50 50 50 50\n50 501 501 -9999\n50 50 50 50\n";

#[test]
fn grids_of_something_else_are_refused() {
    let place = Workplace::new();
    said(&place, POND, "run --steps 2 --formats asc --quiet --out run");
    let refused = |words: &str| {
        let output = place.invocation(POND, words).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}");
        String::from_utf8(output.stderr).unwrap()
    };
    let leaves = refused("render run --view spheres --out pictures");
    let wanted = "error: the formats of the run in run (asc) do not give `leaves` back; run it with --formats +vtk, or \
         draw a checkpoint\n";
    assert_eq!(leaves, wanted);
    let ground = place.read("run/final_ground.asc");
    let lines: Vec<&str> = ground.lines().collect();
    let (header, rows) = lines.split_at(6);
    let first = rows[0].split_once(' ').unwrap().1;
    place.write(
        "run/final_ground.asc",
        &format!("{}\n7 {first}\n{}\n", header.join("\n"), rows[1..].join("\n")),
    );
    let said = refused("render run --out pictures");
    let wanted =
        "run/final_ground.asc: 7 is no value of `ground` (column 1 from the west, row 1 from the north)\n";
    assert!(said.ends_with(wanted), "{said}");
    place.write("run/final_ground.asc", &ground.replacen("cellsize 1", "cellsize 2", 1));
    let said = refused("render run --out pictures");
    assert!(
        said.contains("run/final_ground.asc is not of this run: its cells have a side of 2, not 1"),
        "{said}"
    );
    fs::remove_file(place.path("run/final_ground.asc")).unwrap();
    assert!(refused("render run --out pictures").contains("no state is saved in "));
    assert!(!place.path("pictures").exists());
}

#[test]
fn a_checkpoint_is_drawn() {
    let place = Workplace::new();
    said(&place, CADEM, "run --steps 10 --every 5 --checkpoint-every 5 --quiet");
    let told = said(&place, CADEM, "render out/cadem/checkpoints/step_00000005.checkpoint --range 0,0.5");
    assert_eq!(told, "the state after 5 steps is drawn in out/cadem_pictures/step_00000005.png\n");
    said(&place, CADEM, "render out/cadem --range 0,0.5 --out all --animation none");
    let frame = fs::read(place.path("all/frames/frame_00000005.png")).unwrap();
    assert!(frame == fs::read(place.path("out/cadem_pictures/step_00000005.png")).unwrap());
    assert!(!place.path("all/animation.png").exists());
    // Elsewhere, it does not tell whose it was.
    fs::copy(place.path("out/cadem/checkpoints/step_00000005.checkpoint"), place.path("five")).unwrap();
    fs::remove_dir_all(place.path("out")).unwrap();
    said(&place, CADEM, "render five --range 0,0.5");
    assert!(frame == fs::read(place.path("out/cadem_pictures/step_00000005.png")).unwrap());
}

#[test]
fn an_animated_gif_shows_the_pictures() {
    let place = Workplace::new();
    said(&place, LIFE, "render --steps 3 --every 1 --pixels 420x380 --fps 7 --animation gif --out a --quiet");
    assert!(!place.path("a/animation.png").exists());
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(File::open(place.path("a/animation.gif")).unwrap()).unwrap();
    assert_eq!((decoder.width(), decoder.height(), decoder.repeat()), (420, 380, gif::Repeat::Infinite));
    let mut shown = vec![[0; 3]; 420 * 380];
    for (step, delay) in [14, 15, 14, 14].into_iter().enumerate() {
        let frame = decoder.read_next_frame().unwrap().unwrap();
        assert_eq!(frame.delay, delay);
        let [left, top, width] = [frame.left, frame.top, frame.width].map(usize::from);
        for (at, [red, green, blue, _]) in frame.buffer.as_chunks::<4>().0.iter().enumerate() {
            shown[(top + at / width) * 420 + left + at % width] = [*red, *green, *blue];
        }
        // There are more than 256, as letters and cells have soft edges; what there is most of is exact.
        let (_, wanted) = decoded(&place.path(&format!("a/frames/frame_{step:08}.png")));
        let paper = |(wanted, shown): &(&[u8; 3], &[u8; 3])| **wanted != [255; 3] || wanted == shown;
        assert!(wanted.iter().zip(&shown).all(|pair| paper(&pair)), "step {step}");
        let channels = wanted.as_flattened().iter().zip(shown.as_flattened());
        let largest = channels.map(|(wanted, shown)| wanted.abs_diff(*shown)).max().unwrap();
        assert!(largest <= 24, "step {step}: {largest}");
    }
    assert!(decoder.read_next_frame().unwrap().is_none());
}

#[test]
fn several_views_stand_side_by_side() {
    let place = Workplace::new();
    said(&place, MOD2, "run --size 16 --steps 4 --quiet");
    said(&place, MOD2, "render out/mod2 --view slice,isometric --pixels 900x420 --out both");
    said(&place, MOD2, "render out/mod2 --view isometric --view slice --pixels 900x420 --out turned");
    let (size, both) = decoded(&place.path("both/frames/frame_00000003.png"));
    let (_, turned) = decoded(&place.path("turned/frames/frame_00000003.png"));
    assert_eq!(size, [900, 420]);
    // Below the texts, the halves change places.
    for (y, row) in both.chunks(900).enumerate().skip(130) {
        let other = &turned[900 * y..900 * (y + 1)];
        assert!(row[..450] == other[450..] && row[450..] == other[..450], "row {y}");
    }
    assert!(both != turned);
}

#[test]
fn what_was_run_by_another_program_is_not_drawn() {
    let place = Workplace::new();
    said(&place, LIFE, "run --steps 2 --quiet");
    for (words, wanted) in [
        ("render out/life", "error: cannot draw out/life: its program is life, not heat\n"),
        ("render out", "error: out is not the output of a run: it has no run.json\n"),
        (
            "render out/life/initial.png",
            "error: out/life/initial.png is not a checkpoint of an xca program\n",
        ),
        (
            "render out/life --size 3",
            "error: --size is for a new run; this one is drawn from its files, with its own options\n",
        ),
    ] {
        let output = place.invocation(HEAT, words).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}");
        assert_eq!(String::from_utf8(output.stderr).unwrap(), wanted);
    }
    assert!(!place.path("out/life_pictures").exists());
}
