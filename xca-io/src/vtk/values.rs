//! Arrays of values in VTK files.

use std::collections::HashSet;
use std::fmt;
use std::io::{self, Write};
use std::path::Path;

use super::VtkError;
use super::number_type::NumberType;

/// The values of an array: scalars, or vectors stored one after the other.
///
/// Make it from a slice of scalars (`&[f64]`), from a slice of vectors (`&[[f64; 3]]`), or with
/// [`Values::interleaved`].
#[derive(Debug, Clone, Copy)]
pub struct Values<'a> {
    data: Data<'a>,
    components: usize,
}

#[derive(Debug, Clone, Copy)]
enum Data<'a> {
    U8(&'a [u8]),
    I32(&'a [i32]),
    U32(&'a [u32]),
    F32(&'a [f32]),
    F64(&'a [f64]),
    Source(Source<'a>),
}

/// Values that are not in memory as a whole.
#[derive(Debug, Clone, Copy)]
struct Source<'a> {
    values: &'a dyn ValueSource,
    numbers: NumberType,
    /// The number of scalars.
    scalars: usize,
}

/// Values that are made, or read, while they are written.
pub trait ValueSource: fmt::Debug {
    /// Writes all scalars in little-endian order.
    ///
    /// # Errors
    /// The error of `out`, or the reason why there are no values.
    fn write_to(&self, out: &mut dyn Write) -> io::Result<()>;
}

macro_rules! from_slices {
    ($($scalar:ident $variant:ident),*) => {$(
        impl<'a> From<&'a [$scalar]> for Values<'a> {
            fn from(values: &'a [$scalar]) -> Self {
                Self { data: Data::$variant(values), components: 1 }
            }
        }

        impl<'a, const N: usize> From<&'a [[$scalar; N]]> for Values<'a> {
            fn from(values: &'a [[$scalar; N]]) -> Self {
                Self { data: Data::$variant(values.as_flattened()), components: N }
            }
        }
    )*};
}
from_slices!(u8 U8, i32 I32, u32 U32, f32 F32, f64 F64);

impl<'a> Values<'a> {
    /// Vectors of `components` scalars each, one after the other in a flat slice.
    #[must_use]
    pub fn interleaved(components: usize, values: impl Into<Self>) -> Self {
        Self { components, ..values.into() }
    }

    /// `count` vectors of `components` numbers of this type. Their source is asked once the file is written.
    #[must_use]
    pub fn of_source(
        numbers: NumberType,
        components: usize,
        count: usize,
        values: &'a dyn ValueSource,
    ) -> Self {
        let scalars = count.saturating_mul(components);
        Self { data: Data::Source(Source { values, numbers, scalars }), components }
    }

    /// The number of scalars or vectors. An incomplete vector counts as one.
    #[must_use]
    pub fn len(&self) -> usize {
        self.scalars().div_ceil(self.components.max(1))
    }

    /// Whether there are no values.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.scalars() == 0
    }

    /// The number of scalars in a vector. 1 for plain scalars.
    #[must_use]
    pub fn components(&self) -> usize {
        self.components
    }

    fn scalars(&self) -> usize {
        match self.data {
            Data::U8(v) => v.len(),
            Data::I32(v) => v.len(),
            Data::U32(v) => v.len(),
            Data::F32(v) => v.len(),
            Data::F64(v) => v.len(),
            Data::Source(source) => source.scalars,
        }
    }

    /// The type of the scalars.
    #[must_use]
    pub fn numbers(&self) -> NumberType {
        match self.data {
            Data::U8(_) => NumberType::U8,
            Data::I32(_) => NumberType::I32,
            Data::U32(_) => NumberType::U32,
            Data::F32(_) => NumberType::F32,
            Data::F64(_) => NumberType::F64,
            Data::Source(source) => source.numbers,
        }
    }

    /// The name of the scalar type in VTK.
    pub(super) fn vtk_type(&self) -> &'static str {
        self.numbers().vtk_name()
    }

    /// The number of bytes of all scalars.
    pub(super) fn bytes(&self) -> usize {
        self.scalars().saturating_mul(self.numbers().size())
    }

    pub(super) fn is_float(&self) -> bool {
        matches!(self.numbers(), NumberType::F32 | NumberType::F64)
    }

    /// Writes the scalars in little-endian order, as a [`ValueSource`] does.
    ///
    /// # Errors
    /// The error of `out`, or of a source.
    pub fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        match self.data {
            Data::U8(v) => out.write_all(v),
            Data::I32(v) => write_little_endian(out, v, i32::to_le_bytes),
            Data::U32(v) => write_little_endian(out, v, u32::to_le_bytes),
            Data::F32(v) => write_little_endian(out, v, f32::to_le_bytes),
            Data::F64(v) => write_little_endian(out, v, f64::to_le_bytes),
            Data::Source(source) => source.values.write_to(out),
        }
    }

    fn is_whole(&self) -> bool {
        self.components > 0 && self.scalars().is_multiple_of(self.components)
    }
}

fn write_little_endian<T: Copy, const N: usize>(
    out: &mut dyn Write,
    values: &[T],
    bytes: impl Fn(T) -> [u8; N],
) -> io::Result<()> {
    let mut buffer = Vec::with_capacity(8192 * N);
    for chunk in values.chunks(8192) {
        buffer.clear();
        buffer.extend(chunk.iter().flat_map(|&value| bytes(value)));
        out.write_all(&buffer)?;
    }
    Ok(())
}

/// A named array: one scalar or vector for each particle or cell.
#[derive(Debug, Clone, Copy)]
pub struct DataArray<'a> {
    /// The name that ParaView shows, with the unit if there is one: `velocity (m/s)`.
    pub name: &'a str,
    /// The values.
    pub values: Values<'a>,
    /// The names of the components in ParaView. Defaults: X, Y and Z, or numbers.
    pub components: &'a [String],
    /// The names of the states, by value, if the values (`u8`) are states. They become the field data `states
    /// of NAME`.
    pub states: &'a [String],
}

impl<'a> DataArray<'a> {
    /// An array of scalars (such as `&[f64]`) or of vectors (such as `&[[f64; 3]]`).
    #[must_use]
    pub fn new(name: &'a str, values: impl Into<Values<'a>>) -> Self {
        Self { name, values: values.into(), components: &[], states: &[] }
    }

    /// Adds names of the components.
    #[must_use]
    pub fn with_components(self, components: &'a [String]) -> Self {
        Self { components, ..self }
    }

    /// Adds the names of the states that the values stand for.
    #[must_use]
    pub fn with_states(self, states: &'a [String]) -> Self {
        Self { states, ..self }
    }
}

/// Checks that the arrays have different names and `expected` entries each.
pub(super) fn check_arrays(path: &Path, arrays: &[DataArray<'_>], expected: usize) -> Result<(), VtkError> {
    let mut names = HashSet::new();
    for array in arrays {
        let (path, name) = (path.to_owned(), array.name.to_owned());
        if array.values.len() != expected || !array.values.is_whole() {
            let found = array.values.len();
            return Err(VtkError::ArrayLength { path, array: name, expected, found });
        }
        if !names.insert(array.name) {
            return Err(VtkError::RepeatedArray { path, array: name });
        }
    }
    Ok(())
}
