//! The screen, drawn.

use super::Screen;
use crate::pixels::pixels;
use crate::{blocks, words};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

impl Screen {
    /// Draws the picture and the words around it.
    pub(crate) fn draw(&mut self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(buffer.area);
        let picture = words::draw(self, area, buffer);
        self.room = [usize::from(picture.width), 2 * usize::from(picture.height)];
        if let (Some(news), Some(palette), Some(window)) = (&self.news, self.palette(), self.window()) {
            let pixels = pixels(&news.sight, window, self.look.axis, &palette, self.colours);
            blocks::draw(&pixels, picture, buffer, self.colours);
        }
    }
}
