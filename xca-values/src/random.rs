//! Counter-based random numbers: Philox 4x32-10.
//!
//! J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw: "Parallel random numbers: as easy as 1, 2, 3", SC11. A
//! number is a function of its counter and key alone. Threads may therefore draw in any order.

const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
const KEY_INCREMENTS: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
const ROUNDS: usize = 10;

/// The four words of this counter and key.
#[inline]
pub fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for round in 0..ROUNDS {
        if round > 0 {
            key = [key[0].wrapping_add(KEY_INCREMENTS[0]), key[1].wrapping_add(KEY_INCREMENTS[1])];
        }
        let first = u64::from(MULTIPLIERS[0]) * u64::from(counter[0]);
        let second = u64::from(MULTIPLIERS[1]) * u64::from(counter[2]);
        counter = [
            (second >> 32) as u32 ^ counter[1] ^ key[0],
            second as u32,
            (first >> 32) as u32 ^ counter[3] ^ key[1],
            first as u32,
        ];
    }
    counter
}

/// An independent sequence of random numbers. Each process of a step has one, the initial state of each
/// struct of substates has one, and steering has one.
///
/// A stream is 16 bits of the counter. Numbers below 2^15 are the places of processes in the step, so two
/// runs of one process in a step are independent too. Initial states follow from 2^15 on. The last number is
/// steering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Stream(u16);

impl Stream {
    /// The largest number of processes in a step.
    pub const PROCESSES: usize = 0x8000;
    /// The largest number of structs of substates in a model.
    pub const GROUPS: usize = 0x7FFF;
    /// The stream of steering.
    pub const STEERING: Self = Self(u16::MAX);

    /// The stream of the process at this place in the step, below [`Self::PROCESSES`].
    pub const fn process(place: usize) -> Self {
        Self(place as u16 & 0x7FFF)
    }

    /// The stream of the initial state of the group with this number, below [`Self::GROUPS`].
    pub const fn initial(group: usize) -> Self {
        Self(group as u16 | 0x8000)
    }

    /// Its number.
    pub const fn number(self) -> u16 {
        self.0
    }
}

/// One draw of random bits. With the seed it determines the bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Draw {
    /// The sequence.
    pub stream: Stream,
    /// The number of the step, from 0. Numbers repeat after 2^48 steps.
    pub step: u64,
    /// The linear index of a cell (x fastest), or the label of an item.
    pub owner: u32,
    /// The number of the draw.
    pub number: u32,
}

impl Draw {
    /// The words: Philox with the seed as its key (low word, high word), and the counter
    ///
    /// | word | holds |
    /// |---|---|
    /// | 0 | the owner |
    /// | 1 | the low 32 bits of the step |
    /// | 2 | the next 16 bits of the step, then the 16 bits of the stream |
    /// | 3 | the number of the draw |
    #[inline]
    pub fn words(self, seed: u64) -> [u32; 4] {
        let high = (self.step >> 32) as u32 & 0xFFFF | u32::from(self.stream.0) << 16;
        philox([self.owner, self.step as u32, high, self.number], [seed as u32, (seed >> 32) as u32])
    }
}

#[cfg(test)]
mod tests {
    use super::{Draw, Stream, philox};

    /// The known answers published with the Random123 library.
    #[test]
    fn published_known_answers() {
        let ones = u32::MAX;
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox([ones; 4], [ones; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        assert_eq!(
            philox([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }
    /// The layout of the counter, written out.
    #[test]
    fn layout_of_the_counter() {
        let seed = 0x0123_4567_89AB_CDEF;
        let draw = Draw { stream: Stream::process(5), step: 0x7654_3210_FEDC, owner: 9, number: 11 };
        assert_eq!(draw.words(seed), philox([9, 0x3210_FEDC, 0x0005_7654, 11], [0x89AB_CDEF, 0x0123_4567]));
    }

    #[test]
    fn streams_are_apart() {
        let last_process = Stream::process(Stream::PROCESSES - 1);
        let (first, last) = (Stream::initial(0), Stream::initial(Stream::GROUPS - 1));
        let numbers = [Stream::process(0), last_process, first, last, Stream::STEERING].map(Stream::number);
        assert_eq!(numbers, [0, 0x7FFF, 0x8000, 0xFFFE, 0xFFFF]);
    }
}
