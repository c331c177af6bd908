//! What things are called in a module.

use crate::access::Uses;
use crate::buffer::Buffer;
use crate::constant::constant_text;
use crate::error::{Error, Problem};
use crate::inference::constant_type;
use crate::names::Names;
use crate::program::{Program, Roles, bare};
use crate::shader::Options;
use crate::types::Type;
use crate::visit::{self, Node};
use std::collections::HashMap;
use xca_core::Schema;
use xca_core::ir::{Constant, Expression};

/// What things are called in a module.
pub(crate) struct Glossary {
    /// The functions of the program.
    pub(crate) functions: Vec<String>,
    /// For each struct of substates the variable with what is loaded of it before the process, if anything
    /// is.
    centres: Vec<Option<String>>,
    /// The structs of parameters that are used, and the variable with each.
    parameters: Vec<(&'static Schema, String)>,
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
        let loaded = |argument| uses.substates.iter().any(|used| used.argument == argument && used.centre);
        let centres = roles.substates.iter().enumerate();
        let centres =
            centres.map(|(argument, named)| loaded(argument).then(|| names.module(named.name))).collect();
        let used = roles.parameters.iter().filter(|named| uses.parameters.contains(&named.schema));
        let parameters = used.map(|named| (named.schema, names.module(named.name))).collect();
        let functions = program.functions.iter().map(|function| names.module(function.name)).collect();
        let mut glossary = Self {
            functions,
            centres,
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

    /// The variable with what is loaded of a struct of substates.
    pub(crate) fn central(&self, argument: usize) -> Result<&str, Problem> {
        let variable = self.centres.get(argument).and_then(Option::as_deref);
        variable.ok_or_else(|| Problem::unknown("struct of substates", &argument.to_string()))
    }

    /// The variable with a struct of parameters.
    pub(crate) fn parameters(&self, schema: &Schema) -> Result<&str, Problem> {
        let variable = self.parameters.iter().find(|(used, _)| *used == schema);
        variable
            .map(|(_, variable)| variable.as_str())
            .ok_or_else(|| Problem::unknown("struct of parameters", schema.name))
    }

    /// The buffer of a substate.
    pub(crate) fn buffer(&self, argument: usize, field: &str) -> Result<&Buffer, Problem> {
        self.buffers
            .iter()
            .find(|buffer| buffer.used.argument == argument && bare(buffer.field) == bare(field))
            .ok_or_else(|| Problem::unknown("substate", field))
    }

    pub(crate) fn constant(&self, name: &str, value: &Constant) -> Option<&str> {
        self.constants.get(&(name.to_owned(), format!("{value:?}"))).map(String::as_str)
    }
}
