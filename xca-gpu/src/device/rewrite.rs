//! What is changed in code before a driver sees it.

mod loops;
mod operations;

pub(super) use operations::{Manner, Replacements};

use naga::Module;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

/// What stands in the buffer of watched loops before one was ended early.
pub(crate) const UNTOUCHED: [u32; 4] = [0, u32::MAX, 0, 0];

/// Loops that are watched: see [`loops::watch`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Watch {
    /// The binding of the buffer where it is noted that a loop was ended early.
    pub(super) binding: u32,
    /// What is noted.
    pub(super) number: u32,
}

/// A checked module.
pub(super) struct Checked {
    pub(super) module: Module,
    pub(super) info: ModuleInfo,
}

/// Reads WGSL, and replaces its operations one kind after the other.
pub(super) fn read(
    source: &str,
    replacements: &[Replacements],
    watch: Option<Watch>,
) -> Result<Checked, String> {
    let mut checked = parse(source)?;
    let mut source = source.to_owned();
    // What stands for operations has operations of its own, for which something else may stand, and which is written first.
    for replacements in replacements {
        let text = replacements.text(&checked);
        if !text.is_empty() {
            source = text + &source;
            checked = parse(&source)?;
        }
    }
    for replacements in replacements {
        if operations::replace(&mut checked, *replacements)? {
            checked.info = check(&checked.module, &source)?;
        }
    }
    if let Some(Watch { binding, number }) = watch {
        loops::watch(&mut checked.module, binding, number);
        checked.info = check(&checked.module, &source)?;
    }
    Ok(checked)
}

fn parse(source: &str) -> Result<Checked, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    let info = check(&module, source)?;
    Ok(Checked { module, info })
}

fn check(module: &Module, source: &str) -> Result<ModuleInfo, String> {
    Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(module)
        .map_err(|error| error.emit_to_string(source))
}
