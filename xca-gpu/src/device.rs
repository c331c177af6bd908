//! The device: adapters, buffers, pipelines, submissions. Nothing outside this module names wgpu, whose
//! interface changes every few months.

mod adapter;
mod code;
mod compilation;
mod corrections;
mod error;
mod exact;
mod handicap;
mod instance;
mod passthrough;
mod pieces;
mod recorder;
mod rewrite;
mod transfer;

pub use adapter::{Adapter, AdapterChoice, AdapterKind};
pub(crate) use code::{Access, Code, Pipeline};
pub(crate) use corrections::Corrections;
pub use error::DeviceError;
pub use handicap::Handicap;
#[cfg(test)]
pub(crate) use pieces::in_pieces;
pub(crate) use recorder::{Binding, Bindings, Recorder};
pub(crate) use rewrite::UNTOUCHED;
pub(crate) use transfer::Landing;

use crate::error::GpuError;
use std::collections::HashMap;
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// All adapters of this machine; none where there is no driver.
pub fn adapters() -> Vec<Adapter> {
    adapter::all().into_iter().map(|(_, description)| description).collect()
}

/// An open adapter.
pub(crate) struct Device {
    adapter: Adapter,
    handicap: Handicap,
    /// The most turns of loops, where the device ends them early.
    turns: Option<u32>,
    reach: u64,
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// Why the device is lost, once it is.
    lost: Arc<Mutex<Option<String>>>,
    /// Compiled code by its text.
    pipelines: Mutex<HashMap<Code, Arc<Pipeline>>>,
    buffers: AtomicU64,
}

/// A piece of the device's memory.
#[derive(Clone)]
pub(crate) struct Buffer {
    buffer: wgpu::Buffer,
    /// No two buffers of a device have the same.
    number: u64,
}

impl Buffer {
    /// The size in bytes.
    pub(crate) fn size(&self) -> u64 {
        self.buffer.size()
    }
}

