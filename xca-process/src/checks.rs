//! Types in the code of the macros, by which one mistake in a process gives one message.
//!
//! From a process the macros write a copy, which is checked against the types of [`crate::Cell`], and kernels
//! for each precision. The copy stands in a constant. All types of the kernels go through [`Checked`] of that
//! constant. If the copy has an error, the constant has no value. The compiler then does not know these
//! types, and reports nothing about them.

use crate::ir::Function;

/// The most bytes of all arrays in a process or helper. The limit protects the memory of threads and GPUs.
pub const MOST_BYTES: usize = 65_536;

/// Ends the compilation with a message if arrays take more than [`MOST_BYTES`].
///
/// # Panics
/// During constant evaluation, if there are too many bytes.
pub const fn arrays_fit(bytes: usize) {
    if bytes <= MOST_BYTES {
        return;
    }
    // Constants cannot format numbers.
    let mut text = [0_u8; 160];
    let mut length = append(&mut text, 0, b"the arrays of this function take ");
    let mut unit = 1;
    while bytes / unit >= 10 {
        unit *= 10;
    }
    while unit > 0 {
        text[length] = b'0' + (bytes / unit % 10) as u8;
        length += 1;
        unit /= 10;
    }
    let more =
        b" bytes, at 8 a number; there are 65536 for them: make them shorter, or keep values in substates";
    length = append(&mut text, length, more);
    match std::str::from_utf8(text.split_at(length).0) {
        Ok(text) => panic!("{}", text),
        Err(_) => panic!("the arrays take too many bytes"),
    }
}

const fn append(text: &mut [u8; 160], start: usize, more: &[u8]) -> usize {
    let mut place = 0;
    while place < more.len() {
        text[start + place] = more[place];
        place += 1;
    }
    start + more.len()
}

/// The name of a process with constant generics, including their values: `update<0>`.
pub fn name_of<T>(name: &'static str) -> &'static str {
    let path = std::any::type_name::<T>();
    // The values of constants contain no `::`, so the last `::` precedes the name.
    path.rsplit("::").next().filter(|last| last.starts_with(name)).unwrap_or(name)
}

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

/// A function that a process can call, and its result.
#[diagnostic::on_unimplemented(
    message = "a process calls functions that are marked `#[helper]` only",
    label = "this function is not marked",
    note = "write `#[helper]` above the function; ordinary code can call it as before",
    note = "numbers have methods of their own: `a.max(b)` instead of a function `max(a, b)`"
)]
pub trait Callable<T: Itself> {
    /// Returns the result. The expected type tells nothing about `T`.
    fn result(result: T) -> T::Type {
        result.itself()
    }
}

/// Any type.
pub trait Itself: Sized {
    /// The same type.
    type Type;

    /// The same value.
    fn itself(self) -> Self::Type;
}

impl<T> Itself for T {
    type Type = T;

    fn itself(self) -> T {
        self
    }
}

/// A function without `#[helper]`.
#[derive(Debug, Clone, Copy)]
pub struct PlainFunction;

impl PlainFunction {
    /// As helpers have it.
    pub const SHADERS_KNOW_NO_RECURSION_WRITE_A_LOOP: () = ();

    /// Never called.
    pub fn body() -> Function {
        unreachable!("a process that calls an unmarked function does not compile")
    }
}

/// A result type that no function has.
#[derive(Debug, Clone, Copy)]
pub struct NoResult<const NUMBER: u8>;

// With two candidates, the compiler waits for the type of the result. If that type is unknown, another
// message explains it, and none comes from here.
#[diagnostic::do_not_recommend]
impl Callable<NoResult<0>> for PlainFunction {}
#[diagnostic::do_not_recommend]
impl Callable<NoResult<1>> for PlainFunction {}

/// A type whose constants can be patterns.
#[diagnostic::on_unimplemented(
    message = "a constant of type `{Self}` cannot be a pattern in a process",
    label = "this constant is neither an integer nor a bool nor a state",
    note = "compare floats and vectors with `if`"
)]
pub trait PatternConstant {
    /// Does nothing.
    fn pattern(&self) {}
}

macro_rules! pattern_constants {
    ($($type:ident)*) => {$(
        #[diagnostic::do_not_recommend]
        impl PatternConstant for $type {}
    )*};
}

pattern_constants!(bool u8 i32 u32 usize);

#[diagnostic::do_not_recommend]
impl<T: crate::states::States> PatternConstant for T {}

/// A struct of substates with a position.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no position, by which a search within a radius finds items",
    label = "this search needs positions",
    note = "write `#[position]` above the field of `{Self}` that is the position, a `Vector3<Real>`"
)]
pub trait HasPosition {}
