//! Pixels as characters: two above each other are the halves of one.

use super::colours::Colours;
use super::pixels::Pixels;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

const UPPER: &str = "▀";
const LOWER: &str = "▄";

/// Draws pixels in the middle of an area.
pub(super) fn draw(pixels: &Pixels, area: Rect, buffer: &mut Buffer, colours: Colours) {
    let rows = pixels.height.div_ceil(2);
    let margin = |room: u16, taken: usize| usize::from(room).saturating_sub(taken) / 2;
    let (left, top) = (margin(area.width, pixels.width), margin(area.height, rows));
    for row in 0..rows.min(usize::from(area.height)) {
        for x in 0..pixels.width.min(usize::from(area.width)) {
            // Both fit into the area, so into 16 bits.
            let at = (area.x + (left + x) as u16, area.y + (top + row) as u16);
            let Some(cell) = buffer.cell_mut(at) else { continue };
            let halves = [pixels.get(x, 2 * row), pixels.get(x, 2 * row + 1)];
            match (halves, colours) {
                ([upper, lower], Colours::None) => {
                    cell.set_symbol(without_colours(
                        upper.map_or(0.0, |c| c[0]),
                        lower.map_or(0.0, |c| c[0]),
                    ));
                }
                ([Some(upper), Some(lower)], _) => {
                    cell.set_symbol(UPPER).set_fg(colours.of(upper)).set_bg(colours.of(lower));
                }
                ([Some(upper), None], _) => {
                    cell.set_symbol(UPPER).set_fg(colours.of(upper));
                }
                ([None, _], _) => {}
            }
        }
    }
}

/// The character that looks most like an upper and a lower half of these lightnesses.
fn without_colours(upper: f32, lower: f32) -> &'static str {
    if upper - lower > 0.5 {
        UPPER
    } else if lower - upper > 0.5 {
        LOWER
    } else {
        Colours::shade(f32::midpoint(upper, lower))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::style::Color;

    #[test]
    fn lightnesses_become_characters() {
        for (upper, lower, wanted) in [
            (0.0, 0.0, " "),
            (1.0, 1.0, "█"),
            (1.0, 0.0, "▀"),
            (0.0, 1.0, "▄"),
            (0.2, 0.3, "░"),
            (0.5, 0.5, "▒"),
            (0.5, 0.9, "▓"),
            (f32::NAN, 7.0, " "),
        ] {
            assert_eq!(without_colours(upper, lower), wanted, "{upper} {lower}");
        }
    }

    #[test]
    fn colours_are_those_that_the_terminal_has() {
        assert_eq!(Colours::True.of([1.0, 0.0, 0.0]), Color::Rgb(255, 0, 0));
        // 16 + 36 r + 6 g + b, each from 0 to 5.
        assert_eq!(Colours::Indexed.of([1.0, 0.0, 1.0]), Color::Indexed(16 + 36 * 5 + 5));
        assert_eq!(Colours::None.of([1.0; 3]), Color::Reset);
    }
}
