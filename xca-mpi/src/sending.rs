//! A message that MPI is sending.
#![allow(unsafe_code)]

use mpi::request::{Request, StaticScope};
use mpi::traits::Destination;
use std::mem::{forget, take};
use std::slice;

/// A message that MPI is sending, with its bytes.
pub(crate) struct Sending {
    /// `None` when MPI has sent the bytes.
    request: Option<Request<'static, [u8], StaticScope>>,
    bytes: Vec<u8>,
}

// SAFETY: a request is a handle of the MPI library, which can be called from any thread, by one at a time
// (`MPI_THREAD_SERIALIZED`). The mailbox sees to that.
unsafe impl Send for Sending {}

impl Sending {
    /// Begins to send bytes to a process.
    pub(crate) fn begin(to: &impl Destination, tag: i32, bytes: Vec<u8>) -> Self {
        // SAFETY: MPI reads the bytes until the request is complete. Until then they stay where they are: no
        // method changes `bytes`, moving a vector leaves its content in place, and `drop` leaks the bytes of
        // an incomplete request.
        let lent: &'static [u8] = unsafe { slice::from_raw_parts(bytes.as_ptr(), bytes.len()) };
        Self { request: Some(to.immediate_send_with_tag(StaticScope, lent, tag)), bytes }
    }

    /// Goes on sending. Returns the bytes when MPI has sent them.
    pub(crate) fn go_on(mut self) -> Result<Vec<u8>, Self> {
        self.request = self.request.take().and_then(|request| request.test().err());
        if self.request.is_none() { Ok(take(&mut self.bytes)) } else { Err(self) }
    }
}

impl Drop for Sending {
    fn drop(&mut self) {
        if let Some(request) = self.request.take() {
            // MPI still reads the bytes, and dropping the request would panic.
            forget(request);
            forget(take(&mut self.bytes));
        }
    }
}
