//! The work of a kernel with the widest instructions of the processor, and prefetch hints.
//!
//! These change only the speed of a kernel. Each lane performs the operations of the plain code, in the same
//! order, with the same rounding and without fused operations.

use xca_values::Instructions;

/// The work of a kernel on a row.
pub trait Work {
    /// Does the work. Inline it, so that it is compiled for the instruction set of its caller.
    fn run(self);
}

/// Does the work.
#[inline(always)]
pub fn run(work: impl Work) {
    #[cfg(target_arch = "x86_64")]
    match Instructions::present() {
        // SAFETY: the processor has AVX-512.
        #[allow(unsafe_code)]
        Instructions::Avx512 => unsafe { run_with_avx512(work) },
        // SAFETY: the processor has AVX2.
        #[allow(unsafe_code)]
        Instructions::Avx2 => unsafe { run_with_avx2(work) },
        Instructions::Plain => run_plain(work),
    }
    #[cfg(not(target_arch = "x86_64"))]
    run_plain(work);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512bw,avx512dq,avx512vl")]
fn run_with_avx512(work: impl Work) {
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_with_avx2(work: impl Work) {
    work.run();
}

#[inline(never)]
fn run_plain(work: impl Work) {
    work.run();
}

/// Prefetches the memory at an address. This is not an access, so any address is valid.
#[inline(always)]
pub(super) fn announce(place: *const u8) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a hint, for any address.
        #[allow(unsafe_code)]
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(place.cast());
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = place;
}

/// Prefetches `bytes` bytes from an address on.
#[inline(always)]
pub(super) fn announce_bytes(first: *const u8, bytes: usize) {
    (0..bytes).step_by(CACHE_LINE).for_each(|line| announce(first.wrapping_add(line)));
}

/// The size of a cache line in bytes.
const CACHE_LINE: usize = 64;
