//! Functions: the head, and the body between its braces.

use super::statement;
use super::writer::{Shared, Target, Writer, zero};
use crate::error::Problem;
use crate::inference::Analysis;
use crate::program::Roles;
use crate::types::Type;
use std::collections::{HashMap, HashSet};
use xca_core::ir::Role;

/// The text of a function of the program: the body, apart from the entry point.
pub(crate) fn function(shared: &mut Shared<'_>, number: usize) -> Result<String, Problem> {
    let program = shared.program;
    let function = &program.functions[number];
    let analysis = Analysis::of(program, number)?;
    shared.names.open();
    let writer = Writer {
        roles: Roles::of(function),
        shared,
        function,
        analysis,
        out: String::new(),
        indent: 0,
        locals: HashMap::new(),
        neighbours: HashSet::new(),
        ranges: HashMap::new(),
        counted: HashMap::new(),
        loops: Vec::new(),
    };
    writer.run(number)
}

impl Writer<'_, '_> {
    fn run(mut self, number: usize) -> Result<String, Problem> {
        let mut arguments = Vec::new();
        for (position, argument) in self.function.arguments.iter().enumerate() {
            if let (Role::Value(written), Some(local)) = (&argument.role, self.analysis.arguments[position]) {
                let name = self.shared.names.local(argument.name);
                let type_ = Type::from(written);
                self.check_type(&type_)?;
                arguments.push(format!("{name}: {}", type_.wgsl()));
                self.locals.insert(local, name);
            }
        }
        let result = self.analysis.result.clone();
        self.check_type(&result)?;
        let arrow = if result == Type::Unit { String::new() } else { format!(" -> {}", result.wgsl()) };
        let name = self.shared.glossary.functions[number].clone();
        self.line(&format!("fn {name}({}){arrow} {{", arguments.join(", ")));
        self.indent += 1;
        let function = self.function;
        let target = if result == Type::Unit { Target::Nowhere } else { Target::Return };
        self.block_into(&function.body, target)?;
        if result != Type::Unit && !statement::ends_in_return(&function.body) {
            // Never reached, but naga wants to see a `return` at the end.
            self.line(&format!("return {};", zero(&result)));
        }
        self.indent -= 1;
        self.line("}");
        self.shared.names.close();
        Ok(self.out)
    }
}
