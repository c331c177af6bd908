//! Substates: the state of a cell, or of an item in a slot, decomposed into named values.

use crate::float::Float;
use crate::host_value::HostValue;
use std::marker::PhantomData;
use xca_values::Precision;
use xca_values::Schema;

/// A struct whose fields are substates: the state of one cell or one item. Derive it.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy, Debug, PartialEq)]
/// struct Lava {
///     altitude: Real,
///     thickness: Real,
///     temperature: Real,
///     crust: u8,
/// }
///
/// assert_eq!(Lava::SCHEMA.names(), "altitude, thickness, temperature, crust");
/// assert_eq!(Lava::THICKNESS.name(), "thickness");
/// ```
///
/// Field types: `bool`, `u8`, `i32`, `u32`, `f32`, `f64`, `Real`; `Vector2`, `Vector3`, `Vector4` of a
/// number; enums that derive [`crate::States`]; arrays `[T; N]` of these.
///
/// The derive adds a constant for each field, in capitals: a [`Substate`], by which a `State` names the
/// field. In a struct for items, mark one field of type `Vector3<Real>` as `#[position]`: searches for near
/// items use it. Engines store each field in its own array.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no struct of substates",
    label = "its fields are not substates",
    note = "write `#[derive(Substates, Clone, Copy)]` above the struct `{Self}`"
)]
pub trait Substates: Clone + Send + Sync + 'static {
    /// The fields.
    const SCHEMA: &'static Schema;

    /// Writes the field with this number as its stored type.
    fn encode(&self, field: usize, precision: Precision, out: &mut [u8]);

    /// Reads all fields. The closure returns the bytes of a field by its number.
    fn decode<'a>(precision: Precision, field: impl FnMut(usize) -> &'a [u8]) -> Self;
}

/// The type in kernels and the index of the field whose name has this hash. The derive implements it for the
/// macros.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no substate of this name",
    label = "not a field of `{Self}`",
    note = "the substates are the fields of the struct that derives `Substates`; a search for items within a radius \
            needs a field marked `#[position]`"
)]
pub trait HasSubstate<const NAME: u64> {
    /// The type in a kernel of precision `R`.
    type Native<R: Float>: crate::kernel::KernelValue;
    /// The number of the field.
    const INDEX: usize;
}

/// The handle of a substate: `Lava::THICKNESS`. [`Substates`] derives one for each field.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Lava {
///     thickness: Real,
/// }
///
/// let model = Model::builder("lava").extents([4, 4, 1]).substates::<Lava>().build()?;
/// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// let handle: Substate<Lava, f64> = Lava::THICKNESS;
/// simulation.state().set(handle, [1, 1, 0], 2.5)?;
/// assert_eq!(simulation.state().maximum(handle)?, Some(2.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Substate<S, V> {
    index: usize,
    of: PhantomData<fn() -> (S, V)>,
}

impl<S: Substates, V: HostValue> Substate<S, V> {
    /// The field with this number; for the derive.
    #[doc(hidden)]
    pub const fn from_index(index: usize) -> Self {
        Self { index, of: PhantomData }
    }

    /// The number of the field in the struct.
    pub const fn index(self) -> usize {
        self.index
    }

    /// The name of the field.
    pub fn name(self) -> &'static str {
        S::SCHEMA.fields[self.index].name
    }
}

impl<S, V> Clone for Substate<S, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S, V> Copy for Substate<S, V> {}

impl<S: Substates, V: HostValue> std::fmt::Debug for Substate<S, V> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}::{}", S::SCHEMA.name, self.name())
    }
}
