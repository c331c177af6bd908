//! Work for the device, recorded and then submitted as one.

use super::{Buffer, Device, DeviceError, Pipeline};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// A part of a buffer, as code sees it.
#[derive(Debug, Clone)]
pub(crate) struct Binding {
    buffer: Buffer,
    start: u64,
    size: u64,
}

impl Binding {
    /// Bytes of a buffer.
    pub(crate) fn part(buffer: &Buffer, start: u64, size: u64) -> Self {
        Self { buffer: buffer.clone(), start, size }
    }

    /// What is the same for equal bindings only.
    pub(crate) fn key(&self) -> (u64, u64) {
        (self.buffer.number, self.start)
    }
}

impl From<&Buffer> for Binding {
    fn from(buffer: &Buffer) -> Self {
        Self::part(buffer, 0, buffer.size())
    }
}

/// Compiled code with its buffers.
#[derive(Clone)]
pub(crate) struct Bindings {
    pipeline: Arc<Pipeline>,
    group: wgpu::BindGroup,
}

impl fmt::Debug for Bindings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Bindings({:?})", self.pipeline)
    }
}

/// Work to be submitted.
pub(crate) struct Recorder {
    encoder: wgpu::CommandEncoder,
    pass: Option<wgpu::ComputePass<'static>>,
}

impl Recorder {
    /// Runs code in so many workgroups.
    pub(crate) fn run(&mut self, bindings: &Bindings, workgroups: [u32; 3]) {
        if workgroups.contains(&0) {
            return;
        }
        let [x, y, z] = workgroups;
        self.bound(bindings).dispatch_workgroups(x, y, z);
    }

    /// Runs code in as many workgroups as a buffer says at this byte.
    pub(crate) fn run_as_told(&mut self, bindings: &Bindings, workgroups: &Buffer, at: u64) {
        self.bound(bindings).dispatch_workgroups_indirect(&workgroups.buffer, at);
    }

    fn bound(&mut self, bindings: &Bindings) -> &mut wgpu::ComputePass<'static> {
        let encoder = &mut self.encoder;
        let pass = self.pass.get_or_insert_with(|| {
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default()).forget_lifetime()
        });
        pass.set_pipeline(&bindings.pipeline.pipeline);
        pass.set_bind_group(0, &bindings.group, &[]);
        pass
    }

    pub(super) fn copy(&mut self, from: &Buffer, start: u64, to: &wgpu::Buffer, place: Range<u64>) {
        self.pass = None;
        let size = place.end - place.start;
        self.encoder.copy_buffer_to_buffer(&from.buffer, start, to, place.start, size);
    }
}

impl Device {
    /// Gives code its buffers, in the order of their numbers.
    pub(crate) fn bind(
        &self,
        pipeline: &Arc<Pipeline>,
        buffers: &[Binding],
    ) -> Result<Bindings, DeviceError> {
        let most = self.adapter.largest_binding;
        if let Some(part) = buffers.iter().find(|part| part.size > most) {
            let what = format!("what {} reaches at once", pipeline.name);
            return Err(DeviceError::TooLarge { what, wanted: part.size, most });
        }
        let entries: Vec<_> = buffers
            .iter()
            .zip(0..)
            .map(|(part, binding)| wgpu::BindGroupEntry {
                binding,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer: &part.buffer.buffer,
                    offset: part.start,
                    size: std::num::NonZero::new(part.size),
                }),
            })
            .collect();
        let group = self.guarded(&format!("the buffers of {}", pipeline.name), || {
            self.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(&pipeline.name),
                layout: &pipeline.layout,
                entries: &entries,
            })
        })?;
        Ok(Bindings { pipeline: Arc::clone(pipeline), group })
    }

    /// Starts to record.
    pub(crate) fn recorder(&self) -> Recorder {
        let encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Recorder { encoder, pass: None }
    }

    /// Hands recorded work to the device.
    pub(crate) fn submit(&self, recorder: Recorder) -> Result<(), DeviceError> {
        self.guarded("the work of a step", || {
            let Recorder { encoder, pass } = recorder;
            drop(pass);
            self.queue.submit([encoder.finish()]);
        })
    }
}
