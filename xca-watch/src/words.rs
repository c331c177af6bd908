//! The words around the picture.

use super::colours::Colours;
use super::pixels::{looked_along, scale};
use super::screen::Screen;
use super::worker::News;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Style, Stylize};
use ratatui::text::{Line, Span};
use xca_io::numbers::{counted, rate_text, significant};
use xca_picture::Palette;
use xca_record::record::{Sight, Subject};

/// The widest bar of colours.
const BAR: usize = 24;
const AXES: [&str; 3] = ["x", "y", "z"];

/// Draws the words; gives the area that is left for the picture.
pub(super) fn draw(screen: &Screen, area: Rect, buffer: &mut Buffer) -> Rect {
    let mut left = area;
    // As many lines as leave room for a picture, the most needed first.
    if area.height != 0 {
        line(status(screen, area.width), top(&mut left), buffer);
    }
    if area.height >= 6 {
        line(joined(help(screen), area.width), bottom(&mut left), buffer);
    }
    if let Some(news) = screen.news.as_ref().filter(|_| area.height >= 10) {
        line(joined(seen(screen, news), area.width), bottom(&mut left), buffer);
        line(joined(observables(news), area.width), bottom(&mut left), buffer);
    }
    if let Some(note) = screen.facts.note.as_ref().filter(|_| area.height >= 12) {
        line(Line::from(format!("note: {note}").dim()), top(&mut left), buffer);
    }
    left
}

fn top(left: &mut Rect) -> Rect {
    let row = Rect { height: 1, ..*left };
    (left.y, left.height) = (left.y + 1, left.height - 1);
    row
}

fn bottom(left: &mut Rect) -> Rect {
    left.height -= 1;
    Rect { y: left.bottom(), height: 1, ..*left }
}

fn line(line: Line<'_>, row: Rect, buffer: &mut Buffer) {
    buffer.set_line(row.x, row.y, &line, row.width);
}

/// A group of words that stay together.
type Piece = Vec<Span<'static>>;

fn width(piece: &Piece) -> usize {
    piece.iter().map(Span::width).sum()
}

fn plain(text: impl Into<String>) -> Piece {
    vec![Span::raw(text.into())]
}

/// As many pieces as fit side by side; the first in any case.
fn joined(pieces: Vec<Piece>, room: u16) -> Line<'static> {
    let mut line = Line::default();
    for piece in pieces {
        let gap = if line.spans.is_empty() { "" } else { "  " };
        if !gap.is_empty() && line.width() + gap.len() + width(&piece) > usize::from(room) {
            break;
        }
        line.spans.push(Span::raw(gap));
        line.spans.extend(piece);
    }
    line
}

/// Step, time, rate; and the engine at the right end, where there is room.
fn status(screen: &Screen, room: u16) -> Line<'static> {
    let facts = &screen.facts;
    let of = facts.wanted.map(|wanted| format!(" of {wanted}")).unwrap_or_default();
    let mut pieces = vec![vec![format!("step {}{of}", screen.done).bold()]];
    let end = screen.news.as_ref().and_then(|news| news.end.clone());
    pieces.push(match (end, screen.is_paused, screen.rate) {
        (Some(end), ..) => vec![end.bold()],
        (None, true, _) => vec![if screen.is_under_way { "pausing".bold() } else { "paused".bold() }],
        (None, false, rate) => plain(rate.map_or_else(|| "…".to_owned(), rate_text)),
    });
    if let Some(seconds) = facts.time_step {
        pieces.push(plain(format!("time {} s", significant(screen.done as f64 * seconds, 4))));
    }
    // The engine is more needed than what follows.
    let needed = joined(pieces.clone(), u16::MAX).width() + 2;
    let engines = facts.engine.iter().map(|engine| Span::from(engine.clone()).dim());
    let engine = engines.into_iter().find(|engine| needed + engine.width() <= usize::from(room));
    if !screen.has_ended() {
        pieces.push(plain(screen.pace.words()));
    }
    pieces.push(vec![facts.title.clone().bold()]);
    let Some(engine) = engine else { return joined(pieces, room) };
    let mut line = joined(pieces, room - engine.width() as u16 - 2);
    let gap = usize::from(room) - line.width() - engine.width();
    line.spans.extend([Span::raw(" ".repeat(gap)), engine]);
    line
}

fn observables(news: &News) -> Vec<Piece> {
    // What was measured after an earlier step is said more quietly.
    let style = if news.observed == news.step { Style::new() } else { Style::new().dim() };
    let pieces = news.observables.iter().map(|observable| {
        let unit = if observable.unit.is_empty() { String::new() } else { format!(" {}", observable.unit) };
        let text = format!("{} {}{unit}", observable.name, significant(observable.value, 4));
        vec![Span::styled(text, style)]
    });
    pieces.collect()
}

