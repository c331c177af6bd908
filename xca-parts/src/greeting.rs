//! The first message of each part: its version, engine, model and cut. The host detects parts that do not
//! match.

use crate::shared::Shared;
use std::fmt::{Debug, Write as _};
use xca_core::model::Group;
use xca_core::{Model, Precision};

/// Properties that must be the same in all parts, as text that every build on every machine can read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Greeting {
    facts: Vec<(String, String)>,
}

/// The key of the reason of a part that cannot begin.
const DECLINED: &str = "declined";

impl Greeting {
    pub(crate) fn new(shared: &Shared, engine: &str) -> Self {
        let Shared { model, precision, cut } = shared;
        let byte_order = if cfg!(target_endian = "little") { "little-endian" } else { "big-endian" };
        let geometry = model.geometry();
        let space = (geometry.extents(), geometry.side(), geometry.boundaries(), geometry.neighbourhood());
        let parameters = model.parameters();
        let facts = [
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("byte order", byte_order.to_owned()),
            // Each engine has its own messages between parts.
            ("engine", engine.to_owned()),
            ("precision", precision.to_string()),
            ("model", model.name().to_owned()),
            ("space", checksum(&space)),
            ("substates", substates(model, *precision)),
            ("processes", processes(model)),
            ("parameters", checksum(&(parameters.names(), parameters.bits()))),
            ("cut", format!("{} x {} parts", cut.grid().y, cut.grid().z)),
        ];
        Self { facts: facts.into_iter().map(|(name, value)| (name.to_owned(), value)).collect() }
    }

    /// The greeting of a part that cannot begin.
    pub(crate) fn declined(reason: &str) -> Self {
        Self { facts: vec![(DECLINED.to_owned(), reason.replace('\n', "; "))] }
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut text = String::new();
        for (name, value) in &self.facts {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{name}={value}");
        }
        text.into_bytes()
    }

    /// Compares the greeting of another part with that of the host.
    pub(crate) fn check(&self, part: usize, bytes: &[u8]) -> Result<(), String> {
        let said = str::from_utf8(bytes).unwrap_or_default();
        let said: Vec<(&str, &str)> = said.lines().filter_map(|line| line.split_once('=')).collect();
        if let Some((DECLINED, reason)) = said.first() {
            return Err(format!("part {part}: {reason}"));
        }
        for (name, own) in &self.facts {
            let other = said.iter().find(|(said, _)| said == name).map_or("nothing", |(_, value)| *value);
            if other != own {
                return Err(format!(
                    "part {part} differs in its {name}: {other} in place of {own} of part 0; start the same program with \
                     the same options and files for all parts"
                ));
            }
        }
        Ok(())
    }
}

/// The checksum of names, types, outside values and slots.
fn substates(model: &Model, precision: Precision) -> String {
    let outside = |group: &Group| {
        let fields = 0..group.schema().fields.len();
        fields.map(|field| group.outside(field, precision)).collect::<Vec<_>>()
    };
    let all = model.groups().iter().map(|group| (group.schema(), group.kind(), outside(group)));
    checksum(&all.collect::<Vec<_>>())
}

/// The checksum of the processes in their order: reads, writes and bodies.
fn processes(model: &Model) -> String {
    let all = model.processes().iter();
    let all = all.map(|process| (process.name, process.every, process.access, (process.body)()));
    checksum(&all.collect::<Vec<_>>())
}

/// The checksum of the text of data. Leaves out the addresses of functions, which differ between processes.
fn checksum(data: &impl Debug) -> String {
    let (text, mut sum) = (format!("{data:?}"), crc32fast::Hasher::new());
    for (number, piece) in text.split("0x").enumerate() {
        let is_address = |character: char| number > 0 && character.is_ascii_hexdigit();
        sum.update(piece.trim_start_matches(is_address).as_bytes());
    }
    format!("checksum {:08x}", sum.finalize())
}
