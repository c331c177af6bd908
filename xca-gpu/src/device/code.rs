//! Code for the device, and what it is compiled to.

use super::corrections::Corrections;
use std::fmt;
use std::num::NonZeroU32;

/// How code uses a buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Access {
    /// The same for all invocations.
    Uniform,
    /// Read.
    Read,
    /// Read and written.
    Write,
}

/// The text of a compute shader whose entry point is `main`, with its buffers by number.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Code {
    /// What it is for, in messages.
    pub(crate) name: String,
    /// WGSL.
    pub(crate) source: String,
    /// The size of a workgroup.
    pub(crate) workgroup: [u32; 3],
    /// The buffers.
    pub(crate) buffers: Vec<Access>,
    /// Where the driver must not change float arithmetic: which operations are corrected.
    pub(crate) strict: Option<Corrections>,
    /// Where loops that the device ends early are to be told: the number that is written to one more buffer,
    /// which stands behind the others.
    pub(crate) watched: Option<NonZeroU32>,
}

/// Compiled code.
pub(crate) struct Pipeline {
    pub(super) pipeline: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) code: Code,
}

impl fmt::Debug for Pipeline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Pipeline({})", self.code.name)
    }
}
