//! Puts a module together.

use crate::access::{Use, Uses};
use crate::entry::{self, Entry};
use crate::error::{Error, Problem};
use crate::inference::constant_type;
use crate::layout::{FAULT, Layout, MOMENT, SPACE};
use crate::names::{self, Names};
use crate::print::{self, Shared, constant_text};
use crate::program::{Program, Roles};
use crate::routine::{self, Routines};
use crate::shader::{Binding, BindingAccess, Content, Dispatch, Options, Shader, State};
use crate::space;
use crate::types::{self, Type};
use crate::visit::{self, Node};
use std::collections::HashMap;
use std::fmt::Write as _;
use xca_core::ir::{Constant, Expression, FunctionKind};
use xca_core::kernel::Of;
use xca_core::{Precision, Schema, ValueType};

/// What things are called in a module.
pub(crate) struct Glossary {
    /// The functions of the program.
    pub(crate) functions: Vec<String>,
    /// The variable with the own substates.
    pub(crate) subject: Option<String>,
    /// The variable with the substates of the item's cell.
    pub(crate) companion: Option<String>,
    pub(crate) parameters: String,
    /// The number of cells in the neighbourhood.
    pub(crate) neighbours: String,
    pub(crate) buffers: Vec<Buffer>,
    constants: HashMap<(String, String), String>,
}

/// A substate in memory.
pub(crate) struct Buffer {
    pub(crate) used: Use,
    pub(crate) field: &'static str,
    value_type: ValueType,
    now: String,
    next: Option<String>,
    /// The routine that reads a vector.
    reader: Option<String>,
}

impl Buffer {
    /// The value of a cell or item as it was before the process.
    pub(crate) fn read(&self, number: &str) -> String {
        match &self.reader {
            Some(reader) => format!("{reader}({number})"),
            None => format!("{}[{number}]", self.now),
        }
    }

    /// The statements that store a value, indented once.
    pub(crate) fn store(&self, number: &str, value: &str) -> String {
        let target = self.next.as_ref().unwrap_or(&self.now);
        let lanes = self.value_type.lanes;
        if lanes == 1 {
            return format!("    {target}[{number}] = {value};\n");
        }
        (0..lanes)
            .map(|lane| {
                let component = ["x", "y", "z", "w"][usize::from(lane.min(3))];
                format!("    {target}[{lanes}u * {number} + {lane}u] = {value}.{component};\n")
            })
            .collect()
    }

    fn reader_text(&self) -> Option<String> {
        let reader = self.reader.as_ref()?;
        let lanes = self.value_type.lanes;
        let type_ = Type::of_value(self.value_type).wgsl();
        let values: Vec<String> =
            (0..lanes).map(|lane| format!("{}[{lanes}u * number + {lane}u]", self.now)).collect();
        Some(format!("fn {reader}(number: u32) -> {type_} {{\n    return {type_}({});\n}}\n", values.join(", ")))
    }
}

impl Glossary {
    /// The text that reads a substate of another cell or item.
    pub(crate) fn read(&self, of: Of, field: &str, number: &str) -> Result<String, Problem> {
        self.buffers
            .iter()
            .find(|buffer| buffer.used.of == of && buffer.field == field)
            .map(|buffer| buffer.read(number))
            .ok_or_else(|| Problem::unknown("substate", field))
    }

    pub(crate) fn constant(&self, name: &str, value: &Constant) -> Option<&str> {
        self.constants.get(&(name.to_owned(), format!("{value:?}"))).map(String::as_str)
    }
}
