//! The numbers by which MPI tells messages apart.

use xca_core::Face;
use xca_parts::Tag;

/// Tags of one execution.
const EACH: u32 = 16;

/// Numbers of executions come again after so many: MPI takes small numbers alone.
const EXECUTIONS: u32 = 1 << 20;

/// What a message of a job is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A message between parts.
    Part(Tag),
    /// The sender says nothing more in this execution.
    Ended,
    /// What the host wants of the job.
    Order,
    /// Where a process is.
    Place,
    /// What a process says of the engine of its part.
    Opened,
}

/// The number of a kind of message in an execution.
pub(crate) fn number(execution: u32, kind: Kind) -> i32 {
    let kind = match kind {
        Kind::Part(Tag::Command) => 0,
        Kind::Part(Tag::Reply) => 1,
        Kind::Part(Tag::Least) => 2,
        Kind::Ended => 3,
        Kind::Order => 4,
        Kind::Place => 5,
        Kind::Part(Tag::Edge(face)) => match face {
            Face::West => 6,
            Face::East => 7,
            Face::South => 8,
            Face::North => 9,
            Face::Bottom => 10,
            Face::Top => 11,
        },
        Kind::Opened => 12,
        Kind::Part(Tag::Rows) => 13,
    };
    // At most 2^24, which each MPI library takes in practice.
    (execution % EXECUTIONS * EACH) as i32 + kind
}

#[cfg(test)]
mod tests {
    use super::{Kind, number};
    use std::collections::BTreeSet;
    use xca_core::Face;
    use xca_parts::Tag;

    #[test]
    fn each_kind_in_each_execution_has_its_number() {
        let parts =
            [Tag::Command, Tag::Reply, Tag::Least, Tag::Rows].into_iter().chain(Face::ALL.map(Tag::Edge));
        let kinds: Vec<Kind> =
            parts.map(Kind::Part).chain([Kind::Ended, Kind::Order, Kind::Place, Kind::Opened]).collect();
        let all = |execution: u32| kinds.iter().map(move |kind| number(execution, *kind));
        let numbers: BTreeSet<i32> = [0, 1, 2, (1 << 20) - 1].into_iter().flat_map(all).collect();
        assert_eq!(numbers.len(), 4 * kinds.len());
        assert!(numbers.iter().all(|number| (0..1 << 24).contains(number)));
    }
}
