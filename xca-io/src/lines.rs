//! Lines of text files and rows of tables, with a limit of their length.

use std::io::{self, BufRead, Read};

/// The longest line in bytes. A file without line ends would fill the memory.
const LONGEST: usize = 1 << 24;

/// Reads the next line, with its end, into `line`. At the end of the source, `line` is empty.
///
/// # Errors
/// Those of the system, and [`io::ErrorKind::InvalidData`] for a line of more than 16 MiB.
pub(crate) fn read_line(source: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<()> {
    line.clear();
    source.by_ref().take(LONGEST as u64 + 1).read_until(b'\n', line)?;
    if line.len() > LONGEST {
        let message = "a line is longer than 16 MiB; break it into shorter ones";
        return Err(io::Error::new(io::ErrorKind::InvalidData, message));
    }
    Ok(())
}

/// The source of a CSV reader, with a limit of the length of a row. A quotation mark that is never closed
/// would otherwise make one row of the whole rest.
///
/// Call [`Self::begin_row`] before each row. The limit is 16 MiB and includes what the reader has read ahead.
#[derive(Debug)]
pub struct LimitedRows<R> {
    source: R,
    /// The bytes left for the row.
    left: usize,
}

impl<R> LimitedRows<R> {
    /// The rows of `source`.
    pub fn new(source: R) -> Self {
        Self { source, left: LONGEST }
    }

    /// Begins a row.
    pub fn begin_row(&mut self) {
        self.left = LONGEST;
    }

    /// The underlying source.
    pub fn source(&self) -> &R {
        &self.source
    }
}

impl<R: Read> Read for LimitedRows<R> {
    /// Reads from the source. Beyond the limit of the row the error is [`io::ErrorKind::InvalidData`].
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.left == 0 && !buffer.is_empty() {
            let message = "a row is longer than 16 MiB; is there a quotation mark that is not closed?";
            return Err(io::Error::new(io::ErrorKind::InvalidData, message));
        }
        let most = buffer.len().min(self.left);
        let read = self.source.read(&mut buffer[..most])?;
        self.left -= read;
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::BufReader;

    #[test]
    fn rows_have_an_end() {
        let mut rows = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(LimitedRows::new(b"1,\"2\n3\"\n4,5\n".chain(&b"\""[..]).chain(io::repeat(b'6'))));
        let mut record = csv::ByteRecord::new();
        for wanted in [["1", "2\n3"], ["4", "5"]] {
            rows.get_mut().begin_row();
            assert!(rows.read_byte_record(&mut record).unwrap());
            assert!(record.iter().eq(wanted.map(str::as_bytes)));
        }
        rows.get_mut().begin_row();
        let error = rows.read_byte_record(&mut record).unwrap_err().to_string();
        assert!(error.contains("a row is longer than 16 MiB"), "{error}");
        // Many rows together are longer than the limit.
        let text = format!("{}\n", "7".repeat(LONGEST / 4)).repeat(6);
        let mut rows =
            csv::ReaderBuilder::new().has_headers(false).from_reader(LimitedRows::new(text.as_bytes()));
        for _ in 0..6 {
            rows.get_mut().begin_row();
            assert!(rows.read_byte_record(&mut record).unwrap());
        }
        assert!(!rows.read_byte_record(&mut record).unwrap());
    }

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
