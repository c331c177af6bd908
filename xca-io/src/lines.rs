//! Lines of text files, which may not be endless.

use std::io::{self, BufRead, Read};

/// No line has more bytes: a file without any end of line would fill the memory.
const LONGEST: usize = 1 << 24;

/// Puts the next line, with its end, in place of what `line` holds. It is empty at the end of the source.
///
/// # Errors
/// Of the system, and [`io::ErrorKind::InvalidData`] for a line of more than 16 MiB.
pub(crate) fn read_line(source: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<()> {
    line.clear();
    source.by_ref().take(LONGEST as u64 + 1).read_until(b'\n', line)?;
    if line.len() > LONGEST {
        let message = "a line is longer than 16 MiB; break it into shorter ones";
        return Err(io::Error::new(io::ErrorKind::InvalidData, message));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::BufReader;

    #[test]
    fn lines_have_an_end() {
        let mut line = b"before".to_vec();
        let mut text = &b"one\n\nlast"[..];
        for wanted in [&b"one\n"[..], b"\n", b"last", b""] {
            read_line(&mut text, &mut line).unwrap();
            assert_eq!(line, wanted);
        }
        let error = read_line(&mut BufReader::new(io::repeat(b'1')), &mut line).unwrap_err();
        assert!(error.to_string().contains("longer than 16 MiB"), "{error}");
        let mut longest = BufReader::new(io::repeat(b'1').take(LONGEST as u64 - 1).chain(&b"\n2"[..]));
        read_line(&mut longest, &mut line).unwrap();
        assert_eq!(line.len(), LONGEST);
    }
}
