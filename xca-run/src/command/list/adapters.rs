//! The adapters of the gpu engine, where the program is built with it.

#[cfg(feature = "gpu")]
use crate::table::table_with_notes;
#[cfg(not(feature = "gpu"))]
use crate::table::{WIDTH, wrapped};
use serde_json::Value;

/// As a table, or why there is none.
#[cfg(feature = "gpu")]
pub(super) fn as_text() -> String {
    let adapters = xca_gpu::adapters();
    if adapters.is_empty() {
        return xca_gpu::GpuError::NoAdapter.to_string();
    }
    let rows = adapters.into_iter().map(|adapter| {
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
        let row = [adapter.number.to_string(), adapter.interface, floats.to_owned()];
        (row, vec![format!("{}, {}", adapter.name, adapter.kind), limits])
    });
    table_with_notes(["adapter", "interface", "floats"], rows)
}

/// As data.
#[cfg(feature = "gpu")]
pub(super) fn as_json() -> Vec<Value> {
    let adapters = xca_gpu::adapters().into_iter().map(|adapter| {
        serde_json::json!({
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
    adapters.collect()
}

/// Why there is none.
#[cfg(not(feature = "gpu"))]
pub(super) fn as_text() -> String {
    let text = format!("gpu engine: {}", crate::engines::MissingFeature::GPU);
    wrapped(&text, WIDTH).join("\n")
}

/// None.
#[cfg(not(feature = "gpu"))]
pub(super) fn as_json() -> Vec<Value> {
    Vec::new()
}
