//! The types, buffers and private variables of a module.

use crate::access::Uses;
use crate::glossary::Glossary;
use crate::layout::{FAULT, Layout, MOMENT, SPACE};
use crate::names::{self, Names, mentions};
use crate::program::{Program, Roles};
use crate::shader::{Binding, BindingAccess, Content, Options, State};
use crate::types::{self, Type};
use std::fmt::Write as _;
use xca_core::{ScalarType, ValueType};

/// The text, and the buffers for the engine.
pub(crate) struct Declarations {
    pub(crate) text: String,
    pub(crate) bindings: Vec<Binding>,
}

struct Writer<'a> {
    structs: String,
    buffers: String,
    variables: String,
    bindings: Vec<Binding>,
    body: &'a str,
    options: &'a Options,
}

impl Declarations {
    pub(crate) fn of(
        program: &Program,
        uses: &Uses,
        glossary: &Glossary,
        options: &Options,
        body: &str,
        names: &mut Names,
    ) -> Self {
        let roles = Roles::of(program.process());
        let mut writer = Writer {
            structs: String::new(),
            buffers: String::new(),
            variables: String::new(),
            bindings: Vec::new(),
            body,
            options,
        };
        writer.provided();
        writer.parameters(&roles, glossary, names);
        writer.substates(glossary);
        writer.items();
        writer.own(&roles, glossary, names);
        writer.activity();
        writer.private();
        writer.faults(uses);
        writer.finish()
    }
}

