use super::film::read;
use super::*;
use crate::Picture;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// Pictures of 9 by 6 pixels: all black, a red and a green pixel, the same again, one blue pixel.
fn pictures(folder: &Path) -> Vec<PathBuf> {
    let of = |coloured: &[(usize, usize)]| {
        let mut rgb = vec![0; 3 * 9 * 6];
        for &(pixel, channel) in coloured {
            rgb[3 * pixel + channel] = 200;
        }
        Picture::new(9, 6, rgb)
    };
    let all = [of(&[]), of(&[(11, 0), (33, 1)]), of(&[(11, 0), (33, 1)]), of(&[(53, 2)])];
    let written = all.iter().enumerate().map(|(number, picture)| {
        let path = folder.join(format!("{number}.png"));
        picture.write(&path).unwrap();
        path
    });
    written.collect()
}

#[test]
fn an_apng_shows_each_picture() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = pictures(folder.path());
    let path = folder.path().join("animation.png");
    write_apng(&path, &pictures, 25).unwrap();
    let mut reader = png::Decoder::new(BufReader::new(File::open(&path).unwrap())).read_info().unwrap();
    let control = *reader.info().animation_control().unwrap();
    assert_eq!((control.num_frames, control.num_plays), (4, 0));
    let mut shown = vec![7; 3 * 9 * 6];
    let mut sizes = Vec::new();
    for picture in &pictures {
        let mut part = vec![0; 3 * 9 * 6];
        reader.next_frame(&mut part).unwrap();
        let frame = *reader.info().frame_control().unwrap();
        assert_eq!((frame.delay_num, frame.delay_den), (1, 25));
        let [x, y, width, height] =
            [frame.x_offset, frame.y_offset, frame.width, frame.height].map(|n| n as usize);
        for row in 0..height {
            let to = 3 * (9 * (y + row) + x);
            shown[to..to + 3 * width].copy_from_slice(&part[3 * row * width..3 * (row + 1) * width]);
        }
        sizes.push([width, height]);
        assert_eq!(shown, read(picture).unwrap().rgb(), "{}", picture.display());
    }
    // From (2, 1) to (6, 3), no change, and from (2, 1) to (8, 5).
    assert_eq!(sizes, [[9, 6], [5, 3], [1, 1], [7, 5]]);
}

/// The size of a GIF, its number of repetitions, and of each frame the delay, corner and size, and the pixels
/// shown then.
type Played = ([usize; 2], ::gif::Repeat, Vec<(u16, [u16; 4], Vec<u8>)>);

fn played(path: &Path) -> Played {
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(BufReader::new(File::open(path).unwrap())).unwrap();
    let [width, height] = [usize::from(decoder.width()), usize::from(decoder.height())];
    let mut shown = vec![7; 3 * width * height];
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert!(frame.palette.is_none(), "the palette is that of the film");
        assert_eq!(frame.dispose, ::gif::DisposalMethod::Keep);
        let part = [frame.left, frame.top, frame.width, frame.height];
        let [x, y, columns, _] = part.map(usize::from);
        for (row, pixels) in frame.buffer.chunks_exact(4 * columns).enumerate() {
            for (column, rgba) in pixels.as_chunks::<4>().0.iter().enumerate() {
                assert_eq!(rgba[3], 255);
                let to = 3 * (width * (y + row) + x + column);
                shown[to..to + 3].copy_from_slice(&rgba[..3]);
            }
        }
        frames.push((frame.delay, part, shown.clone()));
    }
    ([width, height], decoder.repeat(), frames)
}

#[test]
fn a_gif_shows_each_picture() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = pictures(folder.path());
    let path = folder.path().join("animation.gif");
    write_gif(&path, &pictures, 12).unwrap();
    let (size, repeat, frames) = played(&path);
    assert_eq!((size, repeat, frames.len()), ([9, 6], ::gif::Repeat::Infinite, 4));
    for ((_, _, shown), picture) in frames.iter().zip(&pictures) {
        assert_eq!(shown, read(picture).unwrap().rgb(), "{}", picture.display());
    }
    // From (2, 1) to (6, 3), no change, and from (2, 1) to (8, 5).
    let parts: Vec<[u16; 4]> = frames.iter().map(|(_, part, _)| *part).collect();
    assert_eq!(parts, [[0, 0, 9, 6], [2, 1, 5, 3], [0, 0, 1, 1], [2, 1, 7, 5]]);
    // At twelve a second, each takes 8 1/3 hundredths.
    let delays: Vec<u16> = frames.iter().map(|(delay, ..)| *delay).collect();
    assert_eq!(delays, [8, 9, 8, 8]);
    write_gif(&path, &pictures, 50).unwrap();
    assert!(played(&path).2.iter().all(|(delay, ..)| *delay == 2));
}

