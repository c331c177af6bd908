//! States: enums without fields as values of substates and parameters.

use crate::host_value::{HostScalar, HostValue};
use xca_values::{StateNames, StoredScalar};

/// An enum whose values are the states of a cell, an item or a parameter. Derive it.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(States, Clone, Copy, Debug, PartialEq)]
/// enum Tissue {
///     Resting,
///     Excited,
///     Refractory,
/// }
///
/// #[derive(Substates, Clone, Copy)]
/// struct Heart {
///     tissue: Tissue,
/// }
///
/// #[elementary_process]
/// fn beat(cell: &mut Cell<Heart>) {
///     cell.tissue = match cell.tissue {
///         Tissue::Resting => {
///             let mut next = Tissue::Resting;
///             for n in 1..cell.neighbour_count() {
///                 if cell.neighbour(n).tissue == Tissue::Excited {
///                     next = Tissue::Excited;
///                 }
///             }
///             next
///         }
///         Tissue::Excited => Tissue::Refractory,
///         Tissue::Refractory => Tissue::Resting,
///     };
/// }
///
/// assert_eq!(Tissue::NAMES.states, ["Resting", "Excited", "Refractory"]);
/// ```
///
/// A state takes one byte. The first state is the default of cells and of flat boundaries. Parameters and
/// tables name a state as the source does.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no type of a substate or parameter",
    label = "neither a number, bool, vector or array, nor an enum of states",
    note = "an enum without fields becomes one by `#[derive(States, Clone, Copy, PartialEq)]`"
)]
pub trait States: Copy + PartialEq + Send + Sync + 'static {
    /// The names, in the order of the source.
    const NAMES: &'static StateNames;

    /// The number of the state, from 0 in the order of the source.
    fn number(self) -> u8;

    /// The state with this number, or the first state if there is none.
    fn from_number(number: u8) -> Self;
}

impl<T: States> HostScalar for T {
    fn encode(self, _stored: StoredScalar, out: &mut [u8]) {
        out.copy_from_slice(&[self.number()]);
    }

    fn decode(_stored: StoredScalar, bytes: &[u8]) -> Self {
        T::from_number(bytes.first().copied().unwrap_or_default())
    }

    fn to_number(self) -> f64 {
        self.number().into()
    }

    fn from_number(number: f64) -> Self {
        T::from_number(number as u8)
    }
}

impl<T: States> HostValue for T {
    type Scalar = T;
    const COMPONENTS: usize = 1;

    fn component(&self, _index: usize) -> T {
        *self
    }

    fn from_components(component: &mut dyn FnMut(usize) -> T) -> Self {
        component(0)
    }
}
