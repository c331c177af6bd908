//! Stored bytes as numbers.

use xca_checkpoint::components::DrawnPart;
use xca_core::{StoredScalar, StoredType};
use xca_io::vtk::{NumberType, ReadArray, Values};

/// The type of the numbers of an array. How its components belong together only the model knows.
pub(super) fn stored_of(array: &ReadArray) -> StoredType {
    let scalar = match array.numbers {
        NumberType::U8 => StoredScalar::U8,
        NumberType::I32 => StoredScalar::I32,
        NumberType::U32 => StoredScalar::U32,
        NumberType::F32 => StoredScalar::F32,
        NumberType::F64 => StoredScalar::F64,
    };
    StoredType { scalar, lanes: 1, length: u32::try_from(array.components).unwrap_or(u32::MAX) }
}

/// The type of stored numbers in a file.
pub(super) fn number_type(scalar: StoredScalar) -> NumberType {
    match scalar {
        StoredScalar::U8 => NumberType::U8,
        StoredScalar::I32 => NumberType::I32,
        StoredScalar::U32 => NumberType::U32,
        StoredScalar::F32 => NumberType::F32,
        StoredScalar::F64 => NumberType::F64,
    }
}

/// Makes stored values NaN, or 0 if they are whole numbers, where the mask is true.
pub(super) fn hide(values: &mut [u8], stored: StoredType, missing: &[bool]) {
    let nothing = match stored.scalar {
        StoredScalar::F32 => f32::NAN.to_ne_bytes().to_vec(),
        StoredScalar::F64 => f64::NAN.to_ne_bytes().to_vec(),
        StoredScalar::U8 | StoredScalar::I32 | StoredScalar::U32 => vec![0; stored.scalar.size()],
    };
    let values = values.chunks_exact_mut(stored.size()).zip(missing);
    for (value, _) in values.filter(|(_, is_missing)| **is_missing) {
        value.chunks_exact_mut(nothing.len()).for_each(|number| number.copy_from_slice(&nothing));
    }
}

/// The values of a substate of cells or items.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    numbers: Numbers,
    components: usize,
}

#[derive(Debug, Clone, PartialEq)]
enum Numbers {
    U8(Vec<u8>),
    I32(Vec<i32>),
    U32(Vec<u32>),
    F32(Vec<f32>),
    F64(Vec<f64>),
}

fn decoded<T, const N: usize>(chosen: &[&[u8]], from: impl Fn([u8; N]) -> T) -> Vec<T> {
    let chunks = chosen.iter().flat_map(|bytes| bytes.as_chunks::<N>().0);
    chunks.map(|bytes| from(*bytes)).collect()
}

impl Plane {
    /// All values of an array that was read back.
    pub fn of_array(array: &ReadArray) -> Self {
        Self::all(stored_of(array), &array.bytes)
    }

    /// All values.
    pub fn all(stored: StoredType, bytes: &[u8]) -> Self {
        Self::decode(stored, &[bytes])
    }

    /// The values with these numbers, in this order.
    pub fn chosen(stored: StoredType, bytes: &[u8], which: &[usize]) -> Self {
        let size = stored.size();
        let chosen: Vec<&[u8]> =
            which.iter().map(|&index| &bytes[index * size..(index + 1) * size]).collect();
        Self::decode(stored, &chosen)
    }

    fn decode(stored: StoredType, bytes: &[&[u8]]) -> Self {
        let numbers = match stored.scalar {
            StoredScalar::U8 => Numbers::U8(bytes.concat()),
            StoredScalar::I32 => Numbers::I32(decoded(bytes, i32::from_ne_bytes)),
            StoredScalar::U32 => Numbers::U32(decoded(bytes, u32::from_ne_bytes)),
            StoredScalar::F32 => Numbers::F32(decoded(bytes, f32::from_ne_bytes)),
            StoredScalar::F64 => Numbers::F64(decoded(bytes, f64::from_ne_bytes)),
        };
        Self { numbers, components: stored.components() }
    }

    /// Points.
    pub fn points(points: Vec<[f64; 3]>) -> Self {
        Self { numbers: Numbers::F64(points.into_flattened()), components: 3 }
    }

    /// Points that are moved so far along x and y: as they are where that is nowhere.
    pub(crate) fn shifted(self, [x, y]: [f64; 2]) -> Self {
        if [x, y] == [0.0; 2] {
            return self;
        }
        Self::points(
            self.to_points().into_iter().map(|point| [point[0] + x, point[1] + y, point[2]]).collect(),
        )
    }

