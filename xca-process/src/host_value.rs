//! Values of substates and parameters on the host.

use xca_values::{StoredScalar, StoredType, Vector2, Vector3, Vector4};

/// A scalar on the host, where `Real` is `f64`.
pub trait HostScalar: Copy + PartialEq + Send + Sync + 'static {
    /// Writes the value as the stored type. `f64` may be stored as `f32`.
    fn encode(self, stored: StoredScalar, out: &mut [u8]);

    /// Reads the value back.
    fn decode(stored: StoredScalar, bytes: &[u8]) -> Self;

    /// The value as a number, without loss. `bool` gives 0 or 1, a state its number.
    fn to_number(self) -> f64;

    /// The value of a number that fits the type.
    fn from_number(number: f64) -> Self;
}

macro_rules! host_scalar {
    ($type:ident, $stored:pat) => {
        impl HostScalar for $type {
            fn encode(self, stored: StoredScalar, out: &mut [u8]) {
                debug_assert!(matches!(stored, $stored));
                out.copy_from_slice(&self.to_ne_bytes());
            }

            fn decode(stored: StoredScalar, bytes: &[u8]) -> Self {
                debug_assert!(matches!(stored, $stored));
                bytemuck::pod_read_unaligned(bytes)
            }

            fn to_number(self) -> f64 {
                self.into()
            }

            fn from_number(number: f64) -> Self {
                number as $type
            }
        }
    };
}

host_scalar!(u8, StoredScalar::U8);
host_scalar!(i32, StoredScalar::I32);
host_scalar!(u32, StoredScalar::U32);
host_scalar!(f32, StoredScalar::F32);

impl HostScalar for f64 {
    fn encode(self, stored: StoredScalar, out: &mut [u8]) {
        match stored {
            StoredScalar::F32 => out.copy_from_slice(&(self as f32).to_ne_bytes()),
            _ => out.copy_from_slice(&self.to_ne_bytes()),
        }
    }

    fn decode(stored: StoredScalar, bytes: &[u8]) -> Self {
        match stored {
            StoredScalar::F32 => bytemuck::pod_read_unaligned::<f32>(bytes).into(),
            _ => bytemuck::pod_read_unaligned(bytes),
        }
    }

    fn to_number(self) -> f64 {
        self
    }

    fn from_number(number: f64) -> Self {
        number
    }
}

impl HostScalar for bool {
    fn encode(self, _stored: StoredScalar, out: &mut [u8]) {
        out.copy_from_slice(&[u8::from(self)]);
    }

    fn decode(_stored: StoredScalar, bytes: &[u8]) -> Self {
        bytes != [0]
    }

    fn to_number(self) -> f64 {
        self.into()
    }

    fn from_number(number: f64) -> Self {
        number != 0.0
    }
}

/// A value of a substate or parameter on the host.
pub trait HostValue: Copy + PartialEq + Send + Sync + 'static {
    /// The type of its components.
    type Scalar: HostScalar;

    /// The number of components: the lanes of a vector, the elements of an array, or the lanes of all
    /// elements of an array of vectors.
    const COMPONENTS: usize;

    /// One component.
    fn component(&self, index: usize) -> Self::Scalar;

    /// The value with these components, which are requested in order.
    fn from_components(component: &mut dyn FnMut(usize) -> Self::Scalar) -> Self;

    /// Writes the value as the stored type.
    fn encode(&self, stored: StoredType, out: &mut [u8]) {
        let size = stored.scalar.size();
        for (index, bytes) in out.chunks_exact_mut(size).enumerate() {
            self.component(index).encode(stored.scalar, bytes);
        }
    }

    /// Reads the value back.
    fn decode(stored: StoredType, bytes: &[u8]) -> Self {
        let size = stored.scalar.size();
        Self::from_components(&mut |index| {
            Self::Scalar::decode(stored.scalar, &bytes[index * size..(index + 1) * size])
        })
    }
}

macro_rules! scalar_host_value {
    ($($type:ident)*) => {$(
        impl HostValue for $type {
            type Scalar = $type;
            const COMPONENTS: usize = 1;

            fn component(&self, _index: usize) -> $type {
                *self
            }

            fn from_components(component: &mut dyn FnMut(usize) -> $type) -> Self {
                component(0)
            }
        }
    )*};
}

scalar_host_value!(bool u8 i32 u32 f32 f64);

impl<T: HostValue, const N: usize> HostValue for [T; N] {
    type Scalar = T::Scalar;
    const COMPONENTS: usize = N * T::COMPONENTS;

    fn component(&self, index: usize) -> T::Scalar {
        self[index / T::COMPONENTS].component(index % T::COMPONENTS)
    }

    fn from_components(component: &mut dyn FnMut(usize) -> T::Scalar) -> Self {
        std::array::from_fn(|element| {
            T::from_components(&mut |lane| component(element * T::COMPONENTS + lane))
        })
    }
}

macro_rules! vector_host_value {
    ($name:ident, $lanes:literal, $first:ident $(, $lane:ident)+) => {
        impl<T: HostScalar> HostValue for $name<T> {
            type Scalar = T;
            const COMPONENTS: usize = $lanes;

            fn component(&self, index: usize) -> T {
                [self.$first $(, self.$lane)+][index]
            }

            fn from_components(component: &mut dyn FnMut(usize) -> T) -> Self {
                let mut next = 0..;
                let mut take = || component(next.next().unwrap_or_default());
                Self { $first: take() $(, $lane: take())+ }
            }
        }
    };
}

vector_host_value!(Vector2, 2, x, y);
vector_host_value!(Vector3, 3, x, y, z);
vector_host_value!(Vector4, 4, x, y, z, w);

#[cfg(test)]
mod tests {
    use super::HostValue;
    use xca_values::{StoredScalar, StoredType, Vector2};

    #[test]
    fn arrays_of_vectors_are_stored_element_by_element() {
        let stored = StoredType { scalar: StoredScalar::F32, lanes: 2, length: 3 };
        let value = [Vector2::new(1.0_f64, 2.0), Vector2::new(3.0, 4.0), Vector2::new(5.0, 6.0)];
        let mut bytes = vec![0; stored.size()];
        value.encode(stored, &mut bytes);
        let expected: Vec<u8> = (1..7_u8).flat_map(|number| f32::from(number).to_ne_bytes()).collect();
        assert_eq!(bytes, expected);
        assert_eq!(<[Vector2<f64>; 3]>::decode(stored, &bytes), value);
    }
}