#[test]
fn a_gif_of_many_colours_is_near_and_still_where_nothing_changes() {
    let folder = tempfile::tempdir().unwrap();
    // A constant ramp of 4096 colours, and a square of another colour that moves over it.
    let paths: Vec<PathBuf> = (0..5)
        .map(|number: usize| {
            let mut rgb: Vec<u8> = (0..64 * 64)
                .flat_map(|at: usize| [4 * (at % 64), 4 * (at / 64), 255 - 2 * (at % 64)].map(|c| c as u8))
                .collect();
            for at in (0..16).map(|i| 64 * (10 + i / 4) + 12 * number + i % 4) {
                rgb[3 * at..3 * at + 3].copy_from_slice(&[200, 0, 0]);
            }
            let path = folder.path().join(format!("{number}.png"));
            Picture::new(64, 64, rgb).write(&path).unwrap();
            path
        })
        .collect();
    let path = folder.path().join("animation.gif");
    write_gif(&path, &paths, 10).unwrap();
    let (_, _, frames) = played(&path);
    for ((_, _, shown), picture) in frames.iter().zip(&paths) {
        let wanted = read(picture).unwrap();
        let largest = shown.iter().zip(wanted.rgb()).map(|(shown, wanted)| shown.abs_diff(*wanted)).max();
        assert!(largest.unwrap() <= 40, "{largest:?}");
    }
    // Outside the rows of the square, all frames are the same to the last bit.
    let outside = |shown: &[u8]| [&shown[..3 * 640], &shown[3 * 896..]].concat();
    assert!(frames.windows(2).all(|pair| outside(&pair[0].2) == outside(&pair[1].2)));
    assert!(frames[1..].iter().all(|(_, part, _)| *part != [0, 0, 64, 64]));
}

#[test]
fn what_cannot_be_made_is_said() {
    type Write = fn(&Path, &[PathBuf], u16) -> Result<(), xca_io::atomic::WriteError>;
    for write in [write_apng as Write, write_gif] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("animation");
        assert!(write(&path, &[], 10).is_err());
        assert!(write(&path, &[folder.path().join("none.png")], 10).is_err());
        let mut pictures = pictures(folder.path());
        Picture::new(2, 2, vec![0; 12]).write(&pictures[2]).unwrap();
        pictures.truncate(3);
        assert!(write(&path, &pictures, 10).is_err());
        assert!(!path.exists());
    }
}

/// A header and the end of its picture: 69 bytes with a bit of data.
fn header_alone(width: u32, height: u32) -> Vec<u8> {
    let chunk = |content: &[u8]| {
        let length = (content.len() as u32 - 4).to_be_bytes();
        [&length[..], content, &crc32fast::hash(content).to_be_bytes()].concat()
    };
    let header = [&b"IHDR"[..], &width.to_be_bytes(), &height.to_be_bytes(), &[8, 2, 0, 0, 0]].concat();
    let data = b"IDAT\x78\x9c\x63\0\0\0\x01\0\x01";
    [b"\x89PNG\r\n\x1a\n".to_vec(), chunk(&header), chunk(data), chunk(b"IEND")].concat()
}

#[test]
fn pictures_are_refused_before_there_is_room_for_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("small.png");
    for (width, height, wanted) in [
        (60_000, 61_000, "has 60000 x 61000 pixels, which are too many"),
        (u32::MAX >> 1, u32::MAX >> 1, ""),
        (16_000, 16_000, "is too short for its 16000 x 16000 pixels"),
        (1, 1, ""),
    ] {
        let bytes = header_alone(width, height);
        assert!(bytes.len() < 70, "{}", bytes.len());
        std::fs::write(&path, bytes).unwrap();
        let error = read(&path).map(drop).unwrap_err().to_string();
        assert!(error.contains(wanted), "{width} x {height}: {error}");
    }
    if cfg!(unix) {
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        assert!(read(&pipe).map(drop).unwrap_err().to_string().contains("not a regular file"));
    }
}
