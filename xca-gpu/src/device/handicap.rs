//! An adapter made worse than it is, so that what the engine does at the limits of adapters can be tried on
//! any of them.

/// Limits below those of the adapter, and operations that are worse. They change time and memory, never a
/// result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Handicap {
    /// The most bytes of a buffer in a binding. Larger substates of cells are worked on in sections; larger
    /// buffers of other kinds are bound in pieces.
    pub reach: Option<u64>,
    /// The most invocations of a workgroup.
    pub workgroup: Option<u32>,
    /// The most workgroups along an axis of a dispatch. A dispatch has at most the square of it.
    pub workgroups: Option<u32>,
    /// From how many tiles on it is looked for those where something can change.
    pub tiles: Option<usize>,
    /// The most buffers that a process uses, uniform ones left out.
    pub buffers: Option<u32>,
    /// Whether strict code divides, takes square roots and makes numbers whole by the corrected versions,
    /// though the adapter's own are right.
    pub corrected: bool,
    /// Whether strict code divides and takes square roots with the last digits wrong.
    pub rough: bool,
}

/// The lower of a limit and its handicap, and at least 1.
pub(super) fn lower<T: Ord + From<u8>>(limit: T, handicap: Option<T>) -> T {
    match handicap {
        Some(handicap) => limit.min(handicap.max(T::from(1))),
        None => limit,
    }
}
