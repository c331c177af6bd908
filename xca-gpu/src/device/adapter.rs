//! Adapters: the devices that this machine offers.

use super::instance::{self, BACKENDS};
use std::fmt;

/// What is known of an adapter before it is used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Adapter {
    /// Its number in the list of [`crate::adapters`].
    pub number: usize,
    /// Its name, as its driver gives it.
    pub name: String,
    /// The driver, with its version.
    pub driver: String,
    /// The interface that it is reached by: `vulkan`, `metal`, `dx12`.
    pub interface: String,
    /// What kind of device it is.
    pub kind: AdapterKind,
    /// Whether it computes with 64-bit floats.
    pub has_f64: bool,
    /// Whether strict arithmetic can be asked of it; whether it keeps to it is proved when it is opened.
    pub may_be_strict: bool,
    /// The largest buffer in bytes.
    pub largest_buffer: u64,
    /// The largest part of a buffer that a process can reach at once, in bytes.
    pub largest_binding: u64,
    /// The most buffers that a process can use.
    pub buffers: u32,
}

/// What kind of device an adapter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AdapterKind {
    /// A graphics card.
    Discrete,
    /// A graphics unit beside the processor's cores.
    Integrated,
    /// A part of a graphics card, lent to a virtual machine.
    Virtual,
    /// No GPU: the processor itself plays one.
    Processor,
    /// Unknown.
    Other,
}

impl fmt::Display for AdapterKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Discrete => "graphics card",
            Self::Integrated => "integrated GPU",
            Self::Virtual => "virtual GPU",
            Self::Processor => "the processor, no GPU",
            Self::Other => "unknown kind",
        })
    }
}

impl fmt::Display for Adapter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}, {})", self.name, self.interface, self.kind)
    }
}

/// Which adapter to take.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum AdapterChoice {
    /// A graphics card before an integrated GPU before anything else.
    #[default]
    Best,
    /// By its number in the list of [`crate::adapters`].
    Number(usize),
    /// The first whose name contains this text, in any case.
    Name(String),
    /// For the part of a space with this number on its machine: the best adapter and those of its kind and
    /// interface, in turns.
    Turn(usize),
}

impl From<&str> for AdapterChoice {
    /// A number, `turn` with a number, or a part of a name.
    fn from(text: &str) -> Self {
        let turn = text.strip_prefix("turn ").and_then(|number| number.parse().ok()).map(Self::Turn);
        turn.unwrap_or_else(|| text.parse().map_or_else(|_| Self::Name(text.to_owned()), Self::Number))
    }
}

impl Adapter {
    pub(super) fn describe(number: usize, adapter: &wgpu::Adapter) -> Self {
        let (info, limits, features) = (adapter.get_info(), adapter.limits(), adapter.features());
        let driver = [info.driver, info.driver_info].join(" ").trim().to_owned();
        Self {
            number,
            name: info.name,
            driver,
            interface: info.backend.to_str().to_owned(),
            kind: match info.device_type {
                wgpu::DeviceType::DiscreteGpu => AdapterKind::Discrete,
                wgpu::DeviceType::IntegratedGpu => AdapterKind::Integrated,
                wgpu::DeviceType::VirtualGpu => AdapterKind::Virtual,
                wgpu::DeviceType::Cpu => AdapterKind::Processor,
                wgpu::DeviceType::Other => AdapterKind::Other,
            },
            has_f64: features.contains(wgpu::Features::SHADER_F64),
            may_be_strict: info.backend == wgpu::Backend::Vulkan
                && features.contains(wgpu::Features::PASSTHROUGH_SHADERS),
            largest_buffer: limits.max_buffer_size,
            largest_binding: limits.max_storage_buffer_binding_size,
            buffers: limits.max_storage_buffers_per_shader_stage,
        }
    }

    /// The better, the smaller.
    fn rank(&self) -> usize {
        match self.kind {
            AdapterKind::Discrete => 0,
            AdapterKind::Integrated => 1,
            AdapterKind::Virtual => 2,
            AdapterKind::Other => 3,
            AdapterKind::Processor => 4,
        }
    }
}

