//! Animated PNG files (APNG), which browsers play and every other program shows the first picture of.

use super::atomic::{WriteError, write_atomically};
use super::picture::Picture;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

/// Makes one animated PNG, which is played for ever, of pictures in PNG files; all must have the size of the first, in RGB with 8 bits.
///
/// Only what changes from one picture to the next is stored.
///
/// # Errors
/// [`WriteError::File`] with the path of the animation, where it cannot be written or a picture cannot be read.
pub fn write_animation(path: &Path, pictures: &[PathBuf], pictures_a_second: u16) -> Result<(), WriteError> {
    write_atomically(path, |file| {
        let count = u32::try_from(pictures.len()).map_err(io::Error::other)?;
        let mut rest = pictures.iter();
        let first = rest.next().ok_or_else(|| io::Error::other("an animation of no pictures"))?;
        let mut before = read(first)?;
        let mut encoder = png::Encoder::new(file, size(before.width())?, size(before.height())?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_animated(count, 0)?;
        encoder.set_frame_delay(1, pictures_a_second)?;
        let mut writer = encoder.write_header()?;
        writer.write_image_data(before.rgb())?;
        for path in rest {
            let now = read(path)?;
            if (now.width(), now.height()) != (before.width(), before.height()) {
                return Err(io::Error::other(format!("{} has another size", path.display())));
            }
            let Part { at: [x, y], size: [width, height] } = changed(&before, &now);
            writer.reset_frame_position()?;
            writer.set_frame_dimension(size(width)?, size(height)?)?;
            writer.set_frame_position(size(x)?, size(y)?)?;
            let rows = now.rgb().chunks_exact(3 * now.width()).skip(y).take(height);
            let bytes: Vec<u8> = rows.flat_map(|row| &row[3 * x..3 * (x + width)]).copied().collect();
            writer.write_image_data(&bytes)?;
            before = now;
        }
        Ok(writer.finish()?)
    })
}

fn size(pixels: usize) -> io::Result<u32> {
    u32::try_from(pixels).map_err(io::Error::other)
}

/// A picture as [`Picture::write`] writes it.
fn read(path: &Path) -> io::Result<Picture> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path)?)).read_info()?;
    let [width, height] = [reader.info().width as usize, reader.info().height as usize];
    let mut rgb = vec![0; 3 * width * height];
    if reader.output_buffer_size() != Some(rgb.len()) {
        return Err(io::Error::other(format!("{} is not in RGB with 8 bits", path.display())));
    }
    reader.next_frame(&mut rgb)?;
    Ok(Picture::new(width, height, rgb))
}

/// A rectangle of a picture.
#[derive(Debug, PartialEq)]
struct Part {
    at: [usize; 2],
    size: [usize; 2],
}

/// The least rectangle with all pixels that two pictures of the same size do not share; one pixel where there are none, as a picture of an
/// animation cannot be empty.
fn changed(before: &Picture, now: &Picture) -> Part {
    let width = now.width();
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    let pixels = before.rgb().as_chunks::<3>().0.iter().zip(now.rgb().as_chunks::<3>().0);
    for (place, _) in pixels.enumerate().filter(|(_, (before, now))| before != now) {
        for (axis, at) in [place % width, place / width].into_iter().enumerate() {
            low[axis] = low[axis].min(at);
            high[axis] = high[axis].max(at);
        }
    }
    if low[0] > high[0] {
        return Part { at: [0; 2], size: [1; 2] };
    }
    Part { at: low, size: [high[0] - low[0] + 1, high[1] - low[1] + 1] }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn played_it_shows_each_picture() {
        let folder = tempfile::tempdir().unwrap();
        let pictures = pictures(folder.path());
        let path = folder.path().join("animation.png");
        write_animation(&path, &pictures, 25).unwrap();
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
        // From (2, 1) to (6, 3), nothing, and from (2, 1) to (8, 5).
        assert_eq!(sizes, [[9, 6], [5, 3], [1, 1], [7, 5]]);
    }

    #[test]
    fn what_cannot_be_made_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("animation.png");
        assert!(write_animation(&path, &[], 10).is_err());
        assert!(write_animation(&path, &[folder.path().join("none.png")], 10).is_err());
        let mut pictures = pictures(folder.path());
        Picture::new(2, 2, vec![0; 12]).write(&pictures[2]).unwrap();
        pictures.truncate(3);
        assert!(write_animation(&path, &pictures, 10).is_err());
        assert!(!path.exists());
    }
}
