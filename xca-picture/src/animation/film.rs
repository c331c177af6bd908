//! Sequences of pictures, and the changes between them.

use crate::Picture;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use xca_io::deflate::can_hold;
use xca_io::regular_file;

/// Pictures in PNG files, read one at a time.
pub(super) struct Film<'a> {
    first: Picture,
    rest: &'a [PathBuf],
}

/// A rectangle of a picture with its pixels, row by row.
pub(super) struct Part<'a> {
    pub(super) at: [usize; 2],
    pub(super) size: [usize; 2],
    pub(super) rgb: &'a [u8],
}

impl<'a> Film<'a> {
    pub(super) fn new(pictures: &'a [PathBuf]) -> io::Result<Self> {
        let (first, rest) =
            pictures.split_first().ok_or_else(|| io::Error::other("an animation of no pictures"))?;
        Ok(Self { first: read(first)?, rest })
    }

    /// Width and height.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.first.width(), self.first.height()]
    }

    /// Passes on the first picture, and of each later one the part that changed.
    pub(super) fn each_part(&self, mut see: impl FnMut(Part<'_>) -> io::Result<()>) -> io::Result<()> {
        see(Part { at: [0; 2], size: self.size(), rgb: self.first.rgb() })?;
        let mut before = None;
        for path in self.rest {
            let now = read(path)?;
            if [now.width(), now.height()] != self.size() {
                return Err(io::Error::other(format!("{} has another size", path.display())));
            }
            let [[x, y], [width, height]] = changed(before.as_ref().unwrap_or(&self.first), &now);
            let rows = now.rgb().chunks_exact(3 * now.width()).skip(y).take(height);
            let rgb: Vec<u8> = rows.flat_map(|row| &row[3 * x..3 * (x + width)]).copied().collect();
            see(Part { at: [x, y], size: [width, height], rgb: &rgb })?;
            before = Some(now);
        }
        Ok(())
    }
}

/// The largest number of pixels in a picture of an animation.
const MOST_PIXELS: u64 = 1 << 28;

/// Reads a picture that [`Picture::write`] wrote.
pub(super) fn read(path: &Path) -> io::Result<Picture> {
    let refused = |what: &str| io::Error::other(format!("{} {what}", path.display()));
    let file = regular_file::open(path)?;
    let length = file.metadata()?.len();
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info()?;
    let info = reader.info();
    if (info.color_type, info.bit_depth) != (png::ColorType::Rgb, png::BitDepth::Eight) {
        return Err(refused("is not in RGB with 8 bits"));
    }
    let (width, height) = (info.width, info.height);
    let pixels = u64::from(width) * u64::from(height);
    // Check before allocating: the header may claim any number of pixels.
    if pixels > MOST_PIXELS {
        return Err(refused(&format!("has {width} x {height} pixels, which are too many for an animation")));
    }
    if !can_hold(length, 3 * pixels) {
        return Err(refused(&format!("is too short for its {width} x {height} pixels")));
    }
    let mut rgb = vec![0; 3 * width as usize * height as usize];
    reader.next_frame(&mut rgb)?;
    Ok(Picture::new(width as usize, height as usize, rgb))
}

/// Corner and size of the smallest rectangle with all pixels that differ between two pictures of the same
/// size. Equal pictures give one pixel, because a picture of an animation cannot be empty.
fn changed(before: &Picture, now: &Picture) -> [[usize; 2]; 2] {
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
        return [[0; 2], [1; 2]];
    }
    [low, [high[0] - low[0] + 1, high[1] - low[1] + 1]]
}