impl Device {
    /// Opens an adapter.
    pub(crate) fn open(choice: &AdapterChoice, handicap: Handicap) -> Result<Self, GpuError> {
        let all = adapter::all();
        let known: Vec<Adapter> = all.iter().map(|(_, description)| description.clone()).collect();
        if known.is_empty() {
            return Err(GpuError::NoAdapter);
        }
        let missing = || GpuError::NoSuchAdapter { wanted: choice.to_string(), known: list(&known) };
        let number = choice.of(&known).ok_or_else(missing)?;
        let (adapter, description) =
            all.into_iter().find(|(_, description)| description.number == number).ok_or_else(missing)?;
        let wanted = wgpu::Features::SHADER_F64 | wgpu::Features::PASSTHROUGH_SHADERS;
        let request = wgpu::DeviceDescriptor {
            label: Some("xca"),
            required_features: adapter.features() & wanted,
            required_limits: adapter.limits(),
            experimental_features: passthrough::experimental_features(),
            memory_hints: wgpu::MemoryHints::Performance,
            trace: wgpu::Trace::Off,
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&request)).map_err(|error| {
            GpuError::CannotOpen { adapter: description.to_string(), reason: error.to_string() }
        })?;
        let lost = Arc::new(Mutex::new(None));
        let note = Arc::clone(&lost);
        device.set_device_lost_callback(move |_, reason| {
            let reason = if reason.is_empty() { "its driver does not say why".to_owned() } else { reason };
            note.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(reason);
        });
        // Where no scope waits for an error, it is the next wait that tells of it; without this the library
        // would panic.
        let note = Arc::clone(&lost);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            note.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error.to_string());
        }));
        Ok(Self {
            reach: description.largest_binding,
            adapter: description,
            handicap,
            turns: None,
            device,
            queue,
            lost,
            pipelines: Mutex::new(HashMap::new()),
            buffers: AtomicU64::new(0),
        })
    }

    /// Notes how many turns the loops of an invocation may take together, where it ends them early.
    pub(crate) fn set_turns(&mut self, turns: Option<u32>) {
        self.turns = turns;
    }

    /// Keeps to the handicap in bindings from now on. Before, the device is tried out with large ones.
    pub(crate) fn narrow(&mut self) {
        self.reach = handicap::lower(self.reach, self.handicap.reach);
    }

    /// What is known of it.
    pub(crate) fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// The largest number of workgroups along an axis.
    pub(crate) fn most_workgroups(&self) -> u32 {
        handicap::lower(self.device.limits().max_compute_workgroups_per_dimension, self.handicap.workgroups)
    }

    /// The invocations of a workgroup that suit it. A graphics card fills its units with few; a processor
    /// that plays one does a whole workgroup on one core, and likes them large.
    pub(crate) fn workgroup(&self) -> u32 {
        let most = self.device.limits().max_compute_invocations_per_workgroup;
        let wanted = if self.adapter.kind == AdapterKind::Processor { 1024 } else { 64 };
        let most = handicap::lower(most, self.handicap.workgroup);
        wanted.min(1 << most.max(1).ilog2())
    }

    /// What is corrected from the beginning.
    pub(crate) fn corrections(&self) -> Corrections {
        if self.handicap.corrected { Corrections::ALL } else { Corrections::default() }
    }

    /// From how many tiles on it is looked for those where something can change, where it is told.
    pub(crate) fn few_tiles(&self) -> Option<usize> {
        self.handicap.tiles
    }

    /// The most storage buffers that code uses.
    pub(crate) fn buffers(&self) -> u32 {
        handicap::lower(self.adapter.buffers, self.handicap.buffers)
    }

    /// How many turns the loops of an invocation may take together, where the device ends them early and says
    /// nothing.
    pub(crate) fn turns(&self) -> Option<u32> {
        self.turns
    }

    /// Whether the device finishes loops of so many turns.
    pub(crate) fn finishes(&self, turns: usize) -> bool {
        self.turns.is_none_or(|most| turns <= most as usize)
    }

    /// The most bytes of a buffer that code is bound to at once.
    pub(crate) fn reach(&self) -> u64 {
        self.reach
    }

    /// Memory full of zeros.
    pub(crate) fn buffer(&self, name: &str, size: u64) -> Result<Buffer, DeviceError> {
        self.allocate(name, size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC)
    }

    /// Memory for the sizes of so many dispatches, which the device writes.
    pub(crate) fn dispatches(&self, name: &str, number: usize) -> Result<Buffer, DeviceError> {
        let size = number * 3 * size_of::<u32>();
        self.allocate(name, size as u64, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT)
    }

    /// Memory for what all invocations read alike.
    pub(crate) fn uniform(&self, name: &str, values: &[u8]) -> Result<Buffer, DeviceError> {
        let buffer = self.allocate(name, values.len() as u64, wgpu::BufferUsages::UNIFORM)?;
        self.upload(&buffer, 0, values)?;
        Ok(buffer)
    }

    fn allocate(&self, name: &str, size: u64, usage: wgpu::BufferUsages) -> Result<Buffer, DeviceError> {
        // No empty buffers; and a multiple of what every type of a uniform is aligned to.
        let size = size.max(1).next_multiple_of(16);
        let most = self.adapter.largest_buffer;
        if size > most {
            return Err(DeviceError::TooLarge { what: format!("the buffer for {name}"), wanted: size, most });
        }
        let description = wgpu::BufferDescriptor {
            label: Some(name),
            size,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        };
        let buffer =
            self.guarded(&format!("{size} bytes for {name}"), || self.device.create_buffer(&description))?;
        Ok(Buffer { buffer, number: self.buffers.fetch_add(1, Ordering::Relaxed) })
    }

    /// Waits until everything that was submitted is done.
    pub(crate) fn wait(&self) -> Result<(), DeviceError> {
        let result = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.alive()?;
        result.map(|_| ()).map_err(|error| DeviceError::Lost(error.to_string()))
    }

    /// Has the device be lost, as if its driver had been reset.
    #[cfg(test)]
    pub(crate) fn lose(&self) {
        self.device.destroy();
    }

    fn alive(&self) -> Result<(), DeviceError> {
        let lost = self.lost.lock().unwrap_or_else(PoisonError::into_inner);
        lost.as_ref().map_or(Ok(()), |reason| Err(DeviceError::Lost(reason.clone())))
    }

    /// Does something on the device and looks whether it went wrong.
    fn guarded<T>(&self, what: &str, work: impl FnOnce() -> T) -> Result<T, DeviceError> {
        self.alive()?;
        let filters =
            [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Internal];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let result = work();
        let mut first = None;
        for scope in scopes.into_iter().rev() {
            if let Some(error) = pollster::block_on(scope.pop()) {
                first.get_or_insert(error);
            }
        }
        if first.is_some() {
            // What is made on a lost device is no good, and that is told first; why, only when it is asked.
            let _ = self.device.poll(wgpu::PollType::Poll);
            self.alive()?;
        }
        match first {
            None => Ok(result),
            Some(wgpu::Error::OutOfMemory { .. }) => Err(DeviceError::OutOfMemory(what.to_owned())),
            Some(error) => Err(DeviceError::Refused { what: what.to_owned(), reason: causes(&error) }),
        }
    }
}

/// An error with its sources, on one line.
fn causes(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut source = error.source();
    while let Some(cause) = source {
        let cause_text = cause.to_string();
        if !text.contains(&cause_text) {
            text = format!("{text}: {cause_text}");
        }
        source = cause.source();
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The adapters as one line of a message.
fn list(adapters: &[Adapter]) -> String {
    let lines: Vec<String> =
        adapters.iter().map(|adapter| format!("{}: {adapter}", adapter.number)).collect();
    lines.join(", ")
}

impl fmt::Debug for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Device({})", self.adapter)
    }
}

impl fmt::Debug for Buffer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Buffer({}, {} bytes)", self.number, self.size())
    }
}