/// The scale or the kinds, and what part of the space is seen.
fn seen(screen: &Screen, news: &News) -> Vec<Piece> {
    let sight = &news.sight;
    let mut pieces = vec![plain(raised(&sight.label))];
    if let Some(palette) = screen.palette() {
        if sight.kinds.is_empty() {
            pieces.push(bar(sight, &palette, screen.colours));
        } else {
            let kinds = sight.kinds.iter().enumerate();
            pieces.extend(kinds.map(|(number, kind)| {
                vec![swatch(palette.kind(Some(number)), screen.colours), Span::raw(format!(" {}", kind.name))]
            }));
        }
    }
    match &sight.subject {
        Subject::Layer { layers: 1, axis: 2, .. } => {}
        Subject::Layer { axis, layer, layers, .. } => {
            pieces.push(plain(format!("layer {layer} of {layers} along {}", AXES[*axis])));
        }
        Subject::Items { positions, extents, .. } => {
            let axis = AXES[looked_along(screen.axis(), *extents)];
            pieces.push(plain(format!("{}, seen along {axis}", counted(positions.len() as u64, "item"))));
        }
    }
    pieces
}

/// The colours from end to end, with their values.
fn bar(sight: &Sight, palette: &Palette, colours: Colours) -> Piece {
    let scale = scale(sight);
    let [low, high] = [scale.low, scale.high].map(|end| significant(end, 4));
    if low == high {
        return vec![swatch(palette.of(Some(0.0)), colours), Span::raw(format!(" {low}"))];
    }
    let mut piece = plain(format!("{low} "));
    piece.extend((0..BAR).map(|i| {
        let place = (i as f64 + 0.5) / BAR as f64;
        swatch(palette.of(Some(place)), colours)
    }));
    piece.push(Span::raw(format!(" {high}")));
    piece
}

fn swatch(colour: [f32; 3], colours: Colours) -> Span<'static> {
    match colours {
        Colours::None => Span::raw(Colours::shade(colour[0])),
        _ => Span::styled("█", Style::new().fg(colours.of(colour))),
    }
}

/// The keys that do something here.
fn help(screen: &Screen) -> Vec<Piece> {
    let subject = screen.news.as_ref().map(|news| &news.sight.subject);
    let is_flat = matches!(subject, None | Some(Subject::Layer { axis: 2, layers: 1, .. }));
    let is_layered = matches!(subject, Some(Subject::Layer { layers: 2.., .. }));
    let has_scale = screen.news.as_ref().is_some_and(|news| news.sight.kinds.is_empty());
    let keys = [
        ("q", "quit", true),
        ("space", if screen.is_paused { "go on" } else { "pause" }, !screen.has_ended()),
        ("n", "step", !screen.has_ended()),
        ("+ -", "pace", !screen.has_ended()),
        ("r", "restart", true),
        ("z", if screen.place.is_close { "whole" } else { "closer" }, true),
        ("arrows", "move", screen.place.is_close),
        ("tab", "substate", screen.facts.substates.len() > 1),
        ("[ ]", "layer", is_layered),
        ("a", "axis", !is_flat),
        ("s", "scale anew", has_scale),
    ];
    let keys = keys.into_iter().filter(|(.., is_of_use)| *is_of_use);
    keys.map(|(key, what, _)| vec![key.bold(), format!(" {what}").dim()]).collect()
}

/// A label with `^-1` as raised characters.
fn raised(label: &str) -> String {
    let mut is_raised = false;
    let raise = |c: char| {
        Some(match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '0' | '4'..='9' => char::from_u32('⁰' as u32 + c.to_digit(10)?)?,
            _ => return None,
        })
    };
    let mut text = String::new();
    for c in label.chars() {
        is_raised = c == '^' || is_raised && raise(c).is_some();
        if c != '^' {
            text.push(if is_raised { raise(c).unwrap_or(c) } else { c });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_raised() {
        assert_eq!(raised("speed (m s^-1)"), "speed (m s⁻¹)");
        assert_eq!(raised("a^2 b^10 4"), "a² b¹⁰ 4");
        assert_eq!(raised("plain 3-1"), "plain 3-1");
        assert_eq!(raised("^"), "");
    }

    #[test]
    fn what_does_not_fit_is_left_out() {
        let line = |room| joined(vec![plain("abc"), plain("de"), plain("f")], room).to_string();
        assert_eq!(
            [line(10), line(9), line(7), line(6), line(1)],
            ["abc  de  f", "abc  de", "abc  de", "abc", "abc"]
        );
    }
}
