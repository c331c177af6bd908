//! A function of the accepted Rust subset, checked, with the tokens that its messages and its native copy
//! need.
//!
//! One front end (`parse`) makes it; the native kernel (`native`) and the data of the body (`data`) are made
//! from it. The shape is that of `xca_core::ir`.

use proc_macro2::{Span, TokenStream};
use syn::{AngleBracketedGenericArguments, Expr, Ident, Lifetime, Lit, LitFloat, LitInt, Path, Type};

/// The whole function.
pub(crate) struct Function {
    pub(crate) name: Ident,
    pub(crate) visibility: syn::Visibility,
    pub(crate) attributes: Vec<syn::Attribute>,
    pub(crate) kind: FunctionKind,
    /// `const N: usize` and its kin.
    pub(crate) constants: Vec<syn::ConstParam>,
    pub(crate) arguments: Vec<Argument>,
    /// The type of the result as written; `None` for processes.
    pub(crate) result: Option<Type>,
    pub(crate) body: Block,
    pub(crate) mentions: Mentions,
}

/// What of the user's other code a body mentions.
#[derive(Default)]
pub(crate) struct Mentions {
    pub(crate) calls: Vec<Call>,
    pub(crate) constants: Vec<Path>,
    /// The arrays `[value; length]`, each with what it takes.
    pub(crate) arrays: Vec<ArraySize>,
    /// Constants in patterns.
    pub(crate) patterns: Vec<Path>,
    /// The structs of substates and of parameters.
    pub(crate) substates: Vec<Type>,
    pub(crate) parameters: Vec<Type>,
    /// Names that may be references in Rust, and are values here.
    pub(crate) references: Vec<Ident>,
    /// The types of variables, casts, arguments and results.
    pub(crate) types: Vec<Type>,
}

/// An array in a body.
pub(crate) struct ArraySize {
    /// An expression of type `usize`.
    pub(crate) bytes: TokenStream,
    pub(crate) span: Span,
}

