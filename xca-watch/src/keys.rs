//! The bytes of a terminal as keys.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// No sequence has more bytes; those of a longer one mean nothing.
const LONGEST: usize = 32;

const ESCAPE: u8 = 0x1b;

/// Finds the keys in the bytes of a terminal. What means nothing is left out, and hides no key behind it.
#[derive(Debug, Default)]
pub(super) struct Decoder {
    state: State,
}

/// What the last bytes have begun.
#[derive(Debug, Default, PartialEq)]
enum State {
    #[default]
    Nothing,
    /// A character of several bytes.
    Character(Vec<u8>),
    /// The key Esc, or a sequence.
    Escape,
    /// A sequence of one letter, behind `ESC O`.
    Letter,
    /// A sequence behind `ESC [`.
    Sequence(Vec<u8>),
}

impl Decoder {
    /// Takes the next byte, which may be the end of a key.
    pub(super) fn take(&mut self, byte: u8) -> Option<KeyEvent> {
        match std::mem::take(&mut self.state) {
            State::Character(bytes) if matches!(byte, 0x80..=0xbf) => self.go_on(bytes, byte),
            State::Nothing | State::Character(_) => self.begin(byte),
            State::Escape => match byte {
                b'[' => self.wait(State::Sequence(Vec::new())),
                b'O' => self.wait(State::Letter),
                ESCAPE => {
                    self.state = State::Escape;
                    Some(KeyCode::Esc.into())
                }
                _ => {
                    let key = self.begin(byte)?;
                    Some(KeyEvent::new(key.code, key.modifiers | KeyModifiers::ALT))
                }
            },
            State::Letter if byte.is_ascii_graphic() => letter(byte).map(KeyEvent::from),
            State::Sequence(mut bytes) if matches!(byte, b' '..=b'?') => {
                if bytes.len() < LONGEST {
                    bytes.push(byte);
                }
                self.wait(State::Sequence(bytes))
            }
            State::Sequence(bytes) if matches!(byte, b'@'..=b'~') => sequence(&bytes, byte),
            State::Letter | State::Sequence(_) => self.begin(byte),
        }
    }

    /// Whether bytes wait for others.
    pub(super) fn is_waiting(&self) -> bool {
        self.state != State::Nothing
    }

    /// Gives up waiting: a terminal sends the bytes of a key together. Esc alone is a key.
    pub(super) fn give_up(&mut self) -> Option<KeyEvent> {
        (std::mem::take(&mut self.state) == State::Escape).then(|| KeyCode::Esc.into())
    }

    fn wait(&mut self, state: State) -> Option<KeyEvent> {
        self.state = state;
        None
    }

    /// The first byte of a key.
    fn begin(&mut self, byte: u8) -> Option<KeyEvent> {
        let control = |letter: char| Some(KeyEvent::new(KeyCode::Char(letter), KeyModifiers::CONTROL));
        match byte {
            ESCAPE => self.wait(State::Escape),
            0xc2..=0xf4 => self.wait(State::Character(vec![byte])),
            b'\t' => Some(KeyCode::Tab.into()),
            b'\r' => Some(KeyCode::Enter.into()),
            0x7f => Some(KeyCode::Backspace.into()),
            0 => control(' '),
            1..=26 => control(char::from(byte - 1 + b'a')),
            b' '..=b'~' => Some(KeyCode::Char(char::from(byte)).into()),
            _ => None,
        }
    }

    /// The next byte of a character.
    fn go_on(&mut self, mut bytes: Vec<u8>, byte: u8) -> Option<KeyEvent> {
        bytes.push(byte);
        match std::str::from_utf8(&bytes) {
            Ok(text) => text.chars().next().map(|character| KeyCode::Char(character).into()),
            // It may still become one.
            Err(error) if error.error_len().is_none() => self.wait(State::Character(bytes)),
            Err(_) => None,
        }
    }
}

fn letter(byte: u8) -> Option<KeyCode> {
    match byte {
        b'A' => Some(KeyCode::Up),
        b'B' => Some(KeyCode::Down),
        b'C' => Some(KeyCode::Right),
        b'D' => Some(KeyCode::Left),
        b'H' => Some(KeyCode::Home),
        b'F' => Some(KeyCode::End),
        b'Z' => Some(KeyCode::BackTab),
        _ => None,
    }
}

