//! Text in pictures, in DejaVu Sans. It has the letters, superscripts and signs of most units.

use super::canvas::Canvas;
use ab_glyph::{Font, FontRef, Glyph, GlyphId, Point, PxScale, ScaleFont, point};
use std::sync::OnceLock;

/// The height of a capital as a share of the height of a line.
const CAPITAL: f32 = 1493.0 / 2384.0;
/// The size of a superscript, and how far it is raised, as shares of the height of a capital.
const SUPERSCRIPT: f32 = 0.68;
const RAISED: f32 = 0.55;

/// The anchor of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Left,
    Middle,
    Right,
}

/// The style of a text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    /// The height of a capital, in pixels.
    pub(super) height: f32,
    /// The colour, in encoded RGB.
    pub(super) colour: [f32; 3],
}

/// The font. It is part of the program, so its bytes are valid.
fn font() -> Option<&'static FontRef<'static>> {
    static FONT: OnceLock<Option<FontRef<'static>>> = OnceLock::new();
    FONT.get_or_init(|| FontRef::try_from_slice(dejavu::sans::regular()).ok()).as_ref()
}

/// Draws one line of text with its baseline at `at`. `^` raises the characters up to the next blank or
/// closing bracket: `m s^-2`. Characters without a glyph are drawn as a box.
pub(super) fn draw(canvas: &mut Canvas, text: &str, at: [f32; 2], anchor: Anchor, style: &Style) {
    let Some(font) = font() else { return };
    let line = Line::new(font, text, style);
    let shift = match anchor {
        Anchor::Left => 0.0,
        Anchor::Middle => -line.width / 2.0,
        Anchor::Right => -line.width,
    };
    let [x, y] = at;
    for mut glyph in line.glyphs {
        glyph.position += point(x + shift, y);
        let Some(outline) = font.outline_glyph(glyph) else { continue };
        let Point { x: left, y: top } = outline.px_bounds().min;
        outline.draw(|column, row, cover| {
            let place = [left + column as f32, top + row as f32];
            if place.iter().all(|pixel| *pixel >= 0.0) {
                canvas.blend(place[0] as usize, place[1] as usize, style.colour, cover.min(1.0));
            }
        });
    }
}

/// `style`, reduced in size if `text` would be wider than `width` pixels.
pub(super) fn fitted(text: &str, style: Style, width: f32) -> Style {
    let found = self::width(text, &style);
    if found > width { Style { height: style.height * (width / found).max(0.1), ..style } } else { style }
}

/// The width of a text, in pixels.
pub(super) fn width(text: &str, style: &Style) -> f32 {
    font().map_or(0.0, |font| Line::new(font, text, style).width)
}

/// A line of text that begins at (0, 0), y downwards.
struct Line {
    glyphs: Vec<Glyph>,
    width: f32,
}

impl Line {
    fn new(font: &FontRef<'_>, text: &str, style: &Style) -> Self {
        let (mut glyphs, mut x) = (Vec::new(), 0.0);
        let mut raised = false;
        let mut before: Option<GlyphId> = None;
        for letter in text.chars() {
            match letter {
                '^' => {
                    (raised, before) = (true, None);
                    continue;
                }
                ' ' | ')' | ']' if raised => (raised, before) = (false, None),
                _ => {}
            }
            let (size, lift) = if raised { (SUPERSCRIPT, RAISED * style.height) } else { (1.0, 0.0) };
            let scale = PxScale::from(style.height / CAPITAL * size);
            let scaled = font.as_scaled(scale);
            // In an exponent, the hyphen stands for the minus sign.
            let shown = if raised && letter == '-' { '\u{2212}' } else { letter };
            let id = font.glyph_id(shown);
            x += before.map_or(0.0, |before| scaled.kern(before, id));
            glyphs.push(id.with_scale_and_position(scale, point(x, -lift)));
            x += scaled.h_advance(id);
            before = Some(id);
        }
        Self { glyphs, width: x }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STYLE: Style = Style { height: 14.0, colour: [0.0; 3] };

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
        assert!(width("m^2", &STYLE) < width("m2", &STYLE));
    }

    #[test]
    fn a_long_text_is_drawn_smaller() {
        let text = "displacement (m)";
        assert_eq!(fitted(text, STYLE, 1000.0).height, STYLE.height);
        let small = fitted(text, STYLE, 60.0);
        assert!((width(text, &small) - 60.0).abs() < 0.1);
    }

    #[test]
    fn every_character_draws_something_of_its_own() {
        let mut drawings: Vec<(char, Vec<(usize, usize)>)> = Vec::new();
        let others = "αβγδεζηθικλμνξπρστφχψωΓΔΘΛΞΠΣΦΨΩ°·×÷±¹²³⁻⁴⁵⁰₀₂√∂∇∞≈≤≥‰…äöüßéñçÅøłšž";
        let letters = (33..127_u8).map(char::from).chain(others.chars());
        // The first is the box for characters that the font lacks.
        for c in std::iter::once('\u{e000}').chain(letters.filter(|&c| c != '^')) {
            let drawn = ink(&c.to_string());
            assert!(!drawn.is_empty(), "{c}");
            let twin = drawings.iter().find(|(_, other)| *other == drawn);
            assert!(twin.is_none(), "{c} looks like {twin:?}");
            drawings.push((c, drawn));
        }
    }

    #[test]
    fn a_text_beyond_the_edges_is_cut_off() {
        let drawn = |width, height, [x, y]: [f32; 2]| {
            let mut canvas = Canvas::new(width, height, [1.0; 3]);
            draw(&mut canvas, "Wy^2 \u{1b}WWWWWWWW", [x, y], Anchor::Left, &STYLE);
            canvas.into_picture()
        };
        let (cut, whole) = (drawn(30, 12, [-9.0, 5.0]), drawn(300, 60, [41.0, 35.0]));
        let mut dark = 0;
        for (x, y) in (0..30 * 12).map(|i| (i % 30, i / 30)) {
            let [found, wanted] = [cut.pixel(x, y)[0], whole.pixel(x + 50, y + 30)[0]];
            assert!(found.abs_diff(wanted) <= 2, "{found} and {wanted} at {x}, {y}");
            dark += usize::from(found < 128);
        }
        assert!(dark > 20, "{dark}");
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
        let (first, last) = columns(Anchor::Middle);
        assert!((198..=200).contains(&(first + last)), "{first} to {last}");
    }
}
