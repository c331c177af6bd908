//! The door to the drivers of this machine. No window is ever drawn to.
#![allow(unsafe_code)]

/// OpenGL has neither f64 nor what strict arithmetic needs.
pub(super) const BACKENDS: wgpu::Backends =
    wgpu::Backends::VULKAN.union(wgpu::Backends::METAL).union(wgpu::Backends::DX12);

/// The door, or nothing where there are no drivers.
#[cfg(target_os = "linux")]
pub(super) fn open() -> Option<wgpu::Instance> {
    use wgpu::hal;
    let description = hal::InstanceDescriptor {
        name: "xca",
        // The engine's own shaders write the sizes of dispatches, within the limits.
        flags: wgpu::InstanceFlags::from_build_config().with_env()
            - wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL,
        memory_budget_thresholds: wgpu::MemoryBudgetThresholds::default(),
        backend_options: wgpu::BackendOptions::default(),
        telemetry: None,
        display: None,
    };
    // With Wayland's extension a layer of Mesa looks for a desktop, and complains on stderr where there is
    // none.
    let without_wayland = |given: hal::vulkan::CreateInstanceCallbackArgs<'_, '_, '_>| {
        given.extensions.retain(|name| *name != c"VK_KHR_wayland_surface");
    };
    // SAFETY: nothing is added. Of what may not be taken away in general, only the surfaces of Wayland are:
    // what is left is the list of a machine without Wayland, which the library provides for. It asks the list
    // before it makes such a surface, and this crate makes no surface at all.
    let instance =
        unsafe { hal::vulkan::Instance::init_with_callback(&description, Some(Box::new(without_wayland))) };
    // SAFETY: the instance was made just now, belongs to nobody else, and is given away here.
    Some(unsafe { wgpu::Instance::from_hal::<hal::api::Vulkan>(instance.ok()?) })
}

/// The door.
#[cfg(not(target_os = "linux"))]
pub(super) fn open() -> Option<wgpu::Instance> {
    let description = wgpu::InstanceDescriptor::new_without_display_handle();
    Some(wgpu::Instance::new(wgpu::InstanceDescriptor { backends: BACKENDS, ..description }))
}
