//! The layout of VTK XML files: a head of XML, then the blocks of values that it refers to.

use std::fmt::Write as _;
use std::io::{self, Seek, SeekFrom, Write};

use super::blocks::{Blocks, COMPRESSOR};
use super::values::DataArray;

/// The text before the values.
pub(super) const DATA: &str = "<AppendedData encoding=\"raw\">\n_";
/// The text after the values.
pub(super) const END: &str = "\n</AppendedData>\n</VTKFile>\n";

/// The beginning of the element with the names of the states of an array.
pub(super) const STATES_OF: &str = "<Array type=\"String\" Name=\"states of ";
/// The attribute with the name of a component, without its number.
pub(super) const COMPONENT_NAME: &str = " ComponentName";

/// The first lines of a file of type `kind`.
pub(super) fn head(kind: &str) -> String {
    let attributes = r#"version="1.0" byte_order="LittleEndian" header_type="UInt64""#;
    format!("<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" {attributes} compressor=\"{COMPRESSOR}\">\n")
}

/// The place of an offset in the head. The offset is known once all earlier values are compressed, so it is
/// written into this room later.
const OFFSET: &str = "offset=\"                    \"";

/// The values at the end of a file, in the order of their elements in the head.
#[derive(Default)]
pub(super) struct Appended<'a> {
    values: Vec<Appendix<'a>>,
}

/// Writes the values of an array.
type WriteValues<'a> = dyn FnOnce(&mut dyn Write) -> io::Result<()> + 'a;

/// The values of an array.
struct Appendix<'a> {
    /// The number of bytes.
    length: usize,
    write: Box<WriteValues<'a>>,
}

impl<'a> Appended<'a> {
    /// Appends the values of an array and returns its element.
    pub(super) fn array(&mut self, array: &DataArray<'a>) -> String {
        let mut attributes = format!(
            r#"type="{}" Name="{}" NumberOfComponents="{}""#,
            array.values.vtk_type(),
            escaped(array.name),
            array.values.components()
        );
        for (number, name) in array.components.iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = write!(attributes, r#"{COMPONENT_NAME}{number}="{}""#, escaped(name));
        }
        let values = array.values;
        self.append(&attributes, values.bytes(), move |out| values.write_to(out))
    }

    /// Appends as many integers as there are and returns their element.
    pub(super) fn count(
        &mut self,
        name: &str,
        mut numbers: impl ExactSizeIterator<Item = i32> + 'a,
    ) -> String {
        let length = size_of::<i32>() * numbers.len();
        self.append(&format!(r#"type="Int32" Name="{name}""#), length, move |out| {
            numbers.try_for_each(|number| out.write_all(&number.to_le_bytes()))
        })
    }

