//! What the host says to all other processes of a job. The bytes are the same in all builds.

use xca_core::Precision;
use xca_parts::Grid;

/// What the others are to do.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Order {
    /// To make the engine that this word names, and to tell of it.
    Open(String),
    /// To start a part of the model.
    Start(Beginning),
    /// To end.
    Stop,
}

/// How a model is started.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Beginning {
    /// The number of the execution, which all its messages have.
    pub(crate) execution: u32,
    pub(crate) precision: Precision,
    pub(crate) grid: Grid,
    /// The word that names the engine of each part, which is open.
    pub(crate) part: String,
}

/// The first byte of an order.
const OPEN: u8 = 1;
const START: u8 = 2;

impl Order {
    pub(crate) fn bytes(&self) -> Vec<u8> {
        match self {
            Self::Stop => Vec::new(),
            Self::Open(part) => [&[OPEN], part.as_bytes()].concat(),
            Self::Start(Beginning { execution, precision, grid, part }) => {
                let bits = match precision {
                    Precision::F32 => 32,
                    Precision::F64 => 64,
                };
                let numbers = [u64::from(*execution), bits, grid.y as u64, grid.z as u64];
                [&[START], numbers.map(u64::to_le_bytes).as_flattened(), part.as_bytes()].concat()
            }
        }
    }

    /// Nothing where the bytes are no order.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let word = |bytes: &[u8]| str::from_utf8(bytes).ok().map(str::to_owned);
        match bytes.split_first() {
            None => Some(Self::Stop),
            Some((&OPEN, part)) => word(part).map(Self::Open),
            Some((&START, rest)) => {
                let (numbers, part) = rest.split_at_checked(4 * size_of::<u64>())?;
                let numbers = numbers.as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes));
                let numbers: Vec<usize> =
                    numbers.map(|number| usize::try_from(number).ok()).collect::<Option<_>>()?;
                let [execution, bits, y, z] = numbers.try_into().ok()?;
                let precision = match bits {
                    32 => Precision::F32,
                    64 => Precision::F64,
                    _ => return None,
                };
                let execution = u32::try_from(execution).ok()?;
                let grid = Grid { y, z };
                Some(Self::Start(Beginning { execution, precision, grid, part: word(part)? }))
            }
            Some(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Beginning, Order, START};
    use xca_core::Precision;
    use xca_parts::Grid;

    #[test]
    fn orders_arrive_as_they_were_sent() {
        let grid = Grid { y: 3, z: 5 };
        let beginning =
            |precision| Beginning { execution: 9, precision, grid, part: "gpu:llvm pipe".to_owned() };
        for order in [
            Order::Open("cpu:2".to_owned()),
            Order::Start(beginning(Precision::F32)),
            Order::Start(beginning(Precision::F64)),
            Order::Stop,
        ] {
            assert_eq!(Order::from_bytes(&order.bytes()), Some(order));
        }
        assert_eq!(Order::from_bytes(&[9, 2, 3]), None);
        assert_eq!(Order::from_bytes(&[START; 12]), None);
        assert_eq!(Order::from_bytes(&[START; 40]), None);
        assert_eq!(Order::from_bytes(&[1, 0xff]), None);
    }
}
