//! Text drawn with a pen.

use super::canvas::{Canvas, Strokes};
use super::glyphs::strokes_of;

/// The grid of the glyphs: the base line is at 4, small letters reach 14 and capitals 18.
const BASE: f32 = 4.0;
const CAPITAL: f32 = 14.0;
/// The gap between letters, in grid units.
const GAP: f32 = 4.6;
const SPACE: f32 = 7.0;
const DOT: f32 = 0.4;
/// The size of a superscript, and how far it is raised, in grid units of the text around it.
const SUPERSCRIPT: f32 = 0.68;
const RAISED: f32 = 8.5;

/// Where a text is anchored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Left,
    Right,
}

/// How a text looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    /// The height of a capital, in pixels.
    pub(super) height: f32,
    /// The width of the pen as a share of the height.
    pub(super) weight: f32,
    /// The colour, in encoded RGB.
    pub(super) colour: [f32; 3],
}

/// Draws one line of text with its base line at `at`. `^` raises the characters up to the next blank or closing
/// bracket: `m s^-2`. Characters without a glyph show as a box.
pub(super) fn draw(canvas: &mut Canvas, text: &str, at: [f32; 2], anchor: Anchor, style: &Style) {
    let (mut strokes, width) = lay_out(text, style);
    let shift = match anchor {
        Anchor::Left => 0.0,
        Anchor::Right => -width,
    };
    for point in strokes.segments.iter_mut().flatten() {
        *point = [point[0] + at[0] + shift, point[1] + at[1]];
    }
    canvas.stroke(&strokes, style.colour);
}

/// `style`, or as much smaller as it takes for `text` to fit into `width` pixels.
pub(super) fn fitted(text: &str, style: Style, width: f32) -> Style {
    let found = lay_out(text, &style).1;
    if found > width { Style { height: style.height * (width / found).max(0.1), ..style } } else { style }
}

/// The strokes of a text that begins at (0, 0), y downwards, and its width.
fn lay_out(text: &str, style: &Style) -> (Strokes, f32) {
    let pixels = style.height / CAPITAL;
    let mut strokes = Strokes { segments: Vec::new(), width: (style.height * style.weight).max(1.0) };
    let (mut x, mut end) = (0.0, 0.0);
    let mut raised = false;
    for c in text.chars() {
        match c {
            '^' => {
                raised = true;
                continue;
            }
            ' ' | ')' | ']' => raised = false,
            _ => {}
        }
        if c == ' ' {
            x += SPACE;
            continue;
        }
        let (size, lift) = if raised { (SUPERSCRIPT, RAISED) } else { (1.0, 0.0) };
        let lines = strokes_of(c);
        let place = |p: [f32; 2]| [(x + p[0] * size) * pixels, ((BASE - p[1]) * size - lift) * pixels];
        let mut right = 0.0_f32;
        for line in &lines {
            right = line.iter().fold(right, |right, p| right.max(p[0]));
            if let [[x, y]] = line[..] {
                // A dot is a little wider than the pen.
                strokes.segments.push([place([x - DOT, y]), place([x + DOT, y])]);
                strokes.segments.push([place([x, y - DOT]), place([x, y + DOT])]);
            }
            strokes.segments.extend(line.windows(2).map(|pair| [place(pair[0]), place(pair[1])]));
        }
        end = x + right * size;
        x = end + GAP * size;
    }
    (strokes, end * pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    const STYLE: Style = Style { height: 14.0, weight: 0.1, colour: [0.0; 3] };

    fn ink(text: &str) -> Vec<(usize, usize)> {
        let mut canvas = Canvas::new(200, 60, [1.0; 3]);
        draw(&mut canvas, text, [20.0, 40.0], Anchor::Left, &STYLE);
        let picture = canvas.into_picture();
        (0..200 * 60).map(|i| (i % 200, i / 200)).filter(|&(x, y)| picture.pixel(x, y)[0] < 128).collect()
    }

    #[test]
    fn a_capital_stands_on_the_base_line_and_has_its_height() {
        let ink = ink("H");
        let (top, bottom) = (ink.iter().map(|p| p.1).min().unwrap(), ink.iter().map(|p| p.1).max().unwrap());
        assert!((25..=26).contains(&top) && (39..=40).contains(&bottom), "{top} to {bottom}");
    }

    #[test]
    fn a_superscript_stands_higher_and_ends_at_a_bracket() {
        let lowest = |text: &str| ink(text).iter().map(|p| p.1).max().unwrap();
        assert!(lowest("^2") < lowest("2") - 5);
        assert_eq!(lowest("^2)2"), lowest("2)2"));
        assert!(lay_out("m^2", &STYLE).1 < lay_out("m2", &STYLE).1);
    }

    #[test]
    fn a_long_text_is_drawn_smaller() {
        let text = "displacement (m)";
        assert_eq!(fitted(text, STYLE, 1000.0).height, STYLE.height);
        let small = fitted(text, STYLE, 60.0);
        assert!((lay_out(text, &small).1 - 60.0).abs() < 0.1);
    }

    #[test]
    fn every_character_draws_something_of_its_own() {
        let mut drawings: Vec<(char, Vec<(usize, usize)>)> = Vec::new();
        for c in (33..127_u8).map(char::from).filter(|&c| c != '^') {
            let drawn = ink(&c.to_string());
            assert!(!drawn.is_empty(), "{c}");
            let twin = drawings.iter().find(|(_, other)| *other == drawn);
            // A capital I and a small l are one stroke in many typefaces.
            assert!(twin.is_none_or(|(other, _)| (*other, c) == ('I', 'l')), "{c} looks like {twin:?}");
            drawings.push((c, drawn));
        }
    }

    #[test]
    fn anchors_place_the_text_about_its_point() {
        let columns = |anchor| {
            let mut canvas = Canvas::new(200, 60, [1.0; 3]);
            draw(&mut canvas, "HH", [100.0, 40.0], anchor, &STYLE);
            let picture = canvas.into_picture();
            let dark: Vec<usize> = (0..200).filter(|&x| picture.pixel(x, 35)[0] < 128).collect();
            (dark[0], dark[dark.len() - 1])
        };
        assert!(columns(Anchor::Left).0 >= 99 && columns(Anchor::Right).1 <= 100);
    }
}
