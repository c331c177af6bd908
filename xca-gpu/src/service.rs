//! The engine's own shaders: what happens between processes. They compute with integers alone.

use crate::device::{Access, Binding, Bindings, Code, Device, DeviceError, Recorder};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt::Write as _;
use std::num::NonZeroU32;

const COMMON: &str = include_str!("shaders/common.wgsl");

/// A shader of the engine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Service {
    name: &'static str,
    source: &'static str,
    workgroup: u32,
    buffers: &'static [Access],
    /// Whether it has loops that may be long: one more buffer is bound, where the device ends loops early.
    long: bool,
}

use Access::{Read, Uniform, Write};

macro_rules! services {
    ($($constant:ident = $file:literal $(after $base:literal)?, $workgroup:literal, [$($access:ident),+];)*) => {$(
        pub(crate) const $constant: Service = Service {
            name: $file,
            source: concat!(
                $(include_str!(concat!("shaders/", $base, ".wgsl")),)?
                include_str!(concat!("shaders/", $file, ".wgsl")),
            ),
            workgroup: $workgroup,
            buffers: &[$($access),+],
            long: matches!($file.as_bytes(), b"sort"),
        };
    )*

        #[cfg(test)]
        const ALL: &[Service] = &[$($constant),*];
    };
}

services! {
    ADVANCE = "advance", 1, [Write, Write];
    AIM = "aim", 256, [Uniform, Write, Write, Read, Read, Read, Write, Write];
    DEPART = "depart", 1, [Write, Write];
    FERRY = "ferry", 256, [Read, Write, Write];
    GATHER = "gather", 256, [Write, Write, Read, Read, Write];
    MIRROR = "mirror", 256, [Read, Write];
    OCCUPANCY = "occupancy", 64, [Uniform, Read, Read, Write];
    PLACE = "place", 256, [Write, Write, Read, Read, Write, Write];
    SEAL_REPORT = "seal_report" after "seal", 1, [Uniform, Write, Write];
    SEAL_AIM = "seal_aim" after "seal", 1, [Uniform, Write, Write, Read, Read, Read];
    SEAL_FULL = "seal_full" after "seal", 1, [Uniform, Write, Write, Read, Read];
    SELECT = "select", 256, [Read, Write, Write];
    SORT = "sort", 256, [Uniform, Write, Write, Read, Write, Read, Write];
    SPREAD_BLOCKS = "spread_blocks" after "blocks", 64, [Read, Read, Write];
    SUM_BLOCKS = "sum_blocks" after "blocks", 64, [Read, Write];
}

/// The number by which [`SORT`] is known where its loops are ended early.
pub(crate) const SORTING: NonZeroU32 = NonZeroU32::MAX;

/// What [`SUM_BLOCKS`] and [`SPREAD_BLOCKS`] work on in one workgroup.
pub(crate) const BLOCK: usize = 1024;

/// The engine's shaders with what they are bound to.
#[derive(Debug, Default)]
pub(crate) struct Services {
    bound: HashMap<Key, Bindings>,
}

/// A shader, its constants, and its buffers.
type Key = (&'static str, Vec<usize>, Vec<(u64, u64)>);

impl Services {
    /// Records a shader with its constants and buffers for so many invocations.
    pub(crate) fn run(
        &mut self,
        device: &Device,
        recorder: &mut Recorder,
        service: Service,
        (constants, parts): (&[(&str, usize)], &[Binding]),
        invocations: usize,
    ) -> Result<(), DeviceError> {
        let values = constants.iter().map(|(_, value)| *value).collect();
        let key = (service.name, values, parts.iter().map(Binding::key).collect());
        let bindings = match self.bound.entry(key) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert(service.bind(device, constants, parts)?),
        };
        recorder.run(bindings, workgroups(device, invocations.div_ceil(service.workgroup as usize)));
        Ok(())
    }

    /// Forgets buffers that are no longer there.
    pub(crate) fn forget(&mut self) {
        self.bound.clear();
    }
}

impl Service {
    fn bind(
        self,
        device: &Device,
        constants: &[(&str, usize)],
        parts: &[Binding],
    ) -> Result<Bindings, DeviceError> {
        let watched = device.turns().filter(|_| self.long).map(|_| SORTING);
        device.bind(&device.pipeline(&self.code(constants, watched))?, parts)
    }

    fn code(self, constants: &[(&str, usize)], watched: Option<NonZeroU32>) -> Code {
        Code {
            name: format!("the engine's shader `{}`", self.name),
            source: self.text(constants),
            workgroup: [self.workgroup, 1, 1],
            buffers: self.buffers.to_vec(),
            strict: None,
            watched,
        }
    }

    /// The whole text.
    fn text(self, constants: &[(&str, usize)]) -> String {
        let mut text = COMMON.to_owned();
        for (name, value) in constants {
            // A condition that is known before is a constant too.
            let value = if *name == "PICK_UP" { (*value != 0).to_string() } else { format!("{value}u") };
            let _ = writeln!(text, "const {name} = {value};");
        }
        text + self.source
    }
}

/// So many workgroups in a row, or where a row does not hold them, in several.
pub(crate) fn workgroups(device: &Device, number: usize) -> [u32; 3] {
    let most = device.most_workgroups() as usize;
    let rows = number.div_ceil(most).max(1);
    [number.div_ceil(rows) as u32, rows as u32, 1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::in_pieces;

    fn assert_valid(name: &str, text: &str) {
        let module = naga::front::wgsl::parse_str(text)
            .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(text)));
        let flags = naga::valid::ValidationFlags::all();
        let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
        validator.validate(&module).unwrap_or_else(|error| panic!("{name}: {error:?}"));
    }

    /// Also with all arrays bound in three pieces, where they are used value by value.
    #[test]
    fn all_are_valid_wgsl() {
        let constants = [("WORDS", 2), ("PAIRS", 3), ("CROSSINGS", 3), ("FIRST", 1), ("PICK_UP", 1)];
        let names =
            ["TILES", "ALONG_X", "ALONG_Y", "SIZE_X", "SIZE_Y", "SIZE_Z", "CELLS_X", "CELLS_Y", "CELLS_Z"];
        let more = ["REACH_X", "REACH_Y", "REACH_Z", "MOST", "REGION", "SOURCES", "PLACE"];
        let constants: Vec<_> =
            constants.into_iter().chain(names.into_iter().chain(more).map(|name| (name, 1))).collect();
        let mut refused = Vec::new();
        for service in ALL {
            let code = service.code(&constants, None);
            assert_valid(service.name, &code.source);
            let numbers = 0..service.buffers.len();
            let is_array = |number| {
                let start = format!("@group(0) @binding({number}) ");
                code.source.lines().any(|line| line.starts_with(&start) && line.ends_with(">;"))
            };
            let counts: Vec<usize> = numbers.map(|number| if is_array(number) { 3 } else { 1 }).collect();
            match in_pieces(&code, &counts) {
                Ok(code) => {
                    assert_eq!(code.buffers.len(), counts.iter().sum::<usize>());
                    assert_valid(service.name, &code.source);
                }
                Err(_) => refused.push(service.name),
            }
        }
        // Their buffers have words for each group, or for each tile.
        assert_eq!(refused, ["advance", "select"]);
    }
}
