//! Pictures of states, and the animation of them.

use super::arguments::Animation;
use xca_record::Failure;
use xca_record::record::{Drawing, FRAMES, RunFolder, Scales, Seen};

/// What is done with a state: with the number of its step, and what each panel shows of it.
pub(super) type Look<'a> = dyn FnMut(u64, &[Seen]) -> Result<(), Failure> + 'a;

/// The states that are drawn.
pub(super) trait States {
    /// Looks at each, in the order of their steps: at the same ones each time. Gives the last step that was
    /// reached.
    fn each(&self, doing: &str, look: &mut Look<'_>) -> Result<u64, Failure>;
}

/// How pictures are made.
pub(super) struct Film<'a> {
    pub(super) drawing: &'a Drawing<'a>,
    pub(super) states: &'a dyn States,
    pub(super) animation: Animation,
    pub(super) fps: u16,
}

/// What was made.
pub(super) struct Made {
    pub(super) pictures: usize,
    pub(super) steps: u64,
}

impl Film<'_> {
    /// Finds the scales, draws the pictures, and makes an animation of them.
    pub(super) fn make(&self, folder: &RunFolder) -> Result<Made, Failure> {
        let scales = self.scales()?;
        let mut pictures = Vec::new();
        let steps = self.states.each("drawing", &mut |step, seen| {
            if let Some(picture) = self.drawing.picture(step, seen, &scales)? {
                let path = folder.frames.numbered("frame", step, "png");
                picture.write(&path)?;
                pictures.push(path);
            }
            Ok(())
        })?;
        if let Some(name) = self.animation.file() {
            self.animation.write(&folder.top.file(name), &pictures, self.fps)?;
        }
        Ok(Made { pictures: pictures.len(), steps })
    }

    /// The files that it makes, below its folder.
    pub(super) fn files(&self) -> Vec<String> {
        let animation = self.animation.file().map(str::to_owned);
        animation.into_iter().chain([format!("{FRAMES}/frame_*.png")]).collect()
    }

    /// Where they are, for the user.
    pub(super) fn places(&self, folder: &RunFolder) -> String {
        let folder = folder.top.path().display();
        let frames = format!("they are in {folder}/{FRAMES}");
        match self.animation.file() {
            Some(name) => format!("{frames}; animation: {folder}/{name}"),
            None => frames,
        }
    }

    /// The scales that all pictures have.
    fn scales(&self) -> Result<Scales, Failure> {
        let mut scales = self.drawing.fixed_scales();
        if !scales.are_known() {
            self.states.each("measuring", &mut |_, seen| {
                self.drawing.widen(&mut scales, seen);
                Ok(())
            })?;
        }
        Ok(scales)
    }
}
