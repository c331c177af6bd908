//! Bytes of the structs that processes read.

use crate::space::{Section, Space};
use xca_core::{AnyParameters, Precision, StoredScalar, Stream};
use xca_wgsl::Layout;

/// Fills a struct, field by field, each with the bytes of its elements one after the other.
fn filled(layout: &Layout, value: impl Fn(&str) -> Vec<u8>) -> Vec<u8> {
    let mut bytes = vec![0; layout.size as usize];
    for field in &layout.fields {
        let value = value(&field.name);
        let elements = field.value_type.length.unwrap_or(1) as usize;
        let element = value.len() / elements;
        for (number, value) in value.chunks_exact(element.max(1)).enumerate() {
            let start = field.offset as usize + number * field.stride as usize;
            bytes[start..start + element].copy_from_slice(value);
        }
    }
    bytes
}

fn words(numbers: &[u32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_ne_bytes()).collect()
}

fn real(value: f64, precision: Precision) -> Vec<u8> {
    match precision {
        Precision::F32 => (value as f32).to_ne_bytes().to_vec(),
        Precision::F64 => value.to_ne_bytes().to_vec(),
    }
}

/// What a process knows of the space.
pub(crate) fn space(
    layout: &Layout,
    space: &Space,
    section: &Section,
    (seed, stream): (u64, Stream),
    precision: Precision,
) -> Vec<u8> {
    let narrow = |values: [usize; 3]| words(&values.map(|value| value as u32));
    let geometry = space.geometry();
    filled(layout, |name| match name {
        "extents" => narrow(geometry.extents()),
        "neighbours" => words(&[geometry.neighbourhood().size() as u32]),
        "halo" => narrow(space.reach()),
        "row" => words(&[space.row() as u32]),
        "layer" => words(&[space.layer() as u32]),
        "first" => narrow(section.first),
        "count" => narrow(section.count),
        "base" => words(&[space.shift().wrapping_add(section.base as u32)]),
        "seed" => words(&[seed as u32, (seed >> 32) as u32]),
        "stream" => words(&[stream.number().into()]),
        "side" => real(geometry.side(), precision),
        "covered" => real(geometry.covered_radius(precision), precision),
        // The zero that drivers cannot see; and whatever else there may be, is one.
        _ => Vec::new(),
    })
}

/// The parameters of a model.
pub(crate) fn parameters(layout: &Layout, parameters: &dyn AnyParameters, precision: Precision) -> Vec<u8> {
    filled(layout, |name| {
        let Some((index, field)) = parameters.schema().field(name) else { return Vec::new() };
        let scalar = field.value_type.stored(precision).scalar;
        let value = parameters.value_of(index);
        value.components().iter().flat_map(|component| component_bytes(*component, scalar)).collect()
    })
}

/// A component, which fits its type, as the device stores it.
fn component_bytes(component: f64, scalar: StoredScalar) -> Vec<u8> {
    match scalar {
        StoredScalar::U8 | StoredScalar::U32 => (component as u32).to_ne_bytes().to_vec(),
        StoredScalar::I32 => (component as i32).to_ne_bytes().to_vec(),
        StoredScalar::F32 => (component as f32).to_ne_bytes().to_vec(),
        StoredScalar::F64 => component.to_ne_bytes().to_vec(),
    }
}
