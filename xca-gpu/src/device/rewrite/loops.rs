//! Loops that tell when the device has ended them early.
//!
//! Some devices end loops after so many turns and go on behind them. So each loop gets a variable that says
//! that it is open. Wherever the code leaves the loop the variable becomes 0, and in front of each turn and
//! behind the loop it is looked at. The loop has no other way out, so that behind it the variable is 0,
//! unless the device cut it.
//!
//! A driver's compiler knows that too, and would take the look behind the loop for idle. So the variable
//! begins with a word from memory, and is compared in another way behind the loop than in it. Whether that is
//! enough is tried when the device is opened.

use naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal,
    LocalVariable, MemoryDecorations, Module, ResourceBinding, Scalar, Span, Statement, StorageAccess, Type,
    TypeInner, VectorSize,
};

/// Has all loops watched: the first that the device ends early writes the number, which is not 0, to the
/// first word of the buffer with this binding. The buffer holds [`super::UNTOUCHED`].
pub(super) fn watch(module: &mut Module, binding: u32, number: u32) {
    let mut type_ = |inner| module.types.insert(Type { name: None, inner }, Span::default());
    let word = type_(TypeInner::Scalar(Scalar::U32));
    let words = type_(TypeInner::Vector { size: VectorSize::Bi, scalar: Scalar::U32 });
    let ended = GlobalVariable {
        name: Some("ended_early".to_owned()),
        space: AddressSpace::Storage { access: StorageAccess::LOAD | StorageAccess::STORE },
        binding: Some(ResourceBinding { group: 0, binding }),
        ty: words,
        init: None,
        memory_decorations: MemoryDecorations::empty(),
    };
    let ended = module.global_variables.append(ended, Span::default());
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entries = module.entry_points.iter_mut().map(|entry| &mut entry.function);
    for function in functions.chain(entries) {
        let body = std::mem::take(&mut function.body);
        let body = Watcher { function, word, ended, number }.block(body, None);
        function.body = body;
    }
}

/// Rewrites a function.
struct Watcher<'f> {
    function: &'f mut Function,
    word: Handle<Type>,
    ended: Handle<GlobalVariable>,
    number: u32,
}

/// The pointer to the variable of a loop.
type Open = Handle<Expression>;

impl Watcher<'_> {
    /// A block in a loop with this variable, where a `break` leaves that loop.
    fn block(&mut self, block: Block, open: Option<Open>) -> Block {
        let mut out = Block::new();
        for (statement, span) in block.span_into_iter() {
            match statement {
                Statement::Break => match open {
                    Some(open) => {
                        self.close(&mut out, open);
                        out.push(Statement::Continue, span);
                    }
                    None => out.push(Statement::Break, span),
                },
                Statement::Loop { body, continuing, break_if } => {
                    self.loop_(&mut out, body, continuing, break_if);
                }
                Statement::Block(inner) => out.push(Statement::Block(self.block(inner, open)), span),
                Statement::If { condition, accept, reject } => {
                    self.branch(&mut out, condition, [accept, reject], open);
                }
                Statement::Switch { selector, mut cases } => {
                    // Here `break` leaves the switch.
                    for case in &mut cases {
                        case.body = self.block(std::mem::take(&mut case.body), None);
                    }
                    out.push(Statement::Switch { selector, cases }, span);
                }
                other => out.push(other, span),
            }
        }
        out
    }

    fn branch(
        &mut self,
        out: &mut Block,
        condition: Handle<Expression>,
        [accept, reject]: [Block; 2],
        open: Option<Open>,
    ) {
        let (accept, reject) = (self.block(accept, open), self.block(reject, open));
        out.push(Statement::If { condition, accept, reject }, Span::default());
    }

    fn loop_(
        &mut self,
        out: &mut Block,
        body: Block,
        continuing: Block,
        break_if: Option<Handle<Expression>>,
    ) {
        let variable = LocalVariable { name: Some("open".to_owned()), ty: self.word, init: None };
        let variable = self.function.local_variables.append(variable, Span::default());
        let open = self.expression(Expression::LocalVariable(variable));
        let word = self.note(out, 1);
        let value = self.computed(out, Expression::Load { pointer: word });
        out.push(Statement::Store { pointer: open, value }, Span::default());
        let mut turn = Block::new();
        let left = self.computed(&mut turn, Expression::Load { pointer: open });
        let is_closed = self.compared(&mut turn, BinaryOperator::Equal, left);
        when(&mut turn, is_closed, Block::from_vec(vec![Statement::Break]));
        turn.extend_block(self.block(body, Some(open)));
        let mut continuing = self.block(continuing, None);
        if let Some(condition) = break_if {
            let mut leave = Block::new();
            self.close(&mut leave, open);
            when(&mut continuing, condition, leave);
        }
        out.push(Statement::Loop { body: turn, continuing, break_if: None }, Span::default());
        self.look(out, open);
    }

    /// Behind a loop: notes that it is still open, unless another was noted before.
    fn look(&mut self, out: &mut Block, open: Open) {
        let left = self.computed(out, Expression::Load { pointer: open });
        let word = self.note(out, 1);
        let right = self.computed(out, Expression::Load { pointer: word });
        let both = self.computed(out, Expression::Binary { op: BinaryOperator::And, left, right });
        let is_cut = self.compared(out, BinaryOperator::NotEqual, both);
        let mut look = Block::new();
        let ended = self.note(&mut look, 0);
        let known = self.computed(&mut look, Expression::Load { pointer: ended });
        let is_first = self.compared(&mut look, BinaryOperator::Equal, known);
        let value = self.expression(Expression::Literal(Literal::U32(self.number)));
        when(&mut look, is_first, Block::from_vec(vec![Statement::Store { pointer: ended, value }]));
        when(out, is_cut, look);
    }

    /// A word of the buffer, as a pointer.
    fn note(&mut self, out: &mut Block, index: u32) -> Handle<Expression> {
        let base = self.expression(Expression::GlobalVariable(self.ended));
        self.computed(out, Expression::AccessIndex { base, index })
    }

    /// A comparison with 0.
    fn compared(
        &mut self,
        out: &mut Block,
        op: BinaryOperator,
        left: Handle<Expression>,
    ) -> Handle<Expression> {
        let right = self.expression(Expression::Literal(Literal::U32(0)));
        self.computed(out, Expression::Binary { op, left, right })
    }

    fn close(&mut self, out: &mut Block, pointer: Open) {
        let value = self.expression(Expression::Literal(Literal::U32(0)));
        out.push(Statement::Store { pointer, value }, Span::default());
    }

    /// An expression that stands for itself.
    fn expression(&mut self, expression: Expression) -> Handle<Expression> {
        self.function.expressions.append(expression, Span::default())
    }

    /// An expression that is computed here.
    fn computed(&mut self, out: &mut Block, expression: Expression) -> Handle<Expression> {
        let known = self.function.expressions.len();
        let handle = self.expression(expression);
        out.push(Statement::Emit(self.function.expressions.range_from(known)), Span::default());
        handle
    }
}

/// A branch without another.
fn when(out: &mut Block, condition: Handle<Expression>, accept: Block) {
    out.push(Statement::If { condition, accept, reject: Block::new() }, Span::default());
}
