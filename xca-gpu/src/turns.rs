//! Whether the device ends loops early, and after how many turns.

use crate::device::{Access, Code, Device, DeviceError, UNTOUCHED};
use std::num::NonZeroU32;

/// More turns than this are not tried: some tens of milliseconds on a slow device.
const TRIED: u32 = 1 << 20;

/// A loop in a loop, whose turns nobody can foresee without doing them.
const SOURCE: &str = "@group(0) @binding(0) var<storage, read> wanted: array<u32>;
@group(0) @binding(1) var<storage, read_write> done: array<u32>;

@compute @workgroup_size(1)
fn main() {
    var word = wanted[2];
    var turns = 0u;
    for (var outer = 0u; outer < wanted[0]; outer += 1u) {
        for (var inner = 0u; inner < wanted[1]; inner += 1u) {
            word = word * 1664525u + 1013904223u;
            turns += select(1u, 0u, word == wanted[3]);
        }
    }
    done[0] = turns;
    done[1] = word;
}
";

/// How many turns the loops of an invocation may take together, where the device ends them early: of one long
/// loop, and of many short ones.
pub(crate) fn limit(device: &Device) -> Result<Option<u32>, DeviceError> {
    let mut least = None;
    let side = TRIED.isqrt();
    for [outer, inner] in [[1, TRIED], [side, TRIED / side]] {
        let [found, word, _] = turns(device, [outer, inner], None)?;
        let (wanted_turns, wanted_word) = foreseen(outer * inner);
        if found < wanted_turns {
            least = Some(least.map_or(found, |least: u32| least.min(found)));
            // What cuts loops must at least be caught at it.
            let [.., note] = turns(device, [outer, inner], NonZeroU32::new(NOTE))?;
            if note != NOTE {
                return Err(refused("it ends loops early, and hides it"));
            }
        } else if word != wanted_word {
            return Err(refused("it counts wrongly"));
        }
    }
    Ok(least)
}

/// A word that comes up only by chance in the sequence from [`START`].
const STOP: u32 = 0;
const START: u32 = 1;
/// What is noted of a loop that is ended early.
const NOTE: u32 = 7;

/// What the loops come to on a device that does all their turns.
fn foreseen(turns: u32) -> (u32, u32) {
    let mut counted = 0;
    let mut word = START;
    for _ in 0..turns {
        word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        counted += u32::from(word != STOP);
    }
    (counted, word)
}

fn refused(reason: &str) -> DeviceError {
    DeviceError::Refused { what: "to count the turns of a loop".to_owned(), reason: reason.to_owned() }
}

/// The turns that the device does, the last word, and what is noted of loops that it ends early, where they
/// are watched.
fn turns(
    device: &Device,
    [outer, inner]: [u32; 2],
    watched: Option<NonZeroU32>,
) -> Result<[u32; 3], DeviceError> {
    let code = Code {
        name: "the count of turns".to_owned(),
        source: SOURCE.to_owned(),
        workgroup: [1, 1, 1],
        buffers: vec![Access::Read, Access::Write],
        strict: None,
        watched,
    };
    let wanted = device.buffer("turns", 16)?;
    device.upload(&wanted, 0, bytemuck::cast_slice(&[outer, inner, START, STOP]))?;
    let done = device.buffer("turns", 8)?;
    let note = device.buffer("loops ended early", 16)?;
    device.upload(&note, 0, bytemuck::cast_slice(&UNTOUCHED))?;
    let mut parts = vec![(&wanted).into(), (&done).into()];
    parts.extend(watched.map(|_| (&note).into()));
    let bindings = device.bind(&device.pipeline(&code)?, &parts)?;
    let mut recorder = device.recorder();
    recorder.run(&bindings, [1, 1, 1]);
    device.submit(recorder)?;
    let words: Vec<u32> = bytemuck::pod_collect_to_vec(&device.download(&done, 0..8)?);
    let note: Vec<u32> = bytemuck::pod_collect_to_vec(&device.download(&note, 0..4)?);
    Ok([words[0], words[1], note[0]])
}
