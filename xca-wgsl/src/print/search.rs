//! Loops over items.

use super::frame::Frame;
use super::writer::Writer;
use crate::access;
use crate::error::Problem;
use crate::visit;
use xca_core::ir::{Expression, Loop, Reach, Statement};
use xca_core::kernel::WRONG_RADIUS;
use xca_core::{Boundary, Face};

impl Writer<'_, '_> {
    pub(super) fn for_items(
        &mut self,
        statement: &Statement,
        variable: &str,
        loop_: &Loop,
    ) -> Result<(), Problem> {
        let end = self.shared.names.local("end");
        self.line(&format!("let {end}: u32 = item_ends[here];"));
        self.shared.names.open();
        let item = self.item(statement, variable)?;
        self.line(&format!("for (var {item}: u32 = item_starts[here]; {item} < {end}; {item} += 1u) {{"));
        self.loop_body(Frame::new(loop_, None), loop_)?;
        self.line("}");
        self.shared.names.close();
        Ok(())
    }

    pub(super) fn for_others(
        &mut self,
        statement: &Statement,
        variable: &str,
        reach: Reach,
        radius: Option<&Expression>,
        loop_: &Loop,
    ) -> Result<(), Problem> {
        // What stands before the loop stays visible after it: only the variable of the loop has a scope of
        // its own.
        let near = radius.map(|radius| self.near(reach, radius)).transpose()?;
        if reach == Reach::Cell {
            return self.items_of("here", statement, variable, near.as_ref(), None, loop_);
        }
        let ended = visit::ends_early(loop_).then(|| self.shared.names.local("ended"));
        if let Some(ended) = &ended {
            self.line(&format!("var {ended}: bool = false;"));
        }
        self.shared.names.open();
        let neighbour = self.shared.names.local("neighbour");
        let first = if reach == Reach::All { 0 } else { 1 };
        let count = self.shared.glossary.neighbours.clone();
        self.line(&format!(
            "for (var {neighbour}: u32 = {first}u; {neighbour} < {count}; {neighbour} += 1u) {{"
        ));
        self.inside(|writer| {
            let there = writer.shared.names.local("there");
            writer.line(&format!("let {there}: u32 = neighbour_at({neighbour});"));
            writer.items_of(&there, statement, variable, near.as_ref(), ended.clone(), loop_)?;
            if let Some(ended) = &ended {
                writer.line(&format!("if {ended} {{"));
                writer.line("    break;");
                writer.line("}");
            }
            Ok(())
        })?;
        self.line("}");
        self.shared.names.close();
        Ok(())
    }

    /// What a search measures with: the position before the process, and the square of the radius.
    fn near(&mut self, reach: Reach, radius: &Expression) -> Result<Near, Problem> {
        let field = access::position(&self.roles)?;
        let text = self.expression(radius)?;
        let radius = self.shared.names.local("radius");
        self.line(&format!("let {radius}: Real = {};", text.plain()));
        // Written so that NaN is refused too.
        let covered = if reach == Reach::Cell { "" } else { &format!(" && {radius} <= space.covered") };
        self.line(&format!("if !({radius} >= Real(){covered}) {{"));
        self.line(&format!("    report_fault({WRONG_RADIUS:#x}u, {radius});"));
        self.line("}");
        let limit = self.shared.names.local("limit");
        self.line(&format!("let {limit}: Real = {radius} * {radius};"));
        let position = self.value_of(0, field, "this_item")?;
        let centre = self.shared.names.local("centre");
        self.line(&format!("let {centre}: vec3<Real> = {};", position.plain()));
        let dot = self.shared.routines.need_dot(&crate::types::Type::Vector(xca_core::ScalarType::Real, 3));
        let boundaries = &self.shared.options.boundaries;
        let toroidal = Face::ALL.iter().any(|face| boundaries[*face] == Boundary::Toroidal);
        self.shared.routines.nearest_image |= toroidal;
        Ok(Near { field, centre, limit, dot, toroidal })
    }

    fn items_of(
        &mut self,
        cell: &str,
        statement: &Statement,
        variable: &str,
        near: Option<&Near>,
        ended: Option<String>,
        loop_: &Loop,
    ) -> Result<(), Problem> {
        let end = self.shared.names.local("end");
        self.line(&format!("let {end}: u32 = item_ends[{cell}];"));
        self.shared.names.open();
        let item = self.item(statement, variable)?;
        self.line(&format!("for (var {item}: u32 = item_starts[{cell}]; {item} < {end}; {item} += 1u) {{"));
        self.inside(|writer| {
            writer.line(&format!("if {item} == this_item {{"));
            writer.line("    continue;");
            writer.line("}");
            if let Some(near) = near {
                let position = writer.value_of(0, near.field, &item)?;
                let difference = format!("{} - {}", near.centre, position.plain());
                let separation = writer.shared.names.local("separation");
                let image = if near.toroidal { format!("nearest_image({difference})") } else { difference };
                writer.line(&format!("let {separation}: vec3<Real> = {image};"));
                writer.line(&format!("if !({}({separation}, {separation}) < {}) {{", near.dot, near.limit));
                writer.line("    continue;");
                writer.line("}");
            }
            writer.indent -= 1;
            let result = writer.loop_body(Frame::new(loop_, ended), loop_);
            writer.indent += 1;
            result
        })?;
        self.line("}");
        self.shared.names.close();
        Ok(())
    }

    fn item(&mut self, statement: &Statement, variable: &str) -> Result<String, Problem> {
        let item = self.shared.names.local(variable);
        self.locals.insert(self.analysis.bound(statement)?, item.clone());
        Ok(item)
    }
}

struct Near {
    field: &'static str,
    centre: String,
    limit: String,
    dot: String,
    toroidal: bool,
}
