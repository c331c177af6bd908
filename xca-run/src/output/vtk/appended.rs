//! The layout that all VTK XML files share: a head of XML, then the blocks of values that it refers to.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::compressed::Compressed;
use super::values::DataArray;

/// The values that stand at the end of a file, compressed.
#[derive(Default)]
pub(super) struct Appended {
    bytes: Vec<u8>,
}

impl Appended {
    /// The element of an array whose values are appended.
    pub(super) fn array(&mut self, array: &DataArray<'_>) -> io::Result<String> {
        let attributes = format!(
            r#"type="{}" Name="{}" NumberOfComponents="{}""#,
            array.values.vtk_type(),
            escaped(array.name),
            array.values.components()
        );
        self.append(&attributes, |out| array.values.write_to(out))
    }

    /// The element of an array `from`, `from + 1`, ... of `len` numbers.
    pub(super) fn count(&mut self, name: &str, from: i32, len: i32) -> io::Result<String> {
        self.append(&format!(r#"type="Int32" Name="{name}""#), |out| {
            (0..len).try_for_each(|i| out.write_all(&(from + i).to_le_bytes()))
        })
    }

    /// The elements of point or cell data (`kind`): the first scalars are what ParaView colours by.
    pub(super) fn data(&mut self, kind: &str, arrays: &[DataArray<'_>]) -> io::Result<String> {
        let scalars = arrays.iter().find(|array| array.values.components() == 1);
        let scalars =
            scalars.map(|array| format!(r#" Scalars="{}""#, escaped(array.name))).unwrap_or_default();
        let elements: io::Result<String> = arrays.iter().map(|array| self.array(array)).collect();
        Ok(format!("<{kind}{scalars}>\n{}</{kind}>\n", elements?))
    }

    /// The element that holds the time of the file.
    pub(super) fn time(&mut self, time: f64) -> io::Result<String> {
        let attributes = r#"type="Float64" Name="TimeValue" NumberOfTuples="1""#;
        let element = self.append(attributes, |out| out.write_all(&time.to_le_bytes()))?;
        Ok(format!("<FieldData>\n{element}</FieldData>\n"))
    }

    /// The element with these attributes of the values that `fill` writes.
    fn append(
        &mut self,
        attributes: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<String> {
        let offset = self.bytes.len();
        let mut values = Compressed::default();
        fill(&mut values)?;
        self.bytes.append(&mut values.finish()?);
        Ok(format!("<DataArray {attributes} format=\"appended\" offset=\"{offset}\"/>\n"))
    }

    /// Writes the file: `content` is the element named `kind`.
    pub(super) fn write(&self, out: &mut dyn Write, kind: &str, content: &str) -> io::Result<()> {
        let head = r#"version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor""#;
        write!(out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" {head}>\n{content}")?;
        out.write_all(b"<AppendedData encoding=\"raw\">\n_")?;
        out.write_all(&self.bytes)?;
        out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
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

/// Numbers with blanks between them, each the shortest decimal that reads back exactly.
pub(super) fn joined(numbers: &[f64]) -> String {
    let mut out = String::new();
    for (i, number) in numbers.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(out, "{}{number:?}", if i == 0 { "" } else { " " });
    }
    out
}
