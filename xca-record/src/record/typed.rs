//! Numbers of a file that keeps no types, as the model stores them.

use super::values::Plane;
use xca_checkpoint::components::state_names;
use xca_core::{Field, Precision, StoredScalar};
use xca_io::vtk::{NumberType, ReadArray};

/// A number that a substate cannot be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NoValue {
    /// Of which cell or item.
    pub(crate) index: usize,
    pub(crate) number: f64,
}

/// The array of a substate that has these numbers, all components of a value together.
pub(crate) fn typed(field: &Field, precision: Precision, numbers: &[f64]) -> Result<ReadArray, NoValue> {
    let (scalar, components) = (field.value_type.stored(precision).scalar, field.value_type.components());
    let states = state_names(field.value_type.scalar);
    let mut bytes = Vec::with_capacity(numbers.len() * size(scalar));
    for (place, number) in numbers.iter().copied().enumerate() {
        let no_value = || NoValue { index: place / components, number };
        let is_state = states.is_empty() || number < states.len() as f64;
        if !is_state || !append(scalar, number, &mut bytes) {
            return Err(no_value());
        }
    }
    let component_names = Vec::new();
    let numbers = number_type(scalar);
    Ok(ReadArray { name: field.name.to_owned(), numbers, components, component_names, states, bytes })
}

/// The array as the model stores this substate.
pub(crate) fn retyped(field: &Field, precision: Precision, array: ReadArray) -> Result<ReadArray, NoValue> {
    let states = state_names(field.value_type.scalar);
    let plane = Plane::of_array(&array);
    let mut numbers: Vec<f64> = (0..plane.count()).flat_map(|index| plane.value(index)).collect();
    if states.is_empty()
        && let (false, Some(number)) = (array.states.is_empty(), numbers.first().copied())
    {
        return Err(NoValue { index: 0, number });
    }
    if !array.states.is_empty() && array.states != states {
        // By their names. One that is no state of the substate is none of its numbers either.
        let number =
            |name: &String| states.iter().position(|state| state == name).map_or(-1.0, |at| at as f64);
        let by_name: Vec<f64> = array.states.iter().map(number).collect();
        numbers.iter_mut().for_each(|own| *own = by_name.get(*own as usize).copied().unwrap_or(-1.0));
    }
    typed(field, precision, &numbers)
}

fn size(scalar: StoredScalar) -> usize {
    match scalar {
        StoredScalar::U8 => 1,
        StoredScalar::I32 | StoredScalar::U32 | StoredScalar::F32 => 4,
        StoredScalar::F64 => 8,
    }
}

fn number_type(scalar: StoredScalar) -> NumberType {
    match scalar {
        StoredScalar::U8 => NumberType::U8,
        StoredScalar::I32 => NumberType::I32,
        StoredScalar::U32 => NumberType::U32,
        StoredScalar::F32 => NumberType::F32,
        StoredScalar::F64 => NumberType::F64,
    }
}

/// Appends a number as it is stored; false if it cannot be. Floats are rounded to the nearest one.
fn append(scalar: StoredScalar, number: f64, bytes: &mut Vec<u8>) -> bool {
    let is_within = |low: f64, high: f64| number.fract() == 0.0 && (low..=high).contains(&number);
    match scalar {
        StoredScalar::F64 => bytes.extend(number.to_ne_bytes()),
        StoredScalar::F32 => bytes.extend((number as f32).to_ne_bytes()),
        StoredScalar::U8 if is_within(0.0, u8::MAX.into()) => bytes.push(number as u8),
        StoredScalar::U32 if is_within(0.0, u32::MAX.into()) => bytes.extend((number as u32).to_ne_bytes()),
        StoredScalar::I32 if is_within(i32::MIN.into(), i32::MAX.into()) => {
            bytes.extend((number as i32).to_ne_bytes());
        }
        _ => return false,
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use xca_core::prelude::*;

    #[derive(States, Clone, Copy, PartialEq)]
    enum Ground {
        Rock,
        Soil,
        Water,
    }

    #[derive(Substates, Clone)]
    struct Land {
        ground: Ground,
        wet: bool,
        age: u32,
        slope: i32,
        depth: Real,
        small: f32,
    }

    fn field(name: &str) -> &'static Field {
        Land::SCHEMA.fields.iter().find(|field| field.name == name).unwrap()
    }

    #[test]
    fn numbers_have_the_types_of_the_model() {
        let bytes = |name, precision, numbers: &[f64]| typed(field(name), precision, numbers).unwrap().bytes;
        assert_eq!(bytes("ground", Precision::F64, &[2.0, 0.0]), [2, 0]);
        assert_eq!(bytes("age", Precision::F64, &[4e9]), 4_000_000_000_u32.to_ne_bytes());
        assert_eq!(bytes("slope", Precision::F64, &[-2.0]), (-2_i32).to_ne_bytes());
        assert_eq!(bytes("depth", Precision::F64, &[0.1]), 0.1_f64.to_ne_bytes());
        // The digits of an f32, which are those of another f64.
        assert_eq!(bytes("depth", Precision::F32, &[0.1]), 0.1_f32.to_ne_bytes());
        assert_eq!(bytes("small", Precision::F64, &[0.1]), 0.1_f32.to_ne_bytes());
        for (name, number) in [
            ("ground", 3.0),
            ("ground", 0.5),
            ("ground", f64::NAN),
            ("wet", 2.0),
            ("age", -1.0),
            ("age", 4_294_967_296.0),
            ("slope", 2_147_483_648.0),
        ] {
            let refused = typed(field(name), Precision::F64, &[0.0, 0.0, number]).unwrap_err();
            assert_eq!(refused.index, 2, "{name} {number}");
        }
    }

    #[test]
    fn states_are_those_of_their_names() {
        let array = |states: &[&str], bytes: &[u8]| ReadArray {
            name: "ground".to_owned(),
            numbers: NumberType::U8,
            components: 1,
            component_names: Vec::new(),
            states: states.iter().map(|state| (*state).to_owned()).collect(),
            bytes: bytes.to_vec(),
        };
        let retyped =
            |states: &[&str], bytes: &[u8]| retyped(field("ground"), Precision::F64, array(states, bytes));
        let found = retyped(&["Soil", "Water"], &[1, 0, 1]).unwrap();
        assert_eq!(
            (found.bytes, found.states),
            (vec![2, 1, 2], state_names(field("ground").value_type.scalar))
        );
        assert_eq!(retyped(&["Soil", "Sand"], &[0, 1]).unwrap_err().index, 1);
        assert_eq!(retyped(&[], &[0]).unwrap().bytes, [0]);
        let named = ReadArray { name: "depth".to_owned(), ..array(&["Soil"], &[0]) };
        assert!(super::retyped(field("depth"), Precision::F64, named).is_err());
    }
}
