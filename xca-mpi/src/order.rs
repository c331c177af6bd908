//! What the host says to all other processes of a job. The bytes are the same in all builds.

use xca_core::Precision;
use xca_parts::Grid;

/// What the others are to do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Order {
    /// To start a part of the model.
    Start(Beginning),
    /// To end.
    Stop,
}

/// How a model is started.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Beginning {
    /// The number of the execution, which all its messages have.
    pub(crate) execution: u32,
    pub(crate) precision: Precision,
    pub(crate) grid: Grid,
    /// The threads of each part, where they are chosen.
    pub(crate) threads: Option<usize>,
}

impl Order {
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let Self::Start(beginning) = self else { return Vec::new() };
        let Beginning { execution, precision, grid, threads } = beginning;
        let bits = match precision {
            Precision::F32 => 32,
            Precision::F64 => 64,
        };
        let numbers =
            [u64::from(*execution), bits, grid.y as u64, grid.z as u64, threads.unwrap_or(0) as u64];
        numbers.into_iter().flat_map(u64::to_le_bytes).collect()
    }

    /// Nothing where the bytes are no order.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Option<Self> {
        if bytes.is_empty() {
            return Some(Self::Stop);
        }
        let (numbers, []) = bytes.as_chunks::<8>() else { return None };
        let numbers: Vec<usize> = numbers
            .iter()
            .map(|bytes| usize::try_from(u64::from_le_bytes(*bytes)).ok())
            .collect::<Option<_>>()?;
        let [execution, bits, y, z, threads] = numbers.try_into().ok()?;
        let precision = match bits {
            32 => Precision::F32,
            64 => Precision::F64,
            _ => return None,
        };
        let execution = u32::try_from(execution).ok()?;
        let threads = (threads > 0).then_some(threads);
        Some(Self::Start(Beginning { execution, precision, grid: Grid { y, z }, threads }))
    }
}

#[cfg(test)]
mod tests {
    use super::{Beginning, Order};
    use xca_core::Precision;
    use xca_parts::Grid;

    #[test]
    fn orders_arrive_as_they_were_sent() {
        let grid = Grid { y: 3, z: 5 };
        for (precision, threads) in [(Precision::F32, None), (Precision::F64, Some(7))] {
            let order = Order::Start(Beginning { execution: 9, precision, grid, threads });
            assert_eq!(Order::from_bytes(&order.bytes()), Some(order));
        }
        assert_eq!(Order::from_bytes(&Order::Stop.bytes()), Some(Order::Stop));
        assert_eq!(Order::from_bytes(&[1, 2, 3]), None);
        assert_eq!(Order::from_bytes(&[0; 40]), None);
    }
}
