//! Work for the device, recorded and then submitted as one.

use super::{Access, Buffer, Device, DeviceError, Pipeline, pieces};
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

    /// The binding in pieces of at most so many bytes, all but the last of the same size.
    fn pieces(&self, most: u64) -> Vec<Self> {
        if self.size <= most {
            return vec![self.clone()];
        }
        let piece = (most - most % pieces::ALIGNMENT).max(pieces::ALIGNMENT);
        let starts = (0..self.size).step_by(piece as usize);
        starts
            .map(|start| Self::part(&self.buffer, self.start + start, piece.min(self.size - start)))
            .collect()
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
    // A recorder that is dropped ends its pass first.
    pass: Option<wgpu::ComputePass<'static>>,
    encoder: wgpu::CommandEncoder,
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
        let (pipeline, buffers) = self.in_reach(pipeline, buffers)?;
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
        let group = self.guarded(&format!("the buffers of {}", pipeline.code.name), || {
            self.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(&pipeline.code.name),
                layout: &pipeline.layout,
                entries: &entries,
            })
        })?;
        Ok(Bindings { pipeline, group })
    }

    /// Compiled code with its buffers, or where a buffer is too large for a binding, code that is bound to
    /// pieces of it.
    fn in_reach(
        &self,
        pipeline: &Arc<Pipeline>,
        buffers: &[Binding],
    ) -> Result<(Arc<Pipeline>, Vec<Binding>), DeviceError> {
        let reach = self.reach();
        let pieces: Vec<Vec<Binding>> = buffers.iter().map(|buffer| buffer.pieces(reach)).collect();
        if pieces.iter().all(|pieces| pieces.len() == 1) {
            return Ok((Arc::clone(pipeline), buffers.to_vec()));
        }
        let name = &pipeline.code.name;
        let wanted = buffers.iter().map(|buffer| buffer.size).max().unwrap_or(0);
        let counts: Vec<usize> = pieces.iter().map(Vec::len).collect();
        let code = pieces::in_pieces(&pipeline.code, &counts).map_err(|_| DeviceError::TooLarge {
            what: format!("what {name} reaches at once"),
            wanted,
            most: reach,
        })?;
        let uniform = code.buffers.iter().filter(|access| **access == Access::Uniform).count();
        let (wanted, most) = (counts.iter().sum::<usize>() - uniform, self.buffers() as usize);
        if wanted > most {
            return Err(DeviceError::TooManyPieces { what: name.clone(), wanted, most, reach });
        }
        Ok((self.pipeline(&code)?, pieces.concat()))
    }

    /// Starts to record.
    pub(crate) fn recorder(&self) -> Recorder {
        let encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Recorder { pass: None, encoder }
    }

    /// Hands recorded work to the device.
    pub(crate) fn submit(&self, recorder: Recorder) -> Result<(), DeviceError> {
        self.guarded("the work of a step", || {
            let Recorder { pass, encoder } = recorder;
            drop(pass);
            self.queue.submit([encoder.finish()]);
        })
    }
}
