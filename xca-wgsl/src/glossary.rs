//! What things are called in a module.

use crate::access::Uses;
use crate::buffer::Buffer;
use crate::error::{Error, Problem};
use crate::inference::constant_type;
use crate::names::Names;
use crate::print::constant_text;
use crate::program::{Program, Roles, bare};
use crate::shader::Options;
use crate::types::Type;
use crate::visit::{self, Node};
use std::collections::HashMap;
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
            glossary.buffers.extend(Buffer::of(*used, &roles, names));
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

    /// The buffer of a substate.
    pub(crate) fn buffer(&self, of: Of, field: &str) -> Result<&Buffer, Problem> {
        self.buffers
            .iter()
            .find(|buffer| buffer.used.of == of && bare(buffer.field) == bare(field))
            .ok_or_else(|| Problem::unknown("substate", field))
    }

    pub(crate) fn constant(&self, name: &str, value: &Constant) -> Option<&str> {
        self.constants.get(&(name.to_owned(), format!("{value:?}"))).map(String::as_str)
    }
}
