//! The layout that all VTK XML files share: a head of XML, then the blocks of values that it refers to.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::values::{DataArray, Values};

/// What stands before the values.
pub(super) const DATA: &str = "<AppendedData encoding=\"raw\">\n_";
/// What stands after them.
pub(super) const END: &str = "\n</AppendedData>\n</VTKFile>\n";

/// The first lines of a file of this kind.
pub(super) fn head(kind: &str) -> String {
    let attributes = r#"version="1.0" byte_order="LittleEndian" header_type="UInt64""#;
    format!("<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" {attributes}>\n")
}

/// The values that stand at the end of a file.
#[derive(Default)]
pub(super) struct Appended<'a> {
    blocks: Vec<Block<'a>>,
    /// Where the next block begins, in bytes after the underscore.
    offset: u64,
}

enum Block<'a> {
    Values(Values<'a>),
    Time(f64),
    /// `from`, `from + 1`, ... as `i32`.
    Count {
        from: i32,
        len: i32,
    },
}

impl Block<'_> {
    fn bytes(&self) -> u64 {
        match self {
            Self::Values(values) => values.bytes(),
            Self::Time(_) => 8,
            Self::Count { len, .. } => u64::from(len.unsigned_abs()) * 4,
        }
    }

    fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Values(values) => values.write_to(out),
            Self::Time(time) => out.write_all(&time.to_le_bytes()),
            Self::Count { from, len } => (0..*len).try_for_each(|i| out.write_all(&(from + i).to_le_bytes())),
        }
    }
}

impl<'a> Appended<'a> {
    /// The element of an array whose values are appended.
    pub(super) fn array(&mut self, array: &DataArray<'a>) -> String {
        let attributes = format!(
            r#"type="{}" Name="{}" NumberOfComponents="{}""#,
            array.values.vtk_type().0,
            escaped(array.name),
            array.values.components()
        );
        self.append(&attributes, Block::Values(array.values))
    }

    /// The element of an array `from`, `from + 1`, ... of `len` numbers.
    pub(super) fn count(&mut self, name: &str, from: i32, len: i32) -> String {
        self.append(&format!(r#"type="Int32" Name="{name}""#), Block::Count { from, len })
    }

    /// The elements of point or cell data (`kind`): the first scalars are what ParaView colours by.
    pub(super) fn data(&mut self, kind: &str, arrays: &[DataArray<'a>]) -> String {
        let scalars = arrays.iter().find(|array| array.values.components() == 1);
        let scalars =
            scalars.map(|array| format!(r#" Scalars="{}""#, escaped(array.name))).unwrap_or_default();
        let elements: String = arrays.iter().map(|array| self.array(array)).collect();
        format!("<{kind}{scalars}>\n{elements}</{kind}>\n")
    }

    /// The element that holds the time of the file.
    pub(super) fn time(&mut self, time: f64) -> String {
        let attributes = r#"type="Float64" Name="TimeValue" NumberOfTuples="1""#;
        format!("<FieldData>\n{}</FieldData>\n", self.append(attributes, Block::Time(time)))
    }

    fn append(&mut self, attributes: &str, block: Block<'a>) -> String {
        let element = format!("<DataArray {attributes} format=\"appended\" offset=\"{}\"/>\n", self.offset);
        self.offset += 8 + block.bytes();
        self.blocks.push(block);
        element
    }

    /// Writes the file: `content` is the element named `kind`.
    pub(super) fn write(&self, out: &mut dyn Write, kind: &str, content: &str) -> io::Result<()> {
        write!(out, "{}{content}{DATA}", head(kind))?;
        for block in &self.blocks {
            out.write_all(&block.bytes().to_le_bytes())?;
            block.write_to(out)?;
        }
        out.write_all(END.as_bytes())
    }
}

/// Text as it may stand in an attribute; control characters, which XML cannot hold, become blanks.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Text that was [`escaped`].
pub(super) fn unescaped(text: &str) -> String {
    let plain = text.replace("&quot;", "\"").replace("&gt;", ">").replace("&lt;", "<");
    plain.replace("&amp;", "&")
}

/// Numbers with blanks between them, each the shortest decimal that reads back exactly.
pub(super) fn joined(numbers: &[f64]) -> String {
    let mut out = String::new();
    for (i, number) in numbers.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(out, "{}{number:?}", if i == 0 { "" } else { " " });
    }
    out
}
