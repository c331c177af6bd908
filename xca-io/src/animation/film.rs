//! Pictures that follow each other, and what changes between them.

use crate::picture::Picture;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

/// Pictures in PNG files, read one by one.
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

    /// Hands on the first picture, and of each other one what is not as in the one before.
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

/// A picture as [`Picture::write`] writes it.
pub(super) fn read(path: &Path) -> io::Result<Picture> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path)?)).read_info()?;
    let [width, height] = [reader.info().width as usize, reader.info().height as usize];
    let mut rgb = vec![0; 3 * width * height];
    if reader.output_buffer_size() != Some(rgb.len()) {
        return Err(io::Error::other(format!("{} is not in RGB with 8 bits", path.display())));
    }
    reader.next_frame(&mut rgb)?;
    Ok(Picture::new(width, height, rgb))
}

/// Corner and size of the least rectangle with all pixels that two pictures of the same size do not share; one pixel where there are none, as a
/// picture of an animation cannot be empty.
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
