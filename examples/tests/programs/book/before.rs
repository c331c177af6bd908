//! Runs that commands of the book take for granted: what they go on from, or look at.

use super::command::Command;

/// A run before a command of a page.
pub(super) struct Before {
    page: &'static str,
    command: &'static str,
    pub(super) program: &'static str,
    pub(super) options: &'static str,
}

pub(super) const BEFORE: &[Before] = &[
    Before {
        page: "docs/checkpoints.md",
        command: "cargo run --release --bin lava -- resume out/lava --checkpoint-every 1",
        program: "lava",
        options: "--steps 4 --checkpoint-every 2",
    },
    Before {
        page: "docs/many-machines.md",
        command: "mpirun -n 8 cadem resume out/cadem",
        program: "cadem",
        options: "--steps 4 --checkpoint-every 2",
    },
    Before {
        page: "docs/many-machines.md",
        command: "cadem resume out/cadem --engine cpu",
        program: "cadem",
        options: "--steps 4 --checkpoint-every 2",
    },
];

impl Before {
    pub(super) fn is_before(&self, command: &Command) -> bool {
        (self.page, self.command) == (&command.page, &command.text)
    }
}
