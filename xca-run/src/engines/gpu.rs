//! The engine for graphics adapters. All that the command line knows of adapters is here, also of a program
//! that was built without the engine.

use super::kind::{Devices, EngineKind};
use super::options::{EngineOption, EngineOptions};
use xca_core::{Engine, Model, Precision};
use xca_record::Failure;

/// Has an adapter, and a way to do float arithmetic.
#[derive(Debug)]
pub(super) struct GpuKind;

pub(super) const ADAPTER: EngineOption = EngineOption {
    name: "adapter",
    value_name: "N|NAME",
    about: "Adapter of the gpu engine: its number or part of its name; `list` shows both [default: the best]",
    check: |_| Ok(()),
};

const ARITHMETIC: EngineOption = EngineOption {
    name: "arithmetic",
    value_name: "strict|relaxed|best",
    about: "Float arithmetic of the gpu engine: strict (the bits of the other engines), relaxed (the driver's \
            own), or best (strict where the adapter passes the test) [default: best]",
    check: |text| match text {
        "best" | "strict" | "relaxed" => Ok(()),
        other => Err(format!("unknown arithmetic `{other}`; use best, strict or relaxed")),
    },
};

impl EngineKind for GpuKind {
    fn name(&self) -> &'static str {
        "gpu"
    }

    fn about(&self) -> &'static str {
        "A graphics card, or software Vulkan"
    }

    fn options(&self) -> &'static [EngineOption] {
        &[ADAPTER, ARITHMETIC]
    }

    fn make(&self, options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        built::make(options)
    }

    fn devices(&self) -> Option<Devices> {
        Some(built::devices())
    }

    fn source(&self, model: &Model, precision: Precision) -> Option<Result<String, Failure>> {
        Some(built::source(model, precision))
    }
}

/// With the engine.
#[cfg(feature = "gpu")]
mod built {
    use super::{ADAPTER, ARITHMETIC};
    use crate::engines::{Devices, EngineOptions};
    use serde_json::json;
    use xca_core::{Engine, Model, Precision};
    use xca_gpu::{Adapter, AdapterChoice, Arithmetic, Gpu, GpuError, GpuOptions, adapters};
    use xca_record::Failure;
    use xca_report::table::table_with_notes;

    pub(super) fn make(options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        let arithmetic = match options.get(ARITHMETIC.name) {
            Some("strict") => Arithmetic::Strict,
            Some("relaxed") => Arithmetic::Relaxed,
            _ => Arithmetic::Best,
        };
        let adapter = options.get(ADAPTER.name).map(AdapterChoice::from).unwrap_or_default();
        Ok(Box::new(Gpu::new(&GpuOptions { adapter, arithmetic, ..GpuOptions::default() })?))
    }

    pub(super) fn source(model: &Model, precision: Precision) -> Result<String, Failure> {
        Ok(xca_gpu::wgsl(model, precision)?)
    }

    pub(super) fn devices() -> Devices {
        let adapters = adapters();
        let data = adapters.iter().map(|adapter| {
            json!({
                "number": adapter.number,
                "name": adapter.name,
                "driver": adapter.driver,
                "interface": adapter.interface,
                "kind": adapter.kind.to_string(),
                "f64": adapter.has_f64,
                "may_be_strict": adapter.may_be_strict,
                "largest_buffer": adapter.largest_buffer,
                "largest_binding": adapter.largest_binding,
                "buffers": adapter.buffers,
            })
        });
        let text = match adapters.as_slice() {
            [] => GpuError::NoAdapter.to_string(),
            adapters => table_with_notes(["adapter", "interface", "floats"], adapters.iter().map(row)),
        };
        Devices { data: data.collect(), text }
    }

    fn row(adapter: &Adapter) -> ([String; 3], Vec<String>) {
        let floats = match (adapter.has_f64, adapter.may_be_strict) {
            (true, true) => "f32, f64, strict if proved",
            (true, false) => "f32, f64, relaxed",
            (false, true) => "f32, strict if proved",
            (false, false) => "f32, relaxed",
        };
        let megabytes = |bytes: u64| format!("{} MB", bytes >> 20);
        let limits = format!(
            "largest buffer {}, in reach at once {}, {} buffers",
            megabytes(adapter.largest_buffer),
            megabytes(adapter.largest_binding),
            adapter.buffers
        );
        let row = [adapter.number.to_string(), adapter.interface.clone(), floats.to_owned()];
        (row, vec![format!("{}, {}", adapter.name, adapter.kind), limits])
    }
}

/// Without the engine: what to do to have it.
#[cfg(not(feature = "gpu"))]
mod built {
    use crate::engines::{Devices, EngineOptions, MissingFeature};
    use xca_core::{Engine, Model, Precision};
    use xca_record::Failure;
    use xca_report::table::{WIDTH, wrapped};

    const MISSING: MissingFeature = MissingFeature { feature: "gpu" };

    pub(super) fn make(_options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
        Err(MISSING.into())
    }

    pub(super) fn source(_model: &Model, _precision: Precision) -> Result<String, Failure> {
        Err(MISSING.into())
    }

    pub(super) fn devices() -> Devices {
        let text = wrapped(&format!("gpu engine: {MISSING}"), WIDTH).join("\n");
        Devices { text, data: Vec::new() }
    }
}
