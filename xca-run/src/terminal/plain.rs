//! Texts that may come from anyone, made fit for a terminal.

use std::borrow::Cow;
use std::fmt::Write;

/// The most characters of an error.
const LONGEST_TEXT: usize = 2000;

/// The most characters of a line of what is told about a file.
const LONGEST_LINE: usize = 4000;

/// A text whose characters that control a terminal, or the direction of writing, are written as JSON writes
/// them: `\u001b`.
pub(super) fn escaped(text: &str) -> Cow<'_, str> {
    let is_harmful = |character: char| {
        (character.is_control() && !"\n\t".contains(character))
            || matches!(character, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    if !text.contains(is_harmful) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        if is_harmful(character) {
            // Writing to a string cannot fail.
            let _ = write!(out, "\\u{:04x}", u32::from(character));
        } else {
            out.push(character);
        }
    }
    Cow::Owned(out)
}

/// A text without its middle, where it is too long for a reader.
pub(super) fn shortened(text: &str) -> Cow<'_, str> {
    cut(text, LONGEST_TEXT)
}

/// A text whose lines are not too long for a reader.
pub(crate) fn short_lines(text: &str) -> String {
    text.split('\n').map(|line| cut(line, LONGEST_LINE)).collect::<Vec<_>>().join("\n")
}

/// A text of at most so many characters: of a longer one the beginning and the end, which tell where it is
/// from.
fn cut(text: &str, most: usize) -> Cow<'_, str> {
    let length = text.chars().count();
    if length <= most {
        return Cow::Borrowed(text);
    }
    let place = |number: usize| text.char_indices().nth(number).map_or(text.len(), |(place, _)| place);
    let (begin, end) = (most * 3 / 4, most / 4);
    let (first, last) = (&text[..place(begin)], &text[place(length - end)..]);
    Cow::Owned(format!("{first} ... {} characters ... {last}", length - begin - end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_that_control_terminals_are_escaped() {
        let harmful = "a\u{1b}[31mred\r\u{7f}\u{9b}2J\u{202e}z";
        assert_eq!(escaped(harmful), "a\\u001b[31mred\\u000d\\u007f\\u009b2J\\u202ez");
        let harmless = "täble\tof\n━╸─ things";
        assert_eq!(escaped(harmless), harmless);
        // In JSON it is the same text as before.
        let text = "\u{9b}\u{7f}";
        let json = serde_json::to_string(text).unwrap();
        assert_eq!(serde_json::from_str::<String>(&escaped(&json)).unwrap(), text);
    }

    #[test]
    fn long_texts_keep_their_beginning_and_their_end() {
        let text = format!("in.csv:2: `{}` is no number", "é".repeat(5_000_000));
        let cut_out = format!(" ... {} characters ... ", text.chars().count() - 2000);
        let short = shortened(&text);
        assert!(short.starts_with("in.csv:2: `éé") && short.ends_with("é` is no number"), "{short}");
        assert!(short.chars().count() < 2050 && short.contains(&cut_out), "{short}");
        let whole = "x".repeat(2000);
        assert_eq!(shortened(&whole), whole);
        let lines = short_lines(&format!("a\n{}\nb", "x".repeat(100_000)));
        assert!(lines.starts_with("a\nx") && lines.ends_with("x\nb") && lines.len() < 4100);
    }
}
