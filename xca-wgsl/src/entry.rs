//! The entry point: which cell or item an invocation works on, loading, storing, faults.

use crate::access::Uses;
use crate::glossary::Glossary;
use crate::names;
use crate::shader::{ACTIVITY_HEAD, Numbering, Options};
use std::fmt::Write as _;
use xca_core::ir::FunctionKind;

/// What the entry point is written for.
pub(crate) struct Entry<'a> {
    pub(crate) kind: FunctionKind,
    pub(crate) uses: &'a Uses,
    pub(crate) glossary: &'a Glossary,
    pub(crate) options: &'a Options,
}

impl Entry<'_> {
    pub(crate) fn text(&self) -> String {
        let [x, y, z] = self.options.workgroup_size;
        let (size, guard) = match self.kind {
            FunctionKind::Cells => (format!("{x}, {y}, {z}"), "all(id < space.count)".to_owned()),
            _ => ((x * y * z).to_string(), "item < moment.items".to_owned()),
        };
        let cells = self.kind == FunctionKind::Cells;
        let numbered = cells && self.options.numbering != Numbering::Axes;
        let mut arguments = if numbered {
            vec!["@builtin(local_invocation_id) place: vec3<u32>"]
        } else {
            vec!["@builtin(global_invocation_id) id: vec3<u32>"]
        };
        if !cells || numbered || self.uses.faults {
            arguments.push("@builtin(num_workgroups) workgroups: vec3<u32>");
        }
        if numbered || self.uses.faults {
            arguments.push("@builtin(workgroup_id) workgroup_id: vec3<u32>");
        }
        if self.uses.faults {
            arguments.push("@builtin(local_invocation_index) local: u32");
        }
        let mut out = String::new();
        let over = if self.kind == FunctionKind::Cells { "cell" } else { "item" };
        let _ = writeln!(out, "{}", self.one(over));
        let _ = writeln!(out, "@compute @workgroup_size({size})");
        let _ = writeln!(out, "fn main(\n    {},\n) {{", arguments.join(",\n    "));
        if !cells {
            let _ = writeln!(out, "    let item: u32 = id.x + id.y * workgroups.x * {size}u;");
        }
        if numbered {
            out.push_str(&cells_of_number([x, y, z], self.notes_changes()));
        }
        let argument = if self.kind == FunctionKind::Cells { "space.first + id" } else { "item" };
        if self.uses.faults {
            out.push_str(&self.with_faults(&guard, over, argument));
        } else {
            let _ = writeln!(out, "    if {guard} {{\n        process_{over}({argument});\n    }}");
        }
        out.push_str("}\n");
        out
    }

    /// Whether workgroups look up their tiles, and note in which something changes.
    pub(crate) fn notes_changes(&self) -> bool {
        self.kind == FunctionKind::Cells && self.options.numbering == Numbering::List
    }

    /// Whether the process has to know the cell of its item.
    fn knows_cell(&self) -> bool {
        let of_cell = self.uses.substates.iter().any(|used| used.argument > 0);
        of_cell || self.uses.neighbourhood || self.uses.ranges || self.uses.index
    }

    /// The process for one cell or item: load, run, store.
    fn one(&self, over: &str) -> String {
        let mut out = String::new();
        let argument = if self.kind == FunctionKind::Cells { "id: vec3<u32>" } else { "item: u32" };
        let _ = writeln!(out, "fn process_{over}({argument}) {{");
        if self.kind == FunctionKind::Cells {
            out.push_str("    here = storage_index(id);\n");
            if self.uses.index {
                out.push_str("    here_index = vec3<i32>(id);\n");
            }
        } else {
            out.push_str("    this_item = item;\n");
            if self.knows_cell() {
                out.push_str("    here = item_cells[item];\n");
            }
            if self.uses.index {
                out.push_str("    here_index = cell_index(here);\n");
            }
        }
        let number = if self.kind == FunctionKind::Cells { "here" } else { "item" };
        for buffer in self.glossary.buffers.iter().filter(|buffer| buffer.used.centre) {
            let argument = buffer.used.argument;
            let number = if argument == 0 { number } else { "here" };
            if let Ok(variable) = self.glossary.central(argument) {
                let field = names::field(buffer.field);
                let _ = writeln!(out, "    {variable}.{field} = {};", buffer.read(number));
            }
        }
        for table in &self.glossary.tables {
            let _ = writeln!(out, "    {table}");
        }
        let name = self.glossary.functions.first().map_or("", String::as_str);
        if self.kind == FunctionKind::Migration {
            let _ = writeln!(out, "    destinations[item] = {name}();");
        } else {
            let _ = writeln!(out, "    {name}();");
        }
        if let Ok(variable) = self.glossary.central(0) {
            let written = self.glossary.buffers.iter().filter(|buffer| buffer.used.write);
            for (place, buffer) in written.enumerate() {
                let value = format!("{variable}.{}", names::field(buffer.field));
                if !self.notes_changes() {
                    out.push_str(&buffer.store(number, &value, None));
                    continue;
                }
                let changed = format!("changed_{place}");
                let _ = writeln!(out, "    var {changed}: bool = false;");
                out.push_str(&buffer.store(number, &value, Some(&changed)));
                let row = place + 2;
                let _ = writeln!(out, "    if {changed} {{");
                let at = format!("activity[{ACTIVITY_HEAD}u + {row}u * tiles + tile]");
                let _ = writeln!(out, "        atomicStore(&{at}, run_number);\n    }}");
            }
        }
        out.push_str("}\n");
        out
    }

    /// Of the faults in a workgroup the first is recorded; of all workgroups the first cell or item is
    /// remembered. So the result does not depend on the order in which invocations run.
    fn with_faults(&self, guard: &str, over: &str, argument: &str) -> String {
        let record = if self.notes_changes() {
            "tile"
        } else {
            "(workgroup_id.z * workgroups.y + workgroup_id.y) * workgroups.x + workgroup_id.x"
        };
        let order = if self.kind == FunctionKind::Cells { "linear_index(here_index)" } else { "this_item" };
        format!(
            "    if local == 0u {{
        atomicStore(&first_fault, 0xffffffffu);
    }}
    workgroupBarrier();
    if faults.stopped == 0u && {guard} {{
        process_{over}({argument});
    }}
    if has_fault {{
        atomicMin(&first_fault, {order});
    }}
    workgroupBarrier();
    if has_fault && atomicLoad(&first_fault) == {order} {{
        let number: u32 = {record};
        faults.records[number] = recorded_fault;
        atomicMin(&faults.first, {order});
    }}
"
        )
    }
}

/// The indices of an invocation's cell, from the number of its workgroup, or from the tile that it looks up.
fn cells_of_number([x, y, z]: [u32; 3], is_listed: bool) -> String {
    let [x_more, y_more, z_more] = [x - 1, y - 1, z - 1];
    let (look_up, number) = if is_listed { (LOOK_UP, "tile") } else { ("", "workgroup") };
    format!(
        "    let workgroup: u32 = workgroup_id.x + workgroup_id.y * workgroups.x;
    let size = vec3<u32>({x}u, {y}u, {z}u);
    let along: vec3<u32> = (space.count + vec3<u32>({x_more}u, {y_more}u, {z_more}u)) / size;
{look_up}    let row: u32 = {number} / along.x;
    let id: vec3<u32> = vec3<u32>({number} % along.x, row % along.y, row / along.y) * size + place;
"
    )
}

/// Beyond the end of the list there is no tile.
const LOOK_UP: &str = "    tiles = along.x * along.y * along.z;
    tile = tiles;
    if workgroup < atomicLoad(&activity[1]) {
        tile = atomicLoad(&activity[64u + workgroup]);
    }
    run_number = atomicLoad(&activity[0]);
";