    /// For a VTK file.
    pub fn as_values(&self) -> Values<'_> {
        let values = match &self.numbers {
            Numbers::U8(numbers) => Values::from(numbers.as_slice()),
            Numbers::I32(numbers) => Values::from(numbers.as_slice()),
            Numbers::U32(numbers) => Values::from(numbers.as_slice()),
            Numbers::F32(numbers) => Values::from(numbers.as_slice()),
            Numbers::F64(numbers) => Values::from(numbers.as_slice()),
        };
        Values::interleaved(self.components, values)
    }

    fn number(&self, place: usize) -> f64 {
        match &self.numbers {
            Numbers::U8(numbers) => numbers[place].into(),
            Numbers::I32(numbers) => numbers[place].into(),
            Numbers::U32(numbers) => numbers[place].into(),
            Numbers::F32(numbers) => numbers[place].into(),
            Numbers::F64(numbers) => numbers[place],
        }
    }

    fn places(&self) -> usize {
        match &self.numbers {
            Numbers::U8(numbers) => numbers.len(),
            Numbers::I32(numbers) => numbers.len(),
            Numbers::U32(numbers) => numbers.len(),
            Numbers::F32(numbers) => numbers.len(),
            Numbers::F64(numbers) => numbers.len(),
        }
    }

    /// How many values there are.
    pub fn count(&self) -> usize {
        self.places() / self.components
    }

    /// How many numbers a value has.
    pub fn components(&self) -> usize {
        self.components
    }

    /// Whether the numbers are floating.
    pub fn is_float(&self) -> bool {
        matches!(self.numbers, Numbers::F32(_) | Numbers::F64(_))
    }

    /// One component of each value; each of these types fits into `f64`.
    pub fn component(&self, component: usize) -> Vec<f64> {
        (0..self.count()).map(|index| self.number(index * self.components + component)).collect()
    }

    /// All components of the value with this number.
    pub fn value(&self, index: usize) -> Vec<f64> {
        (0..self.components).map(|component| self.number(index * self.components + component)).collect()
    }

    /// Each value as the one number that is drawn of it.
    pub fn drawn(&self, part: DrawnPart) -> Vec<f64> {
        let number = |index: usize, component: usize| self.number(index * self.components + component);
        let sum = |index: usize, lanes: usize, lane: usize| {
            (lane..self.components).step_by(lanes).map(|component| number(index, component)).sum::<f64>()
        };
        match part {
            DrawnPart::Component(component) => self.component(component),
            DrawnPart::Sum => (0..self.count()).map(|index| sum(index, 1, 0)).collect(),
            DrawnPart::Length { lanes } => {
                let length = |index| {
                    let lanes = (0..lanes).map(|lane| sum(index, lanes, lane));
                    lanes.map(|lane| lane * lane).sum::<f64>().sqrt()
                };
                (0..self.count()).map(length).collect()
            }
        }
    }

    /// Floating numbers as a simulation stores them, as many components of each value as are stored.
    pub(super) fn stored_as(&self, stored: StoredType) -> Vec<u8> {
        let mut bytes = Vec::new();
        for index in 0..self.count() {
            for number in self.value(index).into_iter().take(stored.components()) {
                match stored.scalar {
                    StoredScalar::F32 => bytes.extend((number as f32).to_ne_bytes()),
                    _ => bytes.extend(number.to_ne_bytes()),
                }
            }
        }
        bytes
    }

    /// Values of three components as points.
    pub fn to_points(&self) -> Vec<[f64; 3]> {
        (0..self.count())
            .map(|index| std::array::from_fn(|lane| self.number(index * self.components + lane)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VECTOR: StoredType = StoredType { scalar: StoredScalar::F32, lanes: 2, length: 1 };

    #[test]
    fn bytes_become_numbers() {
        let bytes: Vec<u8> =
            [3.0_f32, -4.0, 0.5, 0.0, 1.0, 1.0].iter().flat_map(|x| x.to_ne_bytes()).collect();
        let plane = Plane::all(VECTOR, &bytes);
        assert_eq!((plane.count(), plane.is_float()), (3, true));
        assert_eq!(plane.component(1), [-4.0, 0.0, 1.0]);
        assert_eq!(plane.drawn(DrawnPart::Length { lanes: 2 })[..2], [5.0, 0.5]);
        assert_eq!(plane.drawn(DrawnPart::Sum), [-1.0, 0.5, 2.0]);
        let chosen = Plane::chosen(VECTOR, &bytes, &[2, 0]);
        assert_eq!(chosen.component(0), [1.0, 3.0]);
        assert_eq!((chosen.as_values().len(), chosen.as_values().components()), (2, 2));
    }

    #[test]
    fn whole_numbers_stay_what_they_are() {
        let stored = StoredType { scalar: StoredScalar::U8, lanes: 1, length: 1 };
        let plane = Plane::chosen(stored, &[7, 8, 9], &[1, 2]);
        assert!(!plane.is_float());
        assert_eq!(plane.drawn(DrawnPart::Component(0)), [8.0, 9.0]);
        assert!(Plane::all(stored, &[]).component(0).is_empty());
    }

    #[test]
    fn cells_without_ground_lose_their_values() {
        let mut bytes: Vec<u8> = [3.0_f32, -4.0, 0.5, 0.0].iter().flat_map(|x| x.to_ne_bytes()).collect();
        hide(&mut bytes, VECTOR, &[true, false]);
        let plane = Plane::all(VECTOR, &bytes);
        assert!(plane.value(0).iter().all(|number| number.is_nan()));
        assert_eq!(plane.value(1), [0.5, 0.0]);
        let stored = StoredType { scalar: StoredScalar::U8, lanes: 1, length: 1 };
        let mut bytes = [7, 8];
        hide(&mut bytes, stored, &[false, true]);
        assert_eq!(bytes, [7, 0]);
        let points = Plane::points(vec![[1.0, 2.0, 3.0]]).shifted([10.0, -2.0]);
        assert_eq!(points.to_points(), [[11.0, 0.0, 3.0]]);
    }

    #[test]
    fn an_array_of_vectors_is_as_long_as_their_sum() {
        let stored = StoredType { scalar: StoredScalar::I32, lanes: 2, length: 3 };
        let bytes: Vec<u8> = [1, 5, 1, -2, 1, 1].iter().flat_map(|x: &i32| x.to_ne_bytes()).collect();
        let plane = Plane::all(stored, &bytes);
        assert_eq!(plane.drawn(DrawnPart::Length { lanes: 2 }), [5.0]);
        assert_eq!(plane.drawn(DrawnPart::Component(3)), [-2.0]);
    }
}
