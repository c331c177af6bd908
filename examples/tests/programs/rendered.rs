//! Pictures of runs, and the animation of them.

use crate::running::{CADEM, HEAT, LIFE, MOD2, Workplace};
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
    // The cube cools, so the scale is that of its first state: the hottest colour is gone in the last picture.
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
    // With both ends given, the hottest cell of the first picture is as before where the ends are those of the run.
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
        (LIFE, "--substate colour", "no substate is called `colour`; there are alive"),
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
