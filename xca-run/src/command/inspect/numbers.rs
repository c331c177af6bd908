//! Stored values as numbers, without a copy of them: a file may be as large as the memory.

use xca_core::{StoredScalar, StoredType};
use xca_io::vtk::{NumberType, ReadArray};

/// The values of a substate of cells or items, as they are stored.
#[derive(Debug, Clone, Copy)]
pub(super) struct Numbers<'a> {
    scalar: StoredScalar,
    components: usize,
    bytes: &'a [u8],
}

impl<'a> Numbers<'a> {
    /// Values of a checkpoint.
    pub(super) fn new(stored: StoredType, bytes: &'a [u8]) -> Self {
        Self { scalar: stored.scalar, components: stored.components(), bytes }
    }

    /// Values of a frame.
    pub(super) fn of_array(array: &'a ReadArray) -> Self {
        let scalar = match array.numbers {
            NumberType::U8 => StoredScalar::U8,
            NumberType::I32 => StoredScalar::I32,
            NumberType::U32 => StoredScalar::U32,
            NumberType::F32 => StoredScalar::F32,
            NumberType::F64 => StoredScalar::F64,
        };
        Self { scalar, components: array.components, bytes: &array.bytes }
    }

    /// How many numbers a value has.
    pub(super) fn components(self) -> usize {
        self.components
    }

    /// One component of each value.
    pub(super) fn component(self, component: usize) -> impl Iterator<Item = f64> + Clone + 'a {
        let places = self.bytes.len() / self.scalar.size();
        (component..places).step_by(self.components.max(1)).filter_map(move |place| self.number(place))
    }

    /// All components of the value with this number.
    pub(super) fn value(self, index: usize) -> Vec<f64> {
        let first = index.saturating_mul(self.components);
        (0..self.components).filter_map(|component| self.number(first.saturating_add(component))).collect()
    }

    /// What the components of a value are where there is none.
    pub(super) fn nothing(self) -> Vec<f64> {
        let is_float = matches!(self.scalar, StoredScalar::F32 | StoredScalar::F64);
        vec![if is_float { f64::NAN } else { 0.0 }; self.components]
    }

    /// Each of the types fits into `f64`.
    fn number(self, place: usize) -> Option<f64> {
        fn at<const SIZE: usize>(bytes: &[u8], place: usize) -> Option<[u8; SIZE]> {
            bytes.as_chunks().0.get(place).copied()
        }
        let Self { scalar, bytes, .. } = self;
        match scalar {
            StoredScalar::U8 => bytes.get(place).map(|number| f64::from(*number)),
            StoredScalar::I32 => at(bytes, place).map(|number| f64::from(i32::from_ne_bytes(number))),
            StoredScalar::U32 => at(bytes, place).map(|number| f64::from(u32::from_ne_bytes(number))),
            StoredScalar::F32 => at(bytes, place).map(|number| f64::from(f32::from_ne_bytes(number))),
            StoredScalar::F64 => at(bytes, place).map(f64::from_ne_bytes),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAIR: StoredType = StoredType { scalar: StoredScalar::F32, lanes: 2, length: 1 };

    #[test]
    fn bytes_are_read_as_what_they_are() {
        let bytes: Vec<u8> = [3.0_f32, -4.0, 0.5, 8.0].iter().flat_map(|x| x.to_ne_bytes()).collect();
        let numbers = Numbers::new(PAIR, &bytes);
        assert_eq!(numbers.component(1).collect::<Vec<_>>(), [-4.0, 8.0]);
        assert_eq!((numbers.value(1), numbers.value(2), numbers.components()), (vec![0.5, 8.0], vec![], 2));
        assert!(numbers.nothing().iter().all(|number| number.is_nan()));
        for (numbers, bytes, wanted) in [
            (NumberType::U8, vec![7, 255], [7.0, 255.0]),
            (NumberType::I32, [-7_i32, i32::MIN].map(i32::to_ne_bytes).concat(), [-7.0, -2_147_483_648.0]),
            (NumberType::U32, [7_u32, u32::MAX].map(u32::to_ne_bytes).concat(), [7.0, 4_294_967_295.0]),
            (NumberType::F64, [0.1, 1e300].map(f64::to_ne_bytes).concat(), [0.1, 1e300]),
        ] {
            let name = "a".to_owned();
            let (components, component_names, states) = (1, Vec::new(), Vec::new());
            let array = ReadArray { name, numbers, components, component_names, states, bytes };
            assert_eq!(Numbers::of_array(&array).component(0).collect::<Vec<_>>(), wanted);
        }
    }
}