/// A helper that is called.
pub(crate) struct Call {
    /// The path that the user wrote, without constants.
    pub(crate) function: Path,
    /// The name by which it is imported.
    pub(crate) import: Ident,
    /// The name by which the generated code calls it: a type that is unknown to the compiler where the check
    /// of the calling function finds an error.
    pub(crate) alias: Ident,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum FunctionKind {
    Cells,
    Items,
    Migration,
    Helper,
}

pub(crate) struct Argument {
    pub(crate) name: Ident,
    pub(crate) role: Role,
}

/// The number of a struct of substates among those that a process takes; 0 is that of the cell or item that
/// it runs for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct ArgumentNumber(pub(crate) usize);

impl ArgumentNumber {
    /// That of the cell or item that the process runs for.
    pub(crate) const SUBJECT: Self = Self(0);
}

/// The structs are written so that they are unknown to the compiler where the check of the function finds an
/// error; the plain types stand in [`Mentions`].
pub(crate) enum Role {
    /// `Cell<S>`: the substates type.
    Cell(Type),
    Slot(Type),
    Slots(Type),
    /// `&P`: the parameters type.
    Parameters(Type),
    Space,
    /// A value, of helpers, with its type as written.
    Value(Type),
}

pub(crate) struct Block {
    pub(crate) statements: Vec<Statement>,
    pub(crate) value: Option<Box<Expression>>,
}

#[expect(clippy::large_enum_variant, reason = "trees are small and short-lived")]
pub(crate) enum Statement {
    Let {
        name: Ident,
        mutable: bool,
        type_: Option<Type>,
        value: Expression,
    },
    /// `let (a, mut b) = value;`
    LetTuple {
        parts: Vec<TuplePart>,
        type_: Option<Type>,
        value: Expression,
    },
    LetNeighbour {
        name: Ident,
        index: Expression,
    },
    Assign {
        place: Place,
        operator: Option<syn::BinOp>,
        value: Expression,
        span: Span,
    },
    Expression(Expression),
    Loop(Loop),
    Break(Option<Lifetime>, Span),
    Continue(Option<Lifetime>, Span),
    Return(Option<Expression>, Span),
    Fault {
        code: Expression,
        value: Expression,
    },
}

/// A variable that takes a part of a tuple; no name where it is `_`.
pub(crate) struct TuplePart {
    pub(crate) name: Option<Ident>,
    pub(crate) mutable: bool,
}

/// A loop of any kind.
pub(crate) struct Loop {
    pub(crate) label: Option<Lifetime>,
    pub(crate) kind: LoopKind,
    pub(crate) body: Block,
}

#[expect(clippy::large_enum_variant, reason = "trees are small and short-lived")]
pub(crate) enum LoopKind {
    While(Expression),
    Forever,
    Range { variable: Ident, range: Range },
    Elements { variable: Ident, array: Expression },
    Others { variable: Ident, reach: Reach, radius: Option<Expression> },
    Items { variable: Ident },
}

/// `from..to` or `from..=to`, perhaps with `.rev()`, then with `.step_by(step)`.
pub(crate) struct Range {
    pub(crate) from: Expression,
    pub(crate) to: Expression,
    pub(crate) inclusive: bool,
    pub(crate) reversed: bool,
    pub(crate) step: Option<Expression>,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Reach {
    Cell,
    Neighbours,
    All,
}

pub(crate) struct Place {
    pub(crate) root: PlaceRoot,
    pub(crate) path: Vec<Projection>,
}

#[derive(PartialEq)]
pub(crate) enum PlaceRoot {
    Local(Ident),
    Own(Ident),
}

#[expect(clippy::large_enum_variant, reason = "trees are small and short-lived")]
pub(crate) enum Projection {
    /// `x`, `y`, `z` or `w`.
    Component(Ident),
    Element(Expression),
}

pub(crate) enum Expression {
    Bool(syn::LitBool),
    Integer(LitInt),
    Float(LitFloat),
    Local(Ident),
    Constant(Path),
    Own(Ident),
    /// A substate that another struct of the cell has: of the cell that the process runs for, or that its
    /// item stands in.
    OfCell {
        argument: ArgumentNumber,
        field: Ident,
    },
    Neighbour {
        argument: ArgumentNumber,
        index: Box<Expression>,
        field: Ident,
    },
    NamedNeighbour {
        argument: ArgumentNumber,
        name: Ident,
        field: Ident,
    },
    Other {
        argument: ArgumentNumber,
        name: Ident,
        field: Ident,
    },
    OtherLabel(Ident),
    Parameter {
        /// The name of the argument.
        argument: Ident,
        field: Ident,
    },
    /// An argument of parameters as a whole, passed to a helper.
    Parameters(Ident),
    /// The space argument as a whole, passed to a helper.
    Space(Span),
    Builtin(Builtin, Vec<Expression>, Span),
    Unary(syn::UnOp, Box<Expression>),
    Binary(syn::BinOp, Box<Expression>, Box<Expression>),
    Cast(Box<Expression>, Type),
    /// The function is the alias of one of [`Mentions::calls`].
    Call {
        function: Path,
        /// `::<N>`
        constants: Option<AngleBracketedGenericArguments>,
        arguments: Vec<Expression>,
    },
    /// With the name as it stands in the source.
    Method {
        method: &'static xca_methods::Method,
        name: Ident,
        receiver: Box<Expression>,
        arguments: Vec<Expression>,
    },
    Component(Box<Expression>, Ident),
    Element(Box<Expression>, Box<Expression>),
    Array(Vec<Expression>, Span),
    Tuple(Vec<Expression>, Span),
    /// The length is made of integer literals and constants.
    Repeat(Box<Expression>, Box<Expr>),
    /// `Vector3::new(a, b, c)`: the path's type segment (`Vector3`) and the components.
    Vector(Ident, Vec<Expression>),
    /// `Vector3::splat(a)`: the path's type segment and the value.
    Splat(Ident, Box<Expression>),
    If {
        condition: Box<Expression>,
        then: Block,
        otherwise: Option<Block>,
        span: Span,
    },
    Match {
        value: Box<Expression>,
        arms: Vec<Arm>,
        span: Span,
    },
    Block(Block),
}

pub(crate) struct Arm {
    pub(crate) patterns: Vec<Pattern>,
    pub(crate) guard: Option<Expression>,
    pub(crate) body: Block,
}

pub(crate) enum Pattern {
    Any(Span),
    /// A literal, negated where the flag is set.
    Literal(Lit, bool),
    Constant(Path),
    /// `a..=b`, each end a literal (negated where the flag is set).
    Range((LitInt, bool), (LitInt, bool)),
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Builtin {
    NeighbourCount,
    Opposite,
    Displacement,
    Exists,
    Index,
    Label,
    Random,
    RandomBits,
    Side,
    Extents,
    Step,
    NearestImage,
    Wrapped,
    CellContaining,
    Stay,
    Outside,
}
