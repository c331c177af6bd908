//! Modules that have been checked.

use naga::Module;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

/// A checked module.
pub(in crate::device) struct Checked {
    pub(in crate::device) module: Module,
    pub(in crate::device) info: ModuleInfo,
}

/// Reads WGSL.
pub(super) fn parse(source: &str) -> Result<Checked, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    let info = check(&module, source)?;
    Ok(Checked { module, info })
}

/// Checks a module.
pub(super) fn check(module: &Module, source: &str) -> Result<ModuleInfo, String> {
    Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(module)
        .map_err(|error| error.emit_to_string(source))
}
