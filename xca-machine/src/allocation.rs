//! What the allocator of the C library does with freed memory.
#![allow(unsafe_code)]

/// Pieces of at least so many bytes go back to the system when they are freed.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const LARGE: i32 = 1 << 20;

/// So many free bytes behind all used ones are kept.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: i32 = 4 << 20;

/// Lets large pieces of memory go back to the system when they are freed. The allocator of glibc keeps pieces
/// of up to 32 MB once one of this size has been freed, and holes between them grow without use. For the
/// beginning of a program; on other systems it does nothing.
pub fn return_large_pieces() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: two options of the allocator, with valid values. It takes its lock to set them, and is in use
    // since before `main`, so that this call does not set it up.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE);
        libc::mallopt(libc::M_TRIM_THRESHOLD, KEPT);
    }
}
