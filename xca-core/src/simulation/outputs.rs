//! The memory that outputs of a state take.

use crate::model::{GroupKind, Model};
use xca_values::Precision;

/// What pictures take, whatever the state.
const PICTURES: u128 = 32 << 20;

impl Model {
    /// The bytes that outputs of a state take beside the state: two copies of what they hold at once, the
    /// numbers of the largest substate of cells, or of all substates of the largest population, as `f64`, and
    /// pictures. An estimate: observables may take more. `cells` is the number of cells that they hold at
    /// once, and `items` gives the number of items of the group with this number.
    pub fn output_memory(&self, precision: Precision, cells: usize, items: impl Fn(usize) -> usize) -> u128 {
        let cells = cells as u128;
        let (mut copies, mut numbers) = (0, 0);
        for (number, group) in self.groups().iter().enumerate() {
            let stored = group.stored(precision);
            let bytes: usize = stored.iter().map(|field| field.size()).sum();
            let components = stored.iter().map(|field| field.components());
            let (owners, together) = match group.kind() {
                GroupKind::Cells { .. } => (cells, components.max().unwrap_or(0)),
                // With label and place.
                GroupKind::Population { .. } => (items(number) as u128, components.sum::<usize>() + 2),
            };
            copies += owners * bytes as u128;
            numbers = numbers.max(owners * 8 * together as u128);
        }
        2 * copies + numbers + PICTURES
    }
}

#[cfg(test)]
mod tests {
    use super::PICTURES;
    use crate::prelude::*;

    #[derive(Substates, Clone, Copy)]
    #[allow(dead_code, reason = "only its types matter")]
    struct Ground {
        flow: Vector2<Real>,
        kind: u8,
    }

    #[derive(Substates, Clone, Copy)]
    #[allow(dead_code, reason = "only its types matter")]
    struct Grain {
        mass: Real,
        kind: u8,
    }

    #[test]
    fn by_hand() {
        let model = Model::builder("ground").extents([5, 4, 1]).substates::<Ground>().population::<Grain>(9);
        let model = model.populate(|_| [Grain { mass: 1.0, kind: 2 }; 3]).build().unwrap();
        let copies = 20 * (2 * 4 + 1) + 60 * (4 + 1);
        assert_eq!(
            model.output_memory(Precision::F32, 20, |group| 60 * group) - PICTURES,
            2 * copies + 60 * 8 * 4
        );
        assert_eq!(model.output_memory(Precision::F64, 7, |_| 0) - PICTURES, 2 * 7 * 17 + 7 * 8 * 2);
    }
}
