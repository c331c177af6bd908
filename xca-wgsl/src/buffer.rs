//! A substate in memory: how it is read and stored.

use crate::access::Use;
use crate::names::{self, Names};
use crate::program::{Roles, bare};
use crate::routine;
use crate::types::{self, Type};
use std::fmt::Write as _;
use xca_core::{ScalarType, ValueType};

/// The largest number of elements that are read and stored one by one in the text.
const MOST_WRITTEN_OUT: u32 = 8;

/// A substate in memory: the components of each cell's or item's value one after the other.
pub(crate) struct Buffer {
    pub(crate) used: Use,
    pub(crate) field: &'static str,
    pub(crate) value_type: ValueType,
    pub(crate) now: String,
    pub(crate) next: Option<String>,
    /// The routine that reads a value of several components.
    reader: Option<String>,
    /// The routine that reads an element of an array of vectors.
    element_reader: Option<String>,
}

impl Buffer {
    pub(crate) fn of(used: Use, roles: &Roles<'_>, names: &mut Names) -> Option<Self> {
        let field = roles.substates.get(used.argument)?.schema.fields.get(used.field)?;
        let (name, value_type) = (bare(field.name), field.value_type);
        let now = names.module(&format!("{name}_now"));
        let next = used.doubled().then(|| names.module(&format!("{name}_next")));
        let array = value_type.length.is_some();
        let reader = (array || value_type.lanes > 1).then(|| names.routine(&format!("{name}_at")));
        let element_reader =
            (array && value_type.lanes > 1).then(|| names.routine(&format!("{name}_element_at")));
        Some(Self { used, field: field.name, value_type, now, next, reader, element_reader })
    }

    /// Whether it is loaded before the process, with others of the struct with this number.
    pub(crate) fn is_central(&self, argument: usize) -> bool {
        self.used.argument == argument && self.used.centre
    }

    /// The value of a cell or item as it was before the process.
    pub(crate) fn read(&self, number: &str) -> String {
        match &self.reader {
            Some(reader) => format!("{reader}({number})"),
            None => self.component(number),
        }
    }

    /// An element of that value. The number stands as a factor in the text, the index as a summand.
    pub(crate) fn read_element(&self, number: &str, index: &str) -> String {
        match &self.element_reader {
            Some(reader) => format!("{reader}({number}, {index})"),
            None => self.component(&format!("{}u * {number} + {index}", self.value_type.components())),
        }
    }

    /// What stands at this place, as a value.
    fn component(&self, place: &str) -> String {
        types::loaded(self.value_type.scalar, &format!("{}[{place}]", self.now))
    }

    /// The statements that store a value, indented once; where a variable is given, it becomes true where the
    /// value changes.
    pub(crate) fn store(&self, number: &str, value: &str, changed: Option<&str>) -> String {
        let target = self.next.as_ref().unwrap_or(&self.now);
        let components = self.value_type.components();
        let lanes = u32::from(self.value_type.lanes);
        let mut text = String::new();
        let mut store = |indent: &str, place: &str, component: &str| {
            let stored = match self.value_type.scalar {
                ScalarType::Bool => format!("u32({component})"),
                _ => component.to_owned(),
            };
            if let Some(changed) = changed {
                let differs = routine::difference(self.value_type.scalar);
                let now = &self.now;
                let _ =
                    writeln!(text, "{indent}{changed} = {changed} | {differs}({now}[{place}], {stored});");
            }
            let _ = writeln!(text, "{indent}{target}[{place}] = {stored};");
        };
        match self.value_type.length {
            None if lanes == 1 => store("    ", number, value),
            None => {
                for lane in 0..lanes {
                    let component = format!("{value}.{}", lane_name(lane));
                    store("    ", &format!("{lanes}u * {number} + {lane}u"), &component);
                }
            }
            Some(length) if length <= MOST_WRITTEN_OUT => {
                for component in 0..length * lanes {
                    let part = part(value, &format!("{}u", component / lanes), component % lanes, lanes);
                    store("    ", &format!("{components}u * {number} + {component}u"), &part);
                }
            }
            Some(length) => {
                for lane in 0..lanes {
                    let place = if lanes == 1 {
                        format!("{components}u * {number} + element")
                    } else {
                        format!("{components}u * {number} + {lanes}u * element + {lane}u")
                    };
                    store("        ", &place, &part(value, "element", lane, lanes));
                }
                let head = "    for (var element: u32 = 0u; element < ";
                text = format!("{head}{length}u; element += 1u) {{\n{text}    }}\n");
            }
        }
        text
    }

    /// The routines that read it, those of them that the text uses.
    pub(crate) fn readers(&self, used_in: &str) -> Vec<String> {
        let uses = |name: &&String, text: &str| names::mentions(text, name);
        let mut texts = Vec::new();
        if let Some(reader) = self.reader.as_ref().filter(|name| uses(name, used_in)) {
            texts.push(self.reader_text(reader));
        }
        let all = format!("{used_in}{}", texts.concat());
        if let Some(reader) = self.element_reader.as_ref().filter(|name| uses(name, &all)) {
            texts.insert(0, self.element_reader_text(reader));
        }
        texts
    }

    fn reader_text(&self, reader: &str) -> String {
        let type_ = Type::of_value(self.value_type).wgsl();
        let components = self.value_type.components();
        let head = format!("fn {reader}(number: u32) -> {type_} {{\n");
        match self.value_type.length {
            Some(length) if length > MOST_WRITTEN_OUT => {
                let element = self.read_element("number", "element");
                format!(
                    "{head}    var value: {type_};
    for (var element: u32 = 0u; element < {length}u; element += 1u) {{
        value[element] = {element};
    }}
    return value;
}}
"
                )
            }
            Some(length) => {
                let values: Vec<String> =
                    (0..length).map(|element| self.read_element("number", &format!("{element}u"))).collect();
                format!("{head}    return {type_}({});\n}}\n", values.join(", "))
            }
            None => {
                let values: Vec<String> = (0..components)
                    .map(|lane| self.component(&format!("{components}u * number + {lane}u")))
                    .collect();
                format!("{head}    return {type_}({});\n}}\n", values.join(", "))
            }
        }
    }

    fn element_reader_text(&self, reader: &str) -> String {
        let type_ = Type::of_value(self.value_type.element()).wgsl();
        let (components, lanes) = (self.value_type.components(), self.value_type.lanes);
        let values: Vec<String> =
            (0..lanes).map(|lane| self.component(&format!("first + {lane}u"))).collect();
        format!(
            "fn {reader}(number: u32, element: u32) -> {type_} {{
    let first: u32 = {components}u * number + {lanes}u * element;
    return {type_}({});
}}
",
            values.join(", ")
        )
    }
}

/// A lane of an element of an array.
fn part(value: &str, element: &str, lane: u32, lanes: u32) -> String {
    if lanes == 1 { format!("{value}[{element}]") } else { format!("{value}[{element}].{}", lane_name(lane)) }
}

fn lane_name(lane: u32) -> &'static str {
    ["x", "y", "z", "w"][lane.min(3) as usize]
}
