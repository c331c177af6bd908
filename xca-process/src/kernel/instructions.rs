//! Which instructions of the processor kernels use.

use std::sync::atomic::{AtomicU8, Ordering};

/// Sets of instructions, from the narrowest to the widest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instructions {
    /// Those that the compiler's target has.
    Plain = 1,
    /// AVX2, registers of 256 bits.
    Avx2 = 2,
    /// AVX-512, registers of 512 bits. Only on processors that keep their clock with it: those since Ice Lake
    /// and Zen 4.
    Avx512 = 3,
}

/// The number of the set in use; 0 before the processor was asked.
static PRESENT: AtomicU8 = AtomicU8::new(0);

impl Instructions {
    /// The widest set of this processor, below the limit if there is one.
    #[inline(always)]
    pub fn present() -> Self {
        match PRESENT.load(Ordering::Relaxed) {
            1 => Self::Plain,
            2 => Self::Avx2,
            3 => Self::Avx512,
            _ => Self::detect(),
        }
    }

    /// From now on kernels use this set at most, in the whole process. The set that they use then is the
    /// result. Results do not change: this is for tests, which have to see that.
    pub fn limit(self) -> Self {
        let set = Self::widest().min(self);
        PRESENT.store(set as u8, Ordering::Relaxed);
        set
    }

    #[cold]
    fn detect() -> Self {
        Self::Avx512.limit()
    }

    /// The widest set of this processor.
    fn widest() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            use std::arch::is_x86_feature_detected as has;
            let is_wide = has!("avx512f") && has!("avx512bw") && has!("avx512dq") && has!("avx512vl");
            // The last one came with processors that keep their clock.
            if is_wide && has!("avx2") && has!("avx512vbmi2") {
                return Self::Avx512;
            }
            if has!("avx2") {
                return Self::Avx2;
            }
        }
        Self::Plain
    }
}
