//! What a process uses: substates, and what the engine provides.

use crate::error::Problem;
use crate::program::{Program, Roles, field_number};
use crate::visit::{self, Node};
use xca_core::Schema;
use xca_core::ir::{Builtin, Expression, Function, FunctionKind, LoopKind, PlaceRoot, Reach, Statement};

/// How a process uses one substate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Use {
    /// The number of the struct among those of substates that the process takes.
    pub(crate) argument: usize,
    pub(crate) field: usize,
    /// Read as a whole or written at the centre: it is loaded before the process and lies in a variable
    /// meanwhile.
    pub(crate) centre: bool,
    /// Elements of it are read at the centre.
    pub(crate) elements: bool,
    /// Read at neighbours or of other items, as it was before the process.
    pub(crate) others: bool,
    pub(crate) write: bool,
}

impl Use {
    /// Whether results go to a second buffer: where others still read what was before.
    pub(crate) fn doubled(&self) -> bool {
        self.others && self.write
    }
}

/// Everything that a process uses.
#[derive(Debug, Default)]
pub(crate) struct Uses {
    pub(crate) substates: Vec<Use>,
    /// The structs of parameters.
    pub(crate) parameters: Vec<&'static Schema>,
    pub(crate) neighbourhood: bool,
    /// The displacements of the neighbours and their opposites.
    pub(crate) directions: bool,
    /// The ranges of items in cells.
    pub(crate) ranges: bool,
    pub(crate) labels: bool,
    pub(crate) index: bool,
    pub(crate) random: bool,
    pub(crate) faults: bool,
    pub(crate) searches: bool,
}

impl Uses {
    pub(crate) fn of(program: &Program) -> Result<Self, Problem> {
        let mut uses = Self::default();
        for function in &program.functions {
            uses.add(function)?;
        }
        uses.substates.sort_by_key(|used| (used.argument, used.field));
        Ok(uses)
    }

    fn add(&mut self, function: &Function) -> Result<(), Problem> {
        let roles = Roles::of(function);
        let kind = function.kind;
        let mut problem = None;
        visit::block(&function.body, &mut |node| self.see(node, &roles, kind, &mut problem));
        problem.map_or(Ok(()), Err)
    }

    /// Whether what is inside the node has to be looked at too.
    fn see(
        &mut self,
        node: Node<'_>,
        roles: &Roles<'_>,
        kind: FunctionKind,
        problem: &mut Option<Problem>,
    ) -> bool {
        let mut inside = true;
        let result = match node {
            Node::Statement(statement) => self.statement(statement, roles, kind),
            Node::Expression(Expression::Element(array, index)) => {
                let owner = match &**array {
                    Expression::Own(name) => Some((0, *name)),
                    Expression::OfCell { argument, field } => Some((*argument, *field)),
                    _ => None,
                };
                match owner {
                    Some((argument, name)) => {
                        // The index alone: the array need not be loaded as a whole.
                        inside = false;
                        visit::expression(index, &mut |node| self.see(node, roles, kind, problem));
                        self.entry(argument, roles, name).map(|used| used.elements = true)
                    }
                    None => Ok(()),
                }
            }
            Node::Expression(expression) => self.expression(expression, roles, kind),
        };
        if let Err(first) = result {
            problem.get_or_insert(first);
        }
        inside
    }

    fn statement(
        &mut self,
        statement: &Statement,
        roles: &Roles<'_>,
        kind: FunctionKind,
    ) -> Result<(), Problem> {
        match statement {
            Statement::LetNeighbour { .. } => self.neighbourhood = true,
            Statement::Assign { place, .. } => {
                if let PlaceRoot::Own(name) = &place.root {
                    if !matches!(kind, FunctionKind::Cells | FunctionKind::Items) {
                        return Err(Problem::unsupported(
                            format!("an assignment to `{name}`"),
                            "only processes write",
                        ));
                    }
                    let used = self.entry(0, roles, name)?;
                    used.centre = true;
                    used.write = true;
                }
            }
            Statement::Loop(loop_) => self.loop_(&loop_.kind, roles, kind)?,
            Statement::Fault { .. } => self.faults = true,
            _ => {}
        }
        Ok(())
    }

    fn loop_(&mut self, loop_: &LoopKind, roles: &Roles<'_>, kind: FunctionKind) -> Result<(), Problem> {
        match loop_ {
            LoopKind::Others { reach, radius, .. } => {
                if kind != FunctionKind::Items {
                    let reason = "it belongs in a process over items";
                    return Err(Problem::unsupported("a search for other items", reason));
                }
                self.ranges = true;
                self.neighbourhood |= *reach != Reach::Cell;
                if radius.is_some() {
                    self.searches = true;
                    // The radius may be too large.
                    self.faults = true;
                    let name = position(roles)?;
                    self.entry(0, roles, name)?.others = true;
                }
            }
            LoopKind::Items { .. } => self.ranges = true,
            _ => {}
        }
        Ok(())
    }

    fn expression(
        &mut self,
        value: &Expression,
        roles: &Roles<'_>,
        kind: FunctionKind,
    ) -> Result<(), Problem> {
        match value {
            Expression::Own(name) => self.entry(0, roles, name)?.centre = true,
            Expression::OfCell { argument, field } => self.entry(*argument, roles, field)?.centre = true,
            Expression::Neighbour { argument, field, .. } => {
                self.neighbourhood = true;
                self.entry(*argument, roles, field)?.others = true;
            }
            Expression::NamedNeighbour { argument, field, .. }
            | Expression::Other { argument, field, .. } => {
                self.entry(*argument, roles, field)?.others = true;
            }
            Expression::OtherLabel(_) | Expression::Builtin(Builtin::Label, _) => self.labels = true,
            Expression::Parameter { argument, .. } => {
                let schema = roles.parameters(argument)?;
                if !self.parameters.contains(&schema) {
                    self.parameters.push(schema);
                }
            }
            Expression::Builtin(Builtin::Random | Builtin::RandomBits, _) => {
                self.random = true;
                match kind {
                    FunctionKind::Cells => self.index = true,
                    _ => self.labels = true,
                }
            }
            Expression::Builtin(Builtin::Index, _) => self.index = true,
            Expression::Builtin(Builtin::Opposite | Builtin::Displacement, _) => self.directions = true,
            Expression::Builtin(Builtin::Exists, _) => {
                self.directions = true;
                self.index = true;
            }
            _ => {}
        }
        Ok(())
    }

    fn entry(&mut self, argument: usize, roles: &Roles<'_>, name: &str) -> Result<&mut Use, Problem> {
        let field = roles
            .substates
            .get(argument)
            .and_then(|named| field_number(named.schema, name))
            .ok_or_else(|| Problem::unknown("substate", name))?;
        let known = self.substates.iter().position(|used| used.argument == argument && used.field == field);
        let index = known.unwrap_or_else(|| {
            self.substates.push(Use {
                argument,
                field,
                centre: false,
                elements: false,
                others: false,
                write: false,
            });
            self.substates.len() - 1
        });
        Ok(&mut self.substates[index])
    }
}

/// The name of the substate by which searches measure distances.
pub(crate) fn position(roles: &Roles<'_>) -> Result<&'static str, Problem> {
    roles
        .substates
        .first()
        .and_then(|named| named.schema.position.and_then(|field| named.schema.fields.get(field)))
        .map(|field| field.name)
        .ok_or_else(|| {
            Problem::unsupported("a search within a radius", "no substate is marked `#[position]`")
        })
}
