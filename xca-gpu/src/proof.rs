//! Strict arithmetic, proved.
use crate::device::Device;
pub(crate) fn of_strictness(device: &Device) -> Result<(), String> {
    if device.adapter().may_be_strict { Ok(()) } else { Err("no".to_owned()) }
}
