//! The colours that a terminal has.

use anstyle::RgbColor;
use anstyle_lossy::rgb_to_xterm;
use ratatui::style::Color;
use xca_picture::encode;

/// Ever lighter.
const SHADES: [&str; 5] = [" ", "░", "▒", "▓", "█"];

/// What colours the terminal has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Colours {
    /// All.
    True,
    /// The 256 of xterm.
    Indexed,
    /// None: only characters tell things apart.
    None,
}

impl Colours {
    /// As the environment says: `NO_COLOR`, `COLORTERM` and `TERM`.
    pub(super) fn of_environment() -> Self {
        if anstyle_query::no_color() || !anstyle_query::term_supports_color() {
            Self::None
        } else if anstyle_query::truecolor() {
            Self::True
        } else {
            Self::Indexed
        }
    }

    /// The terminal's word for a colour in linear RGB.
    pub(super) fn of(self, linear: [f32; 3]) -> Color {
        let [r, g, b] = encode(linear).map(|x| (x * 255.0).round() as u8);
        match self {
            Self::True => Color::Rgb(r, g, b),
            Self::Indexed => Color::Indexed(rgb_to_xterm(RgbColor(r, g, b)).0),
            Self::None => Color::Reset,
        }
    }

    /// The character of a lightness, where there are no colours.
    pub(super) fn shade(lightness: f32) -> &'static str {
        let last = SHADES.len() - 1;
        SHADES[((lightness * last as f32).round() as usize).min(last)]
    }
}
