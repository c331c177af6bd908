//! Several pictures side by side.

use super::canvas::Canvas;
use super::legend::draw_title;
use super::{Picture, PictureError, check_size};

/// Pictures side by side, below one title.
#[derive(Debug, Clone)]
pub struct PanelPicture<'a> {
    /// The pictures, from the left, without titles. Their captions are at the top.
    pub panels: &'a [Picture],
    /// The text above the picture.
    pub title: &'a str,
    /// The smaller text below the title.
    pub caption: &'a str,
    /// Width and height of the whole picture in pixels, if they are fixed. White is added at the right and
    /// below.
    pub size: Option<[usize; 2]>,
}

impl PanelPicture<'_> {
    /// The height that the title adds to the panels, in pixels.
    pub const ABOVE: usize = 34;

    /// Draws the picture.
    ///
    /// # Errors
    /// [`PictureError::Size`].
    pub fn render(&self) -> Result<Picture, PictureError> {
        let width = self.panels.iter().map(Picture::width).sum();
        let height = Self::ABOVE + self.panels.iter().map(Picture::height).max().unwrap_or(0);
        let [width, height] = self.size.unwrap_or([width, height]);
        check_size([width.min(8192), height])?;
        let mut canvas = Canvas::new(width, height, [1.0; 3]);
        let mut left = 0;
        for panel in self.panels {
            canvas.paste([left, Self::ABOVE], panel);
            left += panel.width();
        }
        // Panels without titles are white here.
        draw_title(&mut canvas, 36.0, self.title, self.caption);
        Ok(canvas.into_picture())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(width: usize, height: usize, colour: [u8; 3]) -> Picture {
        let white = [255; 3];
        let pixels = (0..width * height).flat_map(|at| if at / width < 60 { white } else { colour });
        Picture::new(width, height, pixels.collect())
    }

    #[test]
    fn panels_stand_side_by_side_below_one_title() {
        let panels = [panel(300, 220, [250, 3, 7]), panel(320, 240, [1, 128, 77])];
        let wanted = PanelPicture { panels: &panels, title: "", caption: "", size: None };
        let picture = wanted.render().unwrap();
        assert_eq!((picture.width(), picture.height()), (620, 240 + PanelPicture::ABOVE));
        for (number, left) in [0, 300].into_iter().enumerate() {
            for (x, y) in [(0, 0), (299, 219), (0, 219), (150, 100)] {
                let found = picture.pixel(left + x, PanelPicture::ABOVE + y);
                assert_eq!(found, panels[number].pixel(x, y), "{number} {x} {y}");
            }
        }
        assert_eq!(picture.pixel(10, PanelPicture::ABOVE + 220), [255; 3]);
        // The title is above the panels, and changes nothing else.
        let titled = PanelPicture { title: "heat", caption: "step 7", ..wanted.clone() }.render().unwrap();
        let differs = |y: usize| (0..620).any(|x| titled.pixel(x, y) != picture.pixel(x, y));
        assert!((20..80).any(differs) && !(80..274).any(differs));
        let wide = PanelPicture { size: Some([640, 300]), ..wanted }.render().unwrap();
        assert_eq!((wide.width(), wide.height(), wide.pixel(630, 200)), (640, 300, [255; 3]));
    }
}