impl Writer<'_> {
    fn mentions(&self, word: &str) -> bool {
        mentions(self.body, word)
    }

    /// A struct that lies in a buffer.
    fn structure<'f>(&mut self, name: &str, fields: impl IntoIterator<Item = (&'f str, ValueType)>) {
        let fields = fields.into_iter().map(|(field, value_type)| (field, types::in_memory(value_type)));
        self.structure_of(name, fields);
    }

    fn structure_of<'f>(&mut self, name: &str, fields: impl Iterator<Item = (&'f str, String)>) {
        let _ = writeln!(self.structs, "struct {name} {{");
        for (field, type_) in fields {
            let _ = writeln!(self.structs, "    {}: {type_},", names::field(field));
        }
        self.structs.push_str("}\n\n");
    }

    fn buffer(&mut self, name: &str, type_: &str, access: BindingAccess, content: Content) {
        let number = u32::try_from(self.bindings.len()).unwrap_or(u32::MAX);
        let space = match access {
            BindingAccess::Uniform => "uniform",
            BindingAccess::Read => "storage, read",
            BindingAccess::ReadWrite => "storage, read_write",
        };
        let _ = writeln!(self.buffers, "@group(0) @binding({number}) var<{space}> {name}: {type_};");
        self.bindings.push(Binding { number, name: name.to_owned(), access, content });
    }

    fn provided(&mut self) {
        let precision = self.options.precision;
        if self.mentions("space") {
            // Without floats where the process needs none.
            let fields: Vec<_> = SPACE
                .into_iter()
                .filter(|(name, type_)| type_.scalar != ScalarType::Real || self.mentions(name))
                .collect();
            self.structure("Space", fields.iter().copied());
            let layout = Layout::of(fields, precision);
            self.buffer("space", "Space", BindingAccess::Uniform, Content::Space(layout));
        }
        if self.mentions("moment") {
            self.structure("Moment", MOMENT);
            self.buffer(
                "moment",
                "Moment",
                BindingAccess::Read,
                Content::Moment(Layout::of(MOMENT, precision)),
            );
        }
        if self.mentions("neighbour_offsets") {
            self.buffer("neighbour_offsets", "array<i32>", BindingAccess::Read, Content::NeighbourOffsets);
        }
        if self.mentions("neighbour_directions") {
            let (name, type_) = ("neighbour_directions", "array<vec4<i32>>");
            self.buffer(name, type_, BindingAccess::Read, Content::NeighbourDirections);
        }
    }

    fn parameters(&mut self, roles: &Roles<'_>, glossary: &Glossary, names: &mut Names) {
        for (argument, named) in roles.parameters.iter().enumerate() {
            let schema = named.schema;
            let Ok(variable) = glossary.parameters(schema) else { continue };
            let name = names.module(schema.name);
            self.structure(&name, schema.fields.iter().map(|field| (field.name, field.value_type)));
            let layout = Layout::of_schema(schema, self.options.precision);
            // In a uniform buffer the elements of an array would lie 16 bytes apart at least.
            let arrays = schema.fields.iter().any(|field| field.value_type.length.is_some());
            let access = if arrays { BindingAccess::Read } else { BindingAccess::Uniform };
            self.buffer(variable, &name, access, Content::Parameters { argument, layout });
        }
    }

    fn substates(&mut self, glossary: &Glossary) {
        for buffer in &glossary.buffers {
            let used = buffer.used;
            let (argument, field, value_type) = (used.argument, used.field, buffer.value_type);
            let type_ = format!("array<{}>", types::scalar_name(value_type.scalar));
            let content = |state| Content::Substate { argument, field, value_type, state };
            match &buffer.next {
                Some(next) => {
                    self.buffer(&buffer.now, &type_, BindingAccess::Read, content(State::Before));
                    self.buffer(next, &type_, BindingAccess::ReadWrite, content(State::After));
                }
                None if used.write => {
                    self.buffer(&buffer.now, &type_, BindingAccess::ReadWrite, content(State::Both));
                }
                None => self.buffer(&buffer.now, &type_, BindingAccess::Read, content(State::Before)),
            }
        }
    }

    fn items(&mut self) {
        let numbers = [
            ("item_starts", Content::ItemStarts),
            ("item_ends", Content::ItemEnds),
            ("item_labels", Content::ItemLabels),
            ("item_cells", Content::ItemCells),
        ];
        for (name, content) in numbers {
            if self.mentions(name) {
                self.buffer(name, "array<u32>", BindingAccess::Read, content);
            }
        }
        if self.mentions("destinations") {
            self.buffer(
                "destinations",
                "array<Destination>",
                BindingAccess::ReadWrite,
                Content::Destinations,
            );
        }
    }

    fn activity(&mut self) {
        if self.mentions("activity") {
            let type_ = "array<atomic<u32>>";
            self.buffer("activity", type_, BindingAccess::ReadWrite, Content::Activity);
            for name in ["tile", "tiles", "run_number"] {
                let _ = writeln!(self.variables, "var<private> {name}: u32;");
            }
        }
    }

    /// The variables with the own substates, and with those of other structs of the cell.
    fn own(&mut self, roles: &Roles<'_>, glossary: &Glossary, names: &mut Names) {
        for (argument, named) in roles.substates.iter().enumerate() {
            let Ok(variable) = glossary.central(argument) else { continue };
            let buffers = glossary.buffers.iter().filter(|buffer| buffer.is_central(argument));
            let name = names.module(named.schema.name);
            let fields = buffers.map(|buffer| (buffer.field, Type::of_value(buffer.value_type).wgsl()));
            self.structure_of(&name, fields);
            let _ = writeln!(self.variables, "var<private> {variable}: {name};");
        }
    }

    fn private(&mut self) {
        for (name, type_) in [("here", "u32"), ("here_index", "vec3<i32>"), ("this_item", "u32")] {
            if self.mentions(name) {
                let _ = writeln!(self.variables, "var<private> {name}: {type_};");
            }
        }
    }

    fn faults(&mut self, uses: &Uses) {
        if !uses.faults {
            return;
        }
        self.structure("Fault", FAULT);
        self.structs.push_str(
            "struct Faults {\n    first: atomic<u32>,\n    stopped: u32,\n    records: array<Fault>,\n}\n\n",
        );
        let layout = Layout::of(FAULT, self.options.precision);
        self.buffer("faults", "Faults", BindingAccess::ReadWrite, Content::Faults(layout));
        self.variables.push_str("var<private> recorded_fault: Fault;\nvar<private> has_fault: bool;\n");
        self.variables.push_str("var<workgroup> first_fault: atomic<u32>;\n");
    }

    fn finish(self) -> Declarations {
        let mut text = String::new();
        let known = [self.body, &self.structs, &self.buffers].concat();
        if mentions(&known, "Real") {
            let _ = writeln!(text, "alias Real = {};", types::real(self.options.precision));
        }
        if mentions(&known, "Destination") {
            text.push_str("alias Destination = u32;\n");
        }
        if !text.is_empty() {
            text.push('\n');
        }
        text.push_str(&self.structs);
        text.push_str(&self.buffers);
        text.push('\n');
        text.push_str(&self.variables);
        if !self.variables.is_empty() {
            text.push('\n');
        }
        Declarations { text, bindings: self.bindings }
    }
}
