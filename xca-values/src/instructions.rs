//! Instruction sets of the processor for kernels.

use std::sync::atomic::{AtomicU8, Ordering};

/// Instruction sets, from the narrowest to the widest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instructions {
    /// The instructions of the compiler's target.
    Plain = 1,
    /// AVX2, registers of 256 bits.
    Avx2 = 2,
    /// AVX-512, registers of 512 bits. Only on processors that do not reduce their clock for it: since Ice
    /// Lake and Zen 4.
    Avx512 = 3,
}

/// The number of the set in use. 0 before detection.
static PRESENT: AtomicU8 = AtomicU8::new(0);

impl Instructions {
    /// The widest set of this processor, within the limit if there is one.
    #[inline(always)]
    pub fn present() -> Self {
        match PRESENT.load(Ordering::Relaxed) {
            1 => Self::Plain,
            2 => Self::Avx2,
            3 => Self::Avx512,
            _ => Self::detect(),
        }
    }

    /// Limits the kernels of the whole process to this set from now on. Returns the set in use. Results do
    /// not change, which tests verify with this function.
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