    /// The elements of point or cell data (`kind`). ParaView colours by the first scalars.
    pub(super) fn data(&mut self, kind: &str, arrays: &[DataArray<'a>]) -> String {
        let scalars = arrays.iter().find(|array| array.values.components() == 1);
        let scalars =
            scalars.map(|array| format!(r#" Scalars="{}""#, escaped(array.name))).unwrap_or_default();
        let elements: String = arrays.iter().map(|array| self.array(array)).collect();
        format!("<{kind}{scalars}>\n{elements}</{kind}>\n")
    }

    /// The element that holds the time of the file, the names of the states of its arrays, and `others`.
    pub(super) fn field_data(&mut self, time: f64, arrays: &[DataArray<'_>], others: &str) -> String {
        let attributes = r#"type="Float64" Name="TimeValue" NumberOfTuples="1""#;
        let array = self.append(attributes, size_of::<f64>(), move |out| out.write_all(&time.to_le_bytes()));
        let states = arrays.iter().filter(|array| !array.states.is_empty()).map(names_of_states);
        format!("<FieldData>\n{array}{}{others}</FieldData>\n", states.collect::<String>())
    }

    fn append(
        &mut self,
        attributes: &str,
        length: usize,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()> + 'a,
    ) -> String {
        self.values.push(Appendix { length, write: Box::new(write) });
        format!("<DataArray {attributes} format=\"appended\" {OFFSET}/>\n")
    }

    /// Writes a file: `content` makes the element named `kind`, and appends its values.
    pub(super) fn write(
        out: &mut (impl Write + Seek),
        kind: &str,
        content: impl FnOnce(&mut Self) -> String,
    ) -> io::Result<()> {
        let mut appended = Self::default();
        let text = format!("{}{}{DATA}", head(kind), content(&mut appended));
        out.write_all(text.as_bytes())?;
        let start = text.len() as u64;
        let mut end = start;
        for ((place, _), Appendix { length, write }) in text.match_indices(OFFSET).zip(appended.values) {
            out.seek(SeekFrom::Start(place as u64))?;
            let offset = format!("offset=\"{}\"", end - start);
            write!(out, "{offset:width$}", width = OFFSET.len())?;
            out.seek(SeekFrom::Start(end))?;
            let mut blocks = Blocks::new(out, length)?;
            write(&mut blocks)?;
            end += blocks.finish()?;
        }
        out.write_all(END.as_bytes())
    }
}

/// An array of strings. VTK writes each string as the numbers of its bytes, followed by 0.
fn names_of_states(array: &DataArray<'_>) -> String {
    let bytes = array.states.iter().flat_map(|name| name.bytes().chain([0]));
    let numbers: Vec<String> = bytes.map(|byte| byte.to_string()).collect();
    format!(
        "{STATES_OF}{}\" NumberOfTuples=\"{}\" format=\"ascii\">{}</Array>\n",
        escaped(array.name),
        array.states.len(),
        numbers.join(" ")
    )
}

/// Reads the strings of an element that [`names_of_states`] wrote.
pub(super) fn read_names(element: &str) -> Option<Vec<String>> {
    let numbers = element.split_once('>')?.1.strip_suffix("</Array>")?;
    let bytes = numbers.split(' ').map(|number| number.parse().ok()).collect::<Option<Vec<u8>>>()?;
    let names = bytes.strip_suffix(&[0])?.split(|byte| *byte == 0);
    names.map(|name| String::from_utf8(name.to_vec()).ok()).collect()
}

/// Escapes text for an attribute. Control characters, which XML cannot hold, become blanks.
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

/// Reverses [`escaped`].
pub(super) fn unescaped(text: &str) -> String {
    let plain = text.replace("&quot;", "\"").replace("&gt;", ">").replace("&lt;", "<");
    plain.replace("&amp;", "&")
}

/// The beginning of the element of numbers that stand in the head itself.
const NUMBERS: &str = "<DataArray type=\"Float64\" Name=\"";
/// The text after the name of such an array and the number of its values.
const AS_TEXT: &str = " format=\"ascii\">";

/// The element of a field of few numbers, as text.
pub(super) fn numbers_as_text(name: &str, numbers: &[f64]) -> String {
    let count = numbers.len();
    format!("{NUMBERS}{name}\" NumberOfTuples=\"{count}\"{AS_TEXT}{}</DataArray>\n", joined(numbers))
}

/// Whether the element holds its values as text.
pub(super) fn is_as_text(element: &str) -> bool {
    element.contains(AS_TEXT)
}

/// Reads the numbers of a field that [`numbers_as_text`] wrote.
pub(super) fn read_numbers<const N: usize>(head: &str, name: &str) -> Option<[f64; N]> {
    let begin = format!("{NUMBERS}{name}\" NumberOfTuples=\"{N}\"{AS_TEXT}");
    let text = head.lines().find_map(|line| line.strip_prefix(&begin))?.strip_suffix("</DataArray>")?;
    let numbers = text.split(' ').map(|number| number.parse().ok()).collect::<Option<Vec<f64>>>()?;
    numbers.try_into().ok()
}

/// Numbers separated by blanks, each the shortest decimal that reads back exactly.
pub(super) fn joined(numbers: &[f64]) -> String {
    let mut out = String::new();
    for (i, number) in numbers.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(out, "{}{number:?}", if i == 0 { "" } else { " " });
    }
    out
}
