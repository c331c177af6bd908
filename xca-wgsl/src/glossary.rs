//! What things are called in a module.

use crate::access::{Use, Uses};
use crate::error::{Error, Problem};
use crate::inference::constant_type;
use crate::names::Names;
use crate::print::constant_text;
use crate::program::{Program, Roles, bare};
use crate::shader::Options;
use crate::types::Type;
use crate::visit::{self, Node};
use std::collections::HashMap;
use xca_core::ValueType;
use xca_core::ir::{Constant, Expression};
use xca_core::kernel::Of;

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
    /// The declarations of the constants.
    pub(crate) declarations: Vec<String>,
    /// Statements that fill tables, at the start.
    pub(crate) tables: Vec<String>,
    constants: HashMap<(String, String), String>,
}

/// A substate in memory.
pub(crate) struct Buffer {
    pub(crate) used: Use,
    pub(crate) field: &'static str,
    pub(crate) value_type: ValueType,
    pub(crate) now: String,
    pub(crate) next: Option<String>,
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

    /// The routine that reads a vector.
    pub(crate) fn reader_text(&self) -> Option<String> {
        let reader = self.reader.as_ref()?;
        let lanes = self.value_type.lanes;
        let type_ = Type::of_value(self.value_type).wgsl();
        let values: Vec<String> =
            (0..lanes).map(|lane| format!("{}[{lanes}u * number + {lane}u]", self.now)).collect();
        Some(format!(
            "fn {reader}(number: u32) -> {type_} {{\n    return {type_}({});\n}}\n",
            values.join(", ")
        ))
    }
}

impl Glossary {
    pub(crate) fn of(
        program: &Program,
        uses: &Uses,
        options: &Options,
        names: &mut Names,
    ) -> Result<Self, Error> {
        let roles = Roles::of(program.process());
        let neighbours =
            options.neighbourhood_size.map_or("space.neighbours".to_owned(), |size| format!("{size}u"));
        let has = |of| uses.substates.iter().any(|used| used.of == of && used.centre);
        let subject = roles.subject.filter(|_| has(Of::Subject)).map(|(name, _)| names.module(name));
        let companion = roles.companion.filter(|_| has(Of::Companion)).map(|(name, _)| names.module(name));
        let parameters = names.module(roles.parameters.map_or("parameters", |(name, _)| name));
        let functions = program.functions.iter().map(|function| names.module(function.name)).collect();
        let mut glossary = Self {
            functions,
            subject,
            companion,
            parameters,
            neighbours,
            buffers: Vec::new(),
            declarations: Vec::new(),
            tables: Vec::new(),
            constants: HashMap::new(),
        };
        for used in &uses.substates {
            glossary.add_buffer(*used, &roles, names);
        }
        for (number, function) in program.functions.iter().enumerate() {
            let mut constants = Vec::new();
            visit::block(&function.body, &mut |node| {
                if let Node::Expression(Expression::Constant { name, value }) = node {
                    constants.push((*name, value));
                }
                true
            });
            for (name, value) in constants {
                glossary
                    .add_constant(name, value, options, names)
                    .map_err(|problem| program.error(number, problem))?;
            }
        }
        Ok(glossary)
    }

    fn add_buffer(&mut self, used: Use, roles: &Roles<'_>, names: &mut Names) {
        let group = match used.of {
            Of::Subject => roles.subject,
            Of::Companion => roles.companion,
        };
        let Some(field) = group.and_then(|(_, schema)| schema.fields.get(used.field)) else { return };
        let now = names.module(&format!("{}_now", bare(field.name)));
        let next = used.doubled().then(|| names.module(&format!("{}_next", bare(field.name))));
        let reader = (field.value_type.lanes > 1).then(|| names.routine(&format!("{}_at", bare(field.name))));
        self.buffers.push(Buffer {
            used,
            field: field.name,
            value_type: field.value_type,
            now,
            next,
            reader,
        });
    }

    /// Gives a constant a name of its own, except where WGSL does not take its value as a constant.
    fn add_constant(
        &mut self,
        path: &str,
        value: &Constant,
        options: &Options,
        names: &mut Names,
    ) -> Result<(), Problem> {
        let key = (path.to_owned(), format!("{value:?}"));
        let text = constant_text(path, value, options)?;
        let type_ = constant_type(path, value)?;
        let table = matches!(type_, Type::Array(..));
        let constant = !text.contains("infinity_") && !text.contains("space.zero");
        if self.constants.contains_key(&key) || !(constant || table) {
            return Ok(());
        }
        let name = names.module(path.rsplit("::").next().unwrap_or(path));
        let type_ = type_.wgsl();
        // Elements of a table are reached by a number that is not known before: it has to be a variable.
        match (constant, table) {
            (true, false) => self.declarations.push(format!("const {name}: {type_} = {text};\n")),
            (true, true) => self.declarations.push(format!("var<private> {name}: {type_} = {text};\n")),
            (false, _) => {
                self.declarations.push(format!("var<private> {name}: {type_};\n"));
                self.tables.push(format!("{name} = {text};"));
            }
        }
        self.constants.insert(key, name);
        Ok(())
    }

    /// The text that reads a substate of another cell or item.
    pub(crate) fn read(&self, of: Of, field: &str, number: &str) -> Result<String, Problem> {
        self.buffers
            .iter()
            .find(|buffer| buffer.used.of == of && bare(buffer.field) == bare(field))
            .map(|buffer| buffer.read(number))
            .ok_or_else(|| Problem::unknown("substate", field))
    }

    pub(crate) fn constant(&self, name: &str, value: &Constant) -> Option<&str> {
        self.constants.get(&(name.to_owned(), format!("{value:?}"))).map(String::as_str)
    }
}
