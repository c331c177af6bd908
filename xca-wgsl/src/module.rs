//! Puts a module together.

use crate::access::Uses;
use crate::declarations::Declarations;
use crate::entry::Entry;
use crate::error::{Error, Problem};
use crate::fault;
use crate::glossary::Glossary;
use crate::names::{Names, mentions};
use crate::print::{self, Shared};
use crate::program::Program;
use crate::routine::{self, Routines};
use crate::shader::{Dispatch, Options, Shader};
use crate::space;
use std::fmt::Write as _;
use xca_core::Parity;
use xca_core::ir::{self, FunctionKind};

/// Writes a process as WGSL.
///
/// # Errors
/// Where something in the process, or in a helper that it calls, cannot be written in WGSL; the error names
/// it.
pub fn shader(process: &ir::Function, options: &Options) -> Result<Shader, Error> {
    let program = Program::collect(process)?;
    write(&program, options)
}

/// Writes the module.
fn write(program: &Program, options: &Options) -> Result<Shader, Error> {
    check(options).map_err(|problem| program.error(0, problem))?;
    let mut uses = Uses::of(program).map_err(|problem| program.error(0, problem))?;
    let mut names = Names::default();
    let glossary = Glossary::of(program, &uses, options, &mut names)?;
    let mut routines = Routines::default();
    for table in &glossary.tables {
        routines.need_infinities(table);
    }
    let mut functions = Vec::new();
    // Callees before callers, for the reader.
    for number in (0..program.functions.len()).rev() {
        let mut shared =
            Shared { program, options, glossary: &glossary, names: &mut names, routines: &mut routines };
        let text = print::function(&mut shared, number).map_err(|problem| program.error(number, problem))?;
        functions.push(text);
    }
    let kind = program.process().kind;
    uses.faults |= routines.checked_neighbours || routines.checks;
    let tables = uses.neighbourhood || uses.directions;
    uses.index |= uses.faults || (tables && options.parity != Parity::None);
    let over_cells = kind == FunctionKind::Cells;
    let entry = Entry { kind, uses: &uses, glossary: &glossary, options };
    let mut body = Vec::new();
    body.extend(glossary.declarations.iter().cloned());
    body.extend(provided(&uses, &routines, &glossary, options, over_cells));
    let entry_text = entry.text();
    let reading = format!("{}{entry_text}", functions.concat());
    body.extend(glossary.buffers.iter().flat_map(|buffer| buffer.readers(&reading)));
    if entry.notes_changes() {
        glossary.buffers.iter().filter(|buffer| buffer.used.write).for_each(|buffer| {
            routines.need_difference(buffer.value_type.scalar, options.precision);
        });
    }
    body.extend(routines.texts().cloned());
    if uses.faults {
        body.push(fault::record(kind));
    }
    if mentions(&reading, "report_fault") {
        body.push(fault::REPORT.to_owned());
    }
    if uses.random {
        let owner = if over_cells { "linear_index(here_index)" } else { "item_labels[this_item]" };
        body.push(routine::random(owner, options.precision));
    }
    body.extend(functions.iter().map(|text| fault::with_exits(text, routines.checks)));
    body.push(entry_text);
    let body = body.join("\n");
    let declarations = Declarations::of(program, &uses, &glossary, options, &body, &mut names);
    let mut source = String::new();
    let process = program.process();
    let _ = writeln!(source, "// {}::{}, Real = {}", process.module, process.name, options.precision);
    source.push('\n');
    source.push_str(&declarations.text);
    source.push_str(&body);
    let [x, y, z] = options.workgroup_size;
    Ok(Shader {
        needs_f64: mentions(&source_without_comment(&source), "f64"),
        source,
        entry_point: "main".to_owned(),
        bindings: declarations.bindings,
        dispatch: if over_cells { Dispatch::Cells([x, y, z]) } else { Dispatch::Items(x * y * z) },
        numbering: options.numbering,
    })
}

fn source_without_comment(source: &str) -> String {
    source.lines().filter(|line| !line.starts_with("//")).collect::<Vec<_>>().join("\n")
}

fn check(options: &Options) -> Result<(), Problem> {
    let [x, y, z] = options.workgroup_size;
    let size = x.checked_mul(y).and_then(|area| area.checked_mul(z));
    if !matches!(size, Some(1..)) {
        return Err(Problem::Options(format!("a workgroup of {x} × {y} × {z} invocations is not possible")));
    }
    if options.neighbourhood_size == Some(0) {
        return Err(Problem::Options("a neighbourhood has at least the central cell".to_owned()));
    }
    Ok(())
}

/// The functions that stand for what an engine provides.
fn provided(
    uses: &Uses,
    routines: &Routines,
    glossary: &Glossary,
    options: &Options,
    over_cells: bool,
) -> Vec<String> {
    let mut texts = Vec::new();
    if over_cells {
        texts.push(space::STORAGE_INDEX.to_owned());
    } else if uses.index {
        texts.push(space::CELL_INDEX.to_owned());
    }
    if uses.faults || (uses.random && over_cells) || routines.cell_containing {
        texts.push(space::LINEAR_INDEX.to_owned());
    }
    if uses.neighbourhood {
        texts.push(space::neighbour_at(options.parity, &glossary.neighbours));
    }
    if uses.directions {
        texts.push(space::neighbour_direction(options.parity, &glossary.neighbours));
    }
    if routines.neighbour_exists {
        texts.push(space::neighbour_exists(&options.boundaries));
    }
    if routines.checked_neighbours {
        texts.push(space::valid_neighbour(&glossary.neighbours));
    }
    if routines.nearest_image {
        texts.push(space::nearest_image(&options.boundaries, options.precision));
    }
    if routines.wrapped {
        texts.push(space::wrapped(&options.boundaries));
    }
    if routines.cell_containing {
        texts.push(space::cell_containing());
    }
    texts
}
