//! The description of an array in the head of a file.

use super::super::appended::{COMPONENT_NAME, unescaped};
use super::super::number_type::NumberType;
use super::found::ReadArray;

/// The name of the array with the time.
pub(super) const TIME: &str = "TimeValue";

/// The largest number of components.
const MOST_COMPONENTS: usize = 1 << 20;

/// The value of an attribute of an element.
pub(super) fn attribute(element: &str, name: &str) -> Option<String> {
    let value = element.split_once(&format!(" {name}=\""))?.1.split_once('"')?.0;
    Some(unescaped(value))
}

/// The description of an array in the head of a file.
pub(super) struct Element {
    pub(super) name: String,
    numbers: NumberType,
    components: usize,
    component_names: Vec<String>,
    /// The offset of its values, and their expanded length in bytes.
    pub(super) offset: usize,
    pub(super) length: usize,
}

impl Element {
    /// Parses a line of the head. `count` is the number of values.
    pub(super) fn new(element: &str, count: usize) -> Option<Self> {
        let numbers = NumberType::with_vtk_name(&attribute(element, "type")?)?;
        let number = |name: &str| attribute(element, name).map(|text| text.parse::<usize>());
        let components = number("NumberOfComponents").unwrap_or(Ok(1)).ok()?;
        if !(1..=MOST_COMPONENTS).contains(&components) {
            return None;
        }
        // Only the time has one number in a file of many values.
        let given = number("NumberOfTuples").transpose().ok()?;
        let name = attribute(element, "Name")?;
        let is_time = name == TIME && given == Some(1);
        let count = if is_time {
            1
        } else {
            Some(count).filter(|count| given.is_none_or(|given| given == *count))?
        };
        let length = count.checked_mul(components)?.checked_mul(numbers.size())?;
        let component_names = component_names(element, components)?;
        let offset = number("offset")?.ok()?;
        Some(Self { name, numbers, components, component_names, offset, length })
    }

    /// Whether its values can be these states.
    pub(super) fn can_have(&self, states: &[String]) -> bool {
        states.is_empty() || self.numbers == NumberType::U8
    }

    /// The array with its values.
    pub(super) fn array(self, bytes: Vec<u8>, states: Vec<String>) -> ReadArray {
        let Self { name, numbers, components, component_names, .. } = self;
        ReadArray {
            name,
            numbers,
            components,
            component_names,
            states,
            bytes: numbers.of_this_machine(bytes),
        }
    }
}

/// The names of the components, by index. `None` if their numbers are out of order.
fn component_names(element: &str, components: usize) -> Option<Vec<String>> {
    let mut names = Vec::new();
    // Only an attribute contains a plain quotation mark. The text before it is the name of the array.
    let attributes = element.split_once(" NumberOfComponents=\"").map_or("", |(_, attributes)| attributes);
    for part in attributes.split(COMPONENT_NAME).skip(1) {
        let (number, rest) = part.split_once("=\"")?;
        if names.len() == components || number.parse() != Ok(names.len()) {
            return None;
        }
        names.push(unescaped(rest.split_once('"')?.0));
    }
    Some(names)
}
