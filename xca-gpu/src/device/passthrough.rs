//! Code that reaches the driver as SPIR-V, unchecked.
#![allow(unsafe_code)]

use super::rewrite::Checked;
use super::{Code, exact};

/// The words of valid SPIR-V.
pub(super) struct Spirv(Vec<u32>);

impl Spirv {
    /// Translates a module that was checked.
    pub(super) fn of(checked: &Checked) -> Result<Self, String> {
        exact::spirv(checked).map(Self)
    }
}

/// What has to be said to be given shader passthrough.
pub(super) fn experimental_features() -> wgpu::ExperimentalFeatures {
    // SAFETY: the only experimental feature that is ever asked for is the passthrough of shaders, which is
    // used in one place, below, where its own conditions are met.
    unsafe { wgpu::ExperimentalFeatures::enabled() }
}

/// Hands code to the driver as SPIR-V, unchecked.
pub(super) fn module(device: &wgpu::Device, code: &Code, spirv: Spirv) -> wgpu::ShaderModule {
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
        device.create_shader_module_passthrough(wgpu::ShaderModuleDescriptorPassthrough {
            label: Some(&code.name),
            spirv: Some(spirv.0.into()),
            entry_points: entry_points.into(),
            ..wgpu::ShaderModuleDescriptorPassthrough::default()
        })
    }
}
