//! What is changed in code before a driver sees it.

mod loops;
mod module;
mod operation;
mod operations;

pub(super) use module::Checked;
pub(super) use operation::Manner;
pub(super) use operations::Replacements;

use module::{check, parse};

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

/// Reads WGSL, and replaces its operations one kind after the other.
pub(super) fn read(
    source: &str,
    replacements: &[Replacements],
    watch: Option<Watch>,
) -> Result<Checked, String> {
    let mut checked = parse(source)?;
    let mut source = source.to_owned();
    // What stands for operations has operations of its own, for which something else may stand, and which is
    // written first.
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
