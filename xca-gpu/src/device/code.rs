//! Code on the device: WGSL compiled to pipelines, strictly or as the driver likes.
#![allow(unsafe_code)]

use super::corrections::Corrections;
use super::rewrite::{self, Manner, Replacements, Watch};
use super::{Device, DeviceError, exact};
use std::borrow::Cow;
use std::fmt;
use std::num::NonZeroU32;
use std::sync::{Arc, PoisonError};

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
    pub(super) name: String,
}

impl fmt::Debug for Pipeline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Pipeline({})", self.name)
    }
}

/// What has to be said to be given shader passthrough.
pub(super) fn experimental_features() -> wgpu::ExperimentalFeatures {
    // SAFETY: the only experimental feature that is ever asked for is the passthrough of shaders, which is
    // used in one place, below, where its own conditions are met.
    unsafe { wgpu::ExperimentalFeatures::enabled() }
}

impl Device {
    /// Compiles code, or finds it compiled.
    pub(crate) fn pipeline(&self, code: &Code) -> Result<Arc<Pipeline>, DeviceError> {
        let known = |device: &Self| {
            device.pipelines.lock().unwrap_or_else(PoisonError::into_inner).get(code).cloned()
        };
        if let Some(pipeline) = known(self) {
            return Ok(pipeline);
        }
        let pipeline = Arc::new(self.compile(code)?);
        let mut pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(Arc::clone(pipelines.entry(code.clone()).or_insert(pipeline)))
    }

    fn compile(&self, code: &Code) -> Result<Pipeline, DeviceError> {
        let what = format!("the code of {}", code.name);
        let refused = |reason: String| DeviceError::Refused { what: what.clone(), reason };
        let watch =
            code.watched.map(|number| Watch { binding: code.buffers.len() as u32, number: number.get() });
        let replacements = code.strict.map(|corrections| self.replacements(corrections)).unwrap_or_default();
        // Wrong WGSL is told with its line, here and by the driver.
        let checked = if code.strict.is_some() || watch.is_some() {
            Some(rewrite::read(&code.source, &replacements, watch).map_err(refused)?)
        } else {
            None
        };
        let words = match &checked {
            Some(checked) if code.strict.is_some() => Some(exact::spirv(checked).map_err(refused)?),
            _ => None,
        };
        self.guarded(&what, || {
            let module = if let Some(words) = words {
                self.passthrough(code, words)
            } else {
                let source = match checked {
                    Some(checked) => wgpu::ShaderSource::Naga(Cow::Owned(checked.module)),
                    None => wgpu::ShaderSource::Wgsl(code.source.as_str().into()),
                };
                let label = Some(code.name.as_str());
                self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label, source })
            };
            let buffers = code.buffers.iter().copied().chain(watch.map(|_| Access::Write));
            let entries: Vec<_> = buffers.zip(0..).map(|(access, number)| entry(number, access)).collect();
            let layout = self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(&code.name),
                entries: &entries,
            });
            let pipeline_layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(&code.name),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(&code.name),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some("main"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    // Code writes what it reads, also in memory that a workgroup shares.
                    zero_initialize_workgroup_memory: false,
                    ..wgpu::PipelineCompilationOptions::default()
                },
                cache: None,
            });
            Pipeline { pipeline, layout, name: code.name.clone() }
        })
    }

    /// What is replaced in strict code.
    fn replacements(&self, corrections: Corrections) -> Vec<Replacements> {
        let corrected = Replacements { manner: Manner::Corrected, of: corrections };
        let all = Corrections { divisions: [true; 2], roots: [true; 2], roundings: [true; 2] };
        let rough = Replacements { manner: Manner::Rough, of: all };
        if self.handicap.rough { vec![corrected, rough] } else { vec![corrected] }
    }

    fn passthrough(&self, code: &Code, words: Vec<u32>) -> wgpu::ShaderModule {
        let entry_points = vec![wgpu::PassthroughShaderEntryPoint {
            name: "main".into(),
            workgroup_size: code.workgroup.into(),
        }];
        // SAFETY: the words are valid SPIR-V: naga wrote them from a module that it had checked, and only
        // decorations were added. They are of the version that Vulkan 1.1 takes. Arrays in a process are
        // indexed within their bounds; buffers are indexed by the engine's own numbers of cells and items,
        // which lie in the buffers that it binds, and within these by elements of their arrays, which the
        // text of the process proves or checks. Loops end where they end on the CPU, or at a fault.
        unsafe {
            self.device.create_shader_module_passthrough(wgpu::ShaderModuleDescriptorPassthrough {
                label: Some(&code.name),
                spirv: Some(words.into()),
                entry_points: entry_points.into(),
                ..wgpu::ShaderModuleDescriptorPassthrough::default()
            })
        }
    }
}

fn entry(binding: u32, access: Access) -> wgpu::BindGroupLayoutEntry {
    let ty = match access {
        Access::Uniform => wgpu::BufferBindingType::Uniform,
        Access::Read => wgpu::BufferBindingType::Storage { read_only: true },
        Access::Write => wgpu::BufferBindingType::Storage { read_only: false },
    };
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    }
}
