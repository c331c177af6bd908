//! Compilation of WGSL to pipelines, strictly or as the driver likes.

use super::corrections::Corrections;
use super::passthrough::{self, Spirv};
use super::rewrite::{self, Manner, Replacements, Watch};
use super::{Access, Code, Device, DeviceError, Pipeline};
use std::borrow::Cow;
use std::sync::{Arc, PoisonError};

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
        let spirv = match &checked {
            Some(checked) if code.strict.is_some() => Some(Spirv::of(checked).map_err(refused)?),
            _ => None,
        };
        self.guarded(&what, || {
            let module = if let Some(spirv) = spirv {
                passthrough::module(&self.device, code, spirv)
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
            Pipeline { pipeline, layout, code: code.clone() }
        })
    }

    /// What is replaced in strict code.
    fn replacements(&self, corrections: Corrections) -> Vec<Replacements> {
        let corrected = Replacements { manner: Manner::Corrected, of: corrections };
        let rough = Replacements { manner: Manner::Rough, of: Corrections::ALL };
        if self.handicap.rough { vec![corrected, rough] } else { vec![corrected] }
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
