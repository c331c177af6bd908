//! What can go wrong before a run.

use crate::device::DeviceError;
use xca_core::EngineFailure;

/// A GPU engine that cannot be had.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// This machine has no driver, or no device.
    #[error(
        "no graphics adapter was found; install the driver of your graphics card, or software Vulkan (Debian and Ubuntu: \
         apt-get install mesa-vulkan-drivers; Fedora: dnf install mesa-vulkan-drivers; Arch: pacman -S vulkan-swrast), or take --engine cpu"
    )]
    NoAdapter,
    /// No adapter is meant by the choice.
    #[error("no adapter is {wanted}; this machine has {known}")]
    NoSuchAdapter {
        /// What was asked for.
        wanted: String,
        /// What there is.
        known: String,
    },
    /// The driver does not open it.
    #[error("the adapter {adapter} cannot be opened: {reason}")]
    CannotOpen {
        /// The adapter.
        adapter: String,
        /// Why.
        reason: String,
    },
    /// Strict arithmetic was asked for.
    #[error(
        "the adapter {adapter} has no strict arithmetic: {reason}; take relaxed arithmetic or another adapter"
    )]
    NotStrict {
        /// The adapter.
        adapter: String,
        /// Why not.
        reason: String,
    },
}

/// A model that the device cannot run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(crate) enum NotOnDevice {
    /// Its code.
    #[error(transparent)]
    Shader(#[from] xca_wgsl::Error),
    /// The device.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// 64-bit floats.
    #[error(
        "{what} needs 64-bit floats, which the adapter does not compute with; take --precision f32, another adapter, or the cpu engine"
    )]
    NoF64 {
        /// What needs them.
        what: String,
    },
    /// Too many substates in one process.
    #[error(
        "the process `{process}` uses {wanted} buffers, and a process can use {most} on this adapter; divide it into processes that use fewer substates"
    )]
    TooManyBuffers {
        /// The process.
        process: &'static str,
        /// How many it uses.
        wanted: usize,
        /// How many it can use.
        most: usize,
    },
    /// Something that has to be reached at once.
    #[error(
        "{what} would take {wanted} bytes, and a process can reach {most} at once on this adapter; use fewer cells or items, or the cpu engine"
    )]
    TooLarge {
        /// What it is.
        what: String,
        /// Its bytes.
        wanted: u128,
        /// The limit.
        most: u64,
    },
}

/// What the host hears of an error of the device.
pub(crate) fn failure(error: &DeviceError) -> EngineFailure {
    EngineFailure::Broken { engine: "gpu".to_owned(), reason: error.to_string() }
}

impl From<DeviceError> for EngineFailure {
    fn from(error: DeviceError) -> Self {
        failure(&error)
    }
}
