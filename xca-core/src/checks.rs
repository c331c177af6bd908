//! What the code of the macros leans on so that one mistake in a process gives one message.
//!
//! From a process the macros write a copy that is checked against the words of [`crate::Cell`] and its kin, and kernels for each
//! precision. The copy stands in a constant. All types of the kernels go through [`Checked`] of that constant: where the copy has an error the
//! constant has no value, so that these types are unknown to the compiler, and it is silent about them.

use crate::ir::Function;

/// The result of the check of a process or helper.
#[derive(Debug, Clone, Copy)]
pub struct Checked<const PASSED: bool>;

/// `T`, if the check has passed.
pub trait Then<T> {
    /// `T`.
    type Type;

    /// The value itself.
    fn pass(value: T) -> Self::Type;
}

impl<T> Then<T> for Checked<true> {
    type Type = T;

    #[inline(always)]
    fn pass(value: T) -> T {
        value
    }
}

/// A function that a process can call.
#[diagnostic::on_unimplemented(
    message = "a process calls functions that are marked `#[helper]` only",
    label = "this function is not marked",
    note = "write `#[helper]` above the function; ordinary code can call it as before",
    note = "numbers have methods of their own: `a.max(b)` instead of a function `max(a, b)`"
)]
pub trait Callable {}

/// Stands for a function that is not marked.
#[derive(Debug, Clone, Copy)]
pub struct PlainFunction;

impl PlainFunction {
    /// The body, which there is not.
    pub fn body() -> Function {
        unreachable!("a process that calls an unmarked function does not compile")
    }
}

/// Checks that a process can call the function.
pub const fn callable<F: Callable>() {}

/// A type whose constants can stand in a pattern.
#[diagnostic::on_unimplemented(
    message = "a constant of type `{Self}` cannot be a pattern in a process",
    label = "this constant is neither an integer nor a bool",
    note = "compare floats and vectors with `if`"
)]
pub trait PatternConstant {}

impl PatternConstant for bool {}
impl PatternConstant for u8 {}
impl PatternConstant for i32 {}
impl PatternConstant for u32 {}
impl PatternConstant for usize {}

/// Checks that a constant can stand in a pattern.
pub const fn pattern<T: PatternConstant>(_constant: &T) {}

/// A struct of substates with a position.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no position, by which a search within a radius finds items",
    label = "this search needs positions",
    note = "write `#[position]` above the field of `{Self}` that is the position, a `Vector3<Real>`"
)]
pub trait HasPosition {}

/// Checks that items have a position.
pub const fn position<S: HasPosition>() {}