/// The key of a sequence with these numbers, of which the second one tells what is held down.
fn sequence(numbers: &[u8], last: u8) -> Option<KeyEvent> {
    let text = std::str::from_utf8(numbers).ok()?;
    let mut numbers = text.split(';').map(|number| number.parse::<u8>().unwrap_or(1));
    let first = numbers.next();
    let code = match (first, last) {
        (Some(5), b'~') => KeyCode::PageUp,
        (Some(6), b'~') => KeyCode::PageDown,
        _ => letter(last)?,
    };
    let held = numbers.next().unwrap_or(1).saturating_sub(1);
    let all = [KeyModifiers::SHIFT, KeyModifiers::ALT, KeyModifiers::CONTROL].into_iter().enumerate();
    let modifiers = all.filter(|(bit, _)| held >> bit & 1 == 1).map(|(_, modifier)| modifier);
    Some(KeyEvent::new(code, modifiers.fold(KeyModifiers::NONE, |all, modifier| all | modifier)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The keys of these bytes, with a pause behind them.
    fn keys(bytes: &[u8]) -> Vec<KeyEvent> {
        let mut decoder = Decoder::default();
        let mut keys: Vec<KeyEvent> = bytes.iter().filter_map(|byte| decoder.take(*byte)).collect();
        keys.extend(decoder.give_up());
        assert!(!decoder.is_waiting());
        keys
    }

    #[test]
    fn each_key_has_its_bytes() {
        for (bytes, code) in [
            (&b"q"[..], KeyCode::Char('q')),
            (b" ", KeyCode::Char(' ')),
            ("é".as_bytes(), KeyCode::Char('é')),
            ("🦀".as_bytes(), KeyCode::Char('🦀')),
            (b"\t", KeyCode::Tab),
            (b"\r", KeyCode::Enter),
            (b"\x7f", KeyCode::Backspace),
            (b"\x1b", KeyCode::Esc),
            (b"\x1b[A", KeyCode::Up),
            (b"\x1bOB", KeyCode::Down),
            (b"\x1b[C", KeyCode::Right),
            (b"\x1bOD", KeyCode::Left),
            (b"\x1b[Z", KeyCode::BackTab),
            (b"\x1b[5~", KeyCode::PageUp),
            (b"\x1b[6~", KeyCode::PageDown),
        ] {
            assert_eq!(keys(bytes), [KeyEvent::from(code)], "{bytes:?}");
        }
        let held = |bytes: &[u8], code, modifiers| assert_eq!(keys(bytes), [KeyEvent::new(code, modifiers)]);
        held(b"\x03", KeyCode::Char('c'), KeyModifiers::CONTROL);
        held(b"\x1bq", KeyCode::Char('q'), KeyModifiers::ALT);
        held(b"\x1b[1;5D", KeyCode::Left, KeyModifiers::CONTROL);
        held(b"\x1b[6;2~", KeyCode::PageDown, KeyModifiers::SHIFT);
        assert_eq!(keys(b"\x1b\x1b"), [KeyEvent::from(KeyCode::Esc); 2]);
    }

    #[test]
    fn what_means_nothing_hides_no_key() {
        for bytes in [
            &b"\xc3q"[..],
            b"\xf0\x9fq",
            b"\xff\x80q",
            b"\x1b[200~q",
            b"\x1b[\x01q",
            b"\x1b[99;99;99Rq",
            b"\x1bO\x80q",
            b"\xed\xa0\x80q",
            b"\x1b[<0;3;4Mq",
        ] {
            assert_eq!(keys(bytes).last(), Some(&KeyEvent::from(KeyCode::Char('q'))), "{bytes:?}");
        }
        let long = [b"\x1b[", vec![b'1'; 100_000].as_slice(), b"~q"].concat();
        assert_eq!(keys(&long), [KeyEvent::from(KeyCode::Char('q'))]);
    }

    #[test]
    fn a_pause_ends_what_is_not_complete() {
        for begun in [&b"\x1b["[..], b"\x1b[1;", b"\x1bO", b"\xc3", b"\xf0\x9f\xa6"] {
            let mut decoder = Decoder::default();
            assert!(begun.iter().all(|byte| decoder.take(*byte).is_none()) && decoder.is_waiting());
            assert_eq!(decoder.give_up(), None);
            assert_eq!(decoder.take(b'q'), Some(KeyEvent::from(KeyCode::Char('q'))), "{begun:?}");
        }
    }
}
