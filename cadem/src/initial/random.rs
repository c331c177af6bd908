//! The pseudo-random numbers of the authors' initial state.

/// The largest number that [`ReentrantRandom`] draws, `RAND_MAX` of the GNU C library.
pub(super) const LARGEST: u32 = (1 << 31) - 1;

/// The generator behind `rand_r` of the GNU C library.
///
/// Its state is one 32-bit word. A draw sends the word through three rounds of the linear congruence that the
/// C standard gives as an example (multiplier 1103515245, increment 12345, modulo 2^32). Of each round's
/// result only bits above the sixteenth are used: the lowest 11 of them from the first round, the lowest 10
/// from the other two. These 31 bits, the first round's uppermost, are the number drawn.
///
/// It is weak by today's standards. It is here because the authors drew their particles with it.
#[derive(Debug, Clone)]
pub(super) struct ReentrantRandom {
    state: u32,
}

impl ReentrantRandom {
    /// A generator with this seed.
    pub(super) const fn new(seed: u32) -> Self {
        Self { state: seed }
    }

    /// One round: advances the state and returns `bits` bits of its upper half.
    const fn round(&mut self, bits: u32) -> u32 {
        self.state = self.state.wrapping_mul(1_103_515_245).wrapping_add(12_345);
        (self.state >> 16) & ((1 << bits) - 1)
    }

    /// The next number, 0 to [`LARGEST`].
    pub(super) const fn next(&mut self) -> u32 {
        let high = self.round(11);
        let middle = self.round(10);
        let low = self.round(10);
        (high << 20) | (middle << 10) | low
    }

    /// The next number, divided by [`LARGEST`]: 0 to 1, both included.
    pub(super) fn next_unit(&mut self) -> f64 {
        f64::from(self.next()) / f64::from(LARGEST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seed, the first five numbers, and the number after a million, from a C program against glibc.
    const DRAWN_BY_GLIBC: [(u32, [u32; 5], u32); 4] = [
        (1, [476_707_713, 1_186_278_907, 505_671_508, 2_137_716_191, 936_145_377], 594_233_376),
        (0, [1_012_484, 1_716_955_679, 1_792_309_082, 229_610_924, 1_639_479_903], 1_184_409_316),
        (42, [681_191_333, 928_546_885, 1_457_394_273, 941_445_650, 2_129_613_237], 28_823_235),
        (u32::MAX, [1_670_702_726, 99_100_226, 931_463_008, 467_940_729, 196_379_357], 1_773_534_632),
    ];

    #[test]
    fn draws_what_glibc_draws() {
        for (seed, first, after_a_million) in DRAWN_BY_GLIBC {
            let mut random = ReentrantRandom::new(seed);
            assert_eq!([(); 5].map(|()| random.next()), first, "seed {seed}");
            for _ in 5..1_000_000 {
                random.next();
            }
            assert_eq!(random.next(), after_a_million, "seed {seed}");
        }
    }

    #[test]
    fn unit_numbers_stay_within_zero_and_one() {
        let mut random = ReentrantRandom::new(7);
        let numbers: Vec<f64> = (0..100_000).map(|_| random.next_unit()).collect();
        assert!(numbers.iter().all(|u| (0.0..=1.0).contains(u)));
        let mean = numbers.iter().sum::<f64>() / 1e5;
        assert!((mean - 0.5).abs() < 0.005, "mean {mean}");
    }
}