/// All adapters with what is known of them.
pub(super) fn all() -> Vec<(wgpu::Adapter, Adapter)> {
    let adapters = instance::open().map(|instance| pollster::block_on(instance.enumerate_adapters(BACKENDS)));
    adapters
        .unwrap_or_default()
        .into_iter()
        .enumerate()
        .map(|(number, adapter)| {
            let description = Adapter::describe(number, &adapter);
            (adapter, description)
        })
        .collect()
}

impl AdapterChoice {
    /// The number of the adapter that is meant.
    pub(super) fn of(&self, adapters: &[Adapter]) -> Option<usize> {
        let best = adapters.iter().min_by_key(|adapter| (adapter.rank(), adapter.number));
        match self {
            Self::Best => best,
            Self::Turn(number) => {
                let alike = |adapter: &&Adapter| {
                    best.is_some_and(|best| {
                        (adapter.kind, &adapter.interface) == (best.kind, &best.interface)
                    })
                };
                let alike: Vec<&Adapter> = adapters.iter().filter(alike).collect();
                number.checked_rem(alike.len()).map(|turn| alike[turn])
            }
            Self::Number(number) => adapters.iter().find(|adapter| adapter.number == *number),
            Self::Name(name) => {
                let wanted = name.to_lowercase();
                adapters.iter().find(|adapter| adapter.name.to_lowercase().contains(&wanted))
            }
        }
        .map(|adapter| adapter.number)
    }
}

impl fmt::Display for AdapterChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Best => f.write_str("any"),
            Self::Number(number) => write!(f, "number {number}"),
            Self::Name(name) => write!(f, "`{name}`"),
            Self::Turn(number) => write!(f, "turn {number}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adapter(number: usize, name: &str, kind: AdapterKind) -> Adapter {
        Adapter {
            number,
            name: name.to_owned(),
            driver: String::new(),
            interface: "vulkan".to_owned(),
            kind,
            has_f64: true,
            may_be_strict: true,
            largest_buffer: 0,
            largest_binding: 0,
            buffers: 0,
        }
    }

    #[test]
    fn choices_by_rank_number_and_name() {
        let adapters = [
            adapter(0, "llvmpipe", AdapterKind::Processor),
            adapter(1, "Intel Graphics", AdapterKind::Integrated),
            adapter(2, "GeForce", AdapterKind::Discrete),
        ];
        assert_eq!(AdapterChoice::Best.of(&adapters), Some(2));
        assert_eq!(AdapterChoice::from("1").of(&adapters), Some(1));
        assert_eq!(AdapterChoice::from("LLVM").of(&adapters), Some(0));
        assert_eq!(AdapterChoice::from("3").of(&adapters), None);
        assert_eq!(AdapterChoice::from("radeon").of(&adapters), None);
        assert_eq!(AdapterChoice::Best.of(&adapters[..1]), Some(0));
    }

    #[test]
    fn parts_take_the_best_adapters_in_turns() {
        let mut adapters = [
            adapter(0, "llvmpipe", AdapterKind::Processor),
            adapter(1, "GeForce", AdapterKind::Discrete),
            adapter(2, "Intel Graphics", AdapterKind::Integrated),
            adapter(3, "GeForce", AdapterKind::Discrete),
            adapter(4, "GeForce", AdapterKind::Discrete),
        ];
        // The same card by another interface.
        adapters[4].interface = "dx12".to_owned();
        let turns = |adapters: &[Adapter]| {
            [0, 1, 2, 3].map(|part| AdapterChoice::from(&*format!("turn {part}")).of(adapters))
        };
        assert_eq!(turns(&adapters), [1, 3, 1, 3].map(Some));
        assert_eq!(turns(&adapters[..1]), [Some(0); 4]);
        assert_eq!(turns(&[]), [None; 4]);
        assert_eq!(AdapterChoice::from("turn"), AdapterChoice::Name("turn".to_owned()));
    }
}
