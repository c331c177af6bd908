//! Where a process of a job is, and how many threads it takes there.

use crate::wire::Wire;
use std::num::NonZeroUsize;

/// Where a process of a job is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The name of its machine.
    pub machine: String,
    /// Its number among the processes on its machine, from 0.
    pub number: usize,
    /// The number of threads of its part where none is chosen: its share of the cores, or those that the
    /// launcher binds it to.
    pub threads: usize,
    /// Whether the launcher leaves it fewer cores than its share.
    pub is_bound: bool,
}

impl Place {
    /// That of this process.
    pub(crate) fn new(wire: &dyn Wire) -> Self {
        let usable = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let online = std::fs::read_to_string("/sys/devices/system/cpu/online");
        let all = online.ok().and_then(|text| cores(&text)).unwrap_or(usable);
        let number = wire.number_on_this_machine();
        Self::among(wire.machine(), (number, wire.on_this_machine()), usable, all)
    }

    fn among(machine: String, (number, processes): (usize, usize), usable: usize, all: usize) -> Self {
        let share = (all / processes.max(1)).max(1);
        // Bound processes have cores of their own; others share what there is.
        let threads = if usable < all { usable } else { share };
        Self { machine, number, threads, is_bound: usable < share }
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        let is_bound = u8::from(self.is_bound);
        format!("{} {} {is_bound} {}", self.number, self.threads, self.machine).into_bytes()
    }

    /// Nothing where the bytes are not those of a place.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let mut words = str::from_utf8(bytes).ok()?.splitn(4, ' ');
        let number = words.next()?.parse().ok()?;
        let threads = words.next()?.parse().ok()?;
        let is_bound = words.next()? == "1";
        Some(Self { machine: words.next()?.to_owned(), number, threads, is_bound })
    }
}

/// How many cores a list of ranges such as `0-3,8-11` has.
fn cores(list: &str) -> Option<usize> {
    let range = |text: &str| {
        let (first, last) = text.split_once('-').unwrap_or((text, text));
        let (first, last) = (first.parse::<usize>().ok()?, last.parse::<usize>().ok()?);
        Some(last.checked_sub(first)? + 1)
    };
    list.trim().split(',').map(range).sum()
}

#[cfg(test)]
mod tests {
    use super::{Place, cores};

    #[test]
    fn cores_are_shared_or_bound() {
        assert_eq!(cores("0-3,8-11,15\n"), Some(9));
        assert_eq!((cores("0\n"), cores(""), cores("3-1"), cores("x")), (Some(1), None, None, None));
        let threads = |usable, all, processes| {
            let place = Place::among("a b".to_owned(), (1, processes), usable, all);
            assert_eq!(Place::from_bytes(&place.bytes()), Some(place.clone()));
            (place.threads, place.is_bound)
        };
        assert_eq!(threads(8, 8, 2), (4, false));
        assert_eq!(threads(1, 8, 2), (1, true));
        assert_eq!(threads(4, 8, 2), (4, false));
        assert_eq!(threads(2, 2, 4), (1, false));
        assert_eq!(Place::from_bytes(b"four"), None);
    }
}
